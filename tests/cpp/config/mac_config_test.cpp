#include "netsim/config/mac_config.hpp"

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

TEST(MacConfig, TheBoundOfAarfIsAtLeastItsThreshold) {
    MacConfig config;
    config.increase_threshold = 60;
    EXPECT_EQ(error_text([&] { config.validate(); }), "no error");
    config.rate_control = "AarfRateControl";
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "mac.increase_threshold = 60: expected at most mac.max_increase_threshold, 50");
}

TEST(MacConfig, WindowsMustNotCross) {
    MacConfig config;
    config.cw_min = 63;
    config.cw_max = 31;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mac.cw_min = 63: expected at most mac.cw_max, 31");
}

}  // namespace
}  // namespace netsim
