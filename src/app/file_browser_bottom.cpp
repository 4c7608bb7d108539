// Below the list of the file browser: the name, the format of a cloud, what else it gets, and the buttons.

#include "app/file_browser_parts.h"
#include "app/widgets.h"
#include "base/counts.h"
#include "base/error.h"
#include "base/whole_file.h"
#include "io/cloud_file.h"
#include "io/format.h"

#include <imgui_stdlib.h>

namespace knead {

namespace {

const char* verb_of(BrowseFor purpose) {
    switch (purpose) {
    case BrowseFor::open:
        return "Open";
    case BrowseFor::save_session:
    case BrowseFor::save_picture:
        return "Save";
    case BrowseFor::take_handles:
        return "Take";
    case BrowseFor::cloud_of_session:
        return "Use";
    default:
        return "Export";
    }
}

// What an exported cloud may get besides stands on a line of its own then.
bool has_line_of_columns(const Ui& ui) {
    return ui.state.browser.purpose == BrowseFor::save_cloud && is_narrow(ui);
}

// Whether there are points that are not seen and could be left out.
bool asks_about_hidden(const Ui& ui) {
    return ui.state.browser.purpose == BrowseFor::save_cloud && ui.editor.hidden > 0;
}

// Whether a file can be saved there; if not, `trouble` says why, and the name stays to be mended.
bool can_save(FileBrowser& browser, const std::filesystem::path& file) {
    if (browser.purpose == BrowseFor::save_session && has_cloud_extension(file)) {
        browser.trouble = file.filename().string() +
                          " is a name for a cloud. A session, the handles and poses, "
                          "ends in .knead; the shape is exported with Ctrl+E.";
        browser.focus_name = true;
        return false;
    }
    try {
        if (browser.purpose == BrowseFor::save_cloud)
            refuse_bad_target(file);
        else
            const FileInTheMaking probe(file);
        return true;
    } catch (const Error& error) {
        std::error_code ignored;
        browser.trouble = error.what();
        if (std::filesystem::status(file.parent_path(), ignored).type() ==
            std::filesystem::file_type::not_found)
            browser.missing_folder = file.parent_path();
        browser.focus_name = true;
        return false;
    }
}

} // namespace

bool is_narrow(const Ui& ui) {
    return ImGui::GetIO().DisplaySize.x < ui.scaled(720);
}

float bottom_height(const Ui& ui) {
    const std::string& trouble = ui.state.browser.trouble;
    const float width = ImGui::GetWindowWidth() - 2 * ImGui::GetStyle().WindowPadding.x;
    const float lines = trouble.empty() ? 0
                                        : ImGui::CalcTextSize(trouble.c_str(), nullptr, false, width).y -
                                              ImGui::GetTextLineHeight();
    const float row = ImGui::GetFrameHeightWithSpacing();
    const float format = ui.state.browser.purpose == BrowseFor::save_cloud ? row : 0;
    const float hidden = asks_about_hidden(ui) && is_narrow(ui) ? row : 0;
    const float help = ui.state.browser.missing_folder.empty() ? 0 : row;
    return ui.scaled(92) + lines + help + format + hidden + (has_line_of_columns(ui) ? row : 0);
}

void choose(const Ui& ui) {
    FileBrowser& browser = ui.state.browser;
    if (browser.typed.empty()) return;
    forget_trouble(browser);
    const std::filesystem::path file = chosen_path(browser);
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        go_to(browser, file);
        return;
    }
    if (reads_file(browser.purpose)) {
        if (!std::filesystem::exists(file, ignored)) {
            browser.trouble = "There is no file " + file.string();
            return;
        }
        if (browser.purpose == BrowseFor::open)
            ui.wish(WishOpen{file});
        else if (browser.purpose == BrowseFor::cloud_of_session)
            ui.wish(WishUseCloud{file});
        else
            ui.wish(WishTakeHandles{file});
    } else {
        if (!can_save(browser, file)) return;
        ui.wish(WishSaveTo{browser.purpose, file, true, browser.options});
    }
    browser.folder = file.parent_path(); // where the next one begins
    ImGui::CloseCurrentPopup();
}

namespace {

// ".txt, .asc: numbers in columns"
std::string words_of(const Format& format) {
    std::string words;
    for (const std::string_view extension : format.extensions)
        words.append(words.empty() ? "" : ", ").append(extension);
    return words.append(": ").append(format.words);
}

// The formats that a cloud can be exported in; the name's extension says which, and becomes what is chosen.
void format_choice(const Ui& ui) {
    FileBrowser& browser = ui.state.browser;
    const Format* const meant = meant_format(browser);
    inline_caption("Format", ImGui::GetStyle().WindowPadding.x + ui.scaled(62));
    ImGui::SetNextItemWidth(ui.scaled(290));
    const std::string shown = meant ? words_of(*meant) : "None that knead writes: choose one";
    if (ImGui::BeginCombo("##format", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const Format& format : known_formats())
            if (ImGui::Selectable(words_of(format).c_str(), &format == meant) && &format != meant)
                take_format(browser, format);
        // Nothing else closes it over a dialog.
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
            ImGui::CloseCurrentPopup();
            browser.name_changed_outside = true; // what is typed next is the name again
        }
        ImGui::EndCombo();
    }
    explain(
        "What the name ends in says which it is. A cloud keeps everything of its file in the format that it "
        "was opened in; in another one what that has a place for, and what is lost is told");
}

// Beside the format, or below it where there is no room.
void hidden_choice(const Ui& ui) {
    if (!asks_about_hidden(ui)) return;
    if (!is_narrow(ui)) ImGui::SameLine(0, ui.scaled(16));
    const std::string words = "Without the " + counted(ui.editor.hidden, "hidden point");
    ImGui::Checkbox((words + "###hidden").c_str(), &ui.state.browser.options.without_hidden);
    explain("Leaves the points out that are hidden now, in a new file that has nothing but the others. "
            "Otherwise the file keeps all of its points, in their order: hiding is for looking and choosing");
}

// What an exported cloud gets beside its own attributes.
void column_choice(FileBrowser& browser) {
    ImGui::SameLine();
    ImGui::Checkbox("With displacement", &browser.options.displacement);
    explain("Adds the attribute \"displacement\": how far each point is from where it was opened, in the "
            "cloud's units");
    ImGui::SameLine();
    ImGui::Checkbox("With stretch", &browser.options.stretch);
    explain("Adds the attribute \"stretch\": how much farther apart a point and its neighbours are than when "
            "the cloud was opened; 1 is unstretched");
}

// Whether Enter was pressed in it.
bool name_field(FileBrowser& browser) {
    // The field keeps its own copy while it is active; typing another name from outside needs it to let go.
    ImGui::PushID(browser.name_version);
    if (browser.name_changed_outside) {
        browser.name_changed_outside = false;
        ++browser.name_version;
        ImGui::PopID();
        ImGui::PushID(browser.name_version);
        browser.focus_name = true;
    }
    if (browser.focus_name) ImGui::SetKeyboardFocusHere();
    browser.focus_name = false;
    ImGui::SetNextItemWidth(-1);
    const bool entered = ImGui::InputText("##path", &browser.typed, ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemEdited()) name_typed(browser);
    ImGui::PopID();
    return entered;
}

// What is wrong, and what helps; or what the name is for.
void words_about_name(FileBrowser& browser) {
    if (browser.trouble.empty())
        return caption(reads_file(browser.purpose) ? "A name in this folder, or a path"
                                                   : "File name, or a path");
    ImGui::PushStyleColor(ImGuiCol_Text, palette::error);
    wrapped_text(browser.trouble);
    ImGui::PopStyleColor();
    if (browser.missing_folder.empty()) return;
    const std::string folder = browser.missing_folder.string();
    if (ImGui::Button("Make that folder")) make_missing_folder(browser);
    explain(folder);
}

} // namespace

void bottom_row(const Ui& ui, bool hears_keys) {
    FileBrowser& browser = ui.state.browser;
    words_about_name(browser);
    const bool entered = name_field(browser);
    if (browser.purpose == BrowseFor::save_cloud) format_choice(ui);
    hidden_choice(ui);
    if (ImGui::Checkbox(has_line_of_columns(ui) ? "All" : "All files", &browser.every_file))
        read_folder(browser);
    explain(browser.purpose == BrowseFor::save_picture ? "Also shows files that are no pictures (.png)"
                                                       : "Also shows files that are neither clouds (" +
                                                             known_extensions() + ") nor sessions (.knead)");
    if (browser.purpose == BrowseFor::save_cloud) column_choice(browser);
    if (browser.purpose == BrowseFor::save_picture) {
        ImGui::SameLine();
        ImGui::Checkbox("Only the cloud", &browser.bare_picture);
        explain("Without the colours of handles and selection, the ground and what the solver works on. "
                "Otherwise as the view shows it, without panels and gizmo");
    }
    const float width = ui.scaled(110), gap = ImGui::GetStyle().ItemSpacing.x;
    const float left = ImGui::GetWindowWidth() - 2 * width - gap - ImGui::GetStyle().WindowPadding.x;
    if (has_line_of_columns(ui))
        ImGui::SetCursorPosX(left);
    else
        ImGui::SameLine(left);
    if (ImGui::Button("Cancel", {width, 0})) ImGui::CloseCurrentPopup();
    ImGui::SameLine();
    ImGui::BeginDisabled(browser.typed.empty());
    const bool confirmed = main_button(verb_of(browser.purpose), {width, 0});
    ImGui::EndDisabled();
    // The lit button is Enter's, whatever was clicked before.
    const bool pressed = hears_keys && !entered && !ImGui::IsAnyItemActive() &&
                         (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) ||
                          ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter), false));
    if (confirmed || entered || pressed) choose(ui);
    if (entered) browser.focus_name = true; // where that was no name to choose, the next is typed
    // Whatever was clicked, what is typed next is the name, unless another one is asked for; but taking the
    // focus would close what dropped down.
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !ImGui::IsAnyItemActive() && popup_has_keys() &&
        !browser.new_folder.asked_for)
        browser.focus_name = true;
}

} // namespace knead
