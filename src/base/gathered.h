#pragma once
// Items put together by many threads.

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace knead {

// Each thread fills a Block of its own and hands it over when it is full or goes out of scope. The order of
// the items is left to chance, and nothing may depend on it.
template<typename Item>
class Gathered {
public:
    std::span<const Item> items() const { return items_; }
    void clear() { items_.clear(); }

    class Block {
    public:
        explicit Block(Gathered& whole) : whole_(whole) {}
        ~Block() { hand_over(); }
        Block(const Block&) = delete;
        Block& operator=(const Block&) = delete;

        void push(const Item& item) {
            held_[count_++] = item;
            if (count_ == std::size(held_)) hand_over();
        }

    private:
        void hand_over() {
            if (count_ == 0) return;
            const std::lock_guard lock(whole_.mutex_);
            whole_.items_.insert(whole_.items_.end(), held_, held_ + count_);
            count_ = 0;
        }

        Gathered& whole_;
        Item held_[128];
        std::size_t count_ = 0;
    };

private:
    std::mutex mutex_;
    std::vector<Item> items_;
};

} // namespace knead
