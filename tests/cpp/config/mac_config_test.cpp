#include "netsim/config/mac_config.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

// Sets one field of a valid configuration and validates.
template <typename Value>
std::string text_with(Value MacConfig::* field, Value value) {
    MacConfig config;
    config.*field = std::move(value);
    return error_text([&] { config.validate(); });
}

TEST(MacConfig, DefaultsAreValid) {
    EXPECT_NO_THROW(MacConfig().validate());
}

TEST(MacConfig, ValidateNamesTheField) {
    EXPECT_EQ(text_with<std::string>(&MacConfig::op_mode, "g"),
              "mac.op_mode = \"g\": expected one of b, g(erp), g(mixed), a; did you mean b?");
    EXPECT_EQ(text_with(&MacConfig::bitrate_bps, 0.0), "mac.bitrate_bps = 0 bps: expected more than 0 bps");
    EXPECT_EQ(text_with(&MacConfig::multicast_bitrate_bps, -2.0),
              "mac.multicast_bitrate_bps = -2 bps: expected more than 0 bps");
    EXPECT_EQ(text_with(&MacConfig::short_retry_limit, 0),
              "mac.short_retry_limit = 0: expected from 1 to 255");
    EXPECT_EQ(text_with(&MacConfig::rts_threshold_bytes, -1),
              "mac.rts_threshold_bytes = -1 B: expected from 0 B to 1000000 B");
    EXPECT_EQ(text_with(&MacConfig::long_retry_limit, 256),
              "mac.long_retry_limit = 256: expected from 1 to 255");
    EXPECT_EQ(text_with(&MacConfig::cw_min, -2),
              "mac.cw_min = -2: expected -1 (that of the operation mode) or from 0 to 32767");
    EXPECT_EQ(text_with(&MacConfig::cw_max, 40000),
              "mac.cw_max = 40000: expected -1 (that of the operation mode) or from 0 to 32767");
    EXPECT_EQ(text_with(&MacConfig::queue_capacity, 0),
              "mac.queue_capacity = 0 frames: expected from 1 frames to 1000000 frames");
    EXPECT_EQ(text_with(&MacConfig::mtu_bytes, 3000), "mac.mtu_bytes = 3000 B: expected from 29 B to 2304 B");
}

TEST(MacConfig, ValidateNamesTheParameterOfRateControl) {
    EXPECT_EQ(text_with<std::string>(&MacConfig::rate_control, "AarfControl"),
              "mac.rate_control = \"AarfControl\": expected one of \"\" (none), ArfRateControl, "
              "AarfRateControl, MinstrelRateControl; did you mean AarfRateControl?");
    EXPECT_EQ(text_with(&MacConfig::initial_rate_bps, 0.0),
              "mac.initial_rate_bps = 0 bps: expected more than 0 bps");
    EXPECT_EQ(text_with(&MacConfig::rate_interval_s, 0.0),
              "mac.rate_interval_s = 0 s: expected from 1e-06 s to 1000000 s");
    EXPECT_EQ(text_with(&MacConfig::increase_threshold, 0),
              "mac.increase_threshold = 0: expected from 1 to 1000000");
    EXPECT_EQ(text_with(&MacConfig::decrease_threshold, 0),
              "mac.decrease_threshold = 0: expected from 1 to 1000000");
    EXPECT_EQ(text_with(&MacConfig::increase_threshold_factor, 0.5),
              "mac.increase_threshold_factor = 0.5: expected from 1 to 1000");
    EXPECT_EQ(text_with(&MacConfig::max_increase_threshold, 0),
              "mac.max_increase_threshold = 0: expected from 1 to 1000000");
    EXPECT_EQ(text_with(&MacConfig::rate_update_interval_s, -1.0),
              "mac.rate_update_interval_s = -1 s: expected from 1e-06 s to 1000000 s");
    EXPECT_EQ(text_with(&MacConfig::look_around_share, 1.5),
              "mac.look_around_share = 1.5: expected from 0 to 1");
    EXPECT_EQ(text_with(&MacConfig::ewma_weight, 1.0), "mac.ewma_weight = 1: expected from 0 to 0.999999");
}

TEST(MacConfig, TheBoundOfAarfIsAtLeastItsThreshold) {
    MacConfig config;
    config.increase_threshold = 60;
    EXPECT_EQ(error_text([&] { config.validate(); }), "no error");
    config.rate_control = "AarfRateControl";
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "mac.max_increase_threshold = 50: expected from 60 to 1000000");
}

TEST(MacConfig, WindowsMustNotCross) {
    MacConfig config;
    config.cw_min = 63;
    config.cw_max = 31;
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "mac.cw_max = 31: expected -1 (that of the operation mode) or from 63 to 32767");
}

TEST(MacConfig, BitrateOfMinusOneStandsForTheDefault) {
    EXPECT_EQ(text_with(&MacConfig::bitrate_bps, -1.0), "no error");
    EXPECT_EQ(text_with(&MacConfig::multicast_bitrate_bps, -1.0), "no error");
}

}  // namespace
}  // namespace netsim
