#pragma once
// How far the chosen handle pulls: dots on the surface around it, the fainter the farther, to where its
// falloff ends.
//
// They are looked for on a thread of its own whenever the handle or its falloff is another one, as far along
// the shape as it was opened as the solver goes, and lie on the shape as it is.

#include "base/background.h"
#include "base/locked.h"
#include "edit/editor.h"

#include <atomic>
#include <memory>
#include <vector>

namespace knead {

// So many at most.
inline constexpr std::size_t most_halo_dots = 2000;

struct HaloDot {
    Index vertex;
    float nearness; // 1 at the handle, 0 where the falloff ends
};

// Destroying it stops a search that goes on.
class FalloffHalo {
public:
    FalloffHalo() = default;
    ~FalloffHalo() { *stop_ = true; }
    FalloffHalo(const FalloffHalo&) = delete;
    FalloffHalo& operator=(const FalloffHalo&) = delete;

    // Drops what was found or is looked for: another cloud is looked at, say.
    void begin_anew();
    // Begins a search where one is due. Call it once a frame. While `wanted` is false there is nothing to
    // see.
    void look_at(const Editor& editor, bool wanted);
    // Null where there are none.
    const std::shared_ptr<const std::vector<HaloDot>>& dots() const { return dots_; }
    // Whether some are on the way: look again soon.
    bool expected() const { return thread_ != nullptr; }

private:
    // What dots are of.
    struct Of {
        std::shared_ptr<const std::vector<Index>> points;      // of the handle; null: of nothing
        double falloff = 0;                                    // its own
        std::shared_ptr<const PatchesOfHandles> small_patches; // of the document; null without any of it
        std::shared_ptr<const Graph> graph;
        bool operator==(const Of&) const = default;
    };
    struct Result {
        bool done = false;
        std::vector<HaloDot> dots;
    };

    static Of due(const Editor& editor, bool wanted);
    void take_found();
    void begin(const Editor& editor, Of of);

    Of searched_; // for last; of nothing where that was dropped
    // Of the search that goes on, or was the last; it has its own hold on it.
    std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
    std::shared_ptr<const std::vector<HaloDot>> dots_;
    Locked<Result> result_;
    std::unique_ptr<Background> thread_; // goes first: it writes the result
};

} // namespace knead
