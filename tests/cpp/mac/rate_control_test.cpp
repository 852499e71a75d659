#include "netsim/mac/rate_control.hpp"

#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

MacConfig config_of(const char* rate_control, double bitrate_bps = -1, double initial_rate_bps = -1) {
    MacConfig config;
    config.op_mode = "g(erp)";
    config.rate_control = rate_control;
    config.bitrate_bps = bitrate_bps;
    config.initial_rate_bps = initial_rate_bps;
    return config;
}

std::int64_t first_bitrate_bps(const MacConfig& config) {
    return make_rate_control(config, 1, {0, 0})->mode_for({1, 100, 0}, SimTime()).bitrate_bps;
}

class EachAdaptiveRateControl : public testing::TestWithParam<const char*> {};

TEST_P(EachAdaptiveRateControl, BeginsWithTheInitialRateOrThatOfDataFrames) {
    MacConfig config = config_of(GetParam());
    config.look_around_share = 0;
    EXPECT_EQ(first_bitrate_bps(config), 24'000'000);
    config.bitrate_bps = 36e6;
    EXPECT_EQ(first_bitrate_bps(config), 36'000'000);
    config.initial_rate_bps = 9e6;
    EXPECT_EQ(first_bitrate_bps(config), 9'000'000);
}

INSTANTIATE_TEST_SUITE_P(Table, EachAdaptiveRateControl,
                         testing::Values("ArfRateControl", "AarfRateControl", "MinstrelRateControl"),
                         [](const auto& test) { return std::string(test.param); });

TEST(RateControl, WithoutOneTheRateIsThatOfDataFramesWhateverHappens) {
    const auto control = make_rate_control(config_of("", 36e6, 9e6), 1, {0, 0});
    SimTime now;
    for (int number = 0; number < 7; ++number) {
        const RateAttempt attempt{1, 100, number};
        const Mode& mode = control->mode_for(attempt, now);
        EXPECT_EQ(mode.bitrate_bps, 36'000'000);
        control->failed(attempt, mode, now);
        now = now + SimTime::from_us(1'000'000);
    }
}

TEST(RateControl, TheInitialRateIsOneOfTheOperationMode) {
    const std::string text = error_text([] { initial_mode(config_of("ArfRateControl", -1, 11e6)); });
    EXPECT_TRUE(text.starts_with("mac.initial_rate_bps = 11000000 bps: expected a bitrate of g(erp)"))
        << text;
}

}  // namespace
}  // namespace netsim
