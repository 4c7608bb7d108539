#include "app/recent_files.h"

#include "app/kept_text.h"
#include "app/kept_views.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace knead {

namespace {

using Files = std::vector<std::filesystem::path>;

struct List {
    const char* name;
    std::size_t most;
};
constexpr List recent_list{"recent", 12}, choosing_list{"automatic-samples", 200};

// Files that are gone are left out.
Files read_list(const List& list) {
    Files files;
    std::ifstream in(kept_file(list.name));
    std::error_code ignored;
    for (std::string line; files.size() < list.most && std::getline(in, line);)
        if (!line.empty() && std::filesystem::is_regular_file(line, ignored)) files.emplace_back(line);
    return files;
}

void write_list(const List& list, const Files& files) {
    std::string text;
    for (const std::filesystem::path& file : files) text += file.string() + '\n';
    keep_text(list.name, text);
}

std::filesystem::path whole_path(const std::filesystem::path& file) {
    std::error_code trouble;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, trouble);
    return trouble ? file : whole;
}

// A line of a list is a file; a name with a line's end in it cannot stand there.
void put_in_front(const List& list, Files& files, const std::filesystem::path& file) {
    if (file.string().find('\n') != std::string::npos) return;
    std::erase(files, file);
    files.insert(files.begin(), file);
    if (files.size() > list.most) files.resize(list.most);
}

} // namespace

Files read_recent_files() {
    return read_list(recent_list);
}

void remember_file(Files& recent, const std::filesystem::path& file) {
    put_in_front(recent_list, recent, whole_path(file));
    write_list(recent_list, recent);
}

void forget_files(Files& recent) {
    recent.clear();
    write_list(recent_list, recent);
    write_list(choosing_list, {});
    forget_views();
}

bool chose_samples(const std::filesystem::path& session) {
    const Files choosing = read_list(choosing_list);
    return std::ranges::find(choosing, whole_path(session)) != choosing.end();
}

void remember_choosing(const std::filesystem::path& session, bool chooses) {
    Files choosing = read_list(choosing_list);
    if (chooses)
        put_in_front(choosing_list, choosing, whole_path(session));
    else
        std::erase(choosing, whole_path(session));
    write_list(choosing_list, choosing);
}

} // namespace knead
