// The Dcf with rate control. Durations as in dcf_test.cpp: g(erp), 164 B with all headers, ACK of
// 14 B.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/dcf.hpp"
#include "netsim/medium/arrival.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::light_microsecond_m;
using test::Station;
using test::us;

MacConfig mac_with(const char* rate_control, double initial_rate_bps = -1) {
    MacConfig config;
    config.op_mode = "g(erp)";
    config.rate_control = rate_control;
    config.initial_rate_bps = initial_rate_bps;
    return config;
}

// Records the frames of one kind: their durations, and the durations that they announce.
class Listener final : public MediumListener {
public:
    struct Frame {
        std::int64_t duration_us;
        std::int64_t field_us;
    };

    Listener(Air& air, FrameKind kind) : kind_(kind) {
        const RadioConfig radio;
        air.medium.attach(air.next_node(),
                          Receiver{this, &trajectory_, {.band = {radio.carrier_hz, radio.bandwidth_hz}}});
    }

    void arrival_started(const Arrival&) override {}
    void arrival_ended(const Arrival& arrival) override {
        const Transmission& transmission = *arrival.transmission;
        if (transmission.label.kind == kind_) {
            frames.push_back({(arrival.end - arrival.start).ps() / 1'000'000,
                              transmission.frame->duration_field.ps() / 1'000'000});
        }
    }
    std::vector<std::int64_t> durations_us() const {
        std::vector<std::int64_t> durations;
        for (const Frame& frame : frames) {
            durations.push_back(frame.duration_us);
        }
        return durations;
    }
    std::vector<std::int64_t> fields_us() const {
        std::vector<std::int64_t> fields;
        for (const Frame& frame : frames) {
            fields.push_back(frame.field_us);
        }
        return fields;
    }

    std::vector<Frame> frames;

private:
    FrameKind kind_;
    Trajectory trajectory_{Position{0, 0, 0}};
};

class DcfRateControl : public testing::Test {
protected:
    void add_pair(const MacConfig& mac, const RadioConfig& receiver_radio = RadioConfig()) {
        a = &air.add_station({0, 0, 0}, mac);
        b = &air.add_station({light_microsecond_m, 0, 0}, mac, receiver_radio);
    }

    Air air;
    Listener data{air, FrameKind::unicast};
    Listener acks{air, FrameKind::ack};
    Listener rts{air, FrameKind::rts};
    Station* a = nullptr;
    Station* b = nullptr;
};

// The ACKs are too weak for the sender: 24 24 18 18 12 12 9 Mbps, and a dropped frame.
TEST_F(DcfRateControl, EachRetryHasTheModeThatTheFailuresSoFarLeadTo) {
    add_pair(mac_with("ArfRateControl"), test::radio_of_power(1e-6));
    a->send(b->id(), 100);
    air.run();
    EXPECT_EQ(data.durations_us(), (std::vector<std::int64_t>{82, 82, 102, 102, 138, 138, 178}));
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::retry_limit), 1U);
}

// All attempts but the last at 24 Mbps, the last one at 6 Mbps.
TEST_F(DcfRateControl, EachRetryGoesDownTheChainOfMinstrel) {
    MacConfig mac = mac_with("MinstrelRateControl");
    mac.look_around_share = 0;
    mac.long_retry_limit = mac.short_retry_limit;
    add_pair(mac, test::radio_of_power(1e-6));
    a->send(b->id(), 100);
    air.run();
    EXPECT_EQ(data.durations_us(), (std::vector<std::int64_t>{82, 82, 82, 82, 82, 82, 250}));
}

// SIFS of 10 µs and an ACK in the mode of the frame or the next slower mandatory one.
TEST_F(DcfRateControl, DurationFieldsAndAcksFollowTheMode) {
    add_pair(mac_with("ArfRateControl", 9e6));
    for (int i = 0; i < 21; ++i) {
        a->send(b->id(), 100);
    }
    air.run();
    std::vector<std::int64_t> data_us(10, 178);
    std::vector<std::int64_t> ack_us(10, 50);
    data_us.insert(data_us.end(), 10, 138);
    ack_us.insert(ack_us.end(), 10, 38);
    data_us.push_back(102);
    ack_us.push_back(38);
    EXPECT_EQ(data.durations_us(), data_us);
    EXPECT_EQ(acks.durations_us(), ack_us);
    std::vector<std::int64_t> fields_us;
    std::ranges::transform(ack_us, std::back_inserter(fields_us), [](std::int64_t ack) { return 10 + ack; });
    EXPECT_EQ(data.fields_us(), fields_us);
    EXPECT_EQ(b->received.size(), 21U);
    EXPECT_EQ(air.message_count(MessageKind::unicast, MessageOutcome::acknowledged), 21U);
}

// Both RTS are at 24 Mbps. The RTS of the eleventh frame announces a faster frame: 138 instead of
// 178 µs, and its ACK 38 instead of 50 µs.
TEST_F(DcfRateControl, RtsKeepsItsModeAndAnnouncesTheModeOfTheData) {
    MacConfig mac = mac_with("ArfRateControl", 9e6);
    mac.rts_threshold_bytes = 0;
    add_pair(mac);
    for (int i = 0; i < 11; ++i) {
        a->send(b->id(), 100);
    }
    air.run();
    constexpr std::int64_t sifs = 10;
    constexpr std::int64_t cts = 34;
    EXPECT_EQ(rts.durations_us(), std::vector<std::int64_t>(11, 34));
    ASSERT_EQ(rts.frames.size(), 11U);
    EXPECT_EQ(rts.frames.front().field_us, sifs + cts + sifs + 178 + sifs + 50);
    EXPECT_EQ(rts.frames.back().field_us, sifs + cts + sifs + 138 + sifs + 38);
    EXPECT_EQ(data.durations_us().back(), 138);
}

// No station answers: 4 RTS fail, which says nothing about data rates.
TEST_F(DcfRateControl, AnRtsThatFailsDoesNotCount) {
    MacConfig mac = mac_with("ArfRateControl");
    mac.rts_threshold_bytes = 0;
    mac.short_retry_limit = 4;
    add_pair(mac, test::radio_of_power(1e-6));
    a->send(b->id(), 100);
    a->send(b->id(), 100);
    air.run();
    EXPECT_EQ(rts.fields_us(), std::vector<std::int64_t>(8, 10 + 34 + 10 + 82 + 10 + 34));
}

TEST_F(DcfRateControl, BroadcastsKeepTheirMode) {
    add_pair(mac_with("ArfRateControl", 9e6));
    Listener broadcasts(air, FrameKind::broadcast);
    for (int i = 0; i < 15; ++i) {
        a->send(b->id(), 100);
        a->send(broadcast_id, 100);
    }
    air.run();
    EXPECT_EQ(broadcasts.durations_us(), std::vector<std::int64_t>(15, 82));
}

TEST_F(DcfRateControl, UnicastFramesAreCountedByBitrate) {
    add_pair(mac_with("ArfRateControl"), test::radio_of_power(1e-6));
    a->send(b->id(), 100);
    a->send(broadcast_id, 100);
    air.run();
    const std::map<std::int64_t, std::uint64_t> expected{{6'000'000, 0},  {9'000'000, 1},  {12'000'000, 2},
                                                         {18'000'000, 2}, {24'000'000, 2}, {36'000'000, 0},
                                                         {48'000'000, 0}, {54'000'000, 0}};
    EXPECT_EQ(a->dcf.frames_by_bitrate(), expected);
}

TEST_F(DcfRateControl, WithoutOneNothingIsCounted) {
    add_pair(MacConfig());
    a->send(b->id(), 100);
    air.run();
    EXPECT_TRUE(a->dcf.frames_by_bitrate().empty());
}

// Messages of 1000 B that one of two stations delivers in `duration`, limited only by noise of
// -90 dBm.
std::uint64_t delivered(const MacConfig& mac, double distance_m, SimTime duration) {
    MediumConfig medium;
    medium.background_noise_w = 1e-12;
    Air air(medium);
    RadioConfig radio;
    radio.sensitivity_w = 1e-15;
    radio.energy_detection_w = 2e-12;
    radio.snir_threshold = 0.01;
    Station& a = air.add_station({0, 0, 0}, mac, radio);
    Station& b = air.add_station({distance_m, 0, 0}, mac, radio);
    constexpr SimTime pause = us(1000);
    for (SimTime time; time < duration; time = time + pause) {
        air.at(time, [&] {
            while (a.dcf.queued_messages() < 10) {
                a.send(b.id(), 1000);
            }
        });
    }
    air.run(duration);
    return air.message_count(MessageKind::unicast, MessageOutcome::acknowledged);
}

std::uint64_t best_of_fixed_rates(double distance_m, SimTime duration) {
    std::uint64_t best = 0;
    for (const Mode& mode : mode_set("g(erp)").modes()) {
        MacConfig fixed = mac_with("");
        fixed.bitrate_bps = static_cast<double>(mode.bitrate_bps);
        best = std::max(best, delivered(fixed, distance_m, duration));
    }
    return best;
}

class RateControlOverDistance : public testing::TestWithParam<double> {};

// In 2 s there are some 1000 to 6000 messages: chance changes their number by less than 2 %.
TEST_P(RateControlOverDistance, GetsMostOfWhatTheBestFixedRateGets) {
    const SimTime duration = SimTime::from_seconds(2);
    const auto best = static_cast<double>(best_of_fixed_rates(GetParam(), duration));
    ASSERT_GT(best, 500);
    for (const char* name : {"ArfRateControl", "AarfRateControl", "MinstrelRateControl"}) {
        const auto adaptive = static_cast<double>(delivered(mac_with(name), GetParam(), duration));
        EXPECT_GE(adaptive, 0.8 * best) << name;
        EXPECT_LE(adaptive, 1.05 * best) << name;
    }
}

// SNR decreases from 29 dB to 5 dB.
INSTANTIATE_TEST_SUITE_P(Distances, RateControlOverDistance,
                         testing::Values(50.0, 170.0, 280.0, 420.0, 780.0),
                         [](const auto& test) { return std::to_string(std::lround(test.param)) + "m"; });

}  // namespace
}  // namespace netsim
