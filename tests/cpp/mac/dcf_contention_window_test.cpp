// Growth and reset of the Dcf's contention window.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "support/air.hpp"
#include "support/dcf_instants.hpp"

namespace netsim {
namespace {

using test::ack_duration;
using test::Air;
using test::difs;
using test::Heard;
using test::light_microsecond_m;
using test::of_kind;
using test::sifs;
using test::slot;
using test::Sniffer;
using test::Station;
using test::us;

// Slots before each attempt of messages that are never acknowledged.
class ContentionWindow : public testing::Test {
protected:
    static constexpr int seeds = 150;

    // slots[attempt] of all seeds, of `messages` messages with `attempts` attempts each.
    static std::vector<std::vector<std::int64_t>> slots_of_attempts(const MacConfig& mac,
                                                                    std::size_t messages = 2,
                                                                    std::size_t attempts = 7) {
        std::vector<std::vector<std::int64_t>> slots(messages * attempts);
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            Air air(MediumConfig(), Culling::enabled, seed);
            Station& sender = air.add_station({0, 0, 0}, mac);
            Station& gone = air.add_station({1e7, 0, 0}, mac);
            Sniffer& sniffer = air.add_sniffer({0, 0, 0});
            for (std::size_t message = 0; message < messages; ++message) {
                sender.send(gone.id(), 100);
            }
            air.run(SimTime::from_seconds(1));
            const std::vector<Heard> frames = of_kind(sniffer, FrameKind::unicast);
            EXPECT_EQ(frames.size(), slots.size());
            for (std::size_t attempt = 1; attempt < slots.size(); ++attempt) {
                const SimTime waited =
                    frames[attempt].start - frames[attempt - 1].end - sifs - ack_duration - difs;
                EXPECT_EQ(waited.ps() % slot.ps(), 0);
                slots[attempt].push_back(waited.ps() / slot.ps());
            }
        }
        return slots;
    }
    static void expect_draws_up_to(const std::vector<std::int64_t>& slots, std::int64_t window) {
        const auto [least, most] = std::minmax_element(slots.begin(), slots.end());
        EXPECT_GE(*least, 0);
        EXPECT_LE(*most, window);
        EXPECT_GT(*most, window * 9 / 10);  // fails with a probability of 0.9^150
    }
};

TEST_F(ContentionWindow, DoublesWithEveryFailureUpToItsMaximum) {
    const auto slots = slots_of_attempts(MacConfig());
    const std::vector<std::int64_t> windows{63, 127, 255, 511, 1023, 1023};
    for (std::size_t retry = 1; retry <= windows.size(); ++retry) {
        SCOPED_TRACE("retry " + std::to_string(retry));
        expect_draws_up_to(slots[retry], windows[retry - 1]);
    }
}

TEST_F(ContentionWindow, IsItsMinimumAgainForTheNextMessage) {
    expect_draws_up_to(slots_of_attempts(MacConfig())[7], 31);
}

TEST_F(ContentionWindow, IsItsMinimumOnlyOnceWithStationCounters) {
    MacConfig mac;
    mac.short_retry_limit = 4;
    mac.inet_station_retry_counters = true;
    // For three messages, with a limit of four failures.
    const std::vector<std::int64_t> windows{63, 127, 255, 31, 63, 127, 255, 511};
    const auto slots = slots_of_attempts(mac, 3, 4);
    for (std::size_t attempt = 1; attempt <= windows.size(); ++attempt) {
        SCOPED_TRACE("attempt " + std::to_string(attempt));
        expect_draws_up_to(slots[attempt], windows[attempt - 1]);
    }
}

// For three messages that fail: without the broadcast, the failures of the first two would add
// up.
TEST_F(ContentionWindow, ABroadcastSetsTheStationCountersBack) {
    MacConfig mac;
    mac.short_retry_limit = 4;
    mac.inet_station_retry_counters = true;
    std::vector<std::int64_t> slots;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Air air(MediumConfig(), Culling::enabled, seed);
        Station& sender = air.add_station({0, 0, 0}, mac);
        Station& gone = air.add_station({1e7, 0, 0}, mac);
        Sniffer& sniffer = air.add_sniffer({0, 0, 0});
        for (const NodeId destination : {gone.id(), broadcast_id, gone.id(), gone.id()}) {
            sender.send(destination, 100);
        }
        air.run(SimTime::from_seconds(1));
        const std::vector<Heard> frames = of_kind(sniffer, FrameKind::unicast);
        ASSERT_EQ(frames.size(), 12U);
        const SimTime waited = frames[8].start - frames[7].end - sifs - ack_duration - difs;
        slots.push_back(waited.ps() / slot.ps());
    }
    expect_draws_up_to(slots, 31);
}

// Three RTS fail, the fourth one is answered, its data is lost, and the fifth one fails. The last
// failure of the frame is the first one of the station after the CTS, and doubles the window
// again.
TEST_F(ContentionWindow, ACtsSetsTheStationCounterOfRtsBack) {
    MacConfig mac;
    mac.rts_threshold_bytes = 0;
    mac.short_retry_limit = 4;
    mac.inet_station_retry_counters = true;
    constexpr SimTime nav_of_rts = us(180);
    std::vector<std::int64_t> slots;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Air air(MediumConfig(), Culling::enabled, seed);
        Station& sender = air.add_station({0, 0, 0}, mac);
        test::BareRadio& peer = air.add_radio({10, 0, 0});
        Sniffer& sniffer = air.add_sniffer({0, 0, 0});
        sender.send(peer.id(), 100);
        sender.send(peer.id(), 100);
        while (sniffer.heard.size() < 4) {
            air.run(air.simulator.now() + us(5));
        }
        air.at(sniffer.heard.back().end + sifs,
               [&] { peer.send_control(FrameKind::cts, sender.id(), SimTime()); });
        air.run(SimTime::from_seconds(1));
        ASSERT_EQ(of_kind(sniffer, FrameKind::unicast).size(), 1U);
        const std::vector<Heard> frames = of_kind(sniffer, FrameKind::rts);
        ASSERT_EQ(frames.size(), 9U);
        const SimTime waited = frames[5].start - frames[4].end - nav_of_rts - difs;
        slots.push_back(waited.ps() / slot.ps());
    }
    expect_draws_up_to(slots, 1023);
}

TEST_F(ContentionWindow, IsItsMinimumAgainAfterAnAck) {
    std::vector<std::int64_t> slots;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Air air(MediumConfig(), Culling::enabled, seed);
        Station& sender = air.add_station({0, 0, 0});
        Station& receiver = air.add_station({20'000, 0, 0});
        Sniffer& sniffer = air.add_sniffer({0, 0, 0});
        sender.send(receiver.id(), 100);
        sender.send(receiver.id(), 100);
        while (sniffer.heard.size() < 4) {
            air.run(air.simulator.now() + us(100));
        }
        receiver.trajectory.go_to(air.simulator.now(), {light_microsecond_m, 0, 0}, 1e15);
        air.run();
        const SimTime first_ack = of_kind(sniffer, FrameKind::ack).at(0).end;
        const SimTime waited = of_kind(sniffer, FrameKind::unicast).back().start - first_ack - difs;
        slots.push_back(waited.ps() / slot.ps());
    }
    expect_draws_up_to(slots, 31);
}

TEST_F(ContentionWindow, HasTheBoundsThatItIsGiven) {
    MacConfig mac;
    mac.cw_min = 7;
    mac.cw_max = 20;
    const auto slots = slots_of_attempts(mac);
    expect_draws_up_to(slots[1], 15);
    expect_draws_up_to(slots[2], 20);
    expect_draws_up_to(slots[6], 20);
    expect_draws_up_to(slots[7], 7);
}

}  // namespace
}  // namespace netsim
