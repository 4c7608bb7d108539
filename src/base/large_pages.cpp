#include "base/large_pages.h"

#include <memory>

#include <sys/mman.h>

namespace knead {

namespace {

// Less is not worth a call, and may share its pages with others.
constexpr std::size_t least_bytes = std::size_t{4} << 20;
constexpr std::size_t page = 4096;

} // namespace

void ask_for_large_pages([[maybe_unused]] void* memory, std::size_t bytes) {
    if (bytes < least_bytes) return;
#ifdef MADV_HUGEPAGE
    if (std::align(page, page, memory, bytes)) (void)::madvise(memory, bytes / page * page, MADV_HUGEPAGE);
#endif
}

} // namespace knead
