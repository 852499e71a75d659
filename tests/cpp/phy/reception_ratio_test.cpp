// Over distance, the ratio of frames that a radio decodes follows from the error model for the SNR
// there.
//
// Each count lies within the interval in which a binomial count lies 99.9 % of the time. Seeds are
// fixed, so a test that passes once passes always.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/phy/error_rate.hpp"
#include "support/air.hpp"
#include "support/error_model.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;

constexpr int frames = 2000;
constexpr int psdu_bytes = 164;

// Interval that contains a binomial count of `trials` with probability `p` in 99.9 % of cases, by
// summing its distribution.
std::pair<int, int> binomial_interval(int trials, double p) {
    constexpr double tail = 0.0005;
    double at_most = 0;
    int low = 0;
    int high = trials;
    bool low_found = false;
    for (int count = 0; count <= trials; ++count) {
        const double log_chance = std::lgamma(trials + 1) - std::lgamma(count + 1) -
                                  std::lgamma(trials - count + 1) + count * std::log(p) +
                                  (trials - count) * std::log1p(-p);
        at_most += std::exp(log_chance);
        if (!low_found && at_most > tail) {
            low = count;
            low_found = true;
        }
        if (at_most >= 1 - tail) {
            high = count;
            break;
        }
    }
    return {low, high};
}

struct Rate {
    const char* op_mode;
    double bitrate_bps;
};

class ReceptionRatio : public testing::TestWithParam<Rate> {
protected:
    const Mode& mode = mode_set(GetParam().op_mode).mode_for_bitrate(GetParam().bitrate_bps);

    double snr_at(double distance_m) const {
        const MediumConfig medium;
        return RadioConfig().tx_power_w * make_path_loss(medium).gain(distance_m, RadioConfig().carrier_hz) /
               medium.background_noise_w;
    }
    double success_at(double distance_m) const {
        return test::error_model(RadioConfig().error_model)
            .success_probability(mode, snr_at(distance_m), psdu_bytes);
    }
    // Distance at which the probability of success falls to `probability`.
    double distance_of(double probability) const {
        double near = 1;
        double far = 1e6;
        for (int i = 0; i < 100; ++i) {
            const double middle = std::sqrt(near * far);
            (success_at(middle) > probability ? near : far) = middle;
        }
        return near;
    }
};

TEST_P(ReceptionRatio, IsThatOfTheErrorModelAtEveryDistance) {
    RadioConfig config;
    config.sensitivity_w = 1e-20;  // noise decides, not sensitivity or threshold
    config.snir_threshold = 0;
    Air air;
    BareRadio& sender = air.add_radio({0, 0, 0}, config);
    struct Point {
        double distance_m;
        double probability;
        BareRadio* receiver;
    };
    std::vector<Point> points;
    for (const double probability : {0.999, 0.98, 0.9, 0.75, 0.5, 0.25, 0.1, 0.02, 0.001}) {
        const double distance_m = distance_of(probability);
        points.push_back({distance_m, success_at(distance_m), &air.add_radio({distance_m, 0, 0}, config)});
    }
    const SimTime duration = mode.duration(psdu_bytes);
    const auto frame = std::make_shared<const Frame>();
    for (int i = 0; i < frames; ++i) {
        sender.radio.transmit(frame, FrameLabel(), psdu_bytes, mode, duration);
        air.run(air.simulator.now() + duration + SimTime::from_us(10'000));
    }
    for (const Point& point : points) {
        const auto [low, high] = binomial_interval(frames, point.probability);
        const auto decoded =
            static_cast<int>(air.broadcast_count_at(*point.receiver, FrameOutcome::delivered));
        EXPECT_GE(decoded, low) << mode.name << " at " << point.distance_m << " m, chance "
                                << point.probability;
        EXPECT_LE(decoded, high) << mode.name << " at " << point.distance_m << " m, chance "
                                 << point.probability;
        EXPECT_EQ(air.broadcast_count_at(*point.receiver, FrameOutcome::noise),
                  frames - static_cast<unsigned>(decoded));
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, ReceptionRatio,
                         testing::Values(Rate{"b", 1e6}, Rate{"b", 11e6}, Rate{"g(mixed)", 6e6},
                                         Rate{"g(mixed)", 24e6}, Rate{"a", 54e6}),
                         [](const auto& param_info) {
                             return std::to_string(static_cast<int>(param_info.param.bitrate_bps / 1e6)) +
                                    "Mbps";
                         });

}  // namespace
}  // namespace netsim
