#include "no_memory/failing_new.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

// Of this thread: those of gtest and of a device are let alone.
thread_local bool is_counting = false;
thread_local std::size_t fails_after = 0, least_size = 0, count = 0;

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* allocate(std::size_t size, std::size_t alignment) {
    if (is_counting && size >= least_size && count++ == fails_after) throw std::bad_alloc();
    const std::size_t whole = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
    void* const memory = std::aligned_alloc(alignment, whole);
    if (!memory) throw std::bad_alloc();
    return memory;
}
#endif

} // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// The compiler takes what new[] and the forms that do not throw are made of from these.
void* operator new(std::size_t size) {
    return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
#endif

namespace knead::test {

FailingNew::FailingNew(std::size_t after, std::size_t at_least) {
    fails_after = after;
    least_size = at_least;
    count = 0;
    is_counting = true;
}

FailingNew::~FailingNew() {
    is_counting = false;
}

bool FailingNew::has_failed() const {
    return count > fails_after;
}

std::size_t FailingNew::counted() const {
    return count;
}

} // namespace knead::test
