#include "app/timeline.h"

#include "app/icons.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <algorithm>
#include <cstdio>

namespace knead {

namespace {

bool is_of_document(const EditorStep& step) {
    return step.document != 0;
}

std::size_t count_of(const std::vector<EditorStep>& steps) {
    return static_cast<std::size_t>(std::ranges::count_if(steps, is_of_document));
}

// Undoes or redoes steps until the position is reached; the document carries them out one after the other.
void go_to(const Ui& ui, std::size_t position) {
    std::size_t at = playback_position(ui.editor);
    const auto &past = ui.editor.past, &future = ui.editor.future;
    for (auto step = past.rbegin(); step != past.rend() && at > position; ++step) {
        ui.tell(UndoStep{});
        if (is_of_document(*step)) --at;
    }
    for (auto step = future.rbegin(); step != future.rend() && at < position; ++step) {
        ui.tell(RedoStep{});
        if (is_of_document(*step)) ++at;
    }
}

bool can_play(const Editor& editor) {
    return editor.document && !editor.drag && playback_steps(editor) > 0;
}

} // namespace

std::size_t playback_position(const Editor& editor) {
    return count_of(editor.past);
}

std::size_t playback_steps(const Editor& editor) {
    return count_of(editor.past) + count_of(editor.future);
}

void toggle_playing(const Ui& ui) {
    Playback& playback = ui.state.playback;
    playback.shown = true;
    playback.playing = !playback.playing && can_play(ui.editor);
    if (!playback.playing) return;
    playback.steps = playback_steps(ui.editor);
    playback.next_at = ImGui::GetTime() + 0.6;
    if (playback_position(ui.editor) == playback.steps) playback.wanted = 0;
}

void play_to(const Ui& ui, std::size_t position) {
    ui.state.playback.wanted = position;
}

// Whoever only looked is back where they were: what was done is not lost by the next act.
void close_timeline(const Ui& ui) {
    ui.state.playback.shown = false;
    ui.state.playback.playing = false;
    if (can_play(ui.editor)) play_to(ui, playback_steps(ui.editor));
}

void play_on(const Ui& ui) {
    Playback& playback = ui.state.playback;
    if (!can_play(ui.editor) || (playback.playing && playback_steps(ui.editor) != playback.steps)) {
        playback.playing = false;
        playback.wanted.reset();
        return;
    }
    const double now = ImGui::GetTime();
    if (ui.editor.status.busy) {
        // What takes long is looked at as long as what does not.
        if (playback.playing) playback.next_at = std::max(playback.next_at, now + 0.5 / playback.speed);
        return;
    }
    if (playback.wanted) {
        go_to(ui, *playback.wanted);
        playback.wanted.reset();
        return;
    }
    if (!playback.playing || now < playback.next_at) return;
    const std::size_t position = playback_position(ui.editor);
    if (position == playback.steps) {
        playback.playing = false;
        return;
    }
    playback.next_at = now + 1 / playback.speed;
    go_to(ui, position + 1);
}

namespace {

// The steps as a line with a notch for each, a knob at the position; a press or a drag goes there.
void step_line(const Ui& ui, float width, float height) {
    Playback& playback = ui.state.playback;
    const std::size_t steps = playback_steps(ui.editor);
    const std::size_t position = playback.wanted ? *playback.wanted : playback_position(ui.editor);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("steps", {width, height});
    const float margin = ui.scaled(9), length = width - 2 * margin, y = corner.y + height / 2;
    const float gap = length / static_cast<float>(std::max<std::size_t>(steps, 1));
    const auto place = [&](std::size_t step) { return corner.x + margin + gap * static_cast<float>(step); };
    if (ImGui::IsItemActive() && steps > 0) {
        const float along = (ImGui::GetIO().MousePos.x - place(0)) / gap;
        const auto there =
            static_cast<std::size_t>(std::clamp(along + 0.5f, 0.0f, static_cast<float>(steps)));
        playback.playing = false;
        if (there != position) play_to(ui, there);
    }
    if (!ImGui::IsItemActive()) explain("Drag to go back and forth through what was done");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float half = ui.scaled(2);
    list.AddRectFilled({place(0), y - half}, {place(0) + length, y + half}, palette::field_pressed, half);
    list.AddRectFilled({place(0), y - half}, {place(position), y + half}, palette::accent, half);
    if (gap > ui.scaled(6))
        for (std::size_t step = 0; step <= steps; ++step)
            list.AddCircleFilled({place(step), y}, ui.scaled(3.5f),
                                 step <= position ? palette::accent : palette::field_pressed);
    const bool held = ImGui::IsItemHovered() || ImGui::IsItemActive();
    list.AddCircleFilled({place(position), y}, ui.scaled(held ? 8.5f : 7.5f), palette::accent);
    list.AddCircleFilled({place(position), y}, ui.scaled(3), palette::on_accent);
}

void play_buttons(const Ui& ui, float side) {
    Playback& playback = ui.state.playback;
    ImGui::BeginDisabled(!can_play(ui.editor));
    if (icon_button("first", Icon::first, side, false, "To the cloud as it was opened")) {
        playback.playing = false;
        play_to(ui, 0);
    }
    ImGui::SameLine();
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play, side, false,
                    playback.playing ? "Stop here (Space)" : "Play the session (Space)"))
        toggle_playing(ui);
    ImGui::SameLine();
    if (icon_button("last", Icon::last, side, false, "To the end")) {
        playback.playing = false;
        play_to(ui, playback_steps(ui.editor));
    }
    ImGui::EndDisabled();
}

// "4 of 12", of a width that does not change while it plays.
std::string position_words(const Ui& ui) {
    const Playback& playback = ui.state.playback;
    const std::size_t position = playback.wanted ? *playback.wanted : playback_position(ui.editor);
    const std::size_t steps = playback_steps(ui.editor);
    if (steps == 0) return "Nothing done yet";
    return "Step " + std::to_string(position) + " of " + std::to_string(steps);
}

void speed_choice(const Ui& ui, float width) {
    Playback& playback = ui.state.playback;
    char label[32];
    std::snprintf(label, sizeof label, "%g a second", playback.speed);
    ImGui::SetNextItemWidth(width);
    if (ImGui::BeginCombo("##speed", label)) {
        for (const double speed : {0.5, 1.0, 2.0, 4.0, 8.0}) {
            std::snprintf(label, sizeof label, "%g a second", speed);
            if (ImGui::Selectable(label, speed == playback.speed)) playback.speed = speed;
        }
        ImGui::EndCombo();
    }
    explain("How many steps are played in a second");
}

} // namespace

void draw_timeline(const Ui& ui, Rectangle where) {
    if (!ui.state.playback.shown) return;
    ImGui::SetNextWindowPos({where.x, where.y});
    ImGui::SetNextWindowSize({where.width, where.height});
    const float side = ImGui::GetFrameHeight(), gap = ui.scaled(8);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(10), (where.height - side) / 2});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
    ImGui::Begin("timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    play_buttons(ui, side);
    ImGui::SameLine();
    const float speed_width = ui.scaled(128), words_width = ui.scaled(116);
    const float line_width = ImGui::GetContentRegionAvail().x - speed_width - words_width - side - 3 * gap;
    step_line(ui, std::max(line_width, ui.scaled(60)), side);
    ImGui::SameLine();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddText({at.x, at.y + (side - ImGui::GetFontSize()) / 2}, palette::faint,
                                        position_words(ui).c_str());
    ImGui::Dummy({words_width, side});
    ImGui::SameLine();
    speed_choice(ui, speed_width);
    ImGui::SameLine();
    if (icon_button("close", Icon::close, side, false, "Back to the end, and close the timeline"))
        close_timeline(ui);
    ImGui::End();
    ImGui::PopStyleVar(4);
}

} // namespace knead
