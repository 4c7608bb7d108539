#include "app/timeline.h"

#include "app/icons.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace knead {

namespace {

// Rest after a step, in seconds at a speed of 1: where something moved, and where nothing did (handles were
// made, settings changed).
constexpr double after_motion = 0.45, after_others = 0.12;

// A document that plays no step so many seconds after it was asked for a frame of it, and is not busy, has
// done so or will not.
constexpr double time_for_frame = 0.25;

double rest_of_step(const Ui& ui) {
    const bool moved = ui.editor.document && ui.editor.document->last_frames > 0;
    return (moved ? after_motion : after_others) / ui.state.playback.speed;
}

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
        ui.tell(UndoStep{.to_look = true});
        if (is_of_document(*step)) --at;
    }
    for (auto step = future.rbegin(); step != future.rend() && at < position; ++step) {
        ui.tell(RedoStep{.to_look = true});
        if (is_of_document(*step)) ++at;
    }
}

// The number of a step among all, those of the past and then those of the future.
const EditorStep& step_at(const Editor& editor, std::size_t number) {
    const std::size_t done = editor.past.size();
    return number < done ? editor.past[number] : editor.future[editor.future.size() - 1 - (number - done)];
}

// Goes to where looking began, if it began at this position: what only changed the selection is as it was,
// too. Returns whether.
bool go_back(const Ui& ui, std::size_t position) {
    const Editor& editor = ui.editor;
    if (!editor.looks_from) return false;
    const std::size_t done = editor.past.size(), wanted = *editor.looks_from;
    std::size_t of_document = 0;
    for (std::size_t step = 0; step < wanted; ++step)
        if (is_of_document(step_at(editor, step))) ++of_document;
    if (of_document != position) return false;
    // The step that is being looked at frame by frame is the last one, but not all of it.
    if (done == wanted && editor.status.playing) {
        ui.tell(UndoStep{.to_look = true});
        ui.tell(RedoStep{.to_look = true});
    }
    for (std::size_t step = done; step < wanted; ++step) ui.tell(RedoStep{.to_look = true});
    for (std::size_t step = done; step > wanted; --step) ui.tell(UndoStep{.to_look = true});
    return true;
}

// Plays the next step of the document; those that only changed the selection come with it.
void play_step(const Ui& ui) {
    const auto& future = ui.editor.future;
    for (auto step = future.rbegin(); step != future.rend(); ++step) {
        if (is_of_document(*step)) return ui.tell(PlayStep{});
        ui.tell(RedoStep{.to_look = true});
    }
}

void ask_for_frame(Playback& playback, std::size_t frame) {
    playback.frame = frame;
    playback.asked_frame_at = ImGui::GetTime();
}

// From where a step of the document ends to the frame before it; without frames, to where it began.
void step_back(const Ui& ui) {
    const std::size_t frames = ui.editor.document->last_frames;
    if (frames < 2 || ui.editor.status.playing) return play_to(ui, playback_position(ui.editor) - 1);
    const auto& past = ui.editor.past;
    for (auto step = past.rbegin(); step != past.rend(); ++step) {
        ui.tell(UndoStep{.to_look = true});
        if (is_of_document(*step)) break;
    }
    ui.tell(PlayStep{});
    ask_for_frame(ui.state.playback, frames - 1);
    ui.tell(
        AdvancePlaying{static_cast<int>(std::min<std::size_t>(frames - 1, std::numeric_limits<int>::max()))});
}

// Whether someone did something else in the middle of it.
bool was_left(const Ui& ui) {
    const Playback& playback = ui.state.playback;
    return !playback.wanted &&
           (playback_steps(ui.editor) != playback.steps || playback_position(ui.editor) != playback.position);
}

// Where the user went on, looking begins from there.
void begin_where_left(const Ui& ui) {
    if (!was_left(ui)) return;
    Playback& playback = ui.state.playback;
    playback.steps = playback_steps(ui.editor);
    playback.origin = playback.position = playback_position(ui.editor);
}

// Whether playing would begin again from here: at the last step, and where the user is, as what they took
// back is theirs to look at frame by frame and no part of the film.
bool is_played_out(const Playback& playback) {
    return playback.position == playback.steps ||
           (playback.position == playback.origin && playback.origin > 0);
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

void show_timeline(const Ui& ui) {
    Playback& playback = ui.state.playback;
    if (playback.shown) return;
    playback.shown = true;
    playback.wanted.reset();
    playback.origin = playback.position;
    begin_where_left(ui);
}

void toggle_playing(const Ui& ui) {
    Playback& playback = ui.state.playback;
    show_timeline(ui);
    if (playback.playing) {
        playback.playing = false;
        return ui.tell(PacePlaying{playback.speed, true});
    }
    if (!can_play(ui.editor)) return;
    begin_where_left(ui);
    playback.playing = true;
    playback.frame.reset();
    playback.rests_since = ImGui::GetTime();
    ui.tell(PacePlaying{playback.speed, false});
    const bool again = is_played_out(playback) && !ui.editor.status.playing;
    if (again) playback.wanted = 0;
    const std::size_t begin = again ? 0 : playback.position;
    playback.end =
        begin < playback.origin || (begin == playback.origin && begin > 0) ? playback.origin : playback.steps;
}

void play_frame(const Ui& ui, int direction) {
    Playback& playback = ui.state.playback;
    if (!can_play(ui.editor)) return;
    show_timeline(ui);
    begin_where_left(ui);
    playback.playing = false;
    if (!playback.frame)
        ui.tell(PacePlaying{playback.speed, true}); // which drops frames that are still to come
    const std::size_t position = playback_position(ui.editor);
    const auto& playing = ui.editor.status.playing;
    if (const auto at = playing && !playback.frame ? playing->frame : playback.frame.value_or(0);
        (playing || playback.frame) && (direction > 0 || at > 1)) {
        ask_for_frame(playback, direction > 0 ? at + 1 : at - 1);
        return ui.tell(AdvancePlaying{direction});
    }
    playback.frame.reset();
    if (direction < 0) return position > 0 ? step_back(ui) : void();
    if (position == playback_steps(ui.editor)) return;
    playback.position = position + 1;
    play_step(ui);
    ask_for_frame(playback, 1);
    ui.tell(AdvancePlaying{1});
}

void play_to(const Ui& ui, std::size_t position) {
    begin_where_left(ui);
    ui.state.playback.wanted = position;
    ui.state.playback.frame.reset();
}

// Whoever only looked is back where they were: neither is what was done lost by the next act, nor what was
// undone done again.
void close_timeline(const Ui& ui) {
    ui.state.playback.shown = false;
    ui.state.playback.playing = false;
    if (can_play(ui.editor) && !was_left(ui)) play_to(ui, ui.state.playback.origin);
}

void play_on(const Ui& ui) {
    Playback& playback = ui.state.playback;
    if (!ui.editor.status.playing && !ui.editor.status.busy &&
        ImGui::GetTime() > playback.asked_frame_at + time_for_frame)
        playback.frame.reset();
    // Who redoes a step while they look back goes on looking.
    if (!playback.wanted && looks_back(ui.editor)) playback.position = playback_position(ui.editor);
    if (!can_play(ui.editor) || (playback.playing && was_left(ui))) {
        playback.playing = false;
        playback.wanted.reset();
        return;
    }
    const double now = ImGui::GetTime();
    if (playback.wanted && (!ui.editor.status.busy || ui.editor.status.playing)) {
        if (!go_back(ui, *playback.wanted)) go_to(ui, *playback.wanted);
        playback.position = *playback.wanted;
        playback.wanted.reset();
        playback.rests_since = now;
        return;
    }
    if (!playback.playing) return;
    if (ui.editor.status.busy) playback.rests_since = now;
    if (ui.editor.status.playing || now < playback.rests_since + rest_of_step(ui)) return;
    if (playback.position == playback.end) {
        playback.playing = false;
        (void)go_back(ui, playback.position);
        return;
    }
    ++playback.position;
    play_step(ui);
}

std::string playback_words(const Ui& ui) {
    const Playback& playback = ui.state.playback;
    if (!playback.shown || !ui.has_cloud() || playback_steps(ui.editor) == 0) return {};
    const auto& playing = ui.editor.status.playing;
    const std::size_t position = playback_position(ui.editor);
    std::string words = playback.playing ? "Playing" : playing ? "Held" : "At";
    words += " step " + std::to_string(position) + " of " + std::to_string(playback_steps(ui.editor));
    if (playing && !playing->handle.empty())
        words += ": \"" + playing->handle + "\" moves, frame " + std::to_string(playing->frame) + " of " +
                 std::to_string(playing->frames);
    else if (playing && playing->frames > 0)
        words += ": the pose comes to rest";
    else if (!playing)
        words += position == 0 ? ": the cloud as it was opened" : ": " + ui.editor.document->last_words;
    if (playback.playing) return words + " · Space holds";
    const std::string close = position == playback.origin || was_left(ui)
                                  ? " · Esc closes"
                                  : " · Esc goes back to step " + std::to_string(playback.origin);
    if (is_played_out(playback) && !playing) return words + " · Space plays it all" + close;
    return words + " · Space plays on · Right shows the next frame" + close;
}

namespace {

// The steps as a line with a notch for each, a knob at the position; a press or a drag goes there.
void step_line(const Ui& ui, float width, float height) {
    Playback& playback = ui.state.playback;
    const std::size_t steps = playback_steps(ui.editor);
    const std::size_t position = playback.wanted ? *playback.wanted : playback_position(ui.editor);
    const auto& playing = ui.editor.status.playing;
    float reached = static_cast<float>(position); // in the middle of a step that is played
    if (playing && position > 0)
        reached += playing->frames > 0
                       ? static_cast<float>(playing->frame) / static_cast<float>(playing->frames) - 1
                       : -1.0f;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("steps", {width, height});
    const float margin = ui.scaled(9), length = width - 2 * margin, y = corner.y + height / 2;
    const float gap = length / static_cast<float>(std::max<std::size_t>(steps, 1));
    const auto at = [&](float steps_done) { return corner.x + margin + gap * steps_done; };
    const auto place = [&](std::size_t step) { return at(static_cast<float>(step)); };
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
    list.AddRectFilled({place(0), y - half}, {at(reached), y + half}, palette::accent, half);
    if (gap > ui.scaled(6))
        for (std::size_t step = 0; step <= steps; ++step)
            list.AddCircleFilled({place(step), y}, ui.scaled(3.5f),
                                 static_cast<float>(step) <= reached ? palette::accent
                                                                     : palette::field_pressed);
    const bool held = ImGui::IsItemHovered() || ImGui::IsItemActive();
    list.AddCircleFilled({at(reached), y}, ui.scaled(held ? 8.5f : 7.5f), palette::accent);
    list.AddCircleFilled({at(reached), y}, ui.scaled(3), palette::on_accent);
}

void play_buttons(const Ui& ui, float side) {
    Playback& playback = ui.state.playback;
    ImGui::BeginDisabled(!can_play(ui.editor));
    if (icon_button("first", Icon::first, side, false, "To the cloud as it was opened")) {
        playback.playing = false;
        play_to(ui, 0);
    }
    ImGui::SameLine();
    if (icon_button("back", Icon::frame_back, side, false, "One frame back (Left)")) play_frame(ui, -1);
    ImGui::SameLine();
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play, side, false,
                    playback.playing ? "Hold it here (Space)"
                                     : "Play the session as it was recorded (Space)"))
        toggle_playing(ui);
    ImGui::SameLine();
    if (icon_button("on", Icon::frame_on, side, false, "The next frame that was recorded (Right)"))
        play_frame(ui, 1);
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
    std::snprintf(label, sizeof label, "Speed × %g", playback.speed);
    ImGui::SetNextItemWidth(width);
    if (ImGui::BeginCombo("##speed", label)) {
        for (const double speed : {0.25, 0.5, 1.0, 2.0, 4.0}) {
            std::snprintf(label, sizeof label, "× %g", speed);
            if (!ImGui::Selectable(label, speed == playback.speed)) continue;
            playback.speed = speed;
            ui.tell(PacePlaying{speed, !playback.playing});
        }
        ImGui::EndCombo();
    }
    explain("× 1 shows 30 of the recorded frames in a second");
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
    // The status line says where it is, too.
    const bool narrow = where.width < ui.scaled(640);
    const float speed_width = narrow ? 0 : ui.scaled(128), words_width = narrow ? 0 : ui.scaled(116);
    const float line_width = ImGui::GetContentRegionAvail().x - speed_width - words_width - side - 3 * gap;
    step_line(ui, std::max(line_width, ui.scaled(60)), side);
    ImGui::SameLine();
    if (!narrow) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddText({at.x, at.y + (side - ImGui::GetFontSize()) / 2}, palette::faint,
                                            position_words(ui).c_str());
        ImGui::Dummy({words_width, side});
        ImGui::SameLine();
        speed_choice(ui, speed_width);
        ImGui::SameLine();
    }
    if (icon_button("close", Icon::close, side, false,
                    "Closes the timeline, and goes back to where you were (Esc)"))
        close_timeline(ui);
    ImGui::End();
    ImGui::PopStyleVar(4);
}

} // namespace knead
