#pragma once
// Normals to light a cloud by whose file has none. Only for looking at: no file gets them.
//
// They are estimated from the neighbours of the points, on a thread of its own, once the neighbours are known
// and again whenever the shape comes to rest; while it moves only where that is quick. Elsewhere none are
// better than old ones: a turned arm would carry its light and shadow along.

#include "base/background.h"
#include "base/locked.h"
#include "edit/editor.h"

#include <memory>
#include <optional>
#include <vector>

namespace knead {

// Destroying it waits for an estimate that goes on: a second for a million points.
class EstimatedNormals {
public:
    // Another cloud is looked at; an estimate of the one before is dropped.
    void begin_anew();
    // Begins an estimate where one is due; `now` in seconds. Call it once a frame. Copies what the estimate
    // needs, so that the document may close meanwhile.
    void look_at(const Editor& editor, bool wanted, double now);
    // The newest, 3n unit floats in the order of the points, if there are any that were not taken yet.
    std::optional<std::vector<float>> take();
    // Whether those that were taken last lie too badly on the moving shape to be shown.
    bool outdated() const;
    // Whether they are made while the shape moves, from its positions. `wanted`: as of look_at().
    bool made_in_motion(const Editor& editor, bool wanted) const;
    // Whether some are on the way or due: look again soon.
    bool expected() const { return thread_ != nullptr || due_; }

private:
    struct Result {
        bool done = false;
        double seconds = 0; // that it took
        std::vector<float> normals;
    };

    void begin(const Editor& editor, double now);

    std::shared_ptr<const PointOrder> order_; // of the cloud
    std::uint64_t cloud_ = 0, of_cloud_ = 0;  // that is looked at, that is estimated for; counted
    std::uint64_t seen_ = 0, estimated_ = 0;  // versions of the frame
    double changed_ = 0;                      // when the version changed last, in seconds
    double begun_ = 0;                        // when the last estimate began
    double cost_ = 0;                         // seconds that it took
    bool due_ = false;
    Locked<Result> result_;
    std::unique_ptr<Background> thread_; // goes first: it writes the result
};

} // namespace knead
