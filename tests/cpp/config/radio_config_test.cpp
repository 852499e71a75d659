#include "netsim/config/radio_config.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

TEST(RadioConfig, DefaultsInTheDecibelsThatPeopleKnow) {
    const RadioConfig config;
    EXPECT_EQ(config.carrier_hz, 2.412e9);
    EXPECT_EQ(config.bandwidth_hz, 22e6);
    EXPECT_EQ(config.tx_power_w, 0.02);
    EXPECT_DOUBLE_EQ(config.sensitivity_w, w_from_dbm(-85));
    EXPECT_DOUBLE_EQ(config.energy_detection_w, w_from_dbm(-85));
    EXPECT_DOUBLE_EQ(config.snir_threshold, ratio_from_db(4));
    EXPECT_NO_THROW(config.validate());
}

TEST(RadioConfig, DefaultsOf802154AreThoseOfInet) {
    const RadioConfig config(ieee802154_interface);
    EXPECT_EQ(config.carrier_hz, 2.45e9);
    EXPECT_EQ(config.bandwidth_hz, 2.8e6);
    EXPECT_DOUBLE_EQ(config.tx_power_w, 2.24e-3);
    EXPECT_DOUBLE_EQ(config.sensitivity_w, w_from_dbm(-100));
    EXPECT_DOUBLE_EQ(config.energy_detection_w, w_from_dbm(-90));
    EXPECT_DOUBLE_EQ(config.snir_threshold, ratio_from_db(-8));
    EXPECT_EQ(config.error_model, "Ieee802154ErrorModel");
    EXPECT_NO_THROW(config.validate());
}

TEST(RadioConfig, AnotherInterfaceIsRefused) {
    EXPECT_EQ(error_text([] { RadioConfig("Ieee80211"); }),
              "interface = \"Ieee80211\": expected one of Ieee80211Interface, Ieee802154NarrowbandInterface; "
              "did you "
              "mean Ieee80211Interface?");
}

// Sets one field of a valid configuration and validates.
template <typename Value>
std::string text_with(Value RadioConfig::* field, Value value) {
    RadioConfig config;
    config.*field = std::move(value);
    return error_text([&] { config.validate(); });
}

TEST(RadioConfig, ValidateNamesTheField) {
    EXPECT_EQ(text_with(&RadioConfig::carrier_hz, 1.0),
              "radio.carrier_hz = 1 Hz: expected from 1000000 Hz to 1000000000000 Hz");
    EXPECT_EQ(text_with(&RadioConfig::bandwidth_hz, 5e9),
              "radio.bandwidth_hz = 5000000000 Hz: expected from 1000 Hz to 1000000000 Hz");
    EXPECT_EQ(text_with(&RadioConfig::tx_power_w, -0.02),
              "radio.tx_power_w = -0.02 W: expected from 0 W to 1000000000000 W");
    EXPECT_EQ(text_with(&RadioConfig::communication_range_m, -1.0),
              "radio.communication_range_m = -1 m: expected at least 0 m");
    EXPECT_EQ(text_with(&RadioConfig::sensitivity_w, 0.0),
              "radio.sensitivity_w = 0 W: expected more than 0 W");
    EXPECT_EQ(text_with(&RadioConfig::energy_detection_w, 0.0),
              "radio.energy_detection_w = 0 W: expected more than 0 W");
    EXPECT_EQ(text_with(&RadioConfig::snir_threshold, -1.0),
              "radio.snir_threshold = -1: expected at least 0");
    EXPECT_EQ(text_with<std::string>(&RadioConfig::error_model, "Nist"),
              "radio.error_model = \"Nist\": expected one of Ieee80211NistErrorModel, "
              "Ieee80211BerTableErrorModel, Ieee802154ErrorModel; did you mean Ieee80211NistErrorModel?");
    EXPECT_EQ(text_with(&RadioConfig::antenna, {.gain = -1}), "antenna.gain = -1: expected at least 0");
}

TEST(RadioConfig, ValidateNamesTheFieldOfAnOption) {
    EXPECT_EQ(text_with(&RadioConfig::noise_figure, 0.5), "radio.noise_figure = 0.5: expected at least 1");
    EXPECT_EQ(text_with<std::string>(&RadioConfig::snir_mode, "mean"),
              "radio.snir_mode = \"mean\": expected one of min, chunks; did you mean min?");
    EXPECT_EQ(text_with<std::string>(&RadioConfig::preamble_detection, "TresholdPreambleDetection"),
              "radio.preamble_detection = \"TresholdPreambleDetection\": expected one of \"\" (none), "
              "ThresholdPreambleDetection; did you mean ThresholdPreambleDetection?");
    EXPECT_EQ(text_with(&RadioConfig::preamble_threshold, -1.0),
              "radio.preamble_threshold = -1: expected at least 0");
    EXPECT_EQ(text_with(&RadioConfig::preamble_minimum_power_w, -1.0),
              "radio.preamble_minimum_power_w = -1 W: expected at least 0 W");
    EXPECT_EQ(text_with(&RadioConfig::preamble_duration_s, 0.0),
              "radio.preamble_duration_s = 0 s: expected from 1e-12 s to 1 s");
    EXPECT_EQ(text_with<std::string>(&RadioConfig::frame_capture, "SimpleCapture"),
              "radio.frame_capture = \"SimpleCapture\": expected one of \"\" (none), SimpleFrameCapture; "
              "did you mean "
              "SimpleFrameCapture?");
    EXPECT_EQ(text_with(&RadioConfig::capture_margin, 0.5),
              "radio.capture_margin = 0.5: expected at least 1");
    EXPECT_EQ(text_with(&RadioConfig::capture_window_s, -1.0),
              "radio.capture_window_s = -1 s: expected from 0 s to 1 s");
}

TEST(RadioConfig, OptionsInTheDecibelsThatPeopleKnow) {
    const RadioConfig config;
    EXPECT_DOUBLE_EQ(config.noise_figure, ratio_from_db(7));
    EXPECT_DOUBLE_EQ(config.preamble_threshold, ratio_from_db(4));
    EXPECT_NEAR(config.preamble_minimum_power_w / w_from_dbm(-82), 1, 1e-14);
    EXPECT_DOUBLE_EQ(config.capture_margin, ratio_from_db(5));
}

TEST(RadioConfig, ABandIsNoWiderThanItsCentreIsHigh) {
    RadioConfig config;
    config.carrier_hz = 1e6;
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.bandwidth_hz = 22000000 Hz: expected from 1000 Hz to 1000000 Hz");
}

TEST(RadioConfig, ASilentRadioIsAllowed) {
    EXPECT_EQ(text_with(&RadioConfig::tx_power_w, 0.0), "no error");
}

}  // namespace
}  // namespace netsim
