#pragma once
// Many items in no order, put one upon the other.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>

namespace knead {

// Takes memory piece by piece: nothing is moved to make room for more, little is left unused, and an empty
// one is a pointer.
template<typename Item>
class Pile {
public:
    Pile() = default;
    Pile(Pile&& other) noexcept = default;
    Pile& operator=(Pile&& other) noexcept {
        clear();
        top_ = std::move(other.top_);
        return *this;
    }
    Pile(const Pile&) = delete;
    Pile& operator=(const Pile&) = delete;
    ~Pile() { clear(); }

    bool empty() const { return !top_; }

    void push(const Item& item) {
        if (!top_ || top_->count == items_a_piece) {
            auto piece = std::make_unique_for_overwrite<Piece>();
            piece->count = 0;
            piece->below = std::move(top_);
            top_ = std::move(piece);
        }
        top_->items[top_->count++] = item;
    }

    // Calls visit(item) for all of them.
    template<typename Visit>
    void each(Visit&& visit) const {
        for (const Piece* piece = top_.get(); piece; piece = piece->below.get())
            for (std::size_t i = 0; i < piece->count; ++i) visit(piece->items[i]);
    }

    // Calls visit(item) for all of them, and frees them on the way.
    template<typename Visit>
    void take(Visit&& visit) {
        for (; top_; pop_piece())
            for (std::size_t i = 0; i < top_->count; ++i) visit(top_->items[i]);
    }

    // One of which is_it(item), null if there is none.
    template<typename Is>
    const Item* find_if(Is&& is_it) const {
        for (const Piece* piece = top_.get(); piece; piece = piece->below.get()) {
            const auto end = piece->items.begin() + static_cast<std::ptrdiff_t>(piece->count);
            const auto found = std::find_if(piece->items.begin(), end, is_it);
            if (found != end) return &*found;
        }
        return nullptr;
    }

    // Takes out those of which goes(item), which is asked once for each.
    template<typename Goes>
    void erase_if(Goes&& goes) {
        for (Piece* piece = top_.get(); piece;) {
            Piece* const below = piece->below.get();
            for (std::size_t i = 0; i < piece->count;) {
                if (!goes(piece->items[i])) {
                    ++i;
                } else if (piece == top_.get()) {
                    piece->items[i] = piece->items[--piece->count];
                } else { // those above have been asked, and stay
                    piece->items[i++] = top_->items[--top_->count];
                    if (top_->count == 0) pop_piece();
                }
            }
            if (piece->count == 0) pop_piece();
            piece = below;
        }
    }

    void clear() {
        while (top_) pop_piece(); // one after the other: their number is no matter of the stack
    }

private:
    static constexpr std::size_t items_a_piece = 32;

    struct Piece {
        std::unique_ptr<Piece> below; // which is full
        std::size_t count;
        std::array<Item, items_a_piece> items;
    };

    void pop_piece() { top_ = std::move(top_->below); }

    std::unique_ptr<Piece> top_;
};

} // namespace knead
