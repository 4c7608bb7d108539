#include "base/large_pages.h"

#include "base/workers.h"

#include <memory>

#include <sys/mman.h>

namespace knead {

namespace {

// Less is not worth a call, and may share its pages with others.
constexpr std::size_t least_bytes = std::size_t{4} << 20;
constexpr std::size_t page = 4096;
constexpr std::size_t pages_at_once = (std::size_t{8} << 20) / page;

} // namespace

void take_large_pages([[maybe_unused]] void* memory, std::size_t bytes, [[maybe_unused]] Workers& workers) {
    if (bytes < least_bytes) return;
#ifdef MADV_HUGEPAGE
    if (!std::align(page, page, memory, bytes)) return;
    const std::size_t pages = bytes / page;
    (void)::madvise(memory, pages * page, MADV_HUGEPAGE);
#ifdef MADV_POPULATE_WRITE
    auto* const first = static_cast<std::byte*>(memory);
    workers.for_chunks(pages, pages_at_once, [&](std::size_t begin, std::size_t end) {
        (void)::madvise(first + begin * page, (end - begin) * page, MADV_POPULATE_WRITE);
    });
#endif
#endif
}

} // namespace knead
