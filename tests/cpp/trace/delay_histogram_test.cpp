#include "netsim/trace/delay_histogram.hpp"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

DelayHistogram of(std::initializer_list<std::int64_t> delays_ps) {
    DelayHistogram histogram;
    for (const std::int64_t delay_ps : delays_ps) {
        histogram.add(SimTime::from_ps(delay_ps));
    }
    return histogram;
}

TEST(DelayHistogram, EmptyItHasNoBins) {
    EXPECT_EQ(of({}).count(), 0U);
    EXPECT_TRUE(of({}).bins().empty());
}

TEST(DelayHistogram, SumsAndExtremesAreExact) {
    const DelayHistogram histogram = of({3'000'000'000'000, 1'000'000'000'000, 500'000'000'000});
    EXPECT_EQ(histogram.count(), 3U);
    EXPECT_DOUBLE_EQ(histogram.sum_s(), 4.5);
    EXPECT_DOUBLE_EQ(histogram.sum_of_squares_s2(), 10.25);
    EXPECT_EQ(histogram.min(), SimTime::from_seconds(0.5));
    EXPECT_EQ(histogram.max(), SimTime::from_seconds(3));
}

TEST(DelayHistogram, EqualDelaysShareABinAndOthersAreInOrder) {
    const auto bins = of({900, 7, 900, 0}).bins();
    ASSERT_EQ(bins.size(), 3U);
    EXPECT_EQ(bins[0].count, 1U);
    EXPECT_EQ(bins[1].count, 1U);
    EXPECT_EQ(bins[2].count, 2U);
    EXPECT_LE(bins[0].end, bins[1].begin);
    EXPECT_LE(bins[1].end, bins[2].begin);
}

// For any delay, also at both ends of each octave.
TEST(DelayHistogram, ABinHoldsItsDelayAndIsNarrow) {
    RandomStream draws(1, 0, Purpose{1001});
    for (unsigned octave = 0; octave < 63; ++octave) {
        const std::int64_t begin_ps = std::int64_t{1} << octave;
        const auto inside = static_cast<std::int64_t>(draws.uniform() * static_cast<double>(begin_ps));
        for (const std::int64_t delay_ps :
             {begin_ps - 1, begin_ps, begin_ps + inside, begin_ps + (begin_ps - 1)}) {
            const auto bins = of({delay_ps}).bins();
            ASSERT_EQ(bins.size(), 1U);
            EXPECT_LE(bins[0].begin.ps(), delay_ps);
            EXPECT_GT(bins[0].end.ps(), std::min(delay_ps, SimTime::max().ps() - 1));
            EXPECT_LE(bins[0].end.ps() - bins[0].begin.ps(), std::max<std::int64_t>(1, delay_ps / 32));
        }
    }
}

TEST(DelayHistogram, BinsOfNeighboursMeet) {
    for (std::int64_t delay_ps = 0; delay_ps < 5000; ++delay_ps) {
        const auto bins = of({delay_ps, delay_ps + 1}).bins();
        if (bins.size() == 2) {
            EXPECT_EQ(bins[0].end, bins[1].begin);
            EXPECT_EQ(bins[0].end.ps(), delay_ps + 1);
        } else {
            EXPECT_GT(bins[0].end.ps(), delay_ps + 1);
        }
    }
}

}  // namespace
}  // namespace netsim
