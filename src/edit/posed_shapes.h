#pragma once
// Where posed points are written, so that somebody can look at one shape while the next one is made, and
// nothing is copied in between: who wants a shape to stay as it is keeps it, and the next one goes into other
// arrays. Those that nobody keeps any more are written over.

#include "base/locked.h"
#include "edit/rest_shape.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace knead {

class Workers;

// One thread at a time; what it hands out may be looked at, and let go of, in any.
class PosedShapes {
public:
    PosedShapes();

    // The one that was written last; empty before make_room().
    const RestShape& now() const { return now_->shape; }
    // The same. It stays as it is for as long as somebody has it, this object or not.
    std::shared_ptr<const RestShape> keep_now();

    // Makes sure that now() has room for so many numbers, without a promise of what they are.
    void make_room(std::size_t positions, std::size_t normals, Workers& workers);

    // Takes the memory for shapes to come while two are kept, so that next() need not: one that is shown, and
    // one that waits to be.
    void make_spares(Workers& workers);

    // What to write the next shape into, which becomes now(): the one that is now(), if nobody keeps it.
    struct Target {
        RestShape& shape; // of now()'s sizes
        bool was_written; // whether it has a shape that was written before; else anything
    };
    Target next(Workers& workers);

private:
    struct Written {
        RestShape shape;
        bool was_written = false;
    };
    using Spent = Locked<std::vector<std::unique_ptr<Written>>>;

    static void make_room_in(RestShape& shape, std::size_t positions, std::size_t normals, Workers& workers);
    std::shared_ptr<Written> take();

    std::shared_ptr<Spent> spent_; // those that nobody has any more
    std::shared_ptr<Written> now_;
    bool is_kept_ = false; // or was
};

} // namespace knead
