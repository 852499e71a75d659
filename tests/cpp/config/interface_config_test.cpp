#include "netsim/config/interface_config.hpp"

#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

TEST(InterfaceConfig, DefaultsAreValid) {
    for (const std::string_view type : interface_type_names) {
        EXPECT_NO_THROW(InterfaceConfig(std::string(type)).validate());
    }
}

TEST(InterfaceConfig, ChecksItsRadio) {
    InterfaceConfig config;
    config.radio.tx_power_w = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.tx_power_w = -1 W: expected from 0 W to 1000000000000 W");
}

TEST(InterfaceConfig, ChecksItsMac) {
    InterfaceConfig config;
    config.mac.short_retry_limit = 0;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mac.short_retry_limit = 0: expected from 1 to 255");
}

TEST(InterfaceConfig, ChecksItsCsma) {
    InterfaceConfig config;
    config.csma.min_be = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "csma.min_be = -1: expected from 0 to 20");
}

TEST(InterfaceConfig, ItsTypeSetsTheDefaultsOfTheRadio) {
    EXPECT_EQ(InterfaceConfig(std::string(ieee802154_interface)).radio.carrier_hz, 2.45e9);
}

TEST(InterfaceConfig, TheErrorModelHasToFitTheType) {
    InterfaceConfig config{std::string(ieee802154_interface)};
    config.radio.error_model = "Ieee80211NistErrorModel";
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.error_model = \"Ieee80211NistErrorModel\": expected one for an "
              "Ieee802154NarrowbandInterface, such as \"Ieee802154ErrorModel\"");
    config = InterfaceConfig();
    config.radio.error_model = "Ieee802154ErrorModel";
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.error_model = \"Ieee802154ErrorModel\": expected one for an "
              "Ieee80211Interface, such as \"Ieee80211DespreadingErrorModel\"");
}

TEST(InterfaceConfig, NoErrorModelFitsEachType) {
    for (const std::string_view type : interface_type_names) {
        InterfaceConfig config{std::string(type)};
        config.radio.error_model = "";
        EXPECT_NO_THROW(config.validate()) << type;
    }
}

TEST(InterfaceConfig, TheBandwidthHasToFitTheBitRatesOfTheOperationMode) {
    InterfaceConfig config;
    for (const double fitting_hz : {20e6, 22e6}) {
        config.radio.bandwidth_hz = fitting_hz;
        EXPECT_NO_THROW(config.validate()) << fitting_hz;
    }
    for (const double other_hz : {5e6, 10e6, 40e6}) {
        config.radio.bandwidth_hz = other_hz;
        EXPECT_THROW(config.validate(), ConfigError) << other_hz;
    }
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.bandwidth_hz = 40000000 Hz: expected from 20000000 Hz to 22000000 Hz for the operation "
              "mode g(mixed)");
    config = InterfaceConfig{std::string(ieee802154_interface)};
    config.radio.bandwidth_hz = 5e6;
    EXPECT_NO_THROW(config.validate());
}

}  // namespace
}  // namespace netsim
