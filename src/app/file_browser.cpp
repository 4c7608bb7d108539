// The file browser: folders, clouds and sessions with their sizes, places at the left, a name or a path to be
// typed below (file_browser_bottom.cpp). Arrows, Enter, Backspace and Esc work it without a mouse.

#include "app/file_browser.h"

#include "app/file_browser_parts.h"
#include "app/widgets.h"
#include "base/counts.h"
#include "base/quoted.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <ctime>
#include <utility>

namespace knead {

namespace {

const char* title_of(BrowseFor purpose) {
    switch (purpose) {
    case BrowseFor::open:
        return "Open a cloud or a session";
    case BrowseFor::save_session:
        return "Save the session";
    case BrowseFor::save_picture:
        return "Save a picture of the view";
    case BrowseFor::take_handles:
        return "Take the handles of a session";
    case BrowseFor::cloud_of_session:
        return "Which cloud does this session belong to?";
    default:
        return "Export the cloud";
    }
}

std::string date_words(std::filesystem::file_time_type when) {
    const auto system = std::chrono::file_clock::to_sys(when);
    const std::time_t seconds = std::chrono::system_clock::to_time_t(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
    std::tm parts{};
    localtime_r(&seconds, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d  %H:%M", &parts);
    return text;
}

void choose_entry(const Ui& ui, const FolderEntry& entry) {
    FileBrowser& browser = ui.state.browser;
    if (entry.is_folder)
        go_to(browser, browser.folder / entry.name);
    else {
        browser.typed = entry.name;
        choose(ui);
    }
}

// At the end of the path: a button, or the field for a name that it becomes.
float width_of_new_folder(const Ui& ui) {
    return ui.scaled(ui.state.browser.new_folder.asked_for ? 230 : 110);
}

void new_folder(const Ui& ui) {
    const float width = width_of_new_folder(ui);
    NewFolder& folder = ui.state.browser.new_folder;
    ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x - width);
    if (!folder.asked_for) {
        if (ImGui::Button("New folder", {width, 0})) folder = {.asked_for = true, .focus = true};
        explain("Makes a folder in this one, and goes there");
        return;
    }
    if (std::exchange(folder.focus, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(width);
    folder.entered =
        ImGui::InputTextWithHint("##new", "Name of the new folder", &folder.name,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    folder.left = ImGui::IsItemDeactivated();
}

// What becomes of a name that is asked for: Enter makes the folder, and a name that cannot be made stays to
// be mended; Esc, or going elsewhere, gives it up. At the end of the frame, for the keys are nobody else's in
// it.
void end_naming(FileBrowser& browser) {
    NewFolder& folder = browser.new_folder;
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (folder.entered && !folder.name.empty()) {
        if (make_folder(browser, folder.name))
            folder = {};
        else
            folder.focus = true;
    } else if (folder.entered || folder.left || escaped) {
        if (folder.entered || escaped) browser.focus_name = true; // else the hand has it elsewhere already
        forget_trouble(browser);
        folder = {};
    }
}

// The folders on the way here, each a button.
void path_row(const Ui& ui) {
    FileBrowser& browser = ui.state.browser;
    const float side = ImGui::GetFrameHeight();
    if (icon_button("up", Icon::up, side, false, "The folder above (Backspace)"))
        go_to(browser, browser.folder.parent_path());
    std::vector<std::filesystem::path> way;
    for (std::filesystem::path at = browser.folder;; at = at.parent_path()) {
        way.push_back(at);
        if (!at.has_relative_path()) break;
    }
    std::reverse(way.begin(), way.end());
    const auto name_of = [](const std::filesystem::path& at) {
        return at.has_filename() ? at.filename().string() : std::string("/");
    };
    // Where they do not all fit, the ones nearest to the root are left out.
    const bool makes_folders = !reads_file(browser.purpose);
    float room = ImGui::GetContentRegionAvail().x - side - ui.scaled(8);
    if (makes_folders) room -= width_of_new_folder(ui) + ui.scaled(8);
    std::size_t first = way.size();
    while (first > 0) {
        room -= ImGui::CalcTextSize(name_of(way[first - 1]).c_str()).x + ui.scaled(26);
        if (room < 0 && first < way.size()) break;
        --first;
    }
    ImGui::PushStyleColor(ImGuiCol_Button, 0);
    std::filesystem::path go;
    for (std::size_t i = first; i < way.size(); ++i) {
        ImGui::SameLine(0, ui.scaled(4));
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button(name_of(way[i]).c_str())) go = way[i];
        ImGui::PopID();
    }
    ImGui::PopStyleColor();
    if (makes_folders) new_folder(ui);
    if (!go.empty()) go_to(browser, go);
}

void place(const Ui& ui, Icon icon, const std::filesystem::path& folder, const std::string& label) {
    ImGui::PushID(folder.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    const bool here = ui.state.browser.folder == folder;
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0f, 0.5f});
    if (ImGui::Selectable(("       " + label).c_str(), here, 0, {0, height})) go_to(ui.state.browser, folder);
    ImGui::PopStyleVar();
    explain(folder.string());
    draw_icon(*ImGui::GetWindowDrawList(), icon, {at.x + ui.scaled(12), at.y + height / 2}, ui.scaled(14),
              palette::faint);
    ImGui::PopID();
}

// Home, the folder that the program was started in, and those of the files that were opened last.
void places(const Ui& ui) {
    ImGui::BeginChild("places", {ui.scaled(180), -bottom_height(ui)});
    std::error_code ignored;
    if (const char* home = std::getenv("HOME"); home && std::filesystem::is_directory(home, ignored))
        place(ui, Icon::home, home, "Home");
    place(ui, Icon::folder, std::filesystem::current_path(ignored), "Working folder");
    place(ui, Icon::folder, "/", "Computer");
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& file : ui.state.recent)
        if (std::find(folders.begin(), folders.end(), file.parent_path()) == folders.end())
            folders.push_back(file.parent_path());
    if (!folders.empty()) {
        ImGui::Dummy({0, ui.scaled(4)});
        caption("Recent folders");
        const auto is_namesake = [](const std::filesystem::path& a, const std::filesystem::path& b) {
            return a != b && a.filename() == b.filename();
        };
        for (const std::filesystem::path& folder : folders) {
            const bool has_namesake = std::ranges::any_of(
                folders, [&](const std::filesystem::path& other) { return is_namesake(folder, other); });
            const std::filesystem::path above = folder.parent_path().filename();
            place(ui, Icon::folder, folder,
                  (has_namesake ? above / folder.filename() : folder.filename()).string());
        }
    }
    ImGui::EndChild();
}

void entry_row(const Ui& ui, const FolderEntry& entry, int number) {
    FileBrowser& browser = ui.state.browser;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight() + ui.scaled(4);
    ImGui::PushID(number);
    const bool chosen = number == browser.chosen;
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0f, 0.5f});
    if (ImGui::Selectable(("       " + entry.name).c_str(), chosen,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                              ImGuiSelectableFlags_DontClosePopups,
                          {0, height})) {
        browser.chosen = number;
        if (!entry.is_folder) browser.typed = entry.name;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) browser.enter_chosen = true;
    }
    ImGui::PopStyleVar();
    if (chosen && browser.scroll_to_chosen) {
        ImGui::SetScrollHereY();
        browser.scroll_to_chosen = false;
    }
    ImGui::PopID();
    const Icon icon = entry.is_folder    ? Icon::folder
                      : entry.is_session ? Icon::session
                      : entry.is_picture ? Icon::picture
                                         : Icon::cloud;
    const ImU32 color = entry.is_folder ? palette::faint : palette::accent;
    draw_icon(*ImGui::GetWindowDrawList(), icon, {at.x + ui.scaled(10), at.y + height / 2}, ui.scaled(14),
              color);
    if (is_narrow(ui)) return;
    ImGui::TableNextColumn();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.scaled(2));
    if (!entry.is_folder) caption(byte_size(entry.bytes).c_str());
    ImGui::TableNextColumn();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.scaled(2));
    caption(date_words(entry.changed).c_str());
}

// What is not in the folder.
std::string nothing_words(BrowseFor purpose) {
    switch (purpose) {
    case BrowseFor::save_cloud:
    case BrowseFor::cloud_of_session:
        return "No clouds here, nor folders";
    case BrowseFor::save_session:
    case BrowseFor::take_handles:
        return "No sessions here, nor folders";
    case BrowseFor::save_picture:
        return "No pictures here, nor folders";
    default:
        return "No clouds or sessions here, nor folders";
    }
}

void entry_table(const Ui& ui) {
    FileBrowser& browser = ui.state.browser;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::rgb(0x000000, 46));
    const bool narrow = is_narrow(ui);
    if (ImGui::BeginTable(narrow ? "names" : "entries", narrow ? 1 : 3,
                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, -bottom_height(ui)})) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
        if (!narrow) ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, ui.scaled(80));
        if (!narrow) ImGui::TableSetupColumn("Changed", ImGuiTableColumnFlags_WidthFixed, ui.scaled(140));
        ImGui::TableHeadersRow();
        const std::vector<int> shown = shown_entries(browser);
        for (const int number : shown)
            entry_row(ui, browser.entries[static_cast<std::size_t>(number)], number);
        if (shown.empty()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            faint_text(browser.entries.empty()
                           ? nothing_words(browser.purpose)
                           : "Nothing here has " + knead::quoted(browser.filter) + " in its name");
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleColor();
    if (browser.enter_chosen && browser.chosen >= 0) {
        browser.enter_chosen = false;
        const FolderEntry entry = browser.entries[static_cast<std::size_t>(browser.chosen)];
        choose_entry(ui, entry);
    }
}

// Arrows move the choice, Backspace goes up, while nothing is typed.
void keys(FileBrowser& browser) {
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    int step = 0;
    if (pressed(ImGuiKey_DownArrow)) step = 1;
    if (pressed(ImGuiKey_UpArrow)) step = -1;
    if (pressed(ImGuiKey_PageDown)) step = 12;
    if (pressed(ImGuiKey_PageUp)) step = -12;
    if (const std::vector<int> shown = shown_entries(browser); step != 0 && !shown.empty()) {
        const auto at = std::ranges::find(shown, browser.chosen);
        const auto from = at == shown.end() ? std::ptrdiff_t{-1} : at - shown.begin();
        const auto last = static_cast<std::ptrdiff_t>(shown.size()) - 1;
        browser.chosen = shown[static_cast<std::size_t>(std::clamp(from + step, std::ptrdiff_t{0}, last))];
        browser.scroll_to_chosen = true;
        const FolderEntry& entry = browser.entries[static_cast<std::size_t>(browser.chosen)];
        browser.typed = entry.name;
        browser.name_changed_outside = true;
    }
    // Not as it repeats: whoever holds it to clear the field means no folders.
    const int backspace = ImGui::GetKeyIndex(ImGuiKey_Backspace);
    if (browser.typed.empty() && ImGui::IsKeyPressed(backspace, false))
        go_to(browser, browser.folder.parent_path());
}

} // namespace

void draw_file_browser(const Ui& ui) {
    FileBrowser& browser = ui.state.browser;
    if (browser.open_now) {
        browser.open_now = false;
        browser.filter.clear();
        browser.new_folder = {};
        browser.name_changed_outside = true; // selects it whole, so that typing replaces it
        ImGui::OpenPopup("browser");
        read_folder(browser);
    }
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ui.scaled(860), io.DisplaySize.x * 0.94f),
                              std::min(ui.scaled(580), io.DisplaySize.y * 0.9f)});
    if (!ImGui::BeginPopupModal("browser", nullptr,
                                ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove)) {
        browser.is_open = false;
        return;
    }
    browser.is_open = true;
    if (std::exchange(browser.close_now, false)) ImGui::CloseCurrentPopup();
    ImGui::PushFont(ui.state.fonts.title);
    ImGui::TextUnformatted(title_of(browser.purpose));
    ImGui::PopFont();
    const bool names_folder = browser.new_folder.asked_for;
    const bool hears_keys = popup_has_keys() && !names_folder; // and nothing that has dropped down
    path_row(ui);
    if (hears_keys) keys(browser);
    if (!is_narrow(ui)) {
        places(ui);
        ImGui::SameLine();
    }
    entry_table(ui);
    bottom_row(ui, hears_keys);
    if (names_folder) end_naming(browser);
    if (hears_keys && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace knead
