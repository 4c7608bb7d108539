#pragma once
// An operator new that can be made to fail, for all of this program.

#include <cstddef>

namespace knead::test {

// The sanitizers have an operator new of their own, which this one would get in the way of: then nothing
// fails.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_own_new = false;
#else
constexpr bool has_own_new = true;
#endif

// While it lives, allocations are counted, and one of them throws std::bad_alloc: the one that comes after so
// many of this thread, of those that ask for at least so many bytes.
class FailingNew {
public:
    explicit FailingNew(std::size_t after, std::size_t at_least = 0);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    bool has_failed() const;
    std::size_t counted() const; // so far
};

} // namespace knead::test
