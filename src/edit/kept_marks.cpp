#include "edit/kept_marks.h"

#include "base/require.h"

namespace knead {

namespace {

constexpr std::uint32_t longest_run = 0xffffffffU / 4;
// The two marks are the highest bits of a byte, and the lowest of a run.
constexpr unsigned lower_by = 6;
static_assert(marks_of_selection == 3U << lower_by);

} // namespace

KeptMarks::KeptMarks(std::span<const std::uint8_t> marks) {
    for (std::size_t i = 0; i < marks.size();) {
        const auto mark = static_cast<std::uint8_t>(marks[i] & marks_of_selection);
        const std::size_t begin = i;
        while (i < marks.size() && i - begin < longest_run && (marks[i] & marks_of_selection) == mark) ++i;
        runs_.push_back(static_cast<std::uint32_t>(4 * (i - begin)) |
                        static_cast<std::uint32_t>(mark >> lower_by));
    }
    runs_.shrink_to_fit();
}

void KeptMarks::restore(std::span<std::uint8_t> marks) const {
    std::size_t i = 0;
    for (const std::uint32_t run : runs_) {
        const std::size_t end = i + run / 4;
        const auto mark = (run & 3U) << lower_by;
        require(end <= marks.size(), "marks are of the cloud that they were kept of");
        for (; i < end; ++i) marks[i] = static_cast<std::uint8_t>((marks[i] & ~marks_of_selection) | mark);
    }
}

} // namespace knead
