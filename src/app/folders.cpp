// Reading folders and typed paths for the file browser.

#include "app/file_browser.h"

#include "base/lower_case.h"
#include "base/quoted.h"
#include "io/cloud_file.h"
#include "io/format.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace knead {

namespace {

bool is_cloud(const std::filesystem::path& file) {
    return has_cloud_extension(file);
}
bool is_picture(const std::filesystem::path& file) {
    return lower_case(file.extension().string()) == ".png";
}

// Whether a file is of the kind that is looked for, or that is saved.
bool is_meant(BrowseFor purpose, const std::filesystem::path& file) {
    switch (purpose) {
    case BrowseFor::save_session:
    case BrowseFor::take_handles:
        return has_session_extension(file);
    case BrowseFor::save_cloud:
    case BrowseFor::cloud_of_session:
        return is_cloud(file);
    case BrowseFor::save_picture:
        return is_picture(file);
    default:
        return has_session_extension(file) || is_cloud(file);
    }
}

bool by_name(const FolderEntry& a, const FolderEntry& b) {
    if (a.is_folder != b.is_folder) return a.is_folder;
    const std::string first = lower_case(a.name), second = lower_case(b.name);
    return first != second ? first < second : a.name < b.name;
}

// What follows a dot is a number in "walk 1.2", and no extension.
bool lacks_extension(const std::filesystem::path& file) {
    return file.extension().string().find_first_not_of(".0123456789") == std::string::npos;
}

// Whether what is typed names a file, be it there or not.
bool names_file(const FileBrowser& browser) {
    std::error_code ignored;
    return std::filesystem::path(browser.typed).has_filename() &&
           !std::filesystem::is_directory(typed_path(browser), ignored);
}

} // namespace

void read_folder(FileBrowser& browser) {
    browser.entries.clear();
    browser.trouble.clear();
    browser.missing_folder.clear();
    browser.chosen = -1;
    std::error_code trouble;
    if (browser.folder.empty()) browser.folder = std::filesystem::current_path(trouble);
    std::filesystem::directory_iterator entry(browser.folder, trouble);
    if (trouble) {
        browser.trouble = "This folder cannot be read: " + trouble.message();
        return;
    }
    for (; entry != std::filesystem::directory_iterator(); entry.increment(trouble)) {
        if (trouble) break;
        std::error_code ignored;
        FolderEntry found;
        found.name = entry->path().filename().string();
        if (found.name.starts_with('.')) continue;
        found.is_folder = entry->is_directory(ignored);
        found.is_session = has_session_extension(entry->path());
        found.is_picture = is_picture(entry->path());
        if (!found.is_folder) {
            const bool shown = is_meant(browser.purpose, entry->path());
            if (!entry->is_regular_file(ignored) || (!shown && !browser.every_file)) continue;
            found.bytes = entry->file_size(ignored);
        }
        found.changed = entry->last_write_time(ignored);
        browser.entries.push_back(std::move(found));
    }
    std::sort(browser.entries.begin(), browser.entries.end(), by_name);
}

void forget_trouble(FileBrowser& browser) {
    browser.trouble.clear();
    browser.missing_folder.clear();
}

void name_typed(FileBrowser& browser) {
    forget_trouble(browser); // it was about another name
    if (!reads_file(browser.purpose)) return;
    const bool is_path = browser.typed.find('/') != std::string::npos || browser.typed.starts_with('~');
    browser.filter = is_path ? std::string() : browser.typed;
    browser.chosen = -1;
    if (!browser.typed.starts_with('/') && !browser.typed.starts_with("~/")) return;
    const std::filesystem::path path = typed_path(browser);
    std::error_code ignored;
    if (!std::filesystem::is_directory(path.parent_path(), ignored)) return;
    browser.filter = path.filename().string();
    if (path.parent_path() == browser.folder) return;
    browser.folder = path.parent_path();
    read_folder(browser);
}

std::vector<int> shown_entries(const FileBrowser& browser) {
    const std::string filter = lower_case(browser.filter);
    std::vector<int> shown;
    for (std::size_t i = 0; i < browser.entries.size(); ++i)
        if (lower_case(browser.entries[i].name).find(filter) != std::string::npos)
            shown.push_back(static_cast<int>(i));
    return shown;
}

void go_to(FileBrowser& browser, const std::filesystem::path& place) {
    std::error_code trouble;
    std::filesystem::path folder = std::filesystem::weakly_canonical(place, trouble);
    if (trouble) folder = place;
    if (!std::filesystem::is_directory(folder, trouble)) folder = folder.parent_path();
    browser.folder = folder;
    browser.filter.clear();
    if (reads_file(browser.purpose)) browser.typed.clear();
    browser.name_changed_outside = true;
    read_folder(browser);
}

bool make_folder(FileBrowser& browser, const std::string& name) {
    const std::filesystem::path folder = browser.folder / name;
    std::error_code trouble;
    forget_trouble(browser);
    if (std::filesystem::create_directory(folder, trouble)) {
        go_to(browser, folder);
        return true;
    }
    browser.trouble = trouble ? "The folder " + quoted(name) + " cannot be made: " + trouble.message()
                              : "There is already a folder " + quoted(name);
    return false;
}

void make_missing_folder(FileBrowser& browser) {
    const std::filesystem::path folder = browser.missing_folder;
    std::error_code trouble;
    std::filesystem::create_directories(folder, trouble);
    read_folder(browser); // which may list it now
    if (trouble) browser.trouble = folder.string() + " cannot be made: " + trouble.message();
    browser.focus_name = true;
}

std::filesystem::path typed_path(const FileBrowser& browser) {
    std::filesystem::path typed(browser.typed);
    if (browser.typed == "~" || browser.typed.starts_with("~/"))
        if (const char* home = std::getenv("HOME"))
            typed = std::filesystem::path(home) / (browser.typed.size() > 2 ? browser.typed.substr(2) : "");
    if (typed.is_relative()) typed = browser.folder / typed;
    std::error_code ignored;
    if (!std::filesystem::is_directory(typed, ignored)) {
        if (browser.purpose == BrowseFor::save_session && !has_session_extension(typed)) typed += ".knead";
        if (browser.purpose == BrowseFor::save_picture && !is_picture(typed)) typed += ".png";
        if (browser.purpose == BrowseFor::save_cloud && lacks_extension(typed))
            typed += browser.usual_extension;
    }
    return typed.lexically_normal();
}

std::filesystem::path chosen_path(const FileBrowser& browser) {
    std::filesystem::path typed = typed_path(browser);
    std::error_code ignored;
    if (browser.filter.empty() || std::filesystem::exists(typed, ignored)) return typed;
    const std::vector<int> shown = shown_entries(browser);
    if (shown.size() != 1) return typed;
    return browser.folder / browser.entries[static_cast<std::size_t>(shown.front())].name;
}

const Format* meant_format(const FileBrowser& browser) {
    return format_with_extension(
        names_file(browser) ? typed_path(browser) : std::filesystem::path("cloud" + browser.usual_extension));
}

void take_format(FileBrowser& browser, const Format& format) {
    browser.usual_extension = format.extensions.front();
    forget_trouble(browser);
    if (!names_file(browser)) return;
    std::filesystem::path named(browser.typed);
    if (!lacks_extension(named)) named.replace_extension();
    named += browser.usual_extension;
    browser.typed = named.string();
    browser.name_changed_outside = true;
}

} // namespace knead
