#pragma once
// Items put together by many threads.

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace knead {

// Each thread fills a Block of its own and hands it over when it is full or goes out of scope. The order of
// the items is left to chance, and nothing may depend on it. Items are never copied to make room for more: so
// many of them need no more memory than they are.
template<typename Item>
class Gathered {
public:
    std::size_t size() const { return size_; }

    // Calls visit(item) for all of them.
    template<typename Visit>
    void each(Visit&& visit) const {
        for (const std::vector<Item>& block : blocks_)
            for (const Item& item : block) visit(item);
    }

    // Calls visit(item) for all of them, and forgets and frees them on the way.
    template<typename Visit>
    void take(Visit&& visit) {
        for (std::vector<Item>& block : blocks_)
            for (const Item& item : std::exchange(block, {})) visit(item);
        blocks_.clear();
        size_ = 0;
    }

    class Block {
    public:
        explicit Block(Gathered& whole) : whole_(whole) {}
        ~Block() { hand_over(); }
        Block(const Block&) = delete;
        Block& operator=(const Block&) = delete;

        void push(const Item& item) {
            if (held_.size() == held_.capacity()) {
                hand_over();
                held_.reserve(most);
            }
            held_.push_back(item);
        }

    private:
        static constexpr std::size_t most = 1024;

        void hand_over() {
            if (held_.empty()) return;
            const std::lock_guard lock(whole_.mutex_);
            whole_.size_ += held_.size();
            whole_.blocks_.push_back(std::exchange(held_, {}));
        }

        Gathered& whole_;
        std::vector<Item> held_;
    };

private:
    std::mutex mutex_;
    std::vector<std::vector<Item>> blocks_;
    std::size_t size_ = 0;
};

} // namespace knead
