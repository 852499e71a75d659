#include "netsim/config/radio_config.hpp"

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
    EXPECT_DOUBLE_EQ(config.snir_threshold, ratio_from_db(1));
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
              "radio.bandwidth_hz = 22000000 Hz: expected at most radio.carrier_hz, 1000000 Hz");
}

}  // namespace
}  // namespace netsim
