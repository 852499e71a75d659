#include "netsim/phy/reception.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/phy/modes.hpp"
#include "support/error_model.hpp"

namespace netsim {
namespace {

constexpr double noise_w = 1e-13;

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

// A frame from 1000 µs on.
struct Frame100 {
    explicit Frame100(const Mode& mode, double snr, int psdu_bytes = 100) {
        transmission.mode = &mode;
        transmission.psdu_bytes = psdu_bytes;
        arrival = {&transmission, us(1000), us(1000) + mode.duration(psdu_bytes), snr * noise_w};
    }
    Frame100(const Frame100&) = delete;

    Transmission transmission;
    Arrival arrival;
};

ReceptionModel model(double snir_threshold = 0) {
    return {&test::error_model("Ieee80211NistErrorModel"), snir_threshold, noise_w};
}

double success(const ReceptionModel& reception, FramePart part, const Arrival& arrival,
               const std::vector<Arrival>& others = {}) {
    InterferenceSum sum;
    const Period period = period_of(part, arrival);
    sum.begin(period.start, period.end);
    for (const Arrival& other : others) {
        sum.add(other);
    }
    return reception.success(part, arrival, sum);
}

TEST(Reception, NoInterferenceUpToTheBoundLeavesLessThanTheLeastSuccess) {
    const Frame100 frame(mode_set("g(erp)").mode_for_bitrate(24e6), 40);
    const ReceptionModel reception = model();
    for (const double max_w : {0.0, 0.1 * noise_w, 0.5 * noise_w, 0.9 * noise_w}) {
        const double least = reception.min_success(frame.arrival, max_w);
        EXPECT_GT(least, 0) << max_w;
        for (const double share : {0.0, 0.3, 1.0}) {
            EXPECT_GE(reception.success(frame.arrival, share * max_w), least) << share << " of " << max_w;
        }
    }
}

TEST(Reception, BelowTheThresholdTheLeastSuccessIsNone) {
    const Frame100 frame(mode_set("g(erp)").mode_for_bitrate(6e6), 100);
    EXPECT_GT(model(49).min_success(frame.arrival, noise_w), 0);
    EXPECT_EQ(model(50).min_success(frame.arrival, noise_w), 0);
}

// Also if bounds determine its success, as for all but CCK, or if it is impossible or certain.
TEST(Reception, SurvivesWhatItsDrawIsBelow) {
    RandomStream draws(1, 2, Purpose{1});
    for (const double bitrate_bps : {2e6, 11e6, 6e6, 24e6, 54e6}) {
        const Mode& mode = mode_set("g(mixed)").mode_for_bitrate(bitrate_bps);
        for (int step = 0; step < 312; ++step) {  // up to 1000
            const double snr = 0.1 * std::pow(1.03, step);
            const Frame100 frame(mode, snr);
            const ReceptionModel reception = model(0.5);
            for (int i = 0; i < 20; ++i) {
                const double interference_w = draws.uniform() * noise_w;
                const double success = reception.success(frame.arrival, interference_w);
                for (const double draw :
                     {0.0, draws.uniform(), success, success * (1 - 1e-12), success * (1 + 1e-12)}) {
                    EXPECT_EQ(reception.survives(draw, frame.arrival, interference_w), draw < success)
                        << mode.name << " at " << snr << ", " << draw << " of " << success;
                }
            }
        }
    }
}

TEST(Reception, PartsOfAFrameFollowEachOther) {
    const Frame100 frame(mode_set("g(erp)").mode_for_bitrate(6e6), 1);
    EXPECT_EQ(period_of(FramePart::header, frame.arrival).start, us(1016));
    EXPECT_EQ(period_of(FramePart::header, frame.arrival).end, us(1020));
    EXPECT_EQ(period_of(FramePart::data, frame.arrival).start, us(1020));
    EXPECT_EQ(period_of(FramePart::data, frame.arrival).end, frame.arrival.end - us(6));  // signal extension
}

TEST(Reception, PartsAreNeverBeyondTheEndOfTheFrame) {
    Frame100 frame(mode_set("g(erp)").mode_for_bitrate(6e6), 1);
    frame.arrival.end = us(1018);
    EXPECT_EQ(period_of(FramePart::header, frame.arrival).end, us(1018));
    EXPECT_EQ(period_of(FramePart::data, frame.arrival).start, us(1018));
    EXPECT_EQ(period_of(FramePart::data, frame.arrival).end, us(1018));
}

// Invariant of chunks: with constant noise, header and data together give the closed form of mode
// "min".
TEST(Reception, UnderEvenNoiseChunksAreTheClosedForm) {
    RandomStream draws(1, 0, Purpose{1003});
    const auto modes = mode_set("g(mixed)").modes();
    for (int i = 0; i < 5000; ++i) {
        const Mode& mode = modes[draws.uniform_int(static_cast<std::uint32_t>(modes.size()))];
        const double snr = std::pow(10, 4 * draws.uniform() - 1);
        const Frame100 frame(mode, snr, static_cast<int>(draws.uniform_int(2000)));
        const double other_w = noise_w * draws.uniform();
        const std::vector<Arrival> others{{nullptr, us(0), us(1'000'000), other_w}};
        const ReceptionModel reception = model();
        const NistErrorModel nist(inet_rates);
        const double at = frame.arrival.power_w / (noise_w + other_w);
        const double header = success(reception, FramePart::header, frame.arrival, others);
        const double data = success(reception, FramePart::data, frame.arrival, others);
        EXPECT_EQ(header, std::exp(nist.log_header_success(mode, at)));
        EXPECT_EQ(data, std::exp(nist.log_data_success(mode, at, frame.transmission.psdu_bytes)));
        const double whole = reception.success(frame.arrival, other_w);
        EXPECT_EQ(whole, nist.success_probability(mode, at, frame.transmission.psdu_bytes));
        EXPECT_NEAR(header * data, whole, 1e-12 * whole + 1e-300);
    }
}

TEST(Reception, AChunkCountsWithItsShareOfTheTime) {
    const Mode& mode = mode_set("a").mode_for_bitrate(6e6);
    const Frame100 frame(mode, 2);
    const Period data = period_of(FramePart::data, frame.arrival);
    const SimTime length = data.end - data.start;
    const SimTime quarter = SimTime::from_ps(length.ps() / 4);
    const NistErrorModel nist(inet_rates);
    const double quiet = nist.log_data_success(mode, 2, 100);
    const double disturbed = nist.log_data_success(mode, 2 / 1.2, 100);
    const std::vector<Arrival> others{
        {nullptr, data.start + quarter, data.start + quarter + quarter, 0.2 * noise_w}};
    EXPECT_NEAR(success(model(), FramePart::data, frame.arrival, others),
                std::exp(0.75 * quiet + 0.25 * disturbed), 1e-12);
}

TEST(Reception, WhatDisturbsTheDataLeavesTheHeader) {
    const Frame100 frame(mode_set("a").mode_for_bitrate(6e6), 1000);
    const std::vector<Arrival> others{{nullptr, us(1020), us(2000), 1}};
    EXPECT_EQ(success(model(), FramePart::header, frame.arrival, others), 1);
    EXPECT_LT(success(model(), FramePart::data, frame.arrival, others), 1e-100);
}

TEST(Reception, ThePreambleIsNoPartOfEither) {
    const Frame100 frame(mode_set("a").mode_for_bitrate(6e6), 1000);
    const std::vector<Arrival> others{{nullptr, us(500), us(1016), 1}};
    EXPECT_EQ(success(model(), FramePart::header, frame.arrival, others), 1);
    EXPECT_EQ(success(model(), FramePart::data, frame.arrival, others), 1);
}

TEST(Reception, AMomentBelowTheThresholdIsTheEnd) {
    const Frame100 frame(mode_set("a").mode_for_bitrate(6e6), 100);
    const std::vector<Arrival> others{{nullptr, us(1050), us(1050) + SimTime::from_ps(1), 10 * noise_w}};
    EXPECT_GT(success(model(9), FramePart::data, frame.arrival, others), 0.99);
    EXPECT_EQ(success(model(10), FramePart::data, frame.arrival, others), 0);
    EXPECT_EQ(model(10).success(frame.arrival, 10 * noise_w), 0);
}

}  // namespace
}  // namespace netsim
