// Backoff and channel assessment of a device.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/csma_ca_802154.hpp"
#include "support/csma_devices.hpp"

namespace netsim {
namespace {

using test::BareRadio;
using test::Sniffer;
using test::us;
using test::csma::ack_duration;
using test::csma::cca;
using test::csma::data_duration;
using test::csma::Device;
using test::csma::period;
using test::csma::sifs;
using test::csma::turnaround;
using test::csma::without_backoff;

using CsmaCa802154BackoffTest = test::csma::CsmaDevices;

// BE is 3, 4, 5, 5, 5 for the five waits of a frame.
TEST_F(CsmaCa802154BackoffTest, WaitsGrowWhileTheChannelIsBusy) {
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
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(CsmaCa802154BackoffTest, AfterTheLastBusyAssessmentAFrameIsGivenUp) {
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
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::channel_access_failure), 0U);
    air.run(fifth);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::channel_access_failure), 1U);
    EXPECT_EQ(sender.csma.queued_messages(), 0U);
}

TEST_F(CsmaCa802154BackoffTest, TheFrameAfterOneGivenUpStartsAfresh) {
    CsmaConfig config = without_backoff();
    Device& sender = add_device({0, 0, 0}, config);
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    jam(jammer, cca * 9 + us(1));  // five assessments of the first frame, four of the second one
    sender.send(broadcast_id, 50);
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::channel_access_failure), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::sent), 1U);
    EXPECT_EQ(sniffer.heard.at(1).start, cca * 10 + turnaround);
}

struct Method {
    const char* name;
    std::vector<std::uint32_t> windows;
};

class BackoffMethod : public test::csma::CsmaDevices, public testing::WithParamInterface<Method> {};

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

TEST_F(CsmaCa802154BackoffTest, TwoThatDrawTheSameNumberSendAtOnce) {
    Device& one = add_device({-30, 0, 0}, without_backoff());
    Device& other = add_device({30, 0, 0}, without_backoff());
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    one.send(broadcast_id, 50);
    other.send(broadcast_id, 50);
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 2U);
    EXPECT_EQ(sniffer.heard[0].start, sniffer.heard[1].start);
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::receiver_transmitting), 2U);
}

TEST_F(CsmaCa802154BackoffTest, WhoDrawsTheLargerNumberHearsTheOther) {
    CsmaConfig later = without_backoff();
    later.backoff_method = "constant";
    later.contention_window = 1;
    Device& first = add_device({-30, 0, 0}, without_backoff());
    Device& second = add_device({30, 0, 0}, later);
    first.send(broadcast_id, 50);
    second.send(broadcast_id, 1);
    // 320 µs + 2976 µs on the air; the second device assesses the channel every 448 µs, five times.
    air.run();
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::channel_access_failure), 1U);
    EXPECT_EQ(messages(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(CsmaCa802154BackoffTest, AWaitIsInterruptedToAnswerAndBeginsAnew) {
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
    EXPECT_EQ(messages(MessageKind::unicast, MessageOutcome::acknowledged), 2U);
}

// The channel becomes free within the 128 µs.
TEST_F(CsmaCa802154BackoffTest, InetLooksAtTheEndOfTheAssessment) {
    Device& sender = add_device({0, 0, 0}, without_backoff());
    BareRadio& jammer = add_jammer({0, 0, 0});
    Sniffer& sniffer = add_sniffer({0, 0, 0});
    jam(jammer, us(100));
    sender.send(broadcast_id, 50);
    air.run();
    EXPECT_EQ(sniffer.heard.at(1).start, cca + turnaround);
}

TEST_F(CsmaCa802154BackoffTest, TheWholeWindowCanBeAskedFor) {
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

}  // namespace
}  // namespace netsim
