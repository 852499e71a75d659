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
    EXPECT_EQ(text_with(&RadioConfig::carrier_hz, 0.0), "radio.carrier_hz = 0 Hz: expected more than 0 Hz");
    EXPECT_EQ(text_with(&RadioConfig::bandwidth_hz, -1.0),
              "radio.bandwidth_hz = -1 Hz: expected more than 0 Hz");
    EXPECT_EQ(text_with(&RadioConfig::tx_power_w, -0.02),
              "radio.tx_power_w = -0.02 W: expected at least 0 W");
    EXPECT_EQ(text_with(&RadioConfig::communication_range_m, -1.0),
              "radio.communication_range_m = -1 m: expected at least 0 m");
    EXPECT_EQ(text_with(&RadioConfig::sensitivity_w, 0.0),
              "radio.sensitivity_w = 0 W: expected more than 0 W");
    EXPECT_EQ(text_with(&RadioConfig::energy_detection_w, 0.0),
              "radio.energy_detection_w = 0 W: expected more than 0 W");
    EXPECT_EQ(text_with(&RadioConfig::snir_threshold, -1.0),
              "radio.snir_threshold = -1: expected at least 0");
    EXPECT_EQ(text_with<std::string>(&RadioConfig::error_model, "Nist"),
              "radio.error_model = \"Nist\": expected one of Ieee80211NistErrorModel, Ieee802154ErrorModel; "
              "did you "
              "mean Ieee80211NistErrorModel?");
    EXPECT_EQ(text_with(&RadioConfig::antenna, {.gain = -1}), "antenna.gain = -1: expected at least 0");
}

TEST(RadioConfig, ASilentRadioIsAllowed) {
    EXPECT_EQ(text_with(&RadioConfig::tx_power_w, 0.0), "no error");
}

}  // namespace
}  // namespace netsim
