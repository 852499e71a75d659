#include "netsim/kernel/overflow_buckets.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr std::int64_t end_of_time = std::numeric_limits<std::int64_t>::max();

std::vector<EventKey> keys_at(const std::vector<std::int64_t>& times) {
    std::vector<EventKey> keys;
    for (const std::int64_t time : times) {
        keys.push_back(EventKey{.time_ps = time, .order = keys.size()});
    }
    return keys;
}

// The times of each batch that is opened, sorted.
std::vector<std::vector<std::int64_t>> opened_by(OverflowBuckets& far) {
    std::vector<std::vector<std::int64_t>> batches;
    while (!far.empty()) {
        std::vector<EventKey> keys;
        far.open_next(keys);
        std::vector<std::int64_t>& batch = batches.emplace_back();
        for (const EventKey& key : keys) {
            batch.push_back(key.time_ps);
        }
        std::ranges::sort(batch);
    }
    return batches;
}

OverflowBuckets far_at(const std::vector<std::int64_t>& times) {
    std::vector<EventKey> keys = keys_at(times);
    OverflowBuckets far;
    far.take_all(keys);
    return far;
}

TEST(OverflowBuckets, HoldsNothingAtFirst) {
    const OverflowBuckets far;
    EXPECT_FALSE(far.belongs_here(0));
    EXPECT_FALSE(far.belongs_here(end_of_time));
}

TEST(OverflowBuckets, TakesAllKeys) {
    std::vector<EventKey> keys = keys_at({30, 10, 20});
    OverflowBuckets far;
    far.take_all(keys);
    EXPECT_TRUE(keys.empty());
    EXPECT_EQ(far.size(), 3U);
}

TEST(OverflowBuckets, EarlierEventsDoNotBelongHere) {
    const OverflowBuckets far = far_at({1000, 2000});
    EXPECT_FALSE(far.belongs_here(999));
    EXPECT_TRUE(far.belongs_here(1000));
}

TEST(OverflowBuckets, EventsOfAnOpenedBucketDoNotBelongHere) {
    OverflowBuckets far = far_at({1000, 1000, 5'000'000});
    std::vector<EventKey> keys;
    far.open_next(keys);
    EXPECT_EQ(keys.size(), 2U);
    EXPECT_FALSE(far.belongs_here(1000));
    EXPECT_TRUE(far.belongs_here(5'000'000));
}

TEST(OverflowBuckets, EventsOfOneTimeAreOpenedTogether) {
    OverflowBuckets far = far_at(std::vector<std::int64_t>(1000, 7));
    EXPECT_EQ(opened_by(far), (std::vector<std::vector<std::int64_t>>{std::vector<std::int64_t>(1000, 7)}));
}

TEST(OverflowBuckets, AVeryLateEventDoesNotPutAllOthersIntoOneBucket) {
    std::vector<std::int64_t> times;
    for (std::int64_t i = 0; i < 1000; ++i) {
        times.push_back(i * 1000);
    }
    times.push_back(end_of_time);
    OverflowBuckets far = far_at(times);
    for (const std::vector<std::int64_t>& batch : opened_by(far)) {
        EXPECT_LE(batch.size(), 10U);
    }
}

TEST(OverflowBuckets, ErasedEventsAreNotOpened) {
    OverflowBuckets far = far_at({10, 20, 30, 40, end_of_time});
    far.erase_if([](const EventKey& key) { return key.time_ps % 20 == 0; });
    EXPECT_EQ(far.size(), 3U);
    std::vector<std::int64_t> left;
    for (const std::vector<std::int64_t>& batch : opened_by(far)) {
        left.insert(left.end(), batch.begin(), batch.end());
    }
    EXPECT_EQ(left, (std::vector<std::int64_t>{10, 30, end_of_time}));
}

// For any times of additions that are far ahead, time advances batch by batch, and nothing is lost.
class OverflowBucketsInOrder : public testing::TestWithParam<unsigned> {};

TEST_P(OverflowBucketsInOrder, BatchesFollowEachOther) {
    std::mt19937_64 random(GetParam());
    const std::uint64_t most = std::uint64_t{1} << (random() % 63);
    std::vector<std::int64_t> times(1 + random() % 2000);
    std::ranges::generate(times, [&] { return static_cast<std::int64_t>(random() % most); });
    OverflowBuckets far = far_at(times);
    std::vector<std::int64_t> opened;
    while (!far.empty()) {
        std::vector<EventKey> keys;
        far.open_next(keys);
        ASSERT_FALSE(keys.empty());
        const auto by_time = [](const EventKey& one, const EventKey& other) {
            return one.time_ps < other.time_ps;
        };
        std::ranges::sort(keys, by_time);
        for (const EventKey& key : keys) {
            ASSERT_TRUE(opened.empty() || opened.back() <= key.time_ps);
            opened.push_back(key.time_ps);
        }
        const auto wait = static_cast<std::int64_t>(random() % most / 4);
        if (random() % 2 == 0 && wait <= end_of_time - opened.back() &&
            far.belongs_here(opened.back() + wait)) {
            far.add(EventKey{.time_ps = opened.back() + wait});
            times.push_back(opened.back() + wait);
        }
        if (times.size() > 5000) {
            break;
        }
    }
    std::ranges::sort(times);
    times.resize(opened.size());
    EXPECT_EQ(opened, times);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OverflowBucketsInOrder, testing::Range(1U, 41U));

}  // namespace
}  // namespace netsim
