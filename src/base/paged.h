#pragma once
// A number for each of very many indices, few of which are ever set.

#include <cstddef>
#include <vector>

namespace knead {

// Takes memory page by page, where something is set: quick to make, and small as long as what is set lies
// close together.
template<typename Number>
class Paged {
public:
    // All of them have this value.
    Paged(std::size_t count, Number value) : value_(value), pages_(count / page_size + 1) {}

    Number operator[](std::size_t i) const {
        const std::vector<Number>& page = pages_[i / page_size];
        return page.empty() ? value_ : page[i % page_size];
    }

    // Makes room for this one and its page. Not for several threads at a time.
    void make_room(std::size_t i) {
        std::vector<Number>& page = pages_[i / page_size];
        if (page.empty()) page.assign(page_size, value_);
    }

    // Where there is room. Different ones may be set at the same time.
    void set(std::size_t i, Number number) { pages_[i / page_size][i % page_size] = number; }

private:
    static constexpr std::size_t page_size = 512;
    Number value_;
    std::vector<std::vector<Number>> pages_;
};

} // namespace knead
