// Delays of messages from the send command to the receiving protocol: Network::message_delays.
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "support/dcf_instants.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::data_duration;
using test::difs;
using test::light_microsecond_m;
using test::Recorder;
using test::sifs;
using test::silent_node;
using test::us;

constexpr std::array both_kinds{MessageKind::broadcast, MessageKind::unicast};

// Three nodes, a light-microsecond from one to the next; after a second, the first one sends.
class DelaysOnAFreeChannel : public testing::Test {
protected:
    void run(const std::function<void(Recorder&)>& send) {
        for (int number = 0; number < 3; ++number) {
            NodeConfig config = silent_node({number * light_microsecond_m, 0, 0});
            config.wlan[0].mac = test::without_backoff();
            config.wlan[0].mac.bitrate_bps = 24e6;
            Recorder& recorder = test::add_recorder(network, config);
            if (number == 0) {
                recorder.on_initialize = [](Recorder& self) {
                    self.node.schedule_timer("send", SimTime::from_seconds(1));
                };
                recorder.on_timer = [send](Recorder& self, const std::string&) { send(self); };
            }
        }
        network.initialize();
        network.run_until(SimTime::from_seconds(2));
    }
    const DelayHistogram& of(MessageKind kind) const { return network.message_delays().of(kind); }

    Network network{MediumConfig(), 1};
    const SimTime flight = us(1);
    const std::string text = std::string(100, 'x');
};

TEST_F(DelaysOnAFreeChannel, ABroadcastHasOneForEachReceiver) {
    run([this](Recorder& self) { self.broadcast(text); });
    EXPECT_EQ(of(MessageKind::broadcast).count(), 2U);
    EXPECT_EQ(of(MessageKind::broadcast).min(), data_duration + flight);
    EXPECT_EQ(of(MessageKind::broadcast).max(), data_duration + flight * 2);
}

TEST_F(DelaysOnAFreeChannel, AUnicastHasOneHoweverManyOverhearIt) {
    run([this](Recorder& self) { self.send(1, text); });
    EXPECT_EQ(of(MessageKind::unicast).count(), 1U);
    EXPECT_EQ(of(MessageKind::broadcast).count(), 0U);
}

TEST_F(DelaysOnAFreeChannel, WaitingInTheQueueIsPartOfIt) {
    run([this](Recorder& self) {
        self.send(1, text);
        self.send(1, text);
    });
    const SimTime first = data_duration + flight;
    EXPECT_EQ(of(MessageKind::unicast).min(), first);
    EXPECT_EQ(of(MessageKind::unicast).max(), first + sifs + ack_duration + flight + difs + first);
}

// Five nodes in contention write the sending time into their messages. The delays at receivers are
// the recorded ones, with retries and duplicates, on each medium.
class DelaysInContention : public testing::TestWithParam<std::string_view> {};

TEST_P(DelaysInContention, AreWhatReceiversMeasure) {
    Network network{MediumConfig(std::string(GetParam())), 1};
    std::array<std::vector<SimTime>, message_kind_count> measured;
    for (int number = 0; number < 5; ++number) {
        const bool is_narrowband = GetParam() == ieee802154_scalar_medium;
        NodeConfig config("node", {std::string(is_narrowband ? ieee802154_interface : ieee80211_interface)});
        config.initial_position = {number * 10.0, 0, 0};
        config.mobility.telemetry_interval_s = 0;
        Recorder& recorder = test::add_recorder(network, config);
        recorder.on_initialize = [](Recorder& self) {
            for (int message = 0; message < 40; ++message) {
                self.node.schedule_timer(
                    "send",
                    SimTime::from_us(static_cast<std::int64_t>(self.node.random().uniform() * 200'000)));
            }
        };
        recorder.on_timer = [](Recorder& self, const std::string&) {
            const std::string now = std::to_string(self.node.now().ps());
            const NodeId other = (self.node.id() + 1) % 5;
            self.node.random().uniform() < 0.5 ? self.broadcast("b" + now) : self.send(other, "u" + now);
        };
        recorder.on_packet = [&measured](Recorder& self, const std::string& text) {
            const SimTime sent = SimTime::from_ps(std::stoll(text.substr(1)));
            measured[text[0] == 'b' ? 0 : 1].push_back(self.node.now() - sent);
        };
    }
    network.initialize();
    network.run_until(SimTime::from_seconds(10));
    for (const MessageKind kind : both_kinds) {
        const DelayHistogram& booked = network.message_delays().of(kind);
        const std::vector<SimTime>& expected = measured[static_cast<std::size_t>(kind)];
        ASSERT_GT(expected.size(), 50U);
        double sum_s = 0;
        for (const SimTime delay : expected) {
            sum_s += delay.seconds();
        }
        EXPECT_EQ(booked.count(), expected.size());
        EXPECT_DOUBLE_EQ(booked.sum_s(), sum_s);
        EXPECT_EQ(booked.min(), std::ranges::min(expected));
        EXPECT_EQ(booked.max(), std::ranges::max(expected));
    }
}

INSTANTIATE_TEST_SUITE_P(Media, DelaysInContention, testing::ValuesIn(medium_type_names),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace netsim
