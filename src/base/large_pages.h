#pragma once
// Large arrays in large pages of memory: what is read and written as a whole, frame after frame, then takes
// less time, as the processor has fewer pages to look up.
//
// Linux does so by itself where its transparent huge pages are set to "always", as Debian has them, and where
// they are set to "madvise" for what asks.

#include <cstddef>
#include <vector>

namespace knead {

// Asks for it, for memory that nothing was written to so far. Only a wish: nothing is told of how it went.
void ask_for_large_pages(void* memory, std::size_t bytes);

// array.resize(count), in new memory if it has to become larger; what the array held is lost then.
template<typename Value>
void resize_in_large_pages(std::vector<Value>& array, std::size_t count) {
    if (count > array.capacity()) {
        array = {};
        array.reserve(count);
        ask_for_large_pages(array.data(), count * sizeof(Value));
    }
    array.resize(count);
}

} // namespace knead
