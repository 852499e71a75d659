#include "netsim/config/antenna_config.hpp"

#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;

std::string text_of_error(const AntennaConfig& config) {
    return error_text([&] { config.validate(channel_1_hz); });
}

TEST(AntennaConfig, TheDefaultIsValid) {
    EXPECT_EQ(text_of_error(AntennaConfig()), "no error");
}

TEST(AntennaConfig, ABeamNeedsItsWidth) {
    EXPECT_EQ(text_of_error({.type_name = "CosineAntenna"}),
              "antenna.beam_width_rad = 0 rad: expected more than 0 rad");
    EXPECT_EQ(text_of_error({.type_name = "ParabolicAntenna"}),
              "antenna.beam_width_rad = 0 rad: expected more than 0 rad");
    EXPECT_NE(text_of_error({.type_name = "CosineAntenna", .beam_width_rad = 6.29}), "no error");
    EXPECT_EQ(text_of_error({.type_name = "CosineAntenna", .beam_width_rad = 1}), "no error");
}

TEST(AntennaConfig, TheLeastGainIsNotMoreThanTheLargest) {
    EXPECT_EQ(
        text_of_error({.type_name = "ParabolicAntenna", .max_gain = 1, .min_gain = 2, .beam_width_rad = 1}),
        "antenna.min_gain = 2: expected at most antenna.max_gain, 1");
}

TEST(AntennaConfig, ADipoleIsNotLongerThanTheWave) {
    EXPECT_EQ(text_of_error({.type_name = "DipoleAntenna", .length_m = 0.124}), "no error");
    EXPECT_NE(text_of_error({.type_name = "DipoleAntenna", .length_m = 0.125}), "no error");
}

}  // namespace
}  // namespace netsim
