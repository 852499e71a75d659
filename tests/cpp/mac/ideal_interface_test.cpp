#include "netsim/mac/ideal_interface.hpp"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

using test::Recorder;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

class UnitDisk : public testing::Test {
protected:
    Recorder& add_node(Position position, double range_m = 100) {
        NodeConfig config("node");
        config.initial_position = position;
        config.wlan[0].radio.communication_range_m = range_m;
        config.mobility.telemetry_interval_s = 0;
        return test::add_recorder(network, config);
    }
    void run(double seconds = 1) {
        network.initialize();
        network.run_until(s(seconds));
    }
    std::uint64_t message_count(MessageKind kind, MessageOutcome outcome) const {
        return network.message_outcomes().counts(kind)[static_cast<std::size_t>(outcome)];
    }

    Network network{MediumConfig(std::string(unit_disk_medium)), 1};
};

TEST_F(UnitDisk, DeliversInTheInstantOfSending) {
    Recorder& sender = add_node({0, 0, 0});
    const Recorder& receiver = add_node({50, 0, 0});
    sender.on_initialize = [](Recorder& self) { self.node.schedule_timer("send", s(0.25)); };
    sender.on_timer = [](Recorder& self, const std::string&) { self.broadcast("text"); };
    run();
    EXPECT_EQ(receiver.packets, (std::vector<Recorder::Told>{{s(0.25), "text"}}));
}

TEST_F(UnitDisk, TheRangeIsInclusive) {
    Recorder& sender = add_node({0, 0, 0});
    const Recorder& at_range = add_node({0, 60, 80});
    const Recorder& beyond = add_node({100.000001, 0, 0});
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    run();
    EXPECT_EQ(at_range.packets.size(), 1U);
    EXPECT_TRUE(beyond.packets.empty());
}

TEST_F(UnitDisk, TheRangeIsThatOfTheSender) {
    Recorder& far_reaching = add_node({0, 0, 0}, 1000);
    Recorder& near_reaching = add_node({500, 0, 0}, 10);
    far_reaching.on_initialize = [](Recorder& self) { self.broadcast("from afar"); };
    near_reaching.on_initialize = [](Recorder& self) { self.broadcast("whisper"); };
    run();
    EXPECT_EQ(near_reaching.packet_texts(), std::vector<std::string>{"from afar"});
    EXPECT_TRUE(far_reaching.packets.empty());
}

TEST_F(UnitDisk, TheRangeIsJudgedAtSending) {
    Recorder& sender = add_node({0, 0, 0});
    Recorder& leaving = add_node({99, 0, 0});
    leaving.on_initialize = [](Recorder& self) {
        self.node.set_speed(10);
        self.node.go_to({1000, 0, 0});
    };
    sender.on_initialize = [](Recorder& self) {
        self.node.schedule_timer("in reach", s(0.1));
        self.node.schedule_timer("out of reach", s(0.2));
    };
    sender.on_timer = [](Recorder& self, const std::string& timer) { self.broadcast(timer); };
    run();
    EXPECT_EQ(leaving.packet_texts(), std::vector<std::string>{"in reach"});
}

TEST_F(UnitDisk, DeliversInTheOrderOfNodeIds) {
    std::vector<NodeId> order;
    Recorder& sender = add_node({0, 0, 0});
    for (const double x : {50.0, 10.0, 30.0}) {
        add_node({x, 0, 0}).on_packet = [&order](Recorder& self, const std::string&) {
            order.push_back(self.node.id());
        };
    }
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    run();
    EXPECT_EQ(order, (std::vector<NodeId>{1, 2, 3}));
}

TEST_F(UnitDisk, DeliversMessagesInTheOrderOfSending) {
    Recorder& sender = add_node({0, 0, 0});
    const Recorder& receiver = add_node({10, 0, 0});
    sender.on_initialize = [](Recorder& self) {
        self.broadcast("one");
        self.send(1, "two");
        self.broadcast("three");
    };
    run();
    EXPECT_EQ(receiver.packet_texts(), (std::vector<std::string>{"one", "two", "three"}));
}

TEST_F(UnitDisk, AUnicastIsOnlyForItsReceiver) {
    Recorder& sender = add_node({0, 0, 0});
    const Recorder& other = add_node({10, 0, 0});
    const Recorder& receiver = add_node({20, 0, 0});
    sender.on_initialize = [](Recorder& self) { self.send(2, "text"); };
    run();
    EXPECT_TRUE(other.packets.empty());
    EXPECT_EQ(receiver.packet_texts(), std::vector<std::string>{"text"});
    EXPECT_EQ(message_count(MessageKind::unicast, MessageOutcome::acknowledged), 1U);
}

TEST_F(UnitDisk, AUnicastThatDoesNotReachIsOutOfRange) {
    Recorder& sender = add_node({0, 0, 0});
    add_node({1000, 0, 0});
    sender.on_initialize = [](Recorder& self) { self.send(1, "text"); };
    run();
    EXPECT_EQ(message_count(MessageKind::unicast, MessageOutcome::out_of_range), 1U);
}

TEST_F(UnitDisk, AnswersWithinAnInstantComeAfterTheDeliveriesThatWereDue) {
    std::vector<std::string> order;
    const auto note = [&order](Recorder& self, const std::string& text) {
        order.push_back(std::to_string(self.node.id()) + " got " + text);
        if (text == "question") {
            self.send(0, "answer of " + std::to_string(self.node.id()));
        }
    };
    Recorder& sender = add_node({0, 0, 0});
    sender.on_packet = note;
    add_node({10, 0, 0}).on_packet = note;
    add_node({20, 0, 0}).on_packet = note;
    sender.on_initialize = [](Recorder& self) { self.broadcast("question"); };
    run();
    EXPECT_EQ(order, (std::vector<std::string>{"1 got question", "2 got question", "0 got answer of 1",
                                               "0 got answer of 2"}));
}

TEST_F(UnitDisk, KeepsBooks) {
    Recorder& sender = add_node({0, 0, 0});
    add_node({10, 0, 0});
    add_node({1000, 0, 0});
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    run();
    const auto counts = network.frame_outcomes().counts(FrameKind::broadcast, false);
    EXPECT_EQ(network.frame_outcomes().copies(FrameKind::broadcast, false), 2U);
    EXPECT_EQ(counts[static_cast<std::size_t>(FrameOutcome::delivered)], 1U);
    EXPECT_EQ(counts[static_cast<std::size_t>(FrameOutcome::below_sensitivity)], 1U);
    EXPECT_EQ(message_count(MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST_F(UnitDisk, NeedsARange) {
    EXPECT_THROW(add_node({0, 0, 0}, 0), ConfigError);
}

TEST_F(UnitDisk, MessagesThatAnswerEachOtherWithoutEndAreAnError) {
    const auto answer = [](Recorder& self, const std::string& text) { self.broadcast(text); };
    Recorder& first = add_node({0, 0, 0});
    first.on_packet = answer;
    add_node({50, 0, 0}).on_packet = answer;
    first.on_initialize = [](Recorder& self) { self.broadcast("ping"); };
    try {
        run();
        FAIL() << "the run ended";
    } catch (const SimulationError& error) {
        EXPECT_STREQ(error.what(),
                     "node 0 has sent 1000000 messages at 0.000000 s on a medium without delay: "
                     "time stands still; expected answers that end");
    }
}

MediumConfig unit_disk_with(std::string_view timing) {
    MediumConfig config{std::string(unit_disk_medium)};
    config.timing = timing;
    return config;
}

class UnitDiskWithTime : public testing::Test {
protected:
    explicit UnitDiskWithTime(std::string_view timing) : network(unit_disk_with(timing), 1) {}

    Recorder& add_node(double x, int queue_capacity = 100) {
        NodeConfig config("node");
        config.initial_position = {x, 0, 0};
        config.wlan[0].radio.communication_range_m = 1000;
        config.wlan[0].mac.queue_capacity = queue_capacity;
        config.mobility.telemetry_interval_s = 0;
        return test::add_recorder(network, config);
    }
    void run() {
        network.initialize();
        network.run_until(s(1));
    }
    // Of the frame of a message of 100 B at 24 Mbps: ⌈(16 + 8 · 164 + 6) / 96⌉ = 14 symbols of 4 µs.
    static constexpr SimTime airtime = SimTime::from_us(20 + 14 * 4 + 6);
    const std::string text = std::string(100, 'x');

    Network network;
};

class UnitDiskWithAirtime : public UnitDiskWithTime {
protected:
    UnitDiskWithAirtime() : UnitDiskWithTime("airtime") {}
};

TEST_F(UnitDiskWithAirtime, DeliversAfterTheFrameAndItsWay) {
    Recorder& sender = add_node(0);
    const Recorder& receiver = add_node(299.792458);
    sender.on_initialize = [this](Recorder& self) { self.broadcast(text); };
    run();
    ASSERT_EQ(receiver.packets.size(), 1U);
    EXPECT_EQ(receiver.packets[0].time, airtime + SimTime::from_us(1));
}

TEST_F(UnitDiskWithAirtime, FramesOfOneSenderOverlap) {
    Recorder& sender = add_node(0);
    const Recorder& receiver = add_node(299.792458);
    sender.on_initialize = [this](Recorder& self) {
        self.broadcast(text);
        self.broadcast(text);
    };
    run();
    ASSERT_EQ(receiver.packets.size(), 2U);
    EXPECT_EQ(receiver.packets[0].time, receiver.packets[1].time);
}

class UnitDiskWithAccess : public UnitDiskWithTime {
protected:
    UnitDiskWithAccess() : UnitDiskWithTime("channelAccess") {}

    static constexpr SimTime difs = SimTime::from_us(50);
};

TEST_F(UnitDiskWithAccess, SendersInRangeTakeTurns) {
    const auto send_two = [this](Recorder& self) {
        self.broadcast(text + std::to_string(self.node.id()));
        self.broadcast(text + std::to_string(self.node.id()));
    };
    add_node(0).on_initialize = send_two;
    add_node(0).on_initialize = send_two;
    const Recorder& receiver = add_node(0);
    run();
    std::string senders;
    for (const Recorder::Told& packet : receiver.packets) {
        senders += packet.text.back();
    }
    EXPECT_EQ(senders, "0101");
    EXPECT_EQ(receiver.packets[1].time - receiver.packets[0].time, airtime + difs);
}

TEST_F(UnitDiskWithAccess, HiddenSendersDoNotCollide) {
    const auto send = [this](Recorder& self) { self.broadcast(text); };
    add_node(-900).on_initialize = send;
    const Recorder& between = add_node(0);
    add_node(900).on_initialize = send;
    run();
    EXPECT_EQ(between.packets.size(), 2U);
    EXPECT_LT(between.packets[1].time, airtime * 2);
}

TEST_F(UnitDiskWithAccess, AnAcknowledgedFrameOccupiesTheChannelUntilItsAckHasEnded) {
    Recorder& sender = add_node(0);
    const Recorder& receiver = add_node(0);
    sender.on_initialize = [this](Recorder& self) {
        self.send(1, text);
        self.send(1, text);
    };
    run();
    // SIFS, and 14 B at 24 Mbps: 2 symbols.
    const SimTime response = SimTime::from_us(10 + 20 + 2 * 4 + 6);
    EXPECT_EQ(receiver.packets[1].time - receiver.packets[0].time, airtime + response + difs);
}

TEST_F(UnitDiskWithAccess, WhatDoesNotFitIntoTheQueueIsDropped) {
    Recorder& sender = add_node(0, 2);
    const Recorder& receiver = add_node(0);
    sender.on_initialize = [this](Recorder& self) {
        for (int i = 0; i < 5; ++i) {
            self.broadcast(text);
        }
    };
    run();
    EXPECT_EQ(receiver.packets.size(), 2U);
    const auto counts = network.message_outcomes().counts(MessageKind::broadcast);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageOutcome::queue_overflow)], 3U);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageOutcome::sent)], 2U);
}

class UnitDiskWithAloha : public UnitDiskWithTime {
protected:
    UnitDiskWithAloha() : UnitDiskWithTime("aloha") {}

    std::uint64_t lost(FrameOutcome outcome) const {
        return network.frame_outcomes().counts(FrameKind::broadcast,
                                               false)[static_cast<std::size_t>(outcome)];
    }
};

TEST_F(UnitDiskWithAloha, FramesThatOverlapAreLost) {
    const auto send = [this](Recorder& self) { self.broadcast(text); };
    add_node(-900).on_initialize = send;
    const Recorder& between = add_node(0);
    add_node(900).on_initialize = send;
    run();
    EXPECT_TRUE(between.packets.empty());
    EXPECT_EQ(lost(FrameOutcome::interference), 2U);
    EXPECT_EQ(network.frame_outcomes().interferers_at(1), (std::map<NodeId, std::uint64_t>{{0, 1}, {2, 1}}));
}

TEST_F(UnitDiskWithAloha, ANodeThatSendsReceivesNothing) {
    const auto send = [this](Recorder& self) { self.broadcast(text); };
    Recorder& first = add_node(0);
    first.on_initialize = send;
    add_node(0).on_initialize = send;
    run();
    EXPECT_TRUE(first.packets.empty());
    EXPECT_EQ(lost(FrameOutcome::receiver_transmitting), 2U);
}

TEST_F(UnitDiskWithAloha, FramesOfOneSenderFollowEachOther) {
    Recorder& sender = add_node(0);
    const Recorder& receiver = add_node(0);
    sender.on_initialize = [this](Recorder& self) {
        self.broadcast(text);
        self.broadcast(text);
    };
    run();
    ASSERT_EQ(receiver.packets.size(), 2U);
    EXPECT_GE(receiver.packets[1].time - receiver.packets[0].time, airtime);
}

TEST_F(UnitDiskWithAloha, ALostUnicastIsSentAgainAfterARandomDelay) {
    const auto send = [this](Recorder& self) { self.send(1, text); };
    add_node(-900).on_initialize = send;
    const Recorder& between = add_node(0);
    add_node(900).on_initialize = send;
    run();
    EXPECT_EQ(between.packets.size(), 2U);
    const auto counts = network.message_outcomes().counts(MessageKind::unicast);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageOutcome::acknowledged)], 2U);
    EXPECT_GT(network.frame_outcomes().frames(FrameKind::unicast), 2U);
}

MediumConfig scalar_with(std::string_view timing) {
    MediumConfig config;
    config.timing = timing;
    return config;
}

// -85 dBm, the sensitivity, at 100 m.
constexpr double power_for_100_m_w = 0.00032;

class IdealRadios : public testing::Test {
protected:
    static NodeConfig config_at(double x) {
        NodeConfig config("node");
        config.initial_position = {x, 0, 0};
        config.wlan[0].radio.tx_power_w = power_for_100_m_w;
        config.mobility.telemetry_interval_s = 0;
        return config;
    }
    static void run(Network& network) {
        network.initialize();
        network.run_until(s(1));
    }
    static std::uint64_t count(const Network& network, FrameKind kind, FrameOutcome outcome) {
        return network.frame_outcomes().counts(kind, false)[static_cast<std::size_t>(outcome)];
    }
    const std::string text = std::string(100, 'x');
};

TEST_F(IdealRadios, PowerDecidesWhatArrives) {
    for (const std::string_view timing : {"instant", "airtime", "channelAccess"}) {
        Network network{scalar_with(timing), 1};
        Recorder& sender = test::add_recorder(network, config_at(0));
        const Recorder& near = test::add_recorder(network, config_at(95));
        const Recorder& far = test::add_recorder(network, config_at(105));
        sender.on_initialize = [this](Recorder& self) { self.broadcast(text); };
        run(network);
        EXPECT_EQ(near.packets.size(), 1U) << timing;
        EXPECT_TRUE(far.packets.empty()) << timing;
        EXPECT_EQ(count(network, FrameKind::broadcast, FrameOutcome::below_sensitivity), 1U) << timing;
    }
}

TEST_F(IdealRadios, FramesDoNotCollide) {
    Network network{scalar_with("channelAccess"), 1};
    const auto send = [this](Recorder& self) { self.broadcast(text); };
    test::add_recorder(network, config_at(-90)).on_initialize = send;
    const Recorder& between = test::add_recorder(network, config_at(0));
    test::add_recorder(network, config_at(90)).on_initialize = send;
    run(network);
    EXPECT_EQ(between.packets.size(), 2U);
}

TEST_F(IdealRadios, WithAlohaTheStrongerFrameSurvives) {
    Network network{scalar_with("aloha"), 1};
    const auto send = [this](Recorder& self) { self.broadcast(text + std::to_string(self.node.id())); };
    test::add_recorder(network, config_at(-10)).on_initialize = send;
    const Recorder& between = test::add_recorder(network, config_at(0));
    test::add_recorder(network, config_at(90)).on_initialize = send;
    run(network);
    ASSERT_EQ(between.packets.size(), 1U);
    EXPECT_EQ(between.packets[0].text.back(), '0');
    EXPECT_EQ(count(network, FrameKind::broadcast, FrameOutcome::interference), 1U);
}

TEST_F(IdealRadios, WhatNoiseDestroysIsSentAgain) {
    MediumConfig noisy = scalar_with("channelAccess");
    noisy.background_noise_w = 1.8e-13;  // 12.5 dB below the frame: some frames at 24 Mbps are lost
    Network network{noisy, 1};
    Recorder& sender = test::add_recorder(network, config_at(0));
    const Recorder& receiver = test::add_recorder(network, config_at(99));
    sender.on_initialize = [this](Recorder& self) {
        for (int i = 0; i < 50; ++i) {
            self.send(1, text);
        }
    };
    run(network);
    EXPECT_EQ(receiver.packets.size(), 50U);
    EXPECT_GT(count(network, FrameKind::unicast, FrameOutcome::noise), 0U);
    EXPECT_EQ(network.frame_outcomes().frames(FrameKind::unicast),
              50 + count(network, FrameKind::unicast, FrameOutcome::noise));
}

TEST_F(IdealRadios, AfterTheRetryLimitAMessageIsGivenUp) {
    MediumConfig noisy = scalar_with("airtime");
    noisy.background_noise_w = 1e-12;
    Network network{noisy, 1};
    NodeConfig config = config_at(0);
    config.wlan[0].radio.energy_detection_w = 1e-11;
    Recorder& sender = test::add_recorder(network, config);
    config.initial_position.x = 99;
    test::add_recorder(network, config);
    sender.on_initialize = [this](Recorder& self) { self.send(1, text); };
    run(network);
    EXPECT_EQ(network.frame_outcomes().frames(FrameKind::unicast), 7U);
    const auto counts = network.message_outcomes().counts(MessageKind::unicast);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageOutcome::retry_limit)], 1U);
}

TEST_F(IdealRadios, EachChannelIsApart) {
    Network network{scalar_with("channelAccess"), 1};
    Recorder& sender = test::add_recorder(network, config_at(0));
    NodeConfig other = config_at(10);
    other.wlan[0].radio.carrier_hz = 2.462e9;
    const Recorder& elsewhere = test::add_recorder(network, other);
    sender.on_initialize = [this](Recorder& self) { self.broadcast(text); };
    run(network);
    EXPECT_TRUE(elsewhere.packets.empty());
    EXPECT_EQ(network.frame_outcomes().copies(FrameKind::broadcast, false), 0U);
}

// With no noise and no interference, radios receive what the real MAC and medium deliver.
TEST_F(IdealRadios, ReceivesAloneWhatTheRealMacReceives) {
    std::vector<std::vector<std::size_t>> received;
    for (const std::string_view timing : {"mac", "channelAccess"}) {
        Network network{scalar_with(timing), 1};
        std::vector<const Recorder*> receivers;
        Recorder& sender = test::add_recorder(network, config_at(0));
        for (int i = 1; i <= 20; ++i) {
            receivers.push_back(&test::add_recorder(network, config_at(7.3 * i)));
        }
        sender.on_initialize = [this](Recorder& self) { self.broadcast(text); };
        run(network);
        received.emplace_back();
        for (const Recorder* receiver : receivers) {
            received.back().push_back(receiver->packets.size());
        }
    }
    EXPECT_EQ(received[0], received[1]);
}

TEST(IdealMedium, AUnitDiskHasNoMac) {
    EXPECT_THROW(Network(unit_disk_with("mac"), 1), ConfigError);
}

TEST(IdealMedium, FramesWithoutAMacCannotBeCaptured) {
    Network network{scalar_with("airtime"), 1};
    test::add_recorder(network, NodeConfig("node"));
    EXPECT_THROW(network.capture(0, "unused.pcap"), ConfigError);
}

}  // namespace
}  // namespace netsim
