#include "netsim/propagation/propagation.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/kernel/random.hpp"
#include "support/drawn_path_loss.hpp"

namespace netsim {
namespace {

Transmission sent_from(const Position& origin, NodeId sender = 0, SimTime start = SimTime(),
                       std::uint64_t id = 0) {
    Transmission sent;
    sent.label.number = id;
    sent.sender.node = sender;
    sent.start = start;
    sent.band = {2.412e9, 22e6};
    sent.origin = origin;
    return sent;
}

// Each path loss with random parameters, over random positions, near and far, up to the diagonal of
// a scene.
class EveryPathLoss : public testing::TestWithParam<std::string_view> {
protected:
    EveryPathLoss() { config.path_loss = GetParam(); }

    double between(double low, double high) { return low + draws.uniform() * (high - low); }
    double log_between(double low, double high) { return low * std::pow(high / low, draws.uniform()); }
    Position place() {
        const double far_m = log_between(1e-3, 1e7);
        return Position{between(-1, 1), between(-1, 1), 0} * far_m +
               Position{0, 0, between(0, 1) * log_between(1e-2, 1e3)};
    }
    MediumConfig config;
    RandomStream draws{1, 0, Purpose{1005}};
};

TEST_P(EveryPathLoss, NeverExceedsItsBounds) {
    for (int i = 0; i < 20'000; ++i) {
        if (i % 100 == 0) {
            test::draw_path_loss_parameters(config, draws);
        }
        const Propagation propagation(config, 1);
        const Position a = place();
        const Position b = place();
        const double distance_m = distance(a, b);
        const double gain = propagation.gain(sent_from(a, 0, SimTime::from_us(i)), {1, 0}, b, distance_m);
        ASSERT_GE(gain, 0);
        ASSERT_LE(gain, propagation.max_gain_beyond(distance_m, 2.412e9) * (1 + 1e-12));
        ASSERT_LE(gain, propagation.max_gain_beyond(between(0, distance_m), 2.412e9) * (1 + 1e-12));
        if (gain > 0) {
            ASSERT_GE(propagation.reach_m(gain, 2.412e9) * (1 + 1e-12), distance_m) << gain;
        }
    }
}

TEST_P(EveryPathLoss, IsTheSameForWhomItIsEnough) {
    const Propagation alone(config, 1);
    config.shadowing_standard_deviation_db = 5;
    const Propagation shadowed(config, 1);
    for (int i = 0; i < 4000; ++i) {
        const Propagation& propagation = i % 2 == 0 ? alone : shadowed;
        const Transmission sent = sent_from(place(), 0, SimTime::from_us(i));
        const Position there = place();
        const double distance_m = distance(sent.origin, there);
        const double gain = propagation.gain(sent, {1, 0}, there, distance_m);
        const double least = gain * log_between(0.1, 10);
        const double found = propagation.gain(sent, {1, 0}, there, distance_m, least);
        ASSERT_TRUE(found == gain || (found < least && gain < least)) << found << " for " << gain;
        ASSERT_EQ(propagation.gain(sent, {1, 0}, there, distance_m, gain), gain);
    }
}

TEST_P(EveryPathLoss, IsReciprocal) {
    const Propagation propagation(config, 1);
    for (int i = 0; i < 1000; ++i) {
        const Position a = place();
        const Position b = place();
        const SimTime time = SimTime::from_us(i);
        EXPECT_EQ(propagation.gain(sent_from(a, 4, time), {9, 0}, b, distance(a, b)),
                  propagation.gain(sent_from(b, 9, time), {4, 0}, a, distance(a, b)));
    }
}

TEST_P(EveryPathLoss, NothingReachesForEverButNothing) {
    const Propagation propagation(config, 1);
    EXPECT_EQ(propagation.reach_m(0, 2.412e9), std::numeric_limits<double>::infinity());
    EXPECT_EQ(propagation.reach_m(1e9, 2.412e9), 0);
}

INSTANTIATE_TEST_SUITE_P(Names, EveryPathLoss, testing::ValuesIn(path_loss_names),
                         [](const auto& name) { return std::string(name.param); });

// A model that is not in the table would silently be free space.
TEST(Propagation, EveryNameIsAModelOfItsOwn) {
    MediumConfig config;
    config.shape_factor = 2;
    std::map<double, std::string_view> names;  // by gain
    for (const std::string_view name : path_loss_names) {
        config.path_loss = name;
        const Position place{2000, 0, 1};  // two-ray: beyond the crossover
        const double gain = Propagation(config, 1).gain(sent_from({0, 0, 1}), {1, 0}, place, 2000);
        const auto [other, is_new] = names.try_emplace(gain, name);
        EXPECT_TRUE(is_new) << name << " is the same as " << other->second;
    }
}

TEST(Propagation, FadingIsAFactorOnFreeSpace) {
    MediumConfig config;
    config.path_loss = "RayleighFading";
    const Propagation faded(config, 5);
    const Propagation free(MediumConfig(), 5);
    const Transmission sent = sent_from({0, 0, 10}, 2, SimTime::from_us(777));
    const double factor =
        faded.gain(sent, {6, 0}, {50, 0, 10}, 50) / free.gain(sent, {6, 0}, {50, 0, 10}, 50);
    EXPECT_NEAR(factor, Fading(config, 5).gain(2, 6, SimTime::from_us(777), 0), 1e-12);
    EXPECT_NEAR(faded.gain(sent, {6, 0}, {500, 0, 10}, 500) / free.gain(sent, {6, 0}, {500, 0, 10}, 500),
                factor, 1e-12);
}

TEST(Propagation, ShadowingAndFadingAreFactorsThatDoNotDependOnEachOther) {
    const Transmission sent = sent_from({0, 0, 10}, 2, SimTime::from_us(1'234'000));
    const auto gain = [&](const std::string& path_loss, double sigma_db) {
        MediumConfig config;
        config.path_loss = path_loss;
        config.shadowing_standard_deviation_db = sigma_db;
        return Propagation(config, 5).gain(sent, {6, 0}, {50, 0, 10}, 50);
    };
    for (const std::string_view name : path_loss_names) {
        const std::string path_loss(name);
        EXPECT_NE(gain(path_loss, 4), gain(path_loss, 0)) << name;
        EXPECT_NEAR(gain(path_loss, 4) / gain(path_loss, 0),
                    gain("FreeSpacePathLoss", 4) / gain("FreeSpacePathLoss", 0), 1e-12)
            << name;
    }
}

// In decibels, a product is a sum of independent numbers. Those of an exponentially distributed power have the mean −γ
// 10 / ln 10 and the variance (10 / ln 10)² π² / 6, or 31.0 dB².
TEST(Propagation, DecibelsOfShadowingAndRayleighFadingAddUp) {
    constexpr double sigma_db = 4;
    constexpr double db_per_log = 10 / std::numbers::ln10;
    constexpr double variance =
        sigma_db * sigma_db + db_per_log * db_per_log * std::numbers::pi * std::numbers::pi / 6;
    constexpr int links = 20'000;
    MediumConfig config;
    config.path_loss = "RayleighFading";
    config.shadowing_standard_deviation_db = sigma_db;
    for (const double coherence_time_s : {0.0, 1.0}) {
        config.coherence_time_s = coherence_time_s;
        config.shadowing_decorrelation_time_s = coherence_time_s;
        const Propagation propagation(config, 5);
        const double path_gain = propagation.path_gain({}, {500, 0, 0}, 500, 2.412e9);
        double sum = 0;
        double sum_of_squares = 0;
        for (int link = 1; link <= links; ++link) {
            const Transmission sent =
                sent_from({}, 0, SimTime::from_us(1'300'000), static_cast<std::uint64_t>(link));
            const InterfaceId receiver{static_cast<NodeId>(link), 0};
            const double gain_db =
                db_from_ratio(propagation.gain(sent, receiver, {500, 0, 0}, 500) / path_gain);
            sum += gain_db;
            sum_of_squares += gain_db * gain_db;
        }
        const double mean = sum / links;
        // Five standard errors. The fourth moment of these numbers is below five times the squared variance.
        EXPECT_NEAR(mean, -std::numbers::egamma * db_per_log, 5 * std::sqrt(variance / links));
        EXPECT_NEAR(sum_of_squares / links - mean * mean, variance, 5 * variance * std::sqrt(4.0 / links));
    }
}

TEST(Propagation, ObstaclesAreAFactorOnIt) {
    MediumConfig config;
    config.path_loss = "TwoRayInterference";
    const Position place{100, 0, 2};
    const Transmission sent = sent_from({0, 0, 2});
    const double in_sight = Propagation(config, 1).gain(sent, {1, 0}, place, 100);
    ObstacleConfig wall;
    wall.rings = {{{40, -10}, {40.2, -10}, {40.2, 10}, {40, 10}}};
    wall.top_m = 5;
    config.obstacles = {wall};
    EXPECT_EQ(Propagation(config, 1).gain(sent, {1, 0}, place, 100), in_sight);
    config.obstacle_loss = "DielectricObstacleLoss";
    const double share = Obstacles(config).gain(sent.origin, place, sent.band.carrier_hz);
    EXPECT_LT(share, 0.1);
    EXPECT_GT(share, 0.01);
    EXPECT_DOUBLE_EQ(Propagation(config, 1).gain(sent, {1, 0}, place, 100), in_sight * share);
    config.obstacle_loss = "IdealObstacleLoss";
    EXPECT_EQ(Propagation(config, 1).gain(sent, {1, 0}, place, 100), 0);
}

TEST(Propagation, DelayIsThatOfLight) {
    EXPECT_EQ(propagation_delay(299.792458), SimTime::from_us(1));
    EXPECT_GE(max_propagation_delay(299.792458), SimTime::from_us(1));
    EXPECT_GT(max_propagation_delay(std::numeric_limits<double>::infinity()), SimTime::from_seconds(1e6));
}

TEST(Propagation, UnknownPathLossIsAnError) {
    MediumConfig config;
    config.path_loss = "FreePathLoss";
    EXPECT_THROW(Propagation(config, 1), ConfigError);
}

}  // namespace
}  // namespace netsim
