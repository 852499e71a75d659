// The Dcf while other stations reserve the channel. RTS and CTS are in dcf_rts_test.cpp.
#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "support/air.hpp"
#include "support/dcf_instants.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::Air;
using test::BareRadio;
using test::data_duration;
using test::difs;
using test::eifs;
using test::light_microsecond_m;
using test::of_kind;
using test::sifs;
using test::slot;
using test::Sniffer;
using test::Station;
using test::us;
using test::without_backoff;

// Station c hears a, but not b's response.
class HiddenResponder : public testing::Test {
protected:
    static constexpr double hop_m = light_microsecond_m;

    void SetUp() override {
        RadioConfig radio;
        radio.sensitivity_w = 1.5 * at(2 * hop_m);
        radio.energy_detection_w = radio.sensitivity_w;
        b = &air.add_station({0, 0, 0}, without_backoff(), radio);
        a = &air.add_station({hop_m, 0, 0}, without_backoff(), radio);
        c = &air.add_station({2 * hop_m, 0, 0}, without_backoff(), radio);
        at_c = &air.add_sniffer({2 * hop_m, 0, 0});
    }
    static double at(double distance_m) {
        return RadioConfig().tx_power_w *
               make_path_loss(MediumConfig()).gain(distance_m, RadioConfig().carrier_hz);
    }

    Air air;
    Station* a = nullptr;
    Station* b = nullptr;
    Station* c = nullptr;
    Sniffer* at_c = nullptr;
};

TEST_F(HiddenResponder, TheNavKeepsTheThirdStationSilentUntilTheAckIsOver) {
    a->send(b->id(), 100);
    air.at(us(40), [&] { c->send(broadcast_id, 100); });
    air.run();
    const SimTime data_end_at_c = data_duration + us(1);
    ASSERT_EQ(of_kind(*at_c, FrameKind::broadcast).size(), 1U);
    EXPECT_EQ(of_kind(*at_c, FrameKind::broadcast)[0].start, data_end_at_c + sifs + ack_duration + difs);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

TEST_F(HiddenResponder, TheNavCountsAsBusyForImmediateAccess) {
    a->send(b->id(), 100);
    const SimTime data_end_at_c = data_duration + us(1);
    air.at(data_end_at_c + us(5), [&] { c->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(of_kind(*at_c, FrameKind::broadcast).at(0).start, data_end_at_c + sifs + ack_duration + difs);
}

// The contention is not notified of a NAV that starts and ends before there is something to
// send.
TEST_F(HiddenResponder, ANavThatIsOverCountsAsBusyForImmediateAccess) {
    a->send(b->id(), 100);
    const SimTime nav_end = data_duration + us(1) + sifs + ack_duration;
    air.at(nav_end + us(5), [&] { c->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(of_kind(*at_c, FrameKind::broadcast).at(0).start, nav_end + difs);
}

TEST_F(HiddenResponder, ABroadcastLeavesNoNav) {
    a->send(broadcast_id, 100);
    air.at(us(40), [&] { c->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(of_kind(*at_c, FrameKind::broadcast).at(1).start, data_duration + us(1) + difs);
}

// A station that hears an RTS for another one, and has a message to send. As in ns-3, the NAV of 1 ms
// ends after the time of a CTS and one more PHY header, unless a frame follows.
class UnansweredRts : public testing::Test {
protected:
    static constexpr SimTime rts_end = us(34);
    static constexpr SimTime cts_duration = us(34);
    static constexpr SimTime phy_header = us(20);  // with its preamble
    static constexpr SimTime reset = rts_end + sifs + cts_duration + sifs + phy_header + slot + slot;
    static constexpr SimTime nav_end = rts_end + us(1000);
    static constexpr NodeId stranger = 99;

    void SetUp() override {
        MacConfig mac = without_backoff();
        mac.unanswered_rts_resets_nav = true;
        RadioConfig radio;
        radio.snir_mode = snir_by_chunks;
        Station& station = air.add_station({0, 0, 0}, mac, radio);
        sniffer = &air.add_sniffer({0, 0, 0});
        sends(us(0), FrameKind::rts, us(1000));
        air.at(us(20), [&station] { station.send(broadcast_id, 100); });
    }
    // By a radio of its own.
    void sends(SimTime time, FrameKind kind, SimTime duration_field) {
        BareRadio& radio = air.add_radio({0, 0, 0});
        air.at(time, [&radio, kind, duration_field] { radio.send_control(kind, stranger, duration_field); });
    }
    void expect_message_at(SimTime time) {
        air.run();
        EXPECT_EQ(of_kind(*sniffer, FrameKind::broadcast).at(0).start, time);
    }

    Air air;
    Sniffer* sniffer = nullptr;
};

TEST_F(UnansweredRts, ResetsTheNav) {
    expect_message_at(reset + difs);
}

TEST_F(UnansweredRts, KeepsTheNavIfAFrameFollows) {
    sends(rts_end + sifs, FrameKind::cts, us(10));
    expect_message_at(nav_end + difs);
}

TEST_F(UnansweredRts, KeepsTheNavIfAFrameIsBeingReceived) {
    sends(reset - phy_header - us(1), FrameKind::cts, us(10));
    expect_message_at(nav_end + difs);
}

TEST_F(UnansweredRts, ResetsTheNavDuringThePhyHeaderOfTheNextFrame) {
    const SimTime start = reset - phy_header + us(1);
    sends(start, FrameKind::cts, us(10));
    expect_message_at(start + cts_duration + us(10) + difs);
}

TEST_F(UnansweredRts, ResetsTheNavIfThePhyHeaderThatFollowsIsLost) {
    sends(rts_end + sifs, FrameKind::cts, us(10));
    sends(rts_end + sifs, FrameKind::cts, us(10));
    expect_message_at(rts_end + sifs + cts_duration + eifs);
}

TEST_F(UnansweredRts, KeepsALongerNavOfAnEarlierFrame) {
    sends(rts_end + sifs, FrameKind::cts, us(2000));
    sends(rts_end + us(100), FrameKind::rts, us(100));
    expect_message_at(rts_end + sifs + cts_duration + us(2000) + difs);
}

}  // namespace
}  // namespace netsim
