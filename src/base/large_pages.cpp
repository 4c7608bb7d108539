#include "base/large_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace knead {

namespace {

// Less is not worth a call, and may share its pages with others.
constexpr std::size_t least_bytes = std::size_t{4} << 20;
constexpr std::uintptr_t page = 4096;

} // namespace

void ask_for_large_pages([[maybe_unused]] void* memory, std::size_t bytes) {
    if (bytes < least_bytes) return;
#ifdef MADV_HUGEPAGE
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
    (void)::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

} // namespace knead
