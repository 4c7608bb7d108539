// Threads where memory runs out while they are made.

#include "base/workers.h"
#include "no_memory/failing_new.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <optional>
#include <string>

namespace knead::test {
namespace {

TEST(WorkersNoMemory, AreFewerOrNoneAndDoTheWork) {
    if (!has_own_new) GTEST_SKIP() << "the sanitizers have an operator new of their own";
    bool has_failed = true;
    for (std::size_t after = 0; has_failed; ++after) {
        SCOPED_TRACE("without allocation " + std::to_string(after));
        std::optional<Workers> workers;
        {
            const FailingNew failing(after);
            try {
                workers.emplace(4);
            } catch (const std::bad_alloc&) { // what was begun is over by now
            }
            has_failed = failing.has_failed();
        }
        if (!workers) continue;
        std::atomic<int> done = 0;
        workers->for_each(100, 1, [&](std::size_t) { ++done; });
        EXPECT_EQ(done, 100);
        EXPECT_EQ(workers->threads() == 4, !has_failed);
    }
}

} // namespace
} // namespace knead::test
