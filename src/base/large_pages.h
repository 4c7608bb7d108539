#pragma once
// Large arrays in large pages of memory: what is read and written as a whole, frame after frame, then takes
// less time, as the processor has fewer pages to look up.
//
// Linux does so by itself where its transparent huge pages are set to "always", as Debian has them, and where
// they are set to "madvise" for what asks.

#include <cstddef>
#include <new>
#include <vector>

namespace knead {

class Workers;

// Bytes of a line of the processor's cache.
inline constexpr std::size_t cache_line = 64;

// For arrays that begin where a line does, so that no vector of a line's size lies across two. (Those of
// std::allocator begin 16 bytes behind, if they are large.)
template<typename Value>
struct LineAllocator {
    using value_type = Value;
    LineAllocator() = default;
    template<typename Other>
    LineAllocator(const LineAllocator<Other>& /*other*/) {}

    Value* allocate(std::size_t count) {
        return static_cast<Value*>(::operator new(count * sizeof(Value), std::align_val_t(cache_line)));
    }
    void deallocate(Value* memory, std::size_t /*count*/) {
        ::operator delete(memory, std::align_val_t(cache_line));
    }
    friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

template<typename Value>
using LineArray = std::vector<Value, LineAllocator<Value>>;

// Asks for them, for memory that nothing was written to so far, and has all workers take them at once: a page
// is cleared when it is touched first, and a vector that is filled touches them one after the other. Only a
// wish: nothing is told of how it went.
void take_large_pages(void* memory, std::size_t bytes, Workers& workers);

// array.resize(count), in new memory if it has to become larger; what the array held is lost then.
template<typename Value, typename Allocator>
void resize_in_large_pages(std::vector<Value, Allocator>& array, std::size_t count, Workers& workers) {
    if (count > array.capacity()) {
        array = std::vector<Value, Allocator>(); // {} would keep the memory
        array.reserve(count);
        take_large_pages(array.data(), count * sizeof(Value), workers);
    }
    array.resize(count);
}

// So many zeros.
template<typename Value>
std::vector<Value> zeros_in_large_pages(std::size_t count, Workers& workers) {
    std::vector<Value> array;
    resize_in_large_pages(array, count, workers);
    return array;
}

} // namespace knead
