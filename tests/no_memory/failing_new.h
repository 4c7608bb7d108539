#pragma once
// An operator new that can be made to fail, for all of this program.

#include <cstddef>

namespace knead::test {

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
