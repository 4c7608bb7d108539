#pragma once
// Playing a session back: its steps are undone and done again in time, drags in the frames that were
// recorded, so what is seen is what was done. A drag or any other act in the middle goes on from there, as
// after an undo; from the end of the step, if that is being played.
//
// Positions count the steps of the document: 0 is the cloud as it was opened. Steps that only changed the
// selection come and go with their neighbours.

#include <cstddef>
#include <optional>
#include <string>

namespace knead {

struct Editor;
struct Ui;

struct Playback {
    bool shown = false; // the bar
    bool playing = false;
    double speed = 1;                  // 1: as it was recorded
    double rests_since = 0;            // ImGui's time when the last step had been played
    std::size_t steps = 0;             // there were when it last moved; others mean that the user went on
    std::size_t position = 0;          // it has led to; another means the same
    std::size_t origin = 0;            // the position when it was shown, where looking ends
    std::size_t end = 0;               // the position at which playing stops
    std::optional<std::size_t> wanted; // the position to go to, once the document is free
    std::optional<std::size_t> frame; // of a step that is looked at frame by frame: asked for last, which the
                                      // document may be on its way to
    double asked_frame_at = 0;        // ImGui's time then
};

std::size_t playback_position(const Editor& editor);
std::size_t playback_steps(const Editor& editor);

// Starts playing, from the beginning where it is at the end; or stops.
void toggle_playing(const Ui& ui);
// Shows the next frame of the step that is played, or the one before it, and stops there.
void play_frame(const Ui& ui, int direction);
// What is played, in words; empty when the timeline is not shown.
std::string playback_words(const Ui& ui);
// Goes to a position, the newest one that was asked for.
void play_to(const Ui& ui, std::size_t position);
// Takes the step that is due. Call it once a frame.
void play_on(const Ui& ui);

// Shows the timeline. Takes it away, and goes back to where it was shown, unless something else was done
// meanwhile.
void show_timeline(const Ui& ui);
void close_timeline(const Ui& ui);

} // namespace knead
