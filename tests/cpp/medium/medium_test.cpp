#include "netsim/medium/medium.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/medium/arrival.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;
using test::light_microsecond_m;
using test::Sniffer;
using test::us;

TEST(Medium, ArrivesAfterThePropagationDelay) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    Sniffer& sniffer = air.add_sniffer({0, 3 * light_microsecond_m, 4 * light_microsecond_m});
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    ASSERT_EQ(sniffer.heard.size(), 1U);
    EXPECT_EQ(sniffer.heard[0].start, us(15));
    EXPECT_EQ(sniffer.heard[0].end, us(115));
}

TEST(Medium, ThePropagationDelayIsRoundedToAPicosecond) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    Sniffer& sniffer = air.add_sniffer({100, 0, 0});  // 333 564.095 ps
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_EQ(sniffer.heard.at(0).start, us(10) + SimTime::from_ps(333'564));
    EXPECT_EQ(sniffer.heard.at(0).end, us(110) + SimTime::from_ps(333'564));
}

TEST(Medium, ArrivesWithThePowerAfterPathLoss) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0}, test::radio_of_power(0.02));
    Sniffer& sniffer = air.add_sniffer({50, 0, 0});
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_NEAR(sniffer.heard.at(0).power_w, 7.8264e-10, 1e-14);  // 13.0103 dBm − 74.0747 dB
}

TEST(Medium, EachRadioHasItsOwnSensitivity) {
    Air air;
    constexpr double arriving_w = 24.5e-12;
    BareRadio& sender = air.add_radio({0, 0, 0}, test::radio_of_power(test::power_for(arriving_w, 50)));
    std::vector<std::pair<BareRadio*, double>> receivers;
    for (int sensitivity_pw = 1; sensitivity_pw <= 50; ++sensitivity_pw) {
        RadioConfig config;
        config.sensitivity_w = sensitivity_pw * 1e-12;
        for (const double y_m : {50, -50}) {
            receivers.emplace_back(&air.add_radio({0, y_m, 0}, config), config.sensitivity_w);
        }
    }
    air.at(us(10), [&] { sender.send(us(100)); });
    air.at(us(60), [&] {
        for (const auto& [receiver, sensitivity_w] : receivers) {
            EXPECT_EQ(receiver->radio.is_receiving(), arriving_w > sensitivity_w) << sensitivity_w;
        }
    });
    air.run();
}

// Channels of 22 MHz that are 15 MHz apart overlap by 7 MHz.
RadioConfig three_channels_up(RadioConfig config = RadioConfig()) {
    config.carrier_hz += 15e6;
    return config;
}

TEST(Medium, AShareOfThePowerArrivesOnAnOverlappingChannel) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0}, test::radio_of_power(0.02));
    Sniffer& same = air.add_sniffer({50, 0, 0});
    Sniffer& next = air.add_sniffer({0, 50, 0}, three_channels_up());
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_DOUBLE_EQ(next.heard.at(0).power_w, same.heard.at(0).power_w * 7 / 22);
}

TEST(Medium, AFrameOfAnOverlappingChannelMakesTheChannelBusyAndIsNotReceived) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    BareRadio& receiver = air.add_radio({50, 0, 0}, three_channels_up());
    air.at(us(10), [&] { sender.send(us(100)); });
    air.at(us(60), [&] {
        EXPECT_TRUE(receiver.radio.is_channel_busy());
        EXPECT_FALSE(receiver.radio.is_receiving());
    });
    air.run();
    EXPECT_FALSE(receiver.radio.is_channel_busy());
    EXPECT_EQ(air.frame_outcomes.copies(FrameKind::broadcast, false), 0U);
}

TEST(Medium, AFrameOfAnOverlappingChannelIsInterference) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    BareRadio& receiver = air.add_radio({300, 0, 0});
    BareRadio& disturber = air.add_radio({310, 0, 0}, three_channels_up());
    air.at(us(10), [&] { sender.send(us(100)); });
    air.at(us(50), [&] { disturber.send(us(20)); });
    air.run();
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::interference), 1U);
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver.id()), (std::map<NodeId, std::uint64_t>{{2, 1}}));
}

TEST(Medium, AtDistanceZeroTheFrameArrivesAtOnceWithFullPower) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0}, test::radio_of_power(0.02));
    Sniffer& sniffer = air.add_sniffer({0, 0, 0});
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_EQ(sniffer.heard.at(0).start, us(10));
    EXPECT_DOUBLE_EQ(sniffer.heard.at(0).power_w, 0.02);
}

TEST(Medium, UsesPositionsAtTheStartOfTheTransmission) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    Sniffer& sniffer = air.add_sniffer({light_microsecond_m, 0, 0});
    sender.trajectory.go_to(us(10), {-10 * light_microsecond_m, 0, 0}, 1e6);
    sniffer.trajectory.go_to(us(0), {11 * light_microsecond_m, 0, 0}, light_microsecond_m / 10e-6);
    air.at(us(10), [&] { sender.send(us(1000)); });  // the sniffer is at 2 light microseconds
    air.run();
    EXPECT_EQ(sniffer.heard.at(0).start, us(12));
    EXPECT_EQ(sniffer.heard.at(0).end, us(1012));
}

TEST(Medium, MakesACopyForEveryOtherRadioOfTheBand) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    air.add_radio({10, 0, 0});
    air.add_radio({1e6, 0, 0});
    RadioConfig elsewhere;
    elsewhere.carrier_hz = 2.437e9;
    air.add_radio({10, 0, 0}, elsewhere);
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run();
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::broadcast), 1U);
    EXPECT_EQ(air.frame_outcomes.copies(FrameKind::broadcast, false), 2U);
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::delivered), 1U);
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::below_sensitivity), 1U);
}

TEST(Medium, SeparatesAddresseesFromOverhearers) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    BareRadio& addressee = air.add_radio({10, 0, 0});
    air.add_radio({20, 0, 0});
    air.at(us(10), [&] { sender.send(us(100), FrameLabel{FrameKind::unicast, addressee.id()}); });
    air.run();
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::delivered, false), 1U);
    EXPECT_EQ(air.frame_count(FrameKind::unicast, FrameOutcome::delivered, true), 1U);
}

TEST(Medium, ACopyIsInTheAirUntilItEnds) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    air.add_radio({10, 0, 0});
    air.at(us(10), [&] { sender.send(us(100)); });
    air.run(us(60));
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::in_air), 1U);
    air.run();
    EXPECT_EQ(air.frame_count(FrameKind::broadcast, FrameOutcome::in_air), 0U);
}

TEST(Medium, IrrelevantReceiversCostNoEvent) {
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0});
    for (int i = 0; i < 100; ++i) {
        air.add_radio({1e5 + i, 0, 0});
    }
    sender.send(us(100));
    air.run();
    EXPECT_EQ(air.simulator.event_count(), 1U);  // the end of the transmission
}

// Records the order of notifications of the end of node 2's frames.
class EndListener final : public MediumListener {
public:
    EndListener(int name, std::vector<int>& order) : name_(name), order_(order) {}

    void arrival_started(const Arrival&) override {}
    void arrival_ended(const Arrival& arrival) override {
        if (arrival.transmission->sender.node == 2) {
            order_.push_back(name_);
        }
    }

private:
    int name_;
    std::vector<int>& order_;
};

TEST(Medium, TiesAreBrokenByNodeNotByNotification) {
    Air air;
    std::vector<int> order;
    const Trajectory place({0, 0, 0});
    const Band band{RadioConfig().carrier_hz, RadioConfig().bandwidth_hz};
    EndListener told_later(0, order);
    EndListener told_alone(1, order);
    air.medium.attach(
        air.next_node(),
        Receiver{&told_later, &place, {.band = band, .sensitivity_w = 1, .energy_detection_w = 1e-10}});
    air.medium.attach(
        air.next_node(),
        Receiver{&told_alone, &place, {.band = band, .sensitivity_w = 1, .energy_detection_w = 1e-12}});
    BareRadio& first = air.add_radio({light_microsecond_m, 0, 0},
                                     test::radio_of_power(test::power_for(6e-11, light_microsecond_m)));
    BareRadio& second = air.add_radio({0, light_microsecond_m, 0},
                                      test::radio_of_power(test::power_for(6e-11, light_microsecond_m)));
    ASSERT_EQ(first.id(), 2);
    air.at(us(10), [&] { first.send(us(100)); });
    air.at(us(50), [&] { second.send(us(20)); });
    air.run();
    EXPECT_EQ(order, (std::vector{0, 1}));
}

TEST(Medium, DropsTransmissionsThatCannotMatter) {
    Air air;
    BareRadio& one = air.add_radio({0, 0, 0});
    BareRadio& other = air.add_radio({100, 0, 0});
    BareRadio& third = air.add_radio({0, 100, 0});
    std::size_t most = 0;
    constexpr int rounds = 34'000;  // three frames each; one is always on the air
    for (int round = 0; round < rounds; ++round) {
        for (BareRadio* sender : {&one, &other, &third}) {
            sender->send(us(150));
            air.run(air.simulator.now() + us(100));
            most = std::max(most, air.medium.remembered_count());
        }
    }
    EXPECT_EQ(air.frame_outcomes.frames(FrameKind::broadcast), 3U * rounds);
    EXPECT_LE(most, 4U);
}

TEST(Medium, KeepsAFrameWhileItInterferes) {
    // The interferer ends just after the signal has begun, and many short frames elsewhere come and
    // go meanwhile.
    Air air;
    BareRadio& receiver = air.add_radio({0, 0, 0});
    BareRadio& signal = air.add_radio({200, 0, 0}, test::radio_of_power(test::power_for(4e-12, 200)));
    BareRadio& hidden = air.add_radio({0, 200, 0}, test::radio_of_power(test::power_for(3e-12, 200)));
    BareRadio& elsewhere = air.add_radio({0, 0, 200}, test::radio_of_power(1e-15));
    air.at(us(10), [&] { hidden.send(us(100)); });
    air.at(us(100), [&] { signal.send(us(1000)); });
    for (int i = 0; i < 50; ++i) {
        air.at(us(105 + 15 * i), [&] { elsewhere.send(us(10)); });
    }
    air.run();
    EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::interference), 1U);
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver.id()).begin()->first, hidden.id());
}

}  // namespace
}  // namespace netsim
