// Configurations that are rejected before a station is built.
#include "netsim/mac/dcf_parameters.hpp"

#include <string>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/dcf_instants.hpp"

namespace netsim {
namespace {

using test::mac_of;

DcfParameters of(const MacConfig& mac) {
    static Simulator simulator;
    return {simulator, mac};
}

TEST(DcfParameters, TheDefaultsArePossibleInEveryMode) {
    for (const std::string_view op_mode : op_mode_names) {
        EXPECT_NO_THROW(of(mac_of(std::string(op_mode).c_str(), -1))) << op_mode;
    }
}

TEST(DcfParameters, ABitrateThatTheModeHasNotIsAnError) {
    EXPECT_THROW(of(mac_of("b", 24e6)), ConfigError);
    MacConfig mac;
    mac.multicast_bitrate_bps = 7e6;
    EXPECT_THROW(of(mac), ConfigError);
    mac.multicast_bitrate_bps = -1;
    mac.control_bitrate_bps = 7e6;
    EXPECT_THROW(of(mac), ConfigError);
}

TEST(DcfParameters, ABitrateThatTheModeHasNotIsAnErrorBesideOthersThatItHas) {
    MacConfig mac = mac_of("b", 24e6);
    mac.multicast_bitrate_bps = mac.initial_rate_bps = 2e6;
    EXPECT_THROW(of(mac), ConfigError);
}

TEST(DcfParameters, AWindowBeyondThatOfTheModeIsAnError) {
    MacConfig mac;
    mac.cw_min = 2000;  // the mode's largest is 1023
    EXPECT_THROW(of(mac), ConfigError);
    mac.cw_max = 4000;
    EXPECT_NO_THROW(of(mac));
}

TEST(DcfParameters, TheErrorNamesBothWindows) {
    MacConfig mac;
    mac.cw_max = 5;
    try {
        of(mac);
        FAIL() << "no error";
    } catch (const ConfigError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "mac.cw_max = 5: expected at least mac.cw_min, 31, of the operation mode g(mixed)");
    }
}

// Age limit of the query of a new message for the cause of its busy channel.
TEST(DcfParameters, TheLongestWaitIsThatOfTheLargestWindowThatANewMessageMayFind) {
    MacConfig mac = mac_of("g(erp)", 24e6);  // DIFS 28 µs, slots of 9 µs
    mac.cw_min = 7;
    mac.cw_max = 255;
    EXPECT_EQ(of(mac).longest_wait, SimTime::from_us(28 + 7 * 9));
    mac.inet_station_retry_counters = true;
    EXPECT_EQ(of(mac).longest_wait, SimTime::from_us(28 + 255 * 9));
    mac.inet_station_retry_counters = false;
    mac.ns3_station_window = true;
    EXPECT_EQ(of(mac).longest_wait, SimTime::from_us(28 + 255 * 9));
}

}  // namespace
}  // namespace netsim
