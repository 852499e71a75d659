#include "netsim/medium/cumulative_energy_detection.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
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
using test::RadioEvent;
using test::RadioWord;
using test::Station;
using test::us;

RadioConfig deaf_but_sensing() {
    RadioConfig config;
    config.sensitivity_w = 1e-9;
    config.energy_detection_w = 1e-10;
    return config;
}

// The detection alone, with a test listener.
class CumulativeEnergyDetectionTest : public testing::Test, private CumulativeEnergyListener {
protected:
    struct Matter {
        RadioId radio;
        std::uint64_t transmission;
        SimTime start;

        bool operator==(const Matter&) const = default;
    };

    // A radio with an ED threshold of 1e-10 W, noise included, that locks on to nothing.
    RadioId add(Position place) {
        const Trajectory& trajectory = places.emplace_back(place);
        const RadioConfig config = deaf_but_sensing();
        watch.add_radio();
        return links.add(InterfaceId{static_cast<NodeId>(places.size()) - 1, 0},
                         {.trajectory = &trajectory,
                          .parameters = {.band = {config.carrier_hz, config.bandwidth_hz},
                                         .sensitivity_w = config.sensitivity_w,
                                         .energy_detection_w = config.energy_detection_w}},
                         MountedAntenna(), SimTime());
    }
    // A transmission of 100 µs that begins now. The receiver at the origin gets that power.
    void send(RadioId sender, double received_w) {
        Transmission transmission;
        transmission.radio = sender;
        transmission.sender = links.interface(sender);
        transmission.duration = us(100);
        transmission.band = links.receiver(sender).band;
        transmission.power_w =
            test::power_for(received_w, distance({}, links.position(sender, simulator.now())));
        ActiveTransmission& entry = waves.put(std::move(transmission), simulator.now(), 0);
        entry.last_end = simulator.now() + us(1000);
        ReceiverGroup& group = links.groups()[0];
        watch.begin_zones(entry, 0);
        group.members.prepare(simulator.now(), links.displacement(), 1000);
        if (links.watches_energy(0) && received_w >= entry.zones[0].min_power_w()) {
            entry.zones[0].watched().push_back({0, {}, links.receiver(0).headroom_w(received_w)});
        }
        std::vector<ActiveTransmission*> concurrent;
        waves.find_concurrent(entry, concurrent);
        if (!concurrent.empty()) {
            watch.add(entry, concurrent);
        }
    }

    Simulator simulator;
    std::deque<Trajectory> places;
    Links links{MediumConfig(), 1};
    ActiveTransmissions waves{links};
    CumulativeEnergyDetection watch{simulator, links, waves, *this};
    std::vector<Matter> notified;
    RadioId receiver = add({0, 0, 0});
    RadioId near = add({light_microsecond_m, 0, 0});
    RadioId far = add({0, 2 * light_microsecond_m, 0});

private:
    void arrival_needed(RadioId radio, ActiveTransmission& active, const Arrival& arrival) override {
        if (radio == receiver) {
            notified.push_back({radio, active.transmission.id(), arrival.start});
        }
    }
};

TEST_F(CumulativeEnergyDetectionTest, ReportsAllThatIsNeeded) {
    send(near, 6e-11);
    EXPECT_TRUE(notified.empty());
    send(far, 6e-11);
    EXPECT_EQ(notified.size(), 2U);
    EXPECT_NE(std::ranges::find(notified, Matter{receiver, 0, us(1)}), notified.end());
    EXPECT_NE(std::ranges::find(notified, Matter{receiver, 1, us(2)}), notified.end());
}

TEST_F(CumulativeEnergyDetectionTest, ReportsNothingBelowTheThreshold) {
    send(near, 4e-11);
    send(far, 4e-11);
    EXPECT_TRUE(notified.empty());
}

TEST_F(CumulativeEnergyDetectionTest, ReportsNothingBeforeARadioWatches) {
    links.set_watches_energy(receiver, false);
    send(near, 6e-11);
    send(far, 6e-11);
    EXPECT_TRUE(notified.empty());
    links.set_watches_energy(receiver, true);
    watch.watch(receiver, simulator.now());
    EXPECT_EQ(notified.size(), 2U);
}

// Two frames make the channel of a receiver busy together from 62 µs to 111 µs. The second lasts
// until 162 µs.
class WatchedEnergy : public testing::Test {
protected:
    WatchedEnergy() {
        receiver.stop_watching_channel();
        air.medium.remember(us(500));
        send_at(us(10));
        send_at(us(60));
    }
    void send_at(SimTime start) {
        const double away_m = ++senders * light_microsecond_m;
        BareRadio& sender =
            air.add_radio({away_m, 0, 0}, test::radio_of_power(test::power_for(6e-11, away_m)));
        air.at(start, [&sender] { sender.send(us(100)); });
    }
    void begins_to_watch_at(SimTime time, SimTime since) {
        air.at(time, [this, since] { busy_until = receiver.watch_channel(since); });
    }

    Air air;
    BareRadio& bare = air.add_radio({0, 0, 0}, deaf_but_sensing());
    Radio& receiver = bare.radio;
    int senders = 0;
    SimTime busy_until = SimTime::from_ps(-1);
};

std::vector<RadioEvent> busy_while_both_last() {
    return {{RadioWord::busy, us(62)}, {RadioWord::free, us(111)}};
}

TEST_F(WatchedEnergy, IsNotReportedWithoutWatching) {
    air.run();
    EXPECT_TRUE(bare.log.events.empty());
}

TEST_F(WatchedEnergy, IsReportedAfterWatchingBegan) {
    begins_to_watch_at(us(5), us(5));
    air.run();
    EXPECT_EQ(bare.log.events, busy_while_both_last());
}

TEST_F(WatchedEnergy, IsReportedIfWatchingBeganDuringTheFirstFrame) {
    begins_to_watch_at(us(30), us(30));
    air.run();
    EXPECT_EQ(bare.log.events, busy_while_both_last());
}

TEST_F(WatchedEnergy, IsReportedIfWatchingBeganBeforeTheSecondArrival) {
    begins_to_watch_at(us(61), us(61));
    air.run();
    EXPECT_EQ(bare.log.events, busy_while_both_last());
}

TEST_F(WatchedEnergy, MakesTheChannelBusyIfWatchingBeginsDuringIt) {
    begins_to_watch_at(us(80), us(80));
    air.run();
    EXPECT_EQ(bare.log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(80)}, {RadioWord::free, us(111)}}));
}

TEST_F(WatchedEnergy, IsNotReportedAfterWatchingStopped) {
    begins_to_watch_at(us(5), us(5));
    air.at(us(30), [this] { receiver.stop_watching_channel(); });
    air.run();
    EXPECT_TRUE(bare.log.events.empty());
}

TEST_F(WatchedEnergy, IsReportedAfterWatchingRestarted) {
    begins_to_watch_at(us(5), us(5));
    air.at(us(30), [this] { receiver.stop_watching_channel(); });
    begins_to_watch_at(us(40), us(40));
    air.run();
    EXPECT_EQ(bare.log.events, busy_while_both_last());
}

TEST_F(WatchedEnergy, ReturnsItsEndAfterwards) {
    begins_to_watch_at(us(150), us(100));
    air.run();
    EXPECT_EQ(busy_until, us(111));
}

TEST_F(WatchedEnergy, ReturnsItsEndAfterAllFramesEnded) {
    send_at(us(300));
    begins_to_watch_at(us(450), us(0));
    air.run();
    EXPECT_EQ(busy_until, us(111));
}

TEST_F(WatchedEnergy, IgnoresEndsBeforeSince) {
    begins_to_watch_at(us(150), us(120));
    air.run();
    EXPECT_EQ(busy_until, SimTime::long_ago());
}

TEST_F(WatchedEnergy, IgnoresEnergyBelowTheThreshold) {
    begins_to_watch_at(us(50), us(0));
    air.run();
    EXPECT_EQ(busy_until, SimTime::long_ago());
}

// Six frames, five of which suffice. They arrive at 11, 12, … µs and last for 100 µs.
class ManyPendingArrivals : public testing::TestWithParam<Culling> {
protected:
    ManyPendingArrivals() {
        receiver.stop_watching_channel();
        for (int i = 1; i <= 6; ++i) {
            const double away_m = i * light_microsecond_m;
            BareRadio& sender =
                air.add_radio({away_m, 0, 0}, test::radio_of_power(test::power_for(2.3e-11, away_m)));
            air.at(us(10), [&sender] { sender.send(us(100)); });
        }
    }

    Air air{MediumConfig(), GetParam()};
    BareRadio& bare = air.add_radio({0, 0, 0}, deaf_but_sensing());
    Radio& receiver = bare.radio;
};

TEST_P(ManyPendingArrivals, MakeTheChannelBusyIfWatchingBeganBeforeThem) {
    air.at(us(10) + SimTime::from_ns(500), [this] { receiver.watch_channel(us(10)); });
    air.run();
    EXPECT_EQ(bare.log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(15)}, {RadioWord::free, us(112)}}));
}

TEST_P(ManyPendingArrivals, MakeTheChannelBusyIfWatchingBeganAtTheFirst) {
    air.at(us(11), [this] { receiver.watch_channel(us(10)); });
    air.run();
    EXPECT_EQ(bare.log.events,
              (std::vector<RadioEvent>{{RadioWord::busy, us(15)}, {RadioWord::free, us(112)}}));
}

INSTANTIATE_TEST_SUITE_P(CullingModes, ManyPendingArrivals,
                         testing::Values(Culling::enabled, Culling::disabled), [](const auto& param_info) {
                             return param_info.param == Culling::disabled ? "everything" : "what_matters";
                         });

// A radio that stops watching before they arrive, to send itself, is notified of none.
TEST(ManyLateArrivals, CostOneEventIfWatchingStops) {
    const auto event_count = [](bool watches) {
        Air air;
        Radio& receiver = air.add_radio({0, 0, 0}, deaf_but_sensing()).radio;
        receiver.stop_watching_channel();
        for (int i = 1; i <= 6; ++i) {
            const double away_m = i * light_microsecond_m;
            BareRadio& sender =
                air.add_radio({away_m, 0, 0}, test::radio_of_power(test::power_for(2.3e-11, away_m)));
            air.at(us(10), [&sender] { sender.send(us(100)); });
        }
        air.at(us(10) + SimTime::from_ns(500), [&receiver, watches] {
            if (watches) {
                receiver.watch_channel(us(10));
                receiver.stop_watching_channel();
            }
        });
        air.run();
        return air.simulator.event_count();
    };
    EXPECT_EQ(event_count(true), event_count(false) + 1);
}

// A station does not watch while it has nothing to send. It finds the same channel state as if it
// did.
class StationWithCumulativeEnergy : public testing::TestWithParam<Culling> {
protected:
    BareRadio& add_sender(double received_w) {
        return air.add_radio({light_microsecond_m, 0, 0},
                             test::radio_of_power(test::power_for(received_w, light_microsecond_m)));
    }
    void sends_at(BareRadio& sender, SimTime start, SimTime duration) {
        air.at(start, [&sender, duration] { sender.send(duration); });
    }
    // When the station begins to send a message that it is given at that time.
    SimTime sent(SimTime time) {
        air.at(time, [this] { station.send(broadcast_id, 100); });
        air.run();
        for (const test::Heard& frame : sniffer.heard) {
            if (frame.sender == station.id() && frame.start >= time) {
                return frame.start;
            }
        }
        return SimTime::long_ago();
    }
    static MacConfig without_backoff() {
        MacConfig config;
        config.cw_min = 0;
        config.cw_max = 0;
        config.short_retry_limit = 1;
        return config;
    }

    const MacTiming timing{mode_set(MacConfig().op_mode)};
    Air air{MediumConfig(), GetParam()};
    Station& station = air.add_station({0, 0, 0}, without_backoff(), deaf_but_sensing());
    test::Sniffer& sniffer = air.add_sniffer({0, 0, 0});
};

TEST_P(StationWithCumulativeEnergy, SendsAtOnceIfTheChannelWasFree) {
    sends_at(add_sender(6e-11), us(10), us(100));
    EXPECT_EQ(sent(us(120)), us(120));
}

TEST_P(StationWithCumulativeEnergy, WaitsFromTheEndOfTheBusyPeriod) {
    sends_at(add_sender(6e-11), us(10), us(100));
    sends_at(add_sender(6e-11), us(10), us(200));
    EXPECT_EQ(sent(us(120)), us(111) + timing.difs);
}

TEST_P(StationWithCumulativeEnergy, WaitsForTheEndOfTheBusyPeriod) {
    sends_at(add_sender(6e-11), us(10), us(200));
    sends_at(add_sender(6e-11), us(10), us(300));
    EXPECT_EQ(sent(us(120)), us(211) + timing.difs);
}

// The wait after a corrupted frame begins when the channel is free, not at the end of the frame.
TEST_P(StationWithCumulativeEnergy, WaitsEifsAfterTheBusyPeriodOfACorruptedFrame) {
    sends_at(add_sender(2e-9), us(10), us(100));
    sends_at(add_sender(2e-9), us(50), us(20));
    sends_at(add_sender(6e-11), us(20), us(200));
    sends_at(add_sender(6e-11), us(20), us(300));
    EXPECT_EQ(sent(us(250)), us(221) + timing.eifs);
}

TEST_P(StationWithCumulativeEnergy, WaitsEifsAfterACorruptedFrameInsteadOfTheLastAck) {
    const Mode& mode = mode_set(MacConfig().op_mode).mode_for_bitrate(MacConfig().bitrate_bps);
    const SimTime no_ack = us(10) + mode.duration(data_psdu_bytes(100)) + us(10);
    sends_at(add_sender(2e-9), no_ack, us(100));
    sends_at(add_sender(2e-9), no_ack + us(40), us(20));
    air.at(us(10), [this] { station.send(1, 100); });
    EXPECT_EQ(sent(no_ack + us(120)), no_ack + us(101) + timing.eifs);
}

INSTANTIATE_TEST_SUITE_P(CullingModes, StationWithCumulativeEnergy,
                         testing::Values(Culling::enabled, Culling::disabled), [](const auto& param_info) {
                             return param_info.param == Culling::disabled ? "everything" : "what_matters";
                         });

}  // namespace
}  // namespace netsim
