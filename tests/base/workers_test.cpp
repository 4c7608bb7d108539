#include "base/require.h"
#include "base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

namespace knead::test {
namespace {

TEST(Workers, reach_every_index_once) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        Workers workers(threads);
        EXPECT_EQ(workers.threads(), threads);
        for (const std::size_t count : {0U, 1U, 7U, 64U, 1000U})
            for (const std::size_t grain : {1U, 7U, 64U, 5000U}) {
                std::vector<std::atomic<int>> met(count);
                workers.for_each(count, grain, [&](std::size_t i) { ++met[i]; });
                for (const auto& times : met) ASSERT_EQ(times, 1) << threads << ' ' << count << ' ' << grain;
            }
    }
}

TEST(Workers, cut_the_work_by_its_size_alone) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        Workers workers(threads);
        std::vector<std::size_t> ends(10, 0);
        workers.for_chunks(95, 10, [&](std::size_t begin, std::size_t end) {
            ASSERT_EQ(begin % 10, 0U);
            ends[begin / 10] = end;
        });
        EXPECT_EQ(ends, (std::vector<std::size_t>{10, 20, 30, 40, 50, 60, 70, 80, 90, 95}));
    }
}

// Sums of floats depend on their order, so equal bits mean equal order.
TEST(Workers, give_the_same_sum_whatever_their_number) {
    std::vector<float> values(100000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0F / static_cast<float>(i + 1);
    std::vector<float> sums;
    for (const unsigned threads : {1U, 2U, 5U}) {
        Workers workers(threads);
        constexpr std::size_t grain = 1000;
        std::vector<float> parts(values.size() / grain, 0.0F);
        workers.for_chunks(values.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) parts[begin / grain] += values[i];
        });
        sums.push_back(std::accumulate(parts.begin(), parts.end(), 0.0F));
    }
    EXPECT_EQ(sums[0], sums[1]);
    EXPECT_EQ(sums[0], sums[2]);
}

TEST(Workers, hand_on_what_the_work_throws_and_go_on_working) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        Workers workers(threads);
        const auto fail = [](std::size_t i) {
            if (i == 77) throw std::runtime_error("77");
        };
        for (int again = 0; again < 20; ++again)
            EXPECT_THROW(workers.for_each(100, 3, fail), std::runtime_error);
        std::atomic<int> met = 0;
        workers.for_each(100, 3, [&](std::size_t) { ++met; });
        EXPECT_EQ(met, 100);
    }
}

TEST(Workers, refuse_chunks_of_nothing) {
    Workers workers(2);
    EXPECT_THROW(workers.for_each(10, 0, [](std::size_t) {}), BrokenInvariant);
}

TEST(Workers, survive_many_small_jobs) {
    Workers workers(4);
    std::atomic<std::size_t> met = 0;
    for (int job = 0; job < 2000; ++job) workers.for_each(8, 1, [&](std::size_t) { ++met; });
    EXPECT_EQ(met, 16000U);
}

// With far more of them than cores most come when the job is over, and find the next one, or none.
TEST(Workers, come_late_into_no_job_that_is_over) {
    Workers workers(32);
    for (std::size_t job = 0; job < 3000; ++job) {
        const std::size_t count = 2 + job % 13;
        std::vector<std::size_t> told(count, 0); // gone with the job, as is what the work refers to
        workers.for_each(count, 1, [&](std::size_t i) { told[i] += job + i; });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(told[i], job + i);
    }
}

TEST(Workers, take_one_thread_a_core_unless_told) {
    EXPECT_EQ(Workers().threads(), std::max(1U, std::thread::hardware_concurrency()));
}

} // namespace
} // namespace knead::test
