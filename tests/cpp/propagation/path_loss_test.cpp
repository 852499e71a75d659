// Expected numbers were computed from the formulas in decibels with 50 digits (mpmath), not with
// this code.
#include "netsim/propagation/path_loss.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;

PathLoss free_space(double alpha = 2) {
    MediumConfig config;
    config.alpha = alpha;
    return make_path_loss(config);
}

PathLoss breakpoint() {
    return make_path_loss(MediumConfig("Ieee802154NarrowbandScalarRadioMedium"));
}

// In decibels.
double loss_db(const PathLoss& path_loss, double distance_m) {
    return -db_from_ratio(path_loss.gain(distance_m, channel_1_hz));
}

TEST(FreeSpacePathLoss, IsThatOfFriis) {
    EXPECT_NEAR(loss_db(free_space(), 1), 40.095329291245648, 1e-9);
    EXPECT_NEAR(loss_db(free_space(), 50), 74.074729377966024, 1e-9);
    EXPECT_NEAR(loss_db(free_space(), 1000), 100.09532929124565, 1e-9);
}

TEST(FreeSpacePathLoss, AlphaIsTheExponentOfTheDistanceOnly) {
    EXPECT_NEAR(loss_db(free_space(2.7), 1), 40.095329291245648, 1e-9);
    EXPECT_NEAR(loss_db(free_space(2.7), 50), 85.967519408318156, 1e-9);
}

TEST(FreeSpacePathLoss, GrowsWithTheCarrier) {
    EXPECT_NEAR(-db_from_ratio(free_space().gain(100, 5.18e9)), 86.734378416788034, 1e-9);
}

TEST(FreeSpacePathLoss, NeverAmplifies) {
    EXPECT_EQ(free_space().gain(0, channel_1_hz), 1);
    EXPECT_EQ(free_space(2.7).gain(0, channel_1_hz), 1);
    EXPECT_EQ(free_space().gain(0.001, channel_1_hz), 1);
}

TEST(BreakpointPathLoss, BelowTheBreakpoint) {
    EXPECT_NEAR(loss_db(breakpoint(), 1), 40.2, 1e-9);
    EXPECT_NEAR(loss_db(breakpoint(), 5), 54.179400086720376, 1e-9);
}

TEST(BreakpointPathLoss, AtTheBreakpointTheFarLawHolds) {
    EXPECT_NEAR(loss_db(breakpoint(), 8), 58.5, 1e-9);
}

TEST(BreakpointPathLoss, AboveTheBreakpoint) {
    EXPECT_NEAR(loss_db(breakpoint(), 80), 91.5, 1e-9);
    EXPECT_NEAR(loss_db(breakpoint(), 50), 84.764040572354482, 1e-9);
}

TEST(BreakpointPathLoss, IsTheSameForAllCarriers) {
    EXPECT_EQ(breakpoint().gain(50, 2.412e9), breakpoint().gain(50, 5.18e9));
}

TEST(BreakpointPathLoss, NeverAmplifies) {
    EXPECT_EQ(breakpoint().gain(0, channel_1_hz), 1);
    EXPECT_EQ(breakpoint().gain(0.001, channel_1_hz), 1);
}

// The two characteristic values of this medium.
TEST(BreakpointPathLoss, TwentyMilliwattsReachAbout126MetresAtMinus85Dbm) {
    const double sensitivity_w = w_from_dbm(-85);
    EXPECT_NEAR(breakpoint().reach_m(sensitivity_w / 0.02, channel_1_hz), 126, 0.5);
}

TEST(BreakpointPathLoss, FiftyMetresNeedAbout950Microwatts) {
    const double sensitivity_w = w_from_dbm(-85);
    EXPECT_NEAR(sensitivity_w / breakpoint().gain(50, channel_1_hz), 0.95e-3, 0.01e-3);
}

TEST(PathLoss, SquaredDistanceGivesTheSameGain) {
    for (const PathLoss& path_loss : {free_space(), free_space(3.1), breakpoint()}) {
        for (const double distance_m : {0.0, 0.5, 3.0, 8.0, 120.0, 1e5}) {
            EXPECT_EQ(path_loss.gain_at_squared_distance(distance_m * distance_m, channel_1_hz),
                      path_loss.gain(distance_m, channel_1_hz));
        }
    }
}

TEST(PathLoss, ReachInvertsGain) {
    for (const PathLoss& path_loss : {free_space(), free_space(3.1), breakpoint()}) {
        for (const double distance_m : {0.5, 3.0, 8.5, 120.0, 1e5}) {
            const double gain = path_loss.gain(distance_m, channel_1_hz);
            EXPECT_NEAR(path_loss.reach_m(gain, channel_1_hz), distance_m, 1e-9 * distance_m);
        }
    }
}

TEST(PathLoss, ReachOfExtremeGains) {
    EXPECT_EQ(free_space().reach_m(1.01, channel_1_hz), 0);
    EXPECT_EQ(free_space().reach_m(0, channel_1_hz), std::numeric_limits<double>::infinity());
}

// By default the loss steps up at the breakpoint, from 58.26 dB to 58.5 dB: 58.4 dB are reached
// just below it.
TEST(PathLoss, ReachStopsAtAStepUpOfTheLoss) {
    EXPECT_DOUBLE_EQ(breakpoint().reach_m(ratio_from_db(-58.4), channel_1_hz), 8);
}

// If the loss steps down at the breakpoint, the part beyond it counts.
TEST(PathLoss, ReachLooksBeyondAStepDownOfTheLoss) {
    MediumConfig config("Ieee802154NarrowbandScalarRadioMedium");
    config.l02_db = 50;
    EXPECT_NEAR(make_path_loss(config).reach_m(ratio_from_db(-50), channel_1_hz), 8, 1e-9);
}

TEST(PathLoss, TheSystemLossLowersFreeSpaceAndWhatIsBuiltOnIt) {
    MediumConfig config;
    config.system_loss = ratio_from_db(3);
    for (const std::string_view name : {"FreeSpacePathLoss", "RayleighFading"}) {
        config.path_loss = name;
        EXPECT_DOUBLE_EQ(make_path_loss(config).gain(100, channel_1_hz) * ratio_from_db(3),
                         free_space().gain(100, channel_1_hz));
    }
    config.path_loss = "TwoRayGroundReflection";
    EXPECT_EQ(make_path_loss(config).gain(100, channel_1_hz), free_space().gain(100, channel_1_hz));
}

TEST(PathLoss, EveryNameOfTheConfigurationIsInTheTable) {
    for (const std::string_view name : path_loss_names) {
        MediumConfig config;
        config.path_loss = name;
        EXPECT_LT(make_path_loss(config).gain(1000, channel_1_hz), 1e-6) << name;
    }
}

TEST(PathLoss, UnknownNameIsAnError) {
    MediumConfig config;
    config.path_loss = "FreePathLoss";
    EXPECT_THROW(make_path_loss(config), ConfigError);
}

}  // namespace
}  // namespace netsim
