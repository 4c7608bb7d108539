#pragma once
// Marks of selection and hiding as they are kept for undo: every step that changes them keeps all of them,
// and points lie in memory as they lie in space, so runs of equal marks are few.

#include "edit/selecting.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

class KeptMarks {
public:
    KeptMarks() = default;
    // Of these marks those of selection and hiding.
    explicit KeptMarks(std::span<const std::uint8_t> marks);

    // Puts them in the place of those there; what else is marked stays. `marks`: as many as were kept.
    void restore(std::span<std::uint8_t> marks) const;

    bool operator==(const KeptMarks&) const = default;

private:
    std::vector<std::uint32_t> runs_; // how many points, times 4, and their marks
};

} // namespace knead
