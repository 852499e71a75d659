#include "netsim/medium/sort_arrivals.hpp"

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr SimTime sent = SimTime::from_us(7);

struct ScheduledArrival {
    SimTime start;
    std::int32_t radio = 0;

    bool operator==(const ScheduledArrival&) const = default;
    friend std::ostream& operator<<(std::ostream& out, const ScheduledArrival& arrivals) {
        return out << arrivals.start.ps() << " ps at " << arrivals.radio;
    }
};

// Arrivals with random delays up to a maximum; `kinds` different ones.
std::vector<ScheduledArrival> draw(RandomStream& draws, std::size_t count, std::int64_t longest_ps,
                                   std::uint32_t kinds) {
    std::vector<ScheduledArrival> arrivals;
    for (std::size_t i = 0; i < count; ++i) {
        const auto delay_ps = static_cast<std::int64_t>(static_cast<double>(longest_ps) *
                                                        draws.uniform_int(kinds) / (kinds - 1));
        const auto radio = static_cast<std::int32_t>(count - i) * 3;
        arrivals.push_back({sent + SimTime::from_ps(delay_ps), i == 0 ? 0x7FFFFFFF : radio});
    }
    return arrivals;
}

struct Case {
    const char* name;
    std::int64_t longest_ps;
    std::uint32_t kinds;
};

class SortArrivals : public testing::TestWithParam<Case> {};

TEST_P(SortArrivals, SortsByStartThenByRadio) {
    RandomStream draws(1, 0, Purpose{1004});
    std::vector<ScheduledArrival> spare;
    for (std::size_t count = 0; count < 70; ++count) {
        std::vector<ScheduledArrival> arrivals = draw(draws, count, GetParam().longest_ps, GetParam().kinds);
        std::vector<ScheduledArrival> expected = arrivals;
        std::ranges::sort(expected, {},
                          [](const ScheduledArrival& one) { return std::tuple(one.start.ps(), one.radio); });
        sort_arrivals(arrivals, sent, spare);
        ASSERT_EQ(arrivals, expected) << count;
    }
}

INSTANTIATE_TEST_SUITE_P(All, SortArrivals,
                         testing::Values(Case{"near", 1'000'000, 1'000'000}, Case{"onCircles", 1'000'000, 3},
                                         Case{"atTheLastDelayThatFits", (1LL << 31) - 2, 1000},
                                         Case{"beyondIt", (1LL << 31) - 1, 1000},
                                         Case{"farAway", 1'000'000'000'000, 1000}),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace netsim
