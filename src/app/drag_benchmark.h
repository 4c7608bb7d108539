#pragma once
// How well the window follows the hand: a scripted artist opens a cloud in the real window, looks at it from
// all round for some seconds, makes two handles and drags one of them, while every picture shown is timed.

#include "app/run_editor.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace knead {

struct DragBenchmarkOptions {
    EditorOptions editor;   // with the file to open
    double seconds = 8;     // of dragging, and half as many of looking round
    double per_second = 60; // motions of the hand
};

// Of something that moves, from the first picture to the last.
struct MovingPictures {
    double seconds = 0;
    std::size_t pictures = 0, whole = 0;        // of them with every pixel, not half as many each way
    double frame_median = 0, frame_95 = 0;      // from one picture to the next, seconds
    double points_median = 0, points_least = 0; // in a picture
};

struct DragBenchmark {
    std::size_t points = 0;
    std::size_t samples = 0;
    double opened = 0;   // seconds from the start to the first picture of the cloud
    double editable = 0; // and until handles can be made and dragged at once
    MovingPictures orbit, drag;
    std::size_t poses = 0;           // of the drag: pictures with a pose that was not shown before
    std::size_t poses_on_device = 0; // of these: with points that were moved where they are drawn
    double age_median = 0, age_95 = 0, age_largest = 0; // of the pose on the screen when it is shown, seconds
    double largest_at = 0;    // when the largest was shown, seconds after the first picture of the drag
    double solve_median = 0;  // of the document's thread, seconds a frame
    std::uint64_t memory = 0; // the most that was held, bytes
    std::string opengl;       // what draws
};

// Throws what run_editor() throws, and Error (input) if the cloud cannot be opened.
DragBenchmark measure_drag(const DragBenchmarkOptions& options);

std::string drag_benchmark_text(const DragBenchmark& result);
std::string drag_benchmark_json(const DragBenchmark& result);

} // namespace knead
