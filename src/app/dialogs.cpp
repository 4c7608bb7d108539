// The questions that are asked before something is lost.

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"
#include "edit/known_files.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace knead {

namespace {

bool begin_question(const Ui& ui, const char* id, const char* title) {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y * 0.42f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ui.scaled(470), io.DisplaySize.x * 0.94f), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(24), ui.scaled(20)});
    const bool open = ImGui::BeginPopupModal(
        id, nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    ImGui::PopStyleVar();
    if (!open) return false;
    ImGui::PushFont(ui.state.fonts.title);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    return true;
}

bool pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}

std::string what_is_unsaved(const Editor& editor) {
    const std::filesystem::path session = editor.document->session.filename();
    if (session.empty())
        return "The handles and poses of " + editor.opened.file.filename().string() +
               " are not saved yet. A session keeps all of them, to go on with later.";
    return "What changed since " + session.string() + " was saved is not in it.";
}

void unsaved_question(const Ui& ui) {
    if (ui.state.ask_unsaved) {
        ui.state.ask_unsaved = false;
        ImGui::OpenPopup("unsaved");
    }
    if (!begin_question(ui, "unsaved", "Save what you did?")) return;
    wrapped_text(what_is_unsaved(ui.editor));
    ImGui::Dummy({0, ui.scaled(8)});
    AfterSaving& after = ui.state.after;
    const char* save = ui.editor.document->session.empty() ? "Save session…" : "Save session";
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (main_button(save, {width, 0}) || pressed(ImGuiKey_Enter)) {
        after.waiting_for_save = true;
        ui.wish(WishSaveSession{});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Discard", {width, 0})) {
        if (after.then) ui.wish(WishDiscard{});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape)) {
        after = {};
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

struct OverwritingWords {
    const char* title = "";
    const char* what_is_lost = "";
    const char *go_on = "Overwrite", *elsewhere = "Another name…";
};

OverwritingWords words_about(const Ui& ui, const WishSaveTo& target) {
    if (target.anyway)
        return {
            "This file has changed",
            "Somebody else wrote to it after knead last read or saved it. Saving here puts what you did in "
            "its place, and theirs is gone for good.",
            "Save anyway", "Save as…"};
    if (ui.has_cloud() && real_name(target.file) == real_name(ui.editor.opened.file))
        return {
            "Overwrite the input?",
            "This is the cloud that you opened. Sessions recorded on it will no longer fit, and the points "
            "as they were are gone for good."};
    return {"Overwrite this file?", "What is in it now will be gone."};
}

void overwriting_question(const Ui& ui) {
    std::optional<WishSaveTo>& target = ui.state.overwriting;
    if (target && !ImGui::IsPopupOpen("overwrite")) ImGui::OpenPopup("overwrite");
    const OverwritingWords words = target ? words_about(ui, *target) : OverwritingWords{};
    if (!begin_question(ui, "overwrite", words.title)) return;
    if (!target) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    wrapped_text(target->file);
    faint_text(words.what_is_lost);
    ImGui::Dummy({0, ui.scaled(8)});
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (ImGui::Button(words.go_on, {width, 0})) {
        target->ask = false;
        ui.wish(*target);
        target.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    const bool gives_up = pressed(ImGuiKey_Escape);
    if (main_button(words.elsewhere, {width, 0}) || pressed(ImGuiKey_Enter) || gives_up) {
        if (target && !(gives_up && target->anyway)) ui.wish(WishBrowse{target->purpose});
        target.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

// Words about a line of a file, without which line and which key that was.
std::string without_place(std::string words) {
    for (const std::string_view key : {"\"cloud\": ", "\"sha256\": ", "\"points\": "})
        if (const std::size_t at = words.find(key); at != std::string::npos) {
            words.erase(0, at + key.size());
            words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
            return words;
        }
    return words;
}

// A session whose cloud was moved, or is another file by now.
void cloud_question(const Ui& ui) {
    std::optional<Editor::WithoutCloud>& session = ui.state.without_cloud;
    const FileBrowser& browser = ui.state.browser;
    if (session && !ImGui::IsPopupOpen("cloud") && !browser.open_now && !browser.is_open)
        ImGui::OpenPopup("cloud");
    if (!begin_question(ui, "cloud", "Where is this session's cloud?")) return;
    if (!session) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    wrapped_text(without_place(session->why));
    faint_text("Choose the cloud as it was when the session began: where that file is now, or a copy of it. "
               "Poses are put on top of whatever is chosen.");
    ImGui::Dummy({0, ui.scaled(8)});
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (main_button("Choose the cloud…", {width, 0}) || pressed(ImGuiKey_Enter)) {
        ui.wish(WishBrowse{BrowseFor::cloud_of_session});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape)) {
        session.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

// What a crash left is gone for good then: there is no other copy.
void deleting_question(const Ui& ui) {
    std::optional<LostWork>& work = ui.state.deleting;
    if (work && !ImGui::IsPopupOpen("delete")) ImGui::OpenPopup("delete");
    if (!begin_question(ui, "delete", "Delete what was not saved?")) return;
    if (!work) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    const std::string file = (work->session.empty() ? work->cloud : work->session).filename().string();
    wrapped_text((counted(work->steps, "recorded step") + " on " + file + " will be gone for good."));
    ImGui::Dummy({0, ui.scaled(8)});
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (ImGui::Button("Delete", {width, 0})) {
        ui.wish(WishDeleteLost{*work});
        work.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (main_button("Keep", {width, 0}) || pressed(ImGuiKey_Enter) || pressed(ImGuiKey_Escape)) {
        work.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace

void draw_dialogs(const Ui& ui) {
    deleting_question(ui);
    unsaved_question(ui);
    overwriting_question(ui);
    cloud_question(ui);
}

} // namespace knead
