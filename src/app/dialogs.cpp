// The questions that are asked before something is lost.

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"
#include "edit/kept_original.h"
#include "edit/known_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>
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

// A row of answers, one of which is lit: Enter gives that one, Tab and the arrows light another. Returns the
// number of the one that is given.
std::optional<int> answers(std::span<const char* const> labels, int lit_first = 0) {
    const auto count = static_cast<int>(labels.size());
    int& lit = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("lit"), lit_first);
    if (ImGui::IsWindowAppearing()) lit = lit_first;
    const auto goes = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    const bool tab = goes(ImGuiKey_Tab), back = ImGui::GetIO().KeyShift;
    if (goes(ImGuiKey_RightArrow) || (tab && !back)) lit = (lit + 1) % count;
    if (goes(ImGuiKey_LeftArrow) || (tab && back)) lit = (lit + count - 1) % count;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x - gap * static_cast<float>(count - 1);
    std::optional<int> given;
    for (int number = 0; number < count; ++number) {
        if (number > 0) ImGui::SameLine();
        const char* label = labels[static_cast<std::size_t>(number)];
        const ImVec2 size(room / static_cast<float>(count), 0);
        if (number == lit ? main_button(label, size) : ImGui::Button(label, size)) given = number;
    }
    if (!given && (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter))) given = lit;
    return given;
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
    const std::optional<int> answer = answers(std::array{save, "Discard", "Cancel"});
    if (answer == 0) {
        after.waiting_for_save = true;
        ui.wish(WishSaveSession{});
    } else if (answer == 1 && after.then) {
        ui.wish(WishDiscard{});
    } else if (answer == 2 || pressed(ImGuiKey_Escape)) {
        after = {};
    }
    if (answer || pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

struct OverwritingWords {
    const char* title = "";
    std::string what_is_lost;
    const char *go_on = "Overwrite", *elsewhere = "Another name…";
    const char* keep = nullptr; // the original; null: that is no question
};

OverwritingWords words_about(const Ui& ui, const WishSaveTo& target) {
    if (target.anyway)
        return {
            "This file has changed",
            "Somebody else wrote to it after knead last read or saved it. Saving here puts what you did in "
            "its place, and theirs is gone for good.",
            "Save anyway", "Save as…"};
    if (ui.has_cloud() && real_name(target.file) == real_name(ui.editor.opened.file))
        return {"Overwrite the input?",
                "This is the cloud that you opened. Overwritten, it no longer fits the sessions recorded on "
                "it, and the points as they were are gone for good, unless you keep the original beside it, "
                "as " +
                    name_of_original(ui.editor.opened.file).filename().string() +
                    ". Your session then goes by that.",
                "Overwrite", "Another name…", "Keep the original"};
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
    const std::optional<int> answer = words.keep
                                          ? answers(std::array{words.go_on, words.elsewhere, words.keep}, 2)
                                          : answers(std::array{words.go_on, words.elsewhere}, 1);
    const bool gives_up = !answer && pressed(ImGuiKey_Escape);
    if (answer == 0 || answer == 2) {
        target->ask = false;
        target->keeps_original = answer == 2;
        ui.wish(*target);
    } else if (answer == 1 || (gives_up && !target->anyway)) {
        ui.wish(WishBrowse{target->purpose});
    }
    if (answer || gives_up) {
        target.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

// Words about a key of a file, without which line and which key that was.
std::string without_place(std::string words) {
    constexpr std::string_view after_key = "\": ";
    const std::size_t at = words.find(after_key);
    if (at == std::string::npos) return words;
    words.erase(0, at + after_key.size());
    const auto is_letter = [](unsigned char one) { return std::isalpha(one) != 0; };
    const std::string first_word = words.substr(0, words.find(' '));
    if (std::ranges::all_of(first_word, is_letter) && !words.empty()) // a file keeps its name
        words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
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
    const std::optional<int> answer = answers(std::array{"Choose the cloud…", "Cancel"});
    if (answer == 0)
        ui.wish(WishBrowse{BrowseFor::cloud_of_session});
    else if (answer == 1 || pressed(ImGuiKey_Escape))
        session.reset();
    if (answer || !session) ImGui::CloseCurrentPopup();
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
    wrapped_text(work->trouble.empty()
                     ? counted(work->steps, "recorded step") + " on " + file + " will be gone for good."
                     : "The recording " + work->journal.string() + " will be gone for good.");
    ImGui::Dummy({0, ui.scaled(8)});
    const std::optional<int> answer = answers(std::array{"Delete", "Keep"}, 1);
    if (answer == 0) ui.wish(WishDeleteLost{*work});
    if (answer || pressed(ImGuiKey_Escape)) {
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
