#include "netsim/phy/radio.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "support/radio_among_senders.hpp"

namespace netsim {
namespace {

using test::BareRadio;
using test::RadioEvent;
using test::RadioWord;
using test::strong_w;
using test::us;

using RadioTest = test::RadioAmongSenders;

TEST_F(RadioTest, ReceivesAFrame) {
    BareRadio& receiver = add_receiver();
    BareRadio& sender = add_sender(strong_w);
    arrives(sender, us(10), us(100));
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{sender.id()});
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::delivered), 1U);
}

TEST_F(RadioTest, ReportsTheFrameBeforeTheChannelIsFree) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(strong_w), us(10), us(100));
    air.run();
    EXPECT_EQ(receiver.log.events,
              (std::vector<RadioEvent>{
                  {RadioWord::busy, us(10)}, {RadioWord::received, us(110)}, {RadioWord::free, us(110)}}));
}

TEST_F(RadioTest, ItsOwnFrameMakesItsChannelBusy) {
    BareRadio& sender = add_sender(strong_w);
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_EQ(sender.log.events,
              (std::vector<RadioEvent>{
                  {RadioWord::busy, us(10)}, {RadioWord::sent, us(110)}, {RadioWord::free, us(110)}}));
}

TEST_F(RadioTest, SaysWhatItIsDoing) {
    BareRadio& receiver = add_receiver();
    BareRadio& sender = add_sender(strong_w);
    arrives(sender, us(10), us(100));
    air.run(us(50));
    EXPECT_TRUE(sender.radio.is_transmitting());
    EXPECT_FALSE(sender.radio.is_receiving());
    EXPECT_TRUE(receiver.radio.is_receiving());
    EXPECT_FALSE(receiver.radio.is_transmitting());
    air.run(us(200));
    EXPECT_FALSE(sender.radio.is_transmitting());
    EXPECT_FALSE(receiver.radio.is_receiving());
}

TEST_F(RadioTest, SensitivityIsTheLeastPowerItLocksOnTo) {
    RadioConfig config;
    config.sensitivity_w = strong_w * 1.001;
    BareRadio& deaf = add_receiver(config);
    config.sensitivity_w = strong_w * 0.999;
    BareRadio& keen = air.add_radio({0, 0, 0}, config);
    arrives(add_sender(strong_w), us(10), us(100));
    air.run();
    EXPECT_TRUE(deaf.log.received_from.empty());
    EXPECT_EQ(keen.log.received_from.size(), 1U);
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::below_sensitivity), 1U);
}

TEST_F(RadioTest, EnergyMakesTheChannelBusyWithoutALock) {
    RadioConfig config;
    config.sensitivity_w = strong_w * 2;
    config.energy_detection_w = strong_w / 2;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(strong_w), us(10), us(100));
    air.run();
    EXPECT_EQ(receiver.log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(10)}, {RadioWord::free, us(110)}}));
}

TEST_F(RadioTest, ALockMakesTheChannelBusyBelowEnergyDetection) {
    RadioConfig config;
    config.energy_detection_w = strong_w * 2;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(strong_w), us(10), us(100));
    air.run();
    EXPECT_EQ(receiver.log.times_of(RadioWord::busy), std::vector{us(10)});
    EXPECT_EQ(receiver.log.times_of(RadioWord::free), std::vector{us(110)});
}

TEST_F(RadioTest, BackgroundNoiseCountsTowardsEnergyDetection) {
    RadioConfig config;
    config.sensitivity_w = 1;
    config.energy_detection_w = strong_w + 0.5 * MediumConfig().background_noise_w;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(strong_w), us(10), us(100));
    air.run(us(50));
    EXPECT_TRUE(receiver.radio.is_channel_busy());
}

TEST_F(RadioTest, WhatStartsWhileItTransmitsIsNotReceived) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(strong_w), us(10), us(100));
    air.at(us(5), [&] { receiver.send(us(10)); });
    air.run();
    EXPECT_TRUE(receiver.log.received_from.empty());
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::receiver_transmitting), 1U);
}

TEST_F(RadioTest, WhatStartsWhileItTransmitsKeepsTheChannelBusy) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(strong_w), us(10), us(100));
    air.at(us(5), [&] { receiver.send(us(10)); });
    air.run();
    EXPECT_EQ(receiver.log.times_of(RadioWord::busy), std::vector{us(5)});
    EXPECT_EQ(receiver.log.times_of(RadioWord::free), std::vector{us(110)});
}

TEST_F(RadioTest, StartingToTransmitGivesUpAReception) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(strong_w), us(10), us(100));
    air.at(us(50), [&] { receiver.send(us(10)); });
    air.run();
    EXPECT_TRUE(receiver.log.received_from.empty());
    EXPECT_TRUE(receiver.log.times_of(RadioWord::corrupted).empty());
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::receiver_transmitting), 1U);
}

TEST_F(RadioTest, LocksAgainAfterItsOwnFrame) {
    BareRadio& receiver = add_receiver();
    BareRadio& sender = add_sender(strong_w);
    air.at(us(5), [&] { receiver.send(us(10)); });
    arrives(sender, us(15), us(100));
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{sender.id()});
}

TEST_F(RadioTest, AStrongerLaterFrameDoesNotCapture) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(strong_w), us(10), us(100));
    arrives(add_sender(1000 * strong_w), us(20), us(100));
    air.run();
    EXPECT_TRUE(receiver.log.received_from.empty());
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::interference), 1U);
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::receiver_locked), 1U);
    EXPECT_EQ(receiver.log.times_of(RadioWord::corrupted), std::vector{us(110)});
}

TEST_F(RadioTest, AFarWeakerLaterFrameDoesNoHarm) {
    BareRadio& receiver = add_receiver();
    BareRadio& strong = add_sender(1000 * strong_w);
    arrives(strong, us(10), us(100));
    arrives(add_sender(strong_w), us(20), us(100));
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{strong.id()});
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::receiver_locked), 1U);
}

TEST_F(RadioTest, WhatBeganDuringALockIsNotReceivedAfterIt) {
    BareRadio& receiver = add_receiver();
    arrives(add_sender(1000 * strong_w), us(10), us(20));
    arrives(add_sender(strong_w), us(20), us(100));
    air.run();
    EXPECT_EQ(receiver.log.received_from.size(), 1U);
    EXPECT_EQ(receiver.log.times_of(RadioWord::free), std::vector{us(120)});
}

TEST_F(RadioTest, OfSimultaneousFramesTheNearestTakesTheLock) {
    BareRadio& receiver = add_receiver();
    BareRadio& far = air.add_radio({500, 0, 0}, test::radio_of_power(test::power_for(strong_w, 500)));
    BareRadio& near = air.add_radio({0, 10, 0}, test::radio_of_power(test::power_for(100 * strong_w, 10)));
    air.at(us(10), [&] {
        far.send(us(100));
        near.send(us(100));
    });
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{near.id()});
}

TEST_F(RadioTest, OfSimultaneousArrivalsTheFirstSentTakesTheLock) {
    BareRadio& receiver = add_receiver();
    BareRadio& one = add_sender(strong_w);
    BareRadio& other = add_sender(strong_w / 100);
    air.at(us(10), [&] {
        one.send(us(100));
        other.send(us(100));
    });
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{one.id()});
}

TEST_F(RadioTest, ReceivesAFrameThatStartsAsAnotherEnds) {
    BareRadio& receiver = add_receiver();
    BareRadio& first = add_sender(1000 * strong_w);
    BareRadio& second = add_sender(strong_w);
    arrives(first, us(10), us(100));
    arrives(second, us(110), us(100));
    air.run();
    EXPECT_EQ(receiver.log.received_from, (std::vector{first.id(), second.id()}));
}

TEST_F(RadioTest, TheThresholdItselfIsNotEnough) {
    const double received_w = 0.01 * make_path_loss(MediumConfig()).gain(100, RadioConfig().carrier_hz);
    RadioConfig config;
    config.snir_threshold = received_w / MediumConfig().background_noise_w;
    BareRadio& at_threshold = add_receiver(config);
    config.snir_threshold *= 1 - 1e-12;
    BareRadio& above_threshold = air.add_radio({0, 0, 0}, config);
    BareRadio& sender = air.add_radio({100, 0, 0}, test::radio_of_power(0.01));
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_EQ(air.broadcast_count_at(at_threshold, FrameOutcome::noise), 1U);
    EXPECT_EQ(air.broadcast_count_at(above_threshold, FrameOutcome::delivered), 1U);
}

TEST_F(RadioTest, WhatNoiseAloneWouldHaveLostIsLostToNoise) {
    RadioConfig config;
    config.snir_threshold = 2 * strong_w / MediumConfig().background_noise_w;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(strong_w), us(10), us(100));
    arrives(add_sender(strong_w), us(20), us(100));
    air.run();
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::noise), 1U);
    EXPECT_TRUE(air.frame_outcomes.interferers_at(receiver.id()).empty());
}

// Then the MAC need not ask for energy that makes the channel busy only together.
TEST_F(RadioTest, SaysOfACorruptedFrameWhetherTheOthersAreWeak) {
    RadioConfig config;
    config.snir_threshold = 2 * strong_w / MediumConfig().background_noise_w;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(strong_w), us(10), us(100));
    arrives(add_sender(strong_w), us(1010), us(100));
    arrives(add_sender(strong_w), us(1020), us(100));
    air.run();
    ASSERT_EQ(receiver.log.corrupted.size(), 2U);
    EXPECT_TRUE(receiver.log.corrupted[0].others_are_weak);
    EXPECT_FALSE(receiver.log.corrupted[1].others_are_weak);
}

TEST_F(RadioTest, ItsOwnEarlierFrameIsNoInterference) {
    BareRadio& receiver = add_receiver();
    BareRadio& sender = add_sender(strong_w);
    air.at(us(5), [&] { receiver.send(us(10)); });
    arrives(sender, us(15), us(100));
    air.run();
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::delivered), 1U);
}

TEST_F(RadioTest, AnotherChannelIsSilent) {
    RadioConfig config;
    config.carrier_hz = 2.437e9;
    BareRadio& receiver = add_receiver(config);
    arrives(add_sender(1), us(10), us(100));
    air.run();
    EXPECT_TRUE(receiver.log.events.empty());
    EXPECT_EQ(air.frame_outcomes.copies(FrameKind::broadcast, false), 0U);
}

TEST_F(RadioTest, AnotherChannelDoesNotInterfere) {
    BareRadio& receiver = add_receiver();
    BareRadio& sender = add_sender(strong_w);
    RadioConfig elsewhere = test::radio_of_power(1);
    elsewhere.carrier_hz = 2.437e9;
    BareRadio& loud = air.add_radio({1, 0, 0}, elsewhere);
    arrives(sender, us(10), us(100));
    air.at(us(20), [&] { loud.send(us(50)); });
    air.run();
    EXPECT_EQ(receiver.log.received_from, std::vector{sender.id()});
}

TEST_F(RadioTest, ASignalMustFitIntoTheBandwidth) {
    RadioConfig narrow = RadioConfig();
    narrow.bandwidth_hz = 20e6;
    BareRadio& narrow_receiver = add_receiver(narrow);
    BareRadio& wide_receiver = add_receiver();
    RadioConfig sender_config = test::radio_of_power(0.02);
    BareRadio& wide_sender = air.add_radio({100, 0, 0}, sender_config);
    sender_config.bandwidth_hz = 20e6;
    BareRadio& narrow_sender = air.add_radio({100, 0, 0}, sender_config);
    air.at(us(10), [&] { wide_sender.send(us(100)); });
    air.at(us(500), [&] { narrow_sender.send(us(100)); });
    air.run();
    EXPECT_EQ(narrow_receiver.log.received_from, std::vector{narrow_sender.id()});
    EXPECT_EQ(wide_receiver.log.received_from, (std::vector{wide_sender.id(), narrow_sender.id()}));
}

using RadioDeathTest = RadioTest;

TEST_F(RadioDeathTest, TransmittingTwiceAtOnceIsAnInternalError) {
    BareRadio& sender = add_sender(strong_w);
    sender.send(us(100));
    EXPECT_DEATH(sender.send(us(100)), "internal error");
}

}  // namespace
}  // namespace netsim
