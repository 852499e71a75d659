// Exchanges of the Dcf that start with RTS and CTS, with instants computed by hand as in
// dcf_test.cpp, and the frames that start such exchanges.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::Heard;
using test::light_microsecond_m;
using test::Sniffer;
using test::Station;
using test::us;

struct Exchange {
    const char* op_mode;
    double bitrate_bps;
    double control_bitrate_bps;
    int sifs_us;
    int rts_us;   // 20 B
    int cts_us;   // 14 B, in the mode of the RTS
    int data_us;  // 164 B
    int ack_us;   // 14 B
};

class RtsExchange : public testing::TestWithParam<Exchange> {};

TEST_P(RtsExchange, TakesPlaceInTheInstantsOfTheStandard) {
    const Exchange& exchange = GetParam();
    const SimTime flight = us(1);
    Air air;
    MacConfig mac;
    mac.op_mode = exchange.op_mode;
    mac.bitrate_bps = exchange.bitrate_bps;
    mac.rts_threshold_bytes = 0;
    mac.control_bitrate_bps = exchange.control_bitrate_bps;
    Station& sender = air.add_station({0, 0, 0}, mac);
    Station& receiver = air.add_station({light_microsecond_m, 0, 0}, mac);
    Sniffer& at_sender = air.add_sniffer({0, 0, 0});
    Sniffer& at_receiver = air.add_sniffer({light_microsecond_m, 0, 0});
    const SimTime start = SimTime::from_ps(1'234'567'890'123);
    air.at(start, [&] { sender.send(receiver.id(), 100); });
    air.run();

    struct Step {
        FrameKind kind;
        SimTime duration;
        bool from_sender;
    };
    const std::vector<Step> steps{{FrameKind::rts, us(exchange.rts_us), true},
                                  {FrameKind::cts, us(exchange.cts_us), false},
                                  {FrameKind::unicast, us(exchange.data_us), true},
                                  {FrameKind::ack, us(exchange.ack_us), false}};
    ASSERT_EQ(at_sender.heard.size(), steps.size());
    ASSERT_EQ(at_receiver.heard.size(), steps.size());
    SimTime begin = start;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        SCOPED_TRACE("frame " + std::to_string(i));
        const auto& [kind, duration, from_sender] = steps[i];
        const Heard& near = (from_sender ? at_sender : at_receiver).heard[i];
        const Heard& far = (from_sender ? at_receiver : at_sender).heard[i];
        EXPECT_EQ(near.kind, kind);
        EXPECT_EQ(near.start, begin);
        EXPECT_EQ(near.end, begin + duration);
        EXPECT_EQ(far.start, begin + flight);
        EXPECT_EQ(far.end, begin + duration + flight);
        begin = far.end + us(exchange.sifs_us);
    }
    ASSERT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(receiver.received[0].time, at_receiver.heard[2].end);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Modes, RtsExchange,
    testing::Values(
        Exchange{"b", 1e6, -1, 10, 207, 203, 1504, 304}, Exchange{"b", 11e6, -1, 10, 207, 203, 312, 203},
        Exchange{"b", 11e6, 1e6, 10, 352, 304, 312, 203}, Exchange{"b", 11e6, 2e6, 10, 272, 248, 312, 203},
        Exchange{"b", 11e6, 5.5e6, 10, 222, 213, 312, 203}, Exchange{"g(erp)", 6e6, -1, 10, 34, 34, 250, 50},
        Exchange{"g(erp)", 54e6, -1, 10, 34, 34, 54, 34}, Exchange{"g(erp)", 54e6, 6e6, 10, 58, 50, 54, 34},
        Exchange{"g(erp)", 54e6, 9e6, 10, 50, 50, 54, 34},  // answered at 6 Mbps
        Exchange{"g(erp)", 54e6, 12e6, 10, 42, 38, 54, 34},
        Exchange{"g(mixed)", 24e6, -1, 10, 34, 34, 82, 34},
        Exchange{"g(mixed)", 6e6, 6e6, 10, 58, 50, 250, 50},
        Exchange{"g(mixed)", 24e6, 1e6, 10, 352, 304, 82, 34}, Exchange{"a", 6e6, -1, 16, 28, 28, 244, 44},
        Exchange{"a", 54e6, -1, 16, 28, 28, 48, 28}, Exchange{"a", 54e6, 6e6, 16, 52, 44, 48, 28}),
    [](const auto& param_info) {
        const auto in_100_kbps = [](double bps) {
            return bps < 0 ? std::string("default") : std::to_string(static_cast<int>(bps / 1e5));
        };
        std::string name = std::string(param_info.param.op_mode) + "_" +
                           in_100_kbps(param_info.param.bitrate_bps) + "_" +
                           in_100_kbps(param_info.param.control_bitrate_bps);
        std::erase_if(name, [](char character) { return character == '(' || character == ')'; });
        return name;
    });

class RtsThreshold : public testing::Test {
protected:
    std::uint64_t rts_frames(int threshold_bytes, int payload_bytes, bool broadcast = false) {
        MacConfig mac;
        mac.rts_threshold_bytes = threshold_bytes;
        Air air;
        Station& a = air.add_station({0, 0, 0}, mac);
        Station& b = air.add_station({light_microsecond_m, 0, 0}, mac);
        a.send(broadcast ? broadcast_id : b.id(), payload_bytes);
        air.run();
        EXPECT_EQ(b.received.size(), 1U);
        EXPECT_EQ(air.frame_outcomes.frames(FrameKind::cts), air.frame_outcomes.frames(FrameKind::rts));
        return air.frame_outcomes.frames(FrameKind::rts);
    }
};

TEST_F(RtsThreshold, AFrameOfItsLengthBeginsWithRts) {
    EXPECT_EQ(rts_frames(164, 100), 1U);
}

TEST_F(RtsThreshold, AShorterFrameDoesNot) {
    EXPECT_EQ(rts_frames(165, 100), 0U);
}

TEST_F(RtsThreshold, ABroadcastNeverDoes) {
    EXPECT_EQ(rts_frames(0, 100, true), 0U);
}

TEST_F(RtsThreshold, ByDefaultTheLongestFrameIsBelowIt) {
    EXPECT_EQ(rts_frames(MacConfig().rts_threshold_bytes, 2276), 0U);
}

}  // namespace
}  // namespace netsim
