// Exchanges, retries, collisions and interframe spaces.
#include "netsim/mac/csma_ca_802154.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/csma_devices.hpp"

namespace netsim {
namespace {

using test::BareRadio;
using test::Heard;
using test::light_microsecond_m;
using test::Sniffer;
using test::us;
using test::csma::ack_duration;
using test::csma::ack_wait;
using test::csma::cca;
using test::csma::data_duration;
using test::csma::Device;
using test::csma::flight;
using test::csma::longest_duration;
using test::csma::narrowband;
using test::csma::sifs;
using test::csma::turnaround;
using test::csma::without_backoff;

using CsmaCa802154Test = test::csma::CsmaDevices;

TEST_F(CsmaCa802154Test, AnExchangeTakesPlaceInTheInstantsOfTheStandard) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Device& receiver = add_device({light_microsecond_m, 0, 0});
    Sniffer& at_sender = add_sniffer({0, 0, 0});
    const SimTime asked = SimTime::from_ps(1'234'567'890'123);
    air.at(asked, [&] { sender.send(receiver.id(), 50); });
    air.run();

    const SimTime start = asked + cca + turnaround;
    ASSERT_EQ(at_sender.heard.size(), 2U);
    EXPECT_EQ(at_sender.heard[0].start, start);
    EXPECT_EQ(at_sender.heard[0].end, start + data_duration);
    EXPECT_EQ(at_sender.heard[1].kind, FrameKind::ack);
    EXPECT_EQ(at_sender.heard[1].start, start + data_duration + flight + sifs + flight);
    EXPECT_EQ(at_sender.heard[1].end, at_sender.heard[1].start + ack_duration);
    EXPECT_EQ(receiver.received, std::vector{start + data_duration + flight});
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

TEST_F(CsmaCa802154Test, ABroadcastIsNotAcknowledged) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Device& receiver = add_device({30, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.size(), 1U);
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(CsmaCa802154Test, WithoutAcksUnicastsAreSentOnce) {
    CsmaConfig config;
    config.use_acks = false;
    Device& sender = add_device({0, 0, 0}, config);
    Device& receiver = add_device({30, 0, 0}, config);
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(receiver.id(), 50);
    air.run();
    EXPECT_EQ(sniffer.heard.size(), 1U);
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::sent), 1U);
}

// Each device requests ACKs or does not, and answers requests.
TEST_F(CsmaCa802154Test, AFrameIsAcknowledgedIfItAsksForThat) {
    CsmaConfig does_not_ask;
    does_not_ask.use_acks = false;
    Device& asking = add_device({0, 0, 0});
    Device& other = add_device({30, 0, 0}, does_not_ask);
    asking.send(other.id(), 50);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 1U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
    other.send(asking.id(), 50);
    air.run(SimTime::from_seconds(200));
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 1U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::sent), 1U);
    EXPECT_EQ(asking.received.size() + other.received.size(), 2U);
}

TEST_F(CsmaCa802154Test, TheNextMessageHasAllRepetitions) {
    Device& sender = add_device({0, 0, 0});
    constexpr NodeId stranger = 99;
    sender.send(stranger, 50);
    sender.send(stranger, 50);
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::unicast), 8U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::retry_limit), 2U);
}

TEST_F(CsmaCa802154Test, WhatComesWhileItTurnsToTransmitIsNotReceived) {
    CsmaConfig slow = without_backoff();
    slow.turnaround_s = 10e-3;
    Device& sender = add_device({0, 0, 0}, slow);
    BareRadio& jammer = add_jammer({30, 0, 0});
    sender.send(broadcast_id, 50);
    air.at(us(1'000), [&] { jam(jammer, us(2'000)); });
    air.run();
    EXPECT_TRUE(sender.received.empty());
}

TEST_F(CsmaCa802154Test, WhatComesWhileItTurnsToAcknowledgeIsNotReceived) {
    CsmaConfig slow;
    slow.sifs_s = 10e-3;
    CsmaConfig once = without_backoff();
    once.max_frame_retries = 0;
    Device& sender = add_device({0, 0, 0}, once);
    Device& receiver = add_device({30, 0, 0}, slow);
    BareRadio& jammer = add_jammer({60, 0, 0});
    sender.send(receiver.id(), 50);
    air.at(us(5'000), [&] { jam(jammer, us(2'000)); });
    air.run();
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 1U);
}

TEST_F(CsmaCa802154Test, TheLongestMessageFillsAFrameOf127Bytes) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(broadcast_id, 90);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 1U);
    EXPECT_EQ(sniffer.heard[0].end - sniffer.heard[0].start, longest_duration);
}

TEST_F(CsmaCa802154Test, ALongerMessageIsRefused) {
    Device& sender = add_device({0, 0, 0});
    try {
        sender.send(broadcast_id, 91);
        FAIL();
    } catch (const SimulationError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "a message of 91 bytes does not fit: the longest is 90 bytes (an 802.15.4 frame of 127 "
                  "bytes less "
                  "MAC, IPv4 and UDP headers)");
    }
    EXPECT_EQ(sender.csma.message_outcomes().accepted(MessageKind::broadcast), 0U);
}

TEST_F(CsmaCa802154Test, AFrameWithoutAckIsRepeatedThreeTimes) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    constexpr NodeId nobody = 99;
    sender.send(nobody, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 4U);
    SimTime expected = cca + turnaround;
    for (const Heard& frame : sniffer.heard) {
        EXPECT_EQ(frame.start, expected);
        expected += data_duration + ack_wait + cca + turnaround;
    }
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::retry_limit), 1U);
}

// A sender that never waits long enough for an ACK.
TEST_F(CsmaCa802154Test, RepetitionsAreAcknowledgedButDeliveredOnce) {
    CsmaConfig impatient = without_backoff();
    impatient.ack_wait_s = 100e-6;
    impatient.max_backoffs = 10;
    Device& sender = add_device({0, 0, 0}, impatient);
    Device& receiver = add_device({30, 0, 0});
    sender.send(receiver.id(), 50);
    air.run();
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::delivered), 4U);
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::ack), 4U);
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::retry_limit), 1U);
}

// 1600 m apart they are below each other's sensitivity; in the middle they are 5 dB above it. With
// a threshold of 1 dB the spreading gain does not save the first frame.
TEST_F(CsmaCa802154Test, HiddenSendersCollide) {
    RadioConfig radio = narrowband();
    radio.snir_threshold = 1.26;
    Device& one = add_device({-800, 0, 0}, without_backoff());
    Device& other = add_device({800, 0, 0}, without_backoff());
    Device& between = add_device({0, 0, 0}, CsmaConfig(), radio);
    one.send(between.id(), 50);
    air.at(us(1'000), [&] { other.send(between.id(), 50); });
    air.run(us(4'300));
    EXPECT_EQ(between.received.size(), 0U);
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::interference), 1U);
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::receiver_locked), 1U);
}

TEST_F(CsmaCa802154Test, TheRadioIsDeafWhileItTurnsAround) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    BareRadio& jammer = add_jammer({30, 0, 0});
    sender.send(broadcast_id, 50);
    air.at(cca + us(1), [&] { jam(jammer, us(500)); });
    air.run();
    EXPECT_EQ(
        air.frame_outcomes.counts_at(
            sender.id(), FrameKind::broadcast)[static_cast<std::size_t>(FrameOutcome::receiver_transmitting)],
        1U);
    EXPECT_TRUE(sender.received.empty());
}

CsmaConfig with_rest() {
    CsmaConfig config = without_backoff();
    config.lifs_s = 640e-6;
    return config;
}

TEST_F(CsmaCa802154Test, TheNextFrameRestsAfterAnAck) {
    Device& sender = add_device({0, 0, 0}, with_rest());
    Device& receiver = add_device({light_microsecond_m, 0, 0});
    Sniffer& at_sender = add_sniffer({0, 0, 0});
    sender.send(receiver.id(), 50);
    sender.send(receiver.id(), 50);
    air.run();
    ASSERT_EQ(at_sender.heard.size(), 4U);
    EXPECT_EQ(at_sender.heard[2].start, at_sender.heard[1].end + us(640) + cca + turnaround);
}

TEST_F(CsmaCa802154Test, TheNextFrameRestsAfterOneWithoutAck) {
    Device& sender = add_device({0, 0, 0}, with_rest());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(broadcast_id, 50);
    sender.send(broadcast_id, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 2U);
    EXPECT_EQ(sniffer.heard[1].start, sniffer.heard[0].end + us(640) + cca + turnaround);
}

TEST_F(CsmaCa802154Test, AMessageThatComesDuringTheRestWaitsForItsEnd) {
    Device& sender = add_device({0, 0, 0}, with_rest());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    const SimTime first_end = cca + turnaround + data_duration;
    sender.send(broadcast_id, 50);
    air.at(first_end + us(100), [&] { sender.send(broadcast_id, 50); });
    air.at(first_end + us(50'000), [&] { sender.send(broadcast_id, 50); });
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 3U);
    EXPECT_EQ(sniffer.heard[1].start, first_end + us(640) + cca + turnaround);
    EXPECT_EQ(sniffer.heard[2].start, first_end + us(50'000) + cca + turnaround);
}

TEST_F(CsmaCa802154Test, NoRestComesBeforeARepetition) {
    Device& sender = add_device({0, 0, 0}, with_rest());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    constexpr NodeId nobody = 99;
    sender.send(nobody, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 4U);
    EXPECT_EQ(sniffer.heard[1].start, sniffer.heard[0].end + ack_wait + cca + turnaround);
}

TEST_F(CsmaCa802154Test, AFullQueueDropsTheNewcomer) {
    CsmaConfig config;
    config.queue_capacity = 1;
    Device& sender = add_device({0, 0, 0}, config);
    sender.send(broadcast_id, 1);
    sender.send(broadcast_id, 1);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::queue_overflow), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 1U);
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::sent), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 0U);
}

}  // namespace
}  // namespace netsim
