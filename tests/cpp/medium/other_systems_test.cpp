#include "netsim/medium/other_systems.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double median_w = 1e-12;

SimTime ms(std::int64_t milliseconds) {
    return SimTime::from_us(1000 * milliseconds);
}

MediumConfig config_of(double standard_deviation_db, double coherence_time_s = 0.001) {
    MediumConfig config;
    config.other_systems_w = median_w;
    config.other_systems_standard_deviation_db = standard_deviation_db;
    config.other_systems_coherence_time_s = coherence_time_s;
    return config;
}

TEST(OtherSystems, AreNoneByDefault) {
    const OtherSystems none(MediumConfig(), 1);
    EXPECT_TRUE(none.is_none());
    EXPECT_EQ(none.power_w(0, ms(5)), 0);
    EXPECT_EQ(none.max_w(0, ms(5), ms(500)), 0);
}

TEST(OtherSystems, AreConstantWithoutADeviation) {
    const OtherSystems constant(config_of(0), 1);
    EXPECT_EQ(constant.power_w(0, ms(5)), median_w);
    EXPECT_EQ(constant.max_w(7, ms(5), ms(50)), median_w);
}

TEST(OtherSystems, AreLogNormal) {
    const OtherSystems systems(config_of(11), 3);
    constexpr int count = 20'000;
    double sum_db = 0;
    double squares = 0;
    for (int i = 0; i < count; ++i) {
        const double db = db_from_ratio(systems.power_w(0, ms(i)) / median_w);
        sum_db += db;
        squares += db * db;
    }
    EXPECT_NEAR(sum_db / count, 0, 0.3);
    EXPECT_NEAR(std::sqrt(squares / count), 11, 0.2);
}

TEST(OtherSystems, ChangeAfterEachCoherenceTime) {
    const OtherSystems systems(config_of(6), 1);
    const double before_w = systems.power_w(0, ms(2));
    EXPECT_EQ(systems.power_w(0, ms(3) - SimTime::from_ps(1)), before_w);
    EXPECT_NE(systems.power_w(0, ms(3)), before_w);
}

TEST(OtherSystems, DifferBetweenRadiosAndSeeds) {
    const OtherSystems systems(config_of(6), 1);
    EXPECT_NE(systems.power_w(0, ms(2)), systems.power_w(1, ms(2)));
    EXPECT_NE(systems.power_w(0, ms(2)), OtherSystems(config_of(6), 2).power_w(0, ms(2)));
    EXPECT_EQ(systems.power_w(0, ms(2)), OtherSystems(config_of(6), 1).power_w(0, ms(2)));
}

TEST(OtherSystems, HaveTheirMaximumWithinAPeriod) {
    const OtherSystems systems(config_of(6), 1);
    double max_w = 0;
    for (int i = 3; i < 9; ++i) {
        max_w = std::max(max_w, systems.power_w(0, ms(i)));
    }
    EXPECT_EQ(systems.max_w(0, ms(3), ms(9)), max_w);
    EXPECT_EQ(systems.max_w(0, ms(3), ms(3)), systems.power_w(0, ms(3)));
    InterferenceSum sum;
    sum.begin(ms(3), ms(9));
    systems.add_to(sum, 0, ms(3), ms(9));
    EXPECT_EQ(sum.worst_w(), max_w);
    EXPECT_EQ(sum.steps().size(), 6U);
    EXPECT_TRUE(sum.interferers().empty());
}

}  // namespace
}  // namespace netsim
