#include "edit/posed_shapes.h"

#include <utility>

namespace knead {

namespace {

// That wait to be written over while others are shown: more are not needed.
constexpr std::size_t most_spent = 2;

} // namespace

PosedShapes::PosedShapes() : spent_(std::make_shared<Spent>()) {
    spent_->with([](auto& all) { all.reserve(most_spent); });
    now_ = take();
}

// One that nobody has, or a new one; it comes back when everybody has let go of it.
std::shared_ptr<PosedShapes::Written> PosedShapes::take() {
    auto one = spent_->with([](auto& all) {
        if (all.empty()) return std::unique_ptr<Written>();
        auto last = std::move(all.back());
        all.pop_back();
        return last;
    });
    if (!one) one = std::make_unique<Written>();
    return {one.release(), [spent = spent_](Written* written) {
                std::unique_ptr<Written> owned(written);
                spent->with([&](auto& all) {
                    if (all.size() < most_spent) all.push_back(std::move(owned));
                });
            }};
}

std::shared_ptr<const RestShape> PosedShapes::keep_now() {
    is_kept_ = true;
    return {now_, &now_->shape};
}

void PosedShapes::make_room(std::size_t positions, std::size_t normals, Workers& workers) {
    RestShape& shape = now_->shape;
    if (shape.positions.size() == positions && shape.normals.size() == normals) return;
    if (is_kept_) now_ = take();
    is_kept_ = now_->was_written = false;
    make_room_in(now_->shape, positions, normals, workers);
}

void PosedShapes::make_room_in(RestShape& shape, std::size_t positions, std::size_t normals,
                               Workers& workers) {
    resize_in_large_pages(shape.positions, positions, workers);
    resize_in_large_pages(shape.normals, normals, workers);
}

void PosedShapes::make_spares(Workers& workers) {
    if (now().positions.empty()) return; // nobody knows how large they are to be
    const std::size_t there = spent_->with([](const auto& all) { return all.size(); });
    for (std::size_t made = there; made < most_spent; ++made) {
        auto spare = std::make_unique<Written>();
        make_room_in(spare->shape, now().positions.size(), now().normals.size(), workers);
        spent_->with([&](auto& all) {
            if (all.size() < most_spent) all.push_back(std::move(spare));
        });
    }
}

PosedShapes::Target PosedShapes::next(Workers& workers) {
    if (is_kept_) {
        std::shared_ptr<Written> other = take();
        make_room_in(other->shape, now().positions.size(), now().normals.size(), workers);
        now_ = std::move(other);
        is_kept_ = false;
    }
    return {now_->shape, std::exchange(now_->was_written, true)};
}

} // namespace knead
