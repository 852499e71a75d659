#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/medium/medium.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;
using test::light_microsecond_m;
using test::RadioEvent;
using test::RadioWord;
using test::Station;
using test::us;

std::string name_of(const testing::TestParamInfo<Culling>& given) {
    return std::string(given.param == Culling::disabled ? "everything" : "what_matters");
}

// Two or three signals at one receiver, none of which exceeds its ED threshold alone.
class CumulativeEnergy : public testing::TestWithParam<Culling> {
protected:
    CumulativeEnergy() : air(MediumConfig(), GetParam()) {
        RadioConfig config;
        config.sensitivity_w = 1e-9;
        config.energy_detection_w = 1e-10;
        receiver = &air.add_radio({0, 0, 0}, config);
    }
    BareRadio& add_sender(Position direction, double received_w) {
        return air.add_radio(
            direction * light_microsecond_m,
            test::radio_of_power(test::power_for(received_w, distance({}, direction) * light_microsecond_m)));
    }
    void sends_at(BareRadio& sender, SimTime start, SimTime duration) {
        air.at(start, [&sender, duration] { sender.send(duration); });
    }

    Air air;
    BareRadio* receiver = nullptr;
};

TEST_P(CumulativeEnergy, IsNotDetectedFromOneFrame) {
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({2, 0, 0}, 6e-11), us(200), us(100));
    air.run();
    EXPECT_TRUE(receiver->log.events.empty());
}

TEST_P(CumulativeEnergy, IsDetectedWhereFramesOverlap) {
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({2, 0, 0}, 6e-11), us(60), us(100));
    air.run();
    EXPECT_EQ(receiver->log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(62)}, {RadioWord::free, us(111)}}));
}

TEST_P(CumulativeEnergy, IsDetectedFromSimultaneousTransmissions) {
    BareRadio& near = add_sender({1, 0, 0}, 6e-11);
    BareRadio& far = add_sender({2, 0, 0}, 6e-11);
    sends_at(near, us(10), us(100));
    sends_at(far, us(10), us(100));
    air.run();
    EXPECT_EQ(receiver->log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(12)}, {RadioWord::free, us(111)}}));
}

TEST_P(CumulativeEnergy, IsDetectedIfTheLaterFrameArrivesFirst) {
    sends_at(add_sender({5, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({1, 0, 0}, 6e-11), us(12), us(100));
    air.run();
    EXPECT_EQ(receiver->log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(15)}, {RadioWord::free, us(113)}}));
}

TEST_P(CumulativeEnergy, NeedsEnoughFrames) {
    sends_at(add_sender({1, 0, 0}, 4e-11), us(10), us(100));
    sends_at(add_sender({1, 0, 0}, 4e-11), us(20), us(100));
    sends_at(add_sender({1, 0, 0}, 4e-11), us(30), us(20));
    air.run();
    EXPECT_EQ(receiver->log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(31)}, {RadioWord::free, us(51)}}));
}

TEST_P(CumulativeEnergy, IsNotDetectedWhereFramesOnlyTouch) {
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({1, 0, 0}, 6e-11), us(110), us(100));
    air.run();
    EXPECT_TRUE(receiver->log.events.empty());
}

TEST_P(CumulativeEnergy, KeepsTheChannelBusyAfterTheOwnFrame) {
    sends_at(*receiver, us(10), us(50));
    sends_at(add_sender({1, 0, 0}, 6e-11), us(20), us(100));
    sends_at(add_sender({2, 0, 0}, 6e-11), us(30), us(100));
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), std::vector{us(10)});
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), std::vector{us(121)});
}

TEST_P(CumulativeEnergy, OfSimultaneousFramesIsDetectedAfterTheOwnFrame) {
    sends_at(*receiver, us(10), us(50));
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({2, 0, 0}, 6e-11), us(10), us(100));
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), std::vector{us(10)});
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), std::vector{us(111)});
}

TEST_P(CumulativeEnergy, IsDetectedAtOnceInTheSamePlace) {
    for (int i = 0; i < 3; ++i) {
        BareRadio& sender = air.add_radio({0, 0, 0}, test::radio_of_power(4e-11));
        sends_at(sender, us(10), us(100));
    }
    air.run();
    EXPECT_EQ(receiver->log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(10)}, {RadioWord::free, us(110)}}));
}

TEST_P(CumulativeEnergy, ReportsEachFrameOnce) {
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(300));
    for (int i = 0; i < 3; ++i) {
        sends_at(add_sender({1, 0, 0}, 6e-11), us(50 + 50 * i), us(20));
    }
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), (std::vector{us(51), us(101), us(151)}));
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), (std::vector{us(71), us(121), us(171)}));
}

TEST_P(CumulativeEnergy, KeepsTheChannelBusyAfterAStrongFrame) {
    sends_at(add_sender({1, 0, 0}, 6e-11), us(10), us(100));
    sends_at(add_sender({2, 0, 0}, 6e-11), us(20), us(100));
    sends_at(add_sender({1, 0, 0}, 1e-8), us(50), us(10));
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), std::vector{us(22)});
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), std::vector{us(111)});
}

// Many, so that the evaluation is deferred.
TEST_P(CumulativeEnergy, KeepsTheChannelBusyAfterAStrongFrameWithManyConcurrentOnes) {
    sends_at(add_sender({1, 0, 0}, 1e-8), us(10), us(100));
    for (int i = 1; i <= 8; ++i) {
        sends_at(add_sender({1.0 * i, 0, 0}, 2e-11), us(20 + i), us(100));
    }
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), std::vector{us(11)});
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), std::vector{us(20 + 4 + 4 + 100)});
}

TEST_P(CumulativeEnergy, OfManyIsDetectedIfItArrivesAfterAConcurrentStrongFrame) {
    sends_at(add_sender({1, 0, 0}, 1e-8), us(10), us(10));
    for (int i = 0; i < 8; ++i) {
        sends_at(add_sender({20.0 + i, 0, 0}, 2e-11), us(12), us(100));
    }
    air.run();
    EXPECT_EQ(receiver->log.times_of(RadioWord::busy), (std::vector{us(11), us(36)}));
    EXPECT_EQ(receiver->log.times_of(RadioWord::free), (std::vector{us(21), us(135)}));
}

// Watches its channel from its first frame on, as a station that responds to it.
class WatcherOfItsFrame final : public RadioListener {
public:
    explicit WatcherOfItsFrame(Radio& radio) : radio_(radio) {
        radio_.set_listener(*this);
        radio_.stop_watching_channel();
    }
    bool was_told_it_is_free() const { return was_told_; }
    bool found_it_busy() const { return found_it_busy_; }

private:
    void channel_busy_changed(bool busy) override { was_told_ |= reports_ && !busy; }
    void frame_received(const Transmission&) override {
        reports_ = true;
        radio_.watch_channel(SimTime());
        found_it_busy_ = radio_.is_channel_busy();
        reports_ = false;
    }
    void frame_corrupted(CorruptedFrame) override {}
    void transmission_ended() override {}

    Radio& radio_;
    bool reports_ = false;
    bool was_told_ = false;
    bool found_it_busy_ = false;
};

// The others suffice together, but one of them has not arrived yet.
TEST_P(CumulativeEnergy, DoesNotMakeTheChannelFreeWhileAFrameIsReported) {
    WatcherOfItsFrame watcher(receiver->radio);
    sends_at(add_sender({1, 0, 0}, 5e-9), us(10), us(50));
    sends_at(add_sender({0, 1, 0}, 3.5e-11), us(20), us(400));
    sends_at(add_sender({0, 2, 0}, 3.5e-11), us(21), us(400));
    sends_at(add_sender({0, 30, 0}, 3.5e-11), us(50), us(400));
    air.run();
    EXPECT_TRUE(watcher.found_it_busy());
    EXPECT_FALSE(watcher.was_told_it_is_free());
}

// So near that they arrive without delay, although no two are at the same place, and too weak to
// be detected anywhere.
TEST_P(CumulativeEnergy, OfManyIsDetectedAtTheInstantOfSending) {
    RadioConfig config = test::radio_of_power(1.8e-11);
    config.sensitivity_w = 1e-9;
    config.energy_detection_w = 1e-10;
    std::vector<BareRadio*> senders;
    for (int i = 1; i <= 6; ++i) {
        senders.push_back(&air.add_radio({i * 2e-5, 0, 0}, config));
    }
    bool is_busy = false;
    air.at(us(10), [&] {
        for (BareRadio* sender : senders) {
            sender->send(us(100));
        }
        air.simulator.schedule_at(us(10), [&] { is_busy = receiver->radio.is_channel_busy(); });
    });
    air.run();
    EXPECT_TRUE(is_busy);
}

// A station gets its message at an instant at which something changes. Its channel is busy before
// and after it.
class SimultaneousEnergy : public testing::TestWithParam<Culling> {
protected:
    SimultaneousEnergy() : air(MediumConfig(), GetParam()) {
        RadioConfig config;
        config.sensitivity_w = 1e-9;
        config.energy_detection_w = 1e-10;
        station = &air.add_station({0, 0, 0}, MacConfig(), config);
    }
    // One is not enough, three are.
    void weak_frame(double from_light_us, SimTime start) {
        const double from_m = from_light_us * light_microsecond_m;
        BareRadio& sender =
            air.add_radio({0, from_m, 0}, test::radio_of_power(test::power_for(3.5e-11, from_m)));
        air.at(start, [&sender] { sender.send(us(400)); });
    }
    bool is_sending_at(SimTime time) {
        bool is_sending = false;
        air.at(time, [&] { is_sending = station->radio.is_transmitting(); });
        air.run(time);
        return is_sending;
    }

    Air air;
    Station* station = nullptr;
};

TEST_P(SimultaneousEnergy, IsDetectedByAStationWhoseMessageComesLater) {
    for (const int i : {1, 2, 3}) {
        weak_frame(i, us(100 - i));
    }
    const auto after_them = [this] {
        air.simulator.schedule_at(us(100), [this] { station->send(broadcast_id, 100); });
    };
    air.at(us(99) + SimTime::from_ns(500), after_them);
    EXPECT_FALSE(is_sending_at(us(101)));
}

TEST_P(SimultaneousEnergy, IsDetectedBeforeAStrongFrameBegins) {
    for (const int i : {1, 2, 3, 4}) {
        weak_frame(i, us(50));
    }
    BareRadio& concurrent = air.add_radio({0, 0, 0}, test::radio_of_power(1e-3));
    air.at(us(100), [&concurrent] { concurrent.send(us(30)); });
    air.at(us(100), [this] { station->send(broadcast_id, 100); });
    EXPECT_FALSE(is_sending_at(us(101)));
}

INSTANTIATE_TEST_SUITE_P(CullingModes, CumulativeEnergy, testing::Values(Culling::enabled, Culling::disabled),
                         name_of);

INSTANTIATE_TEST_SUITE_P(CullingModes, SimultaneousEnergy,
                         testing::Values(Culling::enabled, Culling::disabled), name_of);

// The smallest level: it cannot be divided into zones.
TEST(EnergyWithTheLowestThreshold, IsDetected) {
    MediumConfig config;
    config.background_noise_w = 0;
    Air air(config);
    RadioConfig keen;
    keen.energy_detection_w = std::numeric_limits<double>::denorm_min();
    BareRadio& receiver = air.add_radio({0, 0, 0}, keen);
    BareRadio& first = air.add_radio({0, light_microsecond_m, 0}, keen);
    BareRadio& second = air.add_radio({0, 2 * light_microsecond_m, 0}, keen);
    air.at(us(10), [&] { first.send(us(100)); });
    air.at(us(20), [&] { second.send(us(100)); });
    air.run();
    EXPECT_EQ(receiver.log.times_of(RadioWord::busy), std::vector{us(11)});
    EXPECT_EQ(receiver.log.times_of(RadioWord::free), std::vector{us(122)});
}

// With almost no path loss except at the sender's place, a node that leaves it flies along the
// border of detection.
TEST(EnergyAtAZoneBorder, IsDetectedByANodeFlyingAlongIt) {
    MediumConfig config;
    config.alpha = 1e-7;
    Air air(config);
    RadioConfig radio = test::radio_of_power(6e-11);
    radio.sensitivity_w = 1e-9;
    radio.energy_detection_w = 1e-10;
    for (const std::int64_t i : {1, 2}) {
        BareRadio& sender = air.add_radio({0, 0, 0}, radio);
        air.at(us(10 * i), [&sender] { sender.send(us(1000)); });
    }
    int busy_count = 0;
    for (int i = 0; i < 50; ++i) {
        BareRadio& flier = air.add_radio({0, 0, 0}, radio);
        flier.radio.stop_watching_channel();
        air.at(us(30), [&flier] { flier.trajectory.go_to(us(30), {33, 0, 7}, 5620.61); });
        const SimTime now = us(100 + 7 * i);
        air.at(now, [&flier, &busy_count, now] {
            flier.radio.watch_channel(now);
            busy_count += flier.radio.is_channel_busy() ? 1 : 0;
        });
    }
    air.run();
    EXPECT_EQ(busy_count, 50);
}

// Very many simultaneous frames, some of which suffice to make a channel busy.
TEST(EnergyOfVeryManyFrames, IsEvaluatedAFewTimesPerTransmissionAndRadio) {
    Air air;
    RadioConfig config = test::radio_of_power(test::power_for(3e-11, light_microsecond_m));
    config.sensitivity_w = 1e-9;
    config.energy_detection_w = 1e-10;
    constexpr int side = 10;
    std::vector<BareRadio*> senders;
    std::vector<BareRadio*> listeners;
    for (int i = 0; i < side * side; ++i) {
        const int row = i / side;
        std::vector<BareRadio*>& radios = (i + row) % 2 == 0 ? senders : listeners;
        config.tx_power_w *= 1.001;
        radios.push_back(
            &air.add_radio(Position{0.0 + i % side, 0.0 + row, 0} * light_microsecond_m, config));
    }
    for (std::size_t i = 0; i < senders.size(); ++i) {
        BareRadio& sender = *senders[i * 7 % senders.size()];
        air.at(us(10 * static_cast<std::int64_t>(i)), [&sender] { sender.send(us(2000)); });
    }
    air.run();
    EXPECT_GT(
        std::ranges::count_if(
            listeners, [](const BareRadio* radio) { return !radio->log.times_of(RadioWord::busy).empty(); }),
        25);
    EXPECT_LE(air.medium.energy_evaluation_count(), 4 * senders.size() * side * side);
}

}  // namespace
}  // namespace netsim
