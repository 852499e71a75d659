// The instants are computed by hand: support/dcf_instants.hpp. Missing ACKs, RTS and CTS, the NAV,
// rate control, the contention window and the validation of a configuration have their own files.
#include "netsim/mac/dcf.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/dcf_pair.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::Air;
using test::BareRadio;
using test::data_duration;
using test::difs;
using test::eifs;
using test::light_microsecond_m;
using test::mac_of;
using test::of_kind;
using test::sifs;
using test::slot;
using test::Sniffer;
using test::Station;
using test::us;
using test::without_backoff;

struct Exchange {
    const char* op_mode;
    double bitrate_bps;
    int data_us;  // 100 B of payload, 164 B with all headers
    int sifs_us;
    int ack_us;  // 14 B at the same rate if it is mandatory, else at the next slower mandatory one
};

class UnicastExchange : public testing::TestWithParam<Exchange> {};

TEST_P(UnicastExchange, TakesPlaceInTheInstantsOfTheStandard) {
    const Exchange& exchange = GetParam();
    const SimTime flight = us(1);
    Air air;
    const MacConfig mac = mac_of(exchange.op_mode, exchange.bitrate_bps);
    Station& sender = air.add_station({0, 0, 0}, mac);
    Station& receiver = air.add_station({light_microsecond_m, 0, 0}, mac);
    Sniffer& at_sender = air.add_sniffer({0, 0, 0});
    Sniffer& at_receiver = air.add_sniffer({light_microsecond_m, 0, 0});
    const SimTime start = SimTime::from_ps(1'234'567'890'123);
    air.at(start, [&] { sender.send(receiver.id(), 100); });
    air.run();

    const SimTime data_end = start + us(exchange.data_us);
    const SimTime ack_start = data_end + flight + us(exchange.sifs_us);  // at the receiver
    const SimTime ack_end = ack_start + us(exchange.ack_us);
    ASSERT_EQ(at_sender.heard.size(), 2U);
    ASSERT_EQ(at_receiver.heard.size(), 2U);
    EXPECT_EQ(at_sender.heard[0].start, start);
    EXPECT_EQ(at_sender.heard[0].end, data_end);
    EXPECT_EQ(at_receiver.heard[0].start, start + flight);
    EXPECT_EQ(at_receiver.heard[0].end, data_end + flight);
    EXPECT_EQ(at_receiver.heard[1].kind, FrameKind::ack);
    EXPECT_EQ(at_receiver.heard[1].start, ack_start);
    EXPECT_EQ(at_receiver.heard[1].end, ack_end);
    EXPECT_EQ(at_sender.heard[1].start, ack_start + flight);
    EXPECT_EQ(at_sender.heard[1].end, ack_end + flight);
    ASSERT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(receiver.received[0].time, data_end + flight);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Modes, UnicastExchange,
    testing::Values(Exchange{"b", 1e6, 1504, 10, 304}, Exchange{"b", 2e6, 848, 10, 248},
                    Exchange{"b", 5.5e6, 431, 10, 213}, Exchange{"b", 11e6, 312, 10, 203},
                    Exchange{"g(erp)", 6e6, 250, 10, 50}, Exchange{"g(erp)", 9e6, 178, 10, 50},
                    Exchange{"g(erp)", 12e6, 138, 10, 38}, Exchange{"g(erp)", 18e6, 102, 10, 38},
                    Exchange{"g(erp)", 24e6, 82, 10, 34}, Exchange{"g(erp)", 36e6, 66, 10, 34},
                    Exchange{"g(erp)", 48e6, 54, 10, 34}, Exchange{"g(erp)", 54e6, 54, 10, 34},
                    Exchange{"g(mixed)", 1e6, 1504, 10, 304}, Exchange{"g(mixed)", 2e6, 848, 10, 248},
                    Exchange{"g(mixed)", 5.5e6, 431, 10, 213}, Exchange{"g(mixed)", 6e6, 250, 10, 50},
                    Exchange{"g(mixed)", 9e6, 178, 10, 50}, Exchange{"g(mixed)", 11e6, 312, 10, 203},
                    Exchange{"g(mixed)", 12e6, 138, 10, 38}, Exchange{"g(mixed)", 18e6, 102, 10, 38},
                    Exchange{"g(mixed)", 24e6, 82, 10, 34}, Exchange{"g(mixed)", 36e6, 66, 10, 34},
                    Exchange{"g(mixed)", 48e6, 54, 10, 34}, Exchange{"g(mixed)", 54e6, 54, 10, 34},
                    Exchange{"a", 6e6, 244, 16, 44}, Exchange{"a", 9e6, 172, 16, 44},
                    Exchange{"a", 12e6, 132, 16, 32}, Exchange{"a", 18e6, 96, 16, 32},
                    Exchange{"a", 24e6, 76, 16, 28}, Exchange{"a", 36e6, 60, 16, 28},
                    Exchange{"a", 48e6, 48, 16, 28}, Exchange{"a", 54e6, 48, 16, 28}),
    [](const auto& param_info) {
        std::string name = std::string(param_info.param.op_mode) + "_" +
                           std::to_string(static_cast<int>(param_info.param.bitrate_bps / 1e5));
        std::erase_if(name, [](char character) { return character == '(' || character == ')'; });
        return name;
    });

using DcfTest = test::DcfPair;

TEST_F(DcfTest, AMessageIsDeliveredWithItsTextAndItsSource) {
    add_pair(MacConfig());
    a->send(b->id(), "hello, wörld");
    air.run();
    EXPECT_EQ(b->texts(), std::vector<std::string>{"hello, wörld"});
    EXPECT_EQ(b->received[0].source, a->id());
}

TEST_F(DcfTest, AnEmptyMessageIsDelivered) {
    add_pair(MacConfig());
    a->send(b->id(), "");
    air.run();
    EXPECT_EQ(b->texts(), std::vector<std::string>{""});
}

TEST_F(DcfTest, AUnicastIsOnlyForItsReceiver) {
    add_pair(MacConfig());
    Station& c = air.add_station({0, 100, 0});
    a->send(b->id(), 100);
    air.run();
    EXPECT_TRUE(c.received.empty());
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::delivered, true), 1U);
}

TEST_F(DcfTest, ABroadcastIsForAll) {
    add_pair(MacConfig());
    Station& c = air.add_station({0, 100, 0});
    a->send(broadcast_id, "to all");
    air.run();
    EXPECT_EQ(b->texts(), std::vector<std::string>{"to all"});
    EXPECT_EQ(c.texts(), std::vector<std::string>{"to all"});
    EXPECT_TRUE(a->received.empty());
}

TEST_F(DcfTest, ABroadcastIsNotAcknowledged) {
    add_pair(MacConfig());
    a->send(broadcast_id, 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 0U);
    EXPECT_EQ(air.message_count(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(DcfTest, ABroadcastThatNobodyHearsIsNotRepeated) {
    Station& alone = air.add_station({0, 0, 0});
    alone.send(broadcast_id, 100);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::broadcast), 1U);
    EXPECT_EQ(air.message_count(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(DcfTest, BroadcastsHaveTheirOwnBitrateIfTheyAreGivenOne) {
    MacConfig mac;
    mac.multicast_bitrate_bps = 6e6;
    add_pair(mac);
    a->send(broadcast_id, 100);
    air.run();
    EXPECT_EQ(at_a->heard.at(0).end - at_a->heard.at(0).start, us(250));
}

TEST_F(DcfTest, BroadcastsAreSentAsDataOtherwise) {
    add_pair(MacConfig());
    a->send(broadcast_id, 100);
    air.run();
    EXPECT_EQ(at_a->heard.at(0).end - at_a->heard.at(0).start, data_duration);
}

TEST_F(DcfTest, TheNextFrameFollowsTheAckAfterDifsAndABackoff) {
    add_pair(MacConfig());
    a->send(b->id(), 100);
    a->send(b->id(), 100);
    air.run();
    const SimTime ack_end = of_kind(*at_a, FrameKind::ack).at(0).end;
    const SimTime backoff = starts(FrameKind::unicast).at(1) - ack_end - difs;
    EXPECT_EQ(backoff.ps() % slot.ps(), 0);
    EXPECT_GE(backoff, SimTime());
    EXPECT_LE(backoff, slot * 31);
}

TEST_F(DcfTest, WithoutBackoffTheNextFrameFollowsTheAckAfterDifs) {
    add_pair(without_backoff());
    a->send(b->id(), 100);
    a->send(b->id(), 100);
    air.run();
    const SimTime exchange = data_duration + us(1) + sifs + ack_duration + us(1);
    EXPECT_EQ(starts(FrameKind::unicast), (std::vector{us(0), exchange + difs}));
}

TEST_F(DcfTest, BroadcastsFollowEachOtherAfterDifs) {
    add_pair(without_backoff());
    a->send(broadcast_id, 100);
    a->send(broadcast_id, 100);
    air.run();
    EXPECT_EQ(starts(FrameKind::broadcast), (std::vector{us(0), data_duration + difs}));
}

TEST_F(DcfTest, IfIdleSkipsBackoffsAFrameStillWaitsForTheOneAfterTheFrameBefore) {
    MacConfig config;
    config.skip_backoff_if_idle = true;
    config.cw_min = config.cw_max = 1023;
    add_pair(config);
    const SimTime first_end = difs + data_duration;
    a->send(broadcast_id, 100);
    air.at(first_end + difs + us(7), [&] { a->send(broadcast_id, 100); });
    air.at(us(900'000), [&] { a->send(broadcast_id, 100); });  // after it, and the one after it
    air.run();
    const std::vector<SimTime> sent = starts(FrameKind::broadcast);
    ASSERT_EQ(sent.size(), 3U);
    EXPECT_EQ(sent[0], difs);
    const SimTime backoff = sent[1] - first_end - difs;
    EXPECT_GT(backoff, us(7));
    EXPECT_EQ(backoff.ps() % slot.ps(), 0);
    EXPECT_EQ(sent[2], us(900'000) + difs);
}

TEST_F(DcfTest, MessagesGoOutInTheOrderTheyCameIn) {
    add_pair(MacConfig());
    std::vector<std::string> texts;
    for (int i = 0; i < 50; ++i) {
        texts.push_back("number " + std::to_string(i));
        a->send(i % 3 == 0 ? broadcast_id : b->id(), texts.back());
    }
    air.run();
    EXPECT_EQ(b->texts(), texts);
}

TEST_F(DcfTest, DefersToAFrameThatItHears) {
    add_pair(without_backoff());
    Station& c = air.add_station({0, 0, 0}, without_backoff());
    c.send(broadcast_id, 100);
    air.at(us(40), [&] { a->send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(FrameKind::broadcast), (std::vector{us(0), data_duration + difs}));
}

TEST_F(DcfTest, FramesOfOneInstantCollide) {
    add_pair(MacConfig());
    Station& c = air.add_station({0, light_microsecond_m, 0});
    air.at(us(1000), [&] {
        a->send(broadcast_id, 100);
        c.send(broadcast_id, 100);
    });
    air.run();
    EXPECT_TRUE(a->received.empty());  // a radio that transmits does not receive
    EXPECT_TRUE(c.received.empty());
    EXPECT_EQ(starts(FrameKind::broadcast), (std::vector{us(1000), us(1001)}));
}

TEST_F(DcfTest, ABrokenFrameIsFollowedByEifs) {
    RadioConfig picky;
    picky.snir_threshold = 1e12;  // decodes nothing
    Station& station = air.add_station({0, 0, 0}, without_backoff(), picky);
    Station& other = air.add_station({light_microsecond_m, 0, 0}, without_backoff());
    at_a = &air.add_sniffer({0, 0, 0});
    other.send(broadcast_id, 100);
    air.at(us(40), [&] { station.send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(starts(FrameKind::broadcast), (std::vector{us(1), us(1) + data_duration + eifs}));
}

// As in ns-3: two frames from other places that begin together.
TEST_F(DcfTest, ALostPhyHeaderIsNotFollowedByNs3sEifs) {
    MacConfig mac = without_backoff();
    mac.ns3_eifs = true;
    RadioConfig radio;
    radio.snir_mode = snir_by_chunks;
    Station& station = air.add_station({0, 0, 0}, mac, radio);
    Sniffer& sniffer = air.add_sniffer({0, 0, 0});
    for (int i = 0; i < 2; ++i) {
        BareRadio& peer = air.add_radio({0, 0, 0});
        air.at(us(0), [&peer] { peer.send_control(FrameKind::cts, broadcast_id, SimTime()); });
    }
    air.at(us(30), [&station] { station.send(broadcast_id, 100); });
    air.run();
    EXPECT_EQ(of_kind(sniffer, FrameKind::broadcast).at(0).start, us(34) + difs);
}

TEST_F(DcfTest, TheQueueHoldsAHundredAndTheOneInProgress) {
    add_pair(MacConfig());
    a->send(b->id(), 100);
    air.run(us(10));  // in the air
    for (int i = 0; i < 101; ++i) {
        a->send(b->id(), 100);
    }
    EXPECT_EQ(a->dcf.queued_messages(), 101U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::queue_overflow), 1U);
    air.run();
    EXPECT_EQ(b->received.size(), 101U);
}

TEST_F(DcfTest, AFrameWaitsInTheQueueUntilTheChannelIsGranted) {
    add_pair(MacConfig());
    for (int i = 0; i < 101; ++i) {
        a->send(broadcast_id, 100);
    }
    EXPECT_EQ(air.message_count(MessageKind::broadcast, MessageOutcome::queue_overflow), 1U);
}

TEST_F(DcfTest, QueuedMessagesCountsThoseWithoutAnOutcome) {
    add_pair(MacConfig());
    EXPECT_EQ(a->dcf.queued_messages(), 0U);
    a->send(b->id(), 100);
    a->send(b->id(), 100);
    EXPECT_EQ(a->dcf.queued_messages(), 2U);
    air.run(us(300));
    EXPECT_EQ(a->dcf.queued_messages(), 1U);
    air.run();
    EXPECT_EQ(a->dcf.queued_messages(), 0U);
}

TEST_F(DcfTest, TheLongestMessageFits) {
    add_pair(MacConfig());
    a->send(b->id(), 2276);
    air.run();
    EXPECT_EQ(b->received.size(), 1U);
}

TEST_F(DcfTest, AMessageThatIsTooLongIsAnErrorThatSaysHowLongItMayBe) {
    add_pair(MacConfig());
    try {
        a->send(b->id(), 2277);
        FAIL() << "no error";
    } catch (const SimulationError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "a message of 2277 bytes does not fit: the longest is 2276 bytes (an MTU of 2304 bytes "
                  "less IPv4 and "
                  "UDP headers)");
    }
    EXPECT_EQ(a->dcf.message_outcomes().accepted(MessageKind::unicast), 0U);
}

TEST_F(DcfTest, OnePairSharesTheChannelBothWays) {
    add_pair(MacConfig());
    for (int i = 0; i < 40; ++i) {
        a->send(b->id(), 100);
        b->send(a->id(), 100);
    }
    air.run();
    EXPECT_EQ(a->received.size(), 40U);
    EXPECT_EQ(b->received.size(), 40U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 80U);
}

}  // namespace
}  // namespace netsim
