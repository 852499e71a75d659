// The Dcf without an ACK, with a late ACK, and with another frame instead.
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "support/dcf_pair.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::ack_timeout;
using test::data_duration;
using test::difs;
using test::Heard;
using test::light_microsecond_m;
using test::of_kind;
using test::sifs;
using test::Station;
using test::us;
using test::without_backoff;

using DcfAck = test::DcfPair;

// Without an ACK, the sender's own NAV runs until the expected end of the ACK; the next attempt
// comes DIFS after that.
TEST_F(DcfAck, AFrameWithoutAckIsRepeated) {
    add_pair_without_way_back(without_backoff());
    a->send(b->id(), 100);
    air.run();
    const SimTime attempt = data_duration + sifs + ack_duration + difs;
    std::vector<SimTime> expected;
    for (int i = 0; i < 7; ++i) {
        expected.push_back(attempt * i);
    }
    EXPECT_EQ(starts(FrameKind::unicast), expected);
    EXPECT_EQ(given_up(), 1U);
}

// If the ACK is longer than the timeout waits for its start, the medium is free only after the
// NAV.
TEST_F(DcfAck, ASlowAckIsWaitedForByTheNav) {
    MacConfig mac = without_backoff();
    mac.bitrate_bps = 1e6;
    mac.short_retry_limit = 2;
    Station& alone = air.add_station({0, 0, 0}, mac);
    Station& deaf = air.add_station({1e7, 0, 0}, mac);
    at_a = &air.add_sniffer({0, 0, 0});
    alone.send(deaf.id(), 100);
    air.run();
    EXPECT_EQ(starts(FrameKind::unicast), (std::vector{us(0), us(1504 + 10 + 304 + 50)}));
}

TEST_F(DcfAck, HasABasicBitrate) {
    MacConfig mac = without_backoff();
    mac.op_mode = "b";
    mac.bitrate_bps = 11e6;
    mac.basic_bitrates_bps = {1e6, 2e6};
    add_pair(mac);
    a->send(b->id(), 100);
    air.run();
    const std::vector<Heard> acks = of_kind(*at_a, FrameKind::ack);
    ASSERT_EQ(acks.size(), 1U);
    EXPECT_EQ(acks.front().end - acks.front().start, us(192 + 14 * 8 / 2));
}

// The sender's own NAV has the length of the awaited ACK.
TEST_F(DcfAck, TheNavCoversASlowBasicBitrate) {
    MacConfig mac = without_backoff();
    mac.op_mode = "b";
    mac.bitrate_bps = 11e6;
    mac.basic_bitrates_bps = {1e6};
    mac.short_retry_limit = 2;
    Station& alone = air.add_station({0, 0, 0}, mac);
    Station& deaf = air.add_station({1e7, 0, 0}, mac);
    at_a = &air.add_sniffer({0, 0, 0});
    alone.send(deaf.id(), 100);
    air.run();
    const SimTime data = mode_set("b").mode_for_bitrate(11e6).duration(data_psdu_bytes(100));
    EXPECT_EQ(starts(FrameKind::unicast), (std::vector{us(0), data + us(10 + 304 + 50)}));
}

TEST_F(DcfAck, GivesUpWhenTheAckTimeoutOfTheLastAttemptIsOver) {
    MacConfig mac = without_backoff();
    mac.short_retry_limit = 1;
    add_pair_without_way_back(mac);
    a->send(b->id(), 100);
    air.run(data_duration + ack_timeout - SimTime::from_ps(1));
    EXPECT_EQ(given_up(), 0U);
    air.run(data_duration + ack_timeout);
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(DcfAck, AnAckThatHasBegunByTheTimeoutIsWaitedFor) {
    // At 44 light microseconds back and forth, the ACK starts 54 us after the end of the data and ends
    // at 88 us.
    MacConfig mac;
    a = &air.add_station({0, 0, 0}, mac, test::radio_of_power(100));
    b = &air.add_station({22 * light_microsecond_m, 0, 0}, mac, test::radio_of_power(100));
    a->send(b->id(), 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), 1U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

TEST_F(DcfAck, AnAckThatBeginsAfterTheTimeoutIsTooLate) {
    MacConfig mac;
    mac.short_retry_limit = 1;
    a = &air.add_station({0, 0, 0}, mac, test::radio_of_power(100));
    b = &air.add_station({23 * light_microsecond_m, 0, 0}, mac, test::radio_of_power(100));
    a->send(b->id(), 100);
    air.run();
    EXPECT_EQ(b->received.size(), 1U);
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(DcfAck, AnotherFrameInsteadOfTheAckIsAFailure) {
    MacConfig mac = without_backoff();
    mac.short_retry_limit = 1;
    add_pair_without_way_back(mac);
    a->send(b->id(), 100);
    test::BareRadio& rude = air.add_radio({0, 10, 0});
    air.at(data_duration + us(20), [&] { rude.send(us(50)); });
    air.run(data_duration + ack_timeout);
    EXPECT_EQ(given_up(), 0U);  // it may be the ACK
    air.run(data_duration + us(71));
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(DcfAck, ABrokenFrameThatEndsBeforeTheTimeoutIsNoFailure) {
    MacConfig mac = without_backoff();
    mac.short_retry_limit = 1;
    add_pair_without_way_back(mac);
    a->send(b->id(), 100);
    test::BareRadio& rude = air.add_radio({0, 10, 0});
    test::BareRadio& ruder = air.add_radio({0, 5, 0});
    air.at(data_duration + us(5), [&] { rude.send(us(30)); });
    air.at(data_duration + us(6), [&] { ruder.send(us(30)); });
    air.run(data_duration + ack_timeout - SimTime::from_ps(1));
    EXPECT_EQ(given_up(), 0U);  // the ACK may still come
    air.run(data_duration + ack_timeout);
    EXPECT_EQ(given_up(), 1U);
}

TEST_F(DcfAck, ADuplicateIsAcknowledgedButNotDeliveredAgain) {
    add_pair_without_way_back(MacConfig());
    a->send(b->id(), "once");
    a->send(b->id(), "twice");
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), 14U);
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 14U);
    EXPECT_EQ(b->texts(), (std::vector<std::string>{"once", "twice"}));
}

TEST_F(DcfAck, AfterGivingUpTheNextMessageHasItsTurn) {
    add_pair(MacConfig());
    Station& gone = air.add_station({1e7, 0, 0});
    a->send(gone.id(), "lost");
    a->send(b->id(), "next");
    air.run();
    EXPECT_EQ(b->texts(), std::vector<std::string>{"next"});
    EXPECT_EQ(given_up(), 1U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

}  // namespace
}  // namespace netsim
