// The Dcf while other stations reserve the channel. RTS and CTS are in dcf_rts_test.cpp.
#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "support/air.hpp"
#include "support/dcf_instants.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::Air;
using test::data_duration;
using test::difs;
using test::light_microsecond_m;
using test::of_kind;
using test::sifs;
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
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageFate::acknowledged), 1U);
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

}  // namespace
}  // namespace netsim
