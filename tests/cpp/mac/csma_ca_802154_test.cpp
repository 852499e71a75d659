// The instants are worked out by hand from the durations and intervals of IEEE 802.15.4, which are written out here.
#include "netsim/mac/csma_ca_802154.hpp"

#include <deque>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/phy/oqpsk_mode.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;
using test::Heard;
using test::light_microsecond_m;
using test::Sniffer;
using test::us;

constexpr SimTime period = us(320);
constexpr SimTime cca = us(128);
constexpr SimTime turnaround = us(192);
constexpr SimTime sifs = us(192);
constexpr SimTime ack_duration = us(352);        // 192 µs + 5 B
constexpr SimTime data_duration = us(2'976);     // 192 µs + 87 B, of which 50 B are payload
constexpr SimTime longest_duration = us(4'256);  // 192 µs + 127 B
constexpr SimTime ack_wait = us(560);
constexpr SimTime flight = us(1);

RadioConfig narrowband() {
    return RadioConfig(ieee802154_interface);
}

CsmaConfig without_backoff() {
    CsmaConfig config;
    config.min_be = 0;
    config.max_be = 0;
    return config;
}

struct Device final : LinkListener {
    Device(Air& air_, Position place, const CsmaConfig& config, const RadioConfig& radio_config,
           std::uint64_t seed)
        : air(air_),
          trajectory(place),
          radio(air.simulator, air.medium, air.next_node(), radio_config, trajectory, seed, air.frame_fates,
                air.fingerprint),
          csma(air.simulator, radio, config, seed, air.message_fates, *this) {}

    NodeId id() const { return radio.node(); }
    void send(NodeId destination, std::size_t bytes) {
        csma.send(destination, std::make_shared<const std::string>(bytes, 'x'));
    }
    void message_received(NodeId, const Payload&) override { received.push_back(air.simulator.now()); }

    Air& air;
    Trajectory trajectory;
    Radio radio;
    CsmaCa802154 csma;
    std::vector<SimTime> received;
};

class CsmaCa802154Test : public testing::Test {
protected:
    static constexpr std::uint64_t seed = 7;

    Device& add_device(Position place, const CsmaConfig& config = CsmaConfig(),
                       const RadioConfig& radio = narrowband()) {
        return devices_.emplace_back(air, place, config, radio, seed);
    }
    Sniffer& add_sniffer(Position place) { return air.add_sniffer(place, narrowband()); }
    BareRadio& add_jammer(Position place) { return air.add_radio(place, narrowband()); }
    // Keeps the channel busy with a broadcast frame.
    static void jam(BareRadio& jammer, SimTime duration) {
        Frame frame;
        frame.transmitter = jammer.id();
        frame.payload = std::make_shared<const std::string>();
        jammer.radio.transmit(std::make_shared<const Frame>(std::move(frame)), FrameLabel(), 100,
                              oqpsk_250_kbps, duration);
    }
    // The numbers that a device draws.
    static RandomStream draws_of(const Device& device) {
        return {seed, static_cast<std::uint32_t>(device.id()), Purpose::csma_backoff};
    }
    std::uint64_t messages(MessageKind kind, MessageFate fate) const { return air.message_count(kind, fate); }

    Air air;

private:
    std::deque<Device> devices_;
};

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
    EXPECT_EQ(messages(MessageKind::unicast, MessageFate::acknowledged), 1U);
}

TEST_F(CsmaCa802154Test, ABroadcastIsNotAcknowledged) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Device& receiver = add_device({30, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.size(), 1U);
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::sent), 1U);
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
    EXPECT_EQ(messages(MessageKind::unicast, MessageFate::sent), 1U);
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
    EXPECT_EQ(air.message_fates.accepted(MessageKind::broadcast), 0U);
}

// BE is 3, 4, 5, 5, 5 for the five waits of a frame.
TEST_F(CsmaCa802154Test, WaitsGrowWhileTheChannelIsBusy) {
    Device& sender = add_device({0, 0, 0});
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    RandomStream draws = draws_of(sender);
    SimTime assessed[5];
    SimTime time;
    for (int i = 0; const std::uint32_t waits : {8, 16, 32, 32, 32}) {
        time += period * draws.uniform_int(waits) + cca;
        assessed[i++] = time;
    }
    jam(jammer, assessed[3] + us(1));
    sender.send(broadcast_id, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 2U);
    EXPECT_EQ(sniffer.heard[1].start, assessed[4] + turnaround);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::sent), 1U);
}

TEST_F(CsmaCa802154Test, AfterTheLastBusyAssessmentAFrameIsGivenUp) {
    Device& sender = add_device({0, 0, 0});
    BareRadio& jammer = add_jammer({0, 0, 0});
    RandomStream draws = draws_of(sender);
    SimTime fifth;
    for (const std::uint32_t waits : {8, 16, 32, 32, 32}) {
        fifth += period * draws.uniform_int(waits) + cca;
    }
    jam(jammer, fifth + us(1));
    sender.send(broadcast_id, 50);
    air.run(fifth + us(-1));
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::access_failure), 0U);
    air.run(fifth);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::access_failure), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 0U);
}

TEST_F(CsmaCa802154Test, TheFrameAfterOneGivenUpStartsAfresh) {
    CsmaConfig config = without_backoff();
    Device& sender = add_device({0, 0, 0}, config);
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    jam(jammer, cca * 9 + us(1));  // five assessments of the first frame, four of the second
    sender.send(broadcast_id, 50);
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::access_failure), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::sent), 1U);
    EXPECT_EQ(sniffer.heard.at(1).start, cca * 10 + turnaround);
}

struct Method {
    const char* name;
    std::vector<std::uint32_t> windows;
};

class BackoffMethod : public CsmaCa802154Test, public testing::WithParamInterface<Method> {};

TEST_P(BackoffMethod, WaitsAtLeastOnePeriod) {
    CsmaConfig config;
    config.backoff_method = GetParam().name;
    Device& sender = add_device({0, 0, 0}, config);
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    RandomStream draws = draws_of(sender);
    SimTime last;
    SimTime before;
    for (const std::uint32_t window : GetParam().windows) {
        before = last;
        last += period * (1 + draws.uniform_int(window)) + cca;
    }
    jam(jammer, before + us(1));
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.at(1).start, last + turnaround);
}

INSTANTIATE_TEST_SUITE_P(Methods, BackoffMethod,
                         testing::Values(Method{"linear", {2, 3, 4, 5}}, Method{"constant", {2, 2, 2, 2}}),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

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
    EXPECT_EQ(messages(MessageKind::unicast, MessageFate::retry_limit), 1U);
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
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameFate::delivered), 4U);
    EXPECT_EQ(air.frame_fates.frames(FrameKind::ack), 4U);
    EXPECT_EQ(receiver.received.size(), 1U);
    EXPECT_EQ(messages(MessageKind::unicast, MessageFate::retry_limit), 1U);
}

TEST_F(CsmaCa802154Test, TwoThatDrawTheSameNumberSendAtOnce) {
    Device& one = add_device({-30, 0, 0}, without_backoff());
    Device& other = add_device({30, 0, 0}, without_backoff());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    one.send(broadcast_id, 50);
    other.send(broadcast_id, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 2U);
    EXPECT_EQ(sniffer.heard[0].start, sniffer.heard[1].start);
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameFate::receiver_transmitting), 2U);
}

TEST_F(CsmaCa802154Test, WhoDrawsTheLargerNumberHearsTheOther) {
    CsmaConfig later = without_backoff();
    later.backoff_method = "constant";
    later.contention_window = 1;
    Device& first = add_device({-30, 0, 0}, without_backoff());
    Device& second = add_device({30, 0, 0}, later);
    first.send(broadcast_id, 50);
    second.send(broadcast_id, 1);
    // 320 µs + 2976 µs on the air; the second assesses the channel every 448 µs, five times.
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::access_failure), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::sent), 1U);
}

// 1600 m apart they are below each other's sensitivity, in the middle they are 5 dB above it. A threshold of 1 dB
// keeps the spreading gain from saving the frame that comes first.
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
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameFate::interference), 1U);
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameFate::receiver_locked), 1U);
}

TEST_F(CsmaCa802154Test, AWaitIsInterruptedToAnswerAndBeginsAnew) {
    CsmaConfig one_period;
    one_period.backoff_method = "constant";
    one_period.contention_window = 1;
    one_period.max_backoffs = 200;
    Device& sender = add_device({0, 0, 0}, without_backoff());
    Device& receiver = add_device({0, 0, 0}, one_period);
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    sender.send(receiver.id(), 50);
    air.at(us(1'000), [&] { receiver.send(sender.id(), 1); });
    air.run();
    const SimTime ack_end = cca + turnaround + data_duration + sifs + ack_duration;
    ASSERT_EQ(sniffer.heard.size(), 4U);
    EXPECT_EQ(sniffer.heard[1].end, ack_end);
    EXPECT_EQ(sniffer.heard[2].start, ack_end + period + cca + turnaround);
    EXPECT_EQ(messages(MessageKind::unicast, MessageFate::acknowledged), 2U);
}

TEST_F(CsmaCa802154Test, TheRadioIsDeafWhileItTurnsAround) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    BareRadio& jammer = add_jammer({30, 0, 0});
    sender.send(broadcast_id, 50);
    air.at(cca + us(1), [&] { jam(jammer, us(500)); });
    air.run();
    EXPECT_EQ(
        air.frame_fates.counts_at(
            sender.id(), FrameKind::broadcast)[static_cast<std::size_t>(FrameFate::receiver_transmitting)],
        1U);
    EXPECT_TRUE(sender.received.empty());
}

// The channel becomes free within the 128 µs.
TEST_F(CsmaCa802154Test, InetLooksAtTheEndOfTheAssessment) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    jam(jammer, us(100));
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.at(1).start, cca + turnaround);
}

TEST_F(CsmaCa802154Test, TheWholeWindowCanBeAskedFor) {
    CsmaConfig config = without_backoff();
    config.cca_whole_window = true;
    Device& sender = add_device({0, 0, 0}, config);
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    jam(jammer, us(100));
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.at(1).start, cca * 2 + turnaround);
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
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::queue_overflow), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 1U);
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageFate::sent), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 0U);
}

}  // namespace
}  // namespace netsim
