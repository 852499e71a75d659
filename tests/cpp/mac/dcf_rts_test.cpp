// RTS and CTS of the Dcf, with instants computed by hand as in dcf_test.cpp.
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "netsim/medium/arrival.hpp"
#include "support/air.hpp"
#include "support/dcf_instants.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::Air;
using test::BareRadio;
using test::data_duration;
using test::difs;
using test::Heard;
using test::light_microsecond_m;
using test::sifs;
using test::Sniffer;
using test::Station;
using test::us;

// Every unicast with RTS and CTS.
MacConfig with_rts() {
    MacConfig config;
    config.rts_threshold_bytes = 0;
    return config;
}

// No backoff: every wait is an interframe space.
MacConfig with_rts_without_backoff() {
    MacConfig config = test::without_backoff();
    config.rts_threshold_bytes = 0;
    return config;
}

// g(mixed), all at 24 Mbps, a payload of 100 B.
constexpr SimTime rts_duration = us(34);
constexpr SimTime cts_duration = us(34);
constexpr SimTime cts_timeout = us(55);
constexpr SimTime rts_field = sifs + cts_duration + sifs + data_duration + sifs + ack_duration;

std::vector<SimTime> starts(const Sniffer& sniffer, FrameKind kind) {
    std::vector<SimTime> times;
    for (const Heard& heard : sniffer.heard) {
        if (heard.kind == kind) {
            times.push_back(heard.start);
        }
    }
    return times;
}

// A station and a bare radio at the same place, which the test controls.
class RtsTest : public testing::Test {
protected:
    void add(const MacConfig& mac, double distance_m = 0) {
        station = &air.add_station({0, 0, 0}, mac);
        peer = &air.add_radio({distance_m, 0, 0});
        sniffer = &air.add_sniffer({0, 0, 0});
    }
    void peer_sends(SimTime time, FrameKind kind, NodeId receiver, SimTime duration_field = SimTime()) {
        air.at(time, [this, kind, receiver, duration_field] {
            peer->send_control(kind, receiver, duration_field);
        });
    }
    std::uint64_t given_up() const {
        return air.message_count(MessageKind::unicast, MessageOutcome::retry_limit);
    }
    // The first message, at the same instant.
    void expect_given_up_at(SimTime time) {
        air.run(time - SimTime::from_ps(1));
        EXPECT_EQ(given_up(), 0U);
        air.run(time);
        EXPECT_EQ(given_up(), 1U);
    }

    static constexpr NodeId stranger = 99;

    Air air;
    Station* station = nullptr;
    BareRadio* peer = nullptr;
    Sniffer* sniffer = nullptr;
};

TEST_F(RtsTest, AnRtsForAnotherStationSetsTheNav) {
    add(with_rts_without_backoff());
    peer_sends(us(0), FrameKind::rts, stranger, us(1000));
    air.at(us(20), [&] { station->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::broadcast), std::vector{rts_duration + us(1000) + difs});
}

TEST_F(RtsTest, ACtsForAnotherStationSetsTheNav) {
    add(with_rts_without_backoff());
    peer_sends(us(0), FrameKind::cts, stranger, us(1000));
    air.at(us(20), [&] { station->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::broadcast), std::vector{cts_duration + us(1000) + difs});
}

TEST_F(RtsTest, AnAnnouncementThatEndsEarlierDoesNotShortenTheNav) {
    add(with_rts_without_backoff());
    peer_sends(us(0), FrameKind::rts, stranger, us(1000));
    peer_sends(us(100), FrameKind::cts, stranger, us(10));
    air.at(us(20), [&] { station->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::broadcast), std::vector{rts_duration + us(1000) + difs});
}

TEST_F(RtsTest, AnRtsIsAnsweredAfterSifs) {
    add(MacConfig());
    peer_sends(us(0), FrameKind::rts, station->id(), rts_field);
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::cts), std::vector{rts_duration + sifs});
}

TEST_F(RtsTest, AnRtsIsNotAnsweredWhileTheNavIsSet) {
    add(MacConfig());
    peer_sends(us(0), FrameKind::cts, stranger, us(166) + SimTime::from_ps(1));
    peer_sends(us(166), FrameKind::rts, station->id(), rts_field);  // ends 1 ps before the NAV
    air.run();
    EXPECT_TRUE(starts(*sniffer, FrameKind::cts) == std::vector{us(0)});
}

TEST_F(RtsTest, AnRtsThatEndsWithTheNavIsAnswered) {
    add(MacConfig());
    peer_sends(us(0), FrameKind::cts, stranger, us(166));
    peer_sends(us(166), FrameKind::rts, station->id(), rts_field);
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::cts), (std::vector{us(0), us(166) + rts_duration + sifs}));
}

// The CTS announces the rest of the RTS's announcement. The third station hears only the
// responder.
TEST_F(RtsTest, TheCtsSilencesThoseWhoDoNotHearTheRts) {
    add(MacConfig());
    RadioConfig near_deaf;  // hears only signals twice as strong as those from two hops away
    near_deaf.sensitivity_w = near_deaf.energy_detection_w =
        2 * RadioConfig().tx_power_w *
        make_path_loss(MediumConfig()).gain(2 * light_microsecond_m, RadioConfig().carrier_hz);
    Station& third = air.add_station({0, -light_microsecond_m, 0}, with_rts_without_backoff(), near_deaf);
    BareRadio& asking = air.add_radio({0, light_microsecond_m, 0});
    Sniffer& at_third = air.add_sniffer({0, -light_microsecond_m, 0});
    air.at(us(0), [&] { asking.send_control(FrameKind::rts, station->id(), us(1000)); });
    air.at(us(60), [&] { third.send(broadcast_id, 100); });
    air.run();
    const SimTime rts_end_at_responder = rts_duration + us(1);
    EXPECT_EQ(starts(at_third, FrameKind::broadcast),
              std::vector{rts_end_at_responder + us(1000) + us(1) + difs});
}

TEST_F(RtsTest, WithoutCtsTheDataIsNotSent) {
    add(with_rts());
    station->send(stranger, 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), 0U);
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::rts), 7U);
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(RtsTest, GivesUpWhenTheCtsTimeoutOfTheLastAttemptIsOver) {
    MacConfig mac = with_rts();
    mac.short_retry_limit = 1;
    add(mac);
    station->send(stranger, 100);
    expect_given_up_at(rts_duration + cts_timeout);
}

// The preamble of a CTS at 1 Mbps is longer than that of the data at 24 Mbps.
TEST_F(RtsTest, TheTimeoutIsThatOfACtsInTheModeOfTheRts) {
    constexpr SimTime slow_rts_duration = us(352);
    constexpr SimTime slow_cts_timeout = us(222);
    MacConfig mac = with_rts();
    mac.control_bitrate_bps = 1e6;
    mac.short_retry_limit = 1;
    add(mac);
    station->send(stranger, 100);
    expect_given_up_at(slow_rts_duration + slow_cts_timeout);
}

TEST_F(RtsTest, ACtsThatHasBegunByTheTimeoutIsWaitedFor) {
    // At 44 light microseconds back and forth, the CTS starts 54 us after the end of the RTS and ends
    // at 88 us.
    Station& a = air.add_station({0, 0, 0}, with_rts(), test::radio_of_power(100));
    Station& b = air.add_station({22 * light_microsecond_m, 0, 0}, with_rts(), test::radio_of_power(100));
    a.send(b.id(), 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::rts), 1U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

TEST_F(RtsTest, ACtsThatBeginsAfterTheTimeoutIsTooLate) {
    Station& a = air.add_station({0, 0, 0}, with_rts(), test::radio_of_power(100));
    Station& b = air.add_station({23 * light_microsecond_m, 0, 0}, with_rts(), test::radio_of_power(100));
    a.send(b.id(), 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), 0U);
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(RtsTest, AnotherFrameInsteadOfTheCtsIsAFailure) {
    MacConfig mac = with_rts();
    mac.short_retry_limit = 1;
    add(mac);
    station->send(peer->id(), 100);
    peer_sends(rts_duration + sifs, FrameKind::cts, stranger);
    air.run(rts_duration + sifs + cts_duration);
    EXPECT_EQ(given_up(), 1U);
}

// As in INET: the next attempt comes at the expected end of the exchange.
TEST_F(RtsTest, AFailedRtsIsRepeatedAfterItsOwnNav) {
    add(with_rts_without_backoff());
    station->send(stranger, 100);
    air.run();
    std::vector<SimTime> expected;
    for (int i = 0; i < 7; ++i) {
        expected.push_back((rts_duration + rts_field + difs) * i);
    }
    EXPECT_EQ(starts(*sniffer, FrameKind::rts), expected);
}

// As in INET: after its CTS, a station waits for the end of the exchange, even without data.
TEST_F(RtsTest, TheOwnCtsSetsTheNav) {
    add(with_rts_without_backoff());
    peer_sends(us(0), FrameKind::rts, station->id(), us(1000));
    air.at(us(20), [&] { station->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(*sniffer, FrameKind::cts), std::vector{rts_duration + sifs});
    EXPECT_EQ(starts(*sniffer, FrameKind::broadcast), std::vector{rts_duration + us(1000) + difs});
}

// As in the standard.
TEST_F(RtsTest, AFailedRtsIsRepeatedDifsAfterTheTimeoutIfOwnFramesSetNoNav) {
    MacConfig mac = with_rts_without_backoff();
    mac.own_frames_set_nav = false;
    mac.backoff_optimization = false;  // otherwise the timeout would count as idle time
    add(mac);
    station->send(stranger, 100);
    air.run();
    std::vector<SimTime> expected;
    for (int i = 0; i < 7; ++i) {
        expected.push_back(difs + (rts_duration + cts_timeout + difs) * i);
    }
    EXPECT_EQ(starts(*sniffer, FrameKind::rts), expected);
}

// Attempts of a station whose peer permits some of them, and never acknowledges.
class RtsRetries : public RtsTest {
protected:
    static constexpr SimTime attempt = rts_duration + rts_field + difs;  // own NAV, no backoff

    void expect_frames(const MacConfig& mac, const std::vector<int>& permitted, std::uint64_t rts,
                       std::uint64_t data) {
        add(mac);
        station->send(peer->id(), 100);
        for (const int i : permitted) {
            peer_sends(attempt * i + rts_duration + sifs, FrameKind::cts, station->id());
        }
        air.run();
        EXPECT_EQ(air.frame_outcomes.frames(FrameKind::rts), rts);
        EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), data);
        EXPECT_EQ(given_up(), 1U);
    }
};

TEST_F(RtsRetries, AFrameFromTheThresholdOnIsSentFourTimes) {
    expect_frames(with_rts_without_backoff(), {0, 1, 2, 3, 4, 5, 6}, 4, 4);
}

TEST_F(RtsRetries, TheLongLimitIsConfigurable) {
    MacConfig mac = with_rts_without_backoff();
    mac.long_retry_limit = 6;
    expect_frames(mac, {0, 1, 2, 3, 4, 5, 6}, 6, 6);
}

TEST_F(RtsRetries, ACtsDoesNotResetTheShortCounter) {
    expect_frames(with_rts_without_backoff(), {3}, 8, 1);
}

TEST_F(RtsRetries, BothCountersRunBesideEachOther) {
    expect_frames(with_rts_without_backoff(), {1, 3, 5, 7}, 8, 4);
}

TEST_F(RtsRetries, TheNextMessageHasAllAttempts) {
    add(with_rts_without_backoff());
    station->send(stranger, 100);
    station->send(stranger, 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::rts), 14U);
    EXPECT_EQ(given_up(), 2U);
}

// Retry flag of each data frame.
class RetryFlags final : public MediumListener {
public:
    Trajectory trajectory{Position{}};
    std::vector<bool> flags;

    void arrival_started(const Arrival&) override {}
    void arrival_ended(const Arrival& arrival) override {
        if (arrival.transmission->label.kind == FrameKind::unicast) {
            flags.push_back(arrival.transmission->frame->retry);
        }
    }
};

TEST_F(RtsRetries, DataThatIsSentForTheFirstTimeAfterAFailedRtsIsNoRetry) {
    RetryFlags listener;
    const RadioConfig radio;
    air.medium.attach(
        air.next_node(),
        Receiver{&listener, &listener.trajectory, {.band = {radio.carrier_hz, radio.bandwidth_hz}}});
    add(with_rts_without_backoff());
    station->send(peer->id(), 100);
    for (const int i : {1, 2}) {
        peer_sends(attempt * i + rts_duration + sifs, FrameKind::cts, station->id());
    }
    air.run();
    EXPECT_EQ(listener.flags, (std::vector{false, true}));
}

// Two stations that send RTS to each other at the same time: the later RTS meets a station that
// waits for a CTS.
TEST_F(RtsTest, AnRtsThatComesInsteadOfTheCtsIsAnsweredIfOwnFramesSetNoNav) {
    MacConfig mac = with_rts();
    mac.own_frames_set_nav = false;
    add(mac);
    station->send(peer->id(), 100);
    peer_sends(rts_duration + us(5), FrameKind::rts, station->id(), rts_field);
    air.run(us(200));
    EXPECT_EQ(starts(*sniffer, FrameKind::cts), std::vector{rts_duration + us(5) + rts_duration + sifs});
}

TEST_F(RtsTest, AnRtsThatComesInsteadOfTheCtsIsNotAnsweredUnderTheOwnNav) {
    add(with_rts());
    station->send(peer->id(), 100);
    peer_sends(rts_duration + us(5), FrameKind::rts, station->id(), rts_field);
    air.run(us(200));
    EXPECT_TRUE(starts(*sniffer, FrameKind::cts).empty());
}

TEST_F(RtsTest, AnRtsAndItsCtsAreInTheLedger) {
    Station& a = air.add_station({0, 0, 0}, with_rts());
    Station& b = air.add_station({light_microsecond_m, 0, 0}, with_rts());
    air.add_station({0, 100, 0});
    a.send(b.id(), 100);
    air.run();
    for (const FrameKind kind : {FrameKind::rts, FrameKind::cts}) {
        EXPECT_EQ(air.frame_count(kind, FrameOutcome::delivered, false), 1U);
        EXPECT_EQ(air.frame_count(kind, FrameOutcome::delivered, true), 1U);
    }
}

}  // namespace
}  // namespace netsim
