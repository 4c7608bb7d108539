#pragma once
// Items put together by many threads.

#include <cstddef>
#include <list>
#include <mutex>
#include <vector>

namespace knead {

// Each thread fills a Block of its own and hands it over when it is full or goes out of scope. The order of
// the items is left to chance, and nothing may depend on it. Items are never copied to make room for more: so
// many of them need no more memory than they are. Memory is taken in push() alone: handing over cannot fail.
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
        for (; !blocks_.empty(); blocks_.pop_front())
            for (const Item& item : blocks_.front()) visit(item);
        size_ = 0;
    }

    class Block {
    public:
        explicit Block(Gathered& whole) : whole_(whole) {}
        ~Block() { hand_over(); }
        Block(const Block&) = delete;
        Block& operator=(const Block&) = delete;

        void push(const Item& item) {
            if (held_.empty() || held_.front().size() == most) begin_another();
            held_.front().push_back(item);
        }

    private:
        static constexpr std::size_t most = 1024;

        void begin_another() {
            std::list<std::vector<Item>> next(1);
            next.front().reserve(most);
            hand_over();
            held_.swap(next);
        }

        // Called by the destructor, where an exception would end the program.
        void hand_over() noexcept {
            if (held_.empty()) return;
            const std::lock_guard lock(whole_.mutex_);
            whole_.size_ += held_.front().size();
            whole_.blocks_.splice(whole_.blocks_.end(), held_);
        }

        Gathered& whole_;
        std::list<std::vector<Item>> held_; // one, or none yet
    };

private:
    std::mutex mutex_;
    std::list<std::vector<Item>> blocks_;
    std::size_t size_ = 0;
};

} // namespace knead
