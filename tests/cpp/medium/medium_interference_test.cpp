#include <array>
#include <cmath>
#include <string_view>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "netsim/medium/arrival.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;
using test::us;

// At the end of whatever it could lock on to, holds the bounds of what disturbed that against the sum.
class Judge final : public MediumListener {
public:
    Judge(Air& air, Position place) : medium_(air.medium), trajectory_(place) {
        const RadioConfig config;
        id_ = medium_.attach(air.next_node(), Receiver{this,
                                                       &trajectory_,
                                                       {.band = {config.carrier_hz, config.bandwidth_hz},
                                                        .sensitivity_w = config.sensitivity_w,
                                                        .energy_detection_w = config.energy_detection_w}});
    }

    void arrival_started(const Arrival&) override {}
    void arrival_ended(const Arrival& arrival) override {
        if (arrival.lockable) {
            const double most_w =
                medium_.interference_with(id_, arrival, arrival.start, arrival.end).worst_w();
            const double bound_w = medium_.most_interference_w(id_, arrival);
            EXPECT_LE(most_w, bound_w);
            EXPECT_LE(bound_w, medium_.most_interference_w(arrival) * (1 + 1e-6));
            disturbed += most_w > 0 ? 1 : 0;
            most_sum_w += most_w;
            bound_sum_w += bound_w;
        }
    }

    int disturbed = 0;
    double most_sum_w = 0;
    double bound_sum_w = 0;

private:
    Medium& medium_;
    Trajectory trajectory_;
    RadioId id_ = 0;
};

// Thirty senders in a square of 4 km and a judge in its middle; each sends one frame within the time of five.
void send_all_over(Air& air, std::uint64_t seed) {
    RandomStream draws(seed, 0, Purpose{1002});
    for (int i = 0; i < 30; ++i) {
        BareRadio& sender = air.add_radio({draws.uniform(-2000, 2000), draws.uniform(-2000, 2000), 5},
                                          test::radio_of_power(0.1));
        air.at(us(draws.uniform_int(500)), [&sender] { sender.send(us(100)); });
    }
    air.run();
}

class BoundsOfInterference : public testing::TestWithParam<std::string_view> {};

TEST_P(BoundsOfInterference, AreNeverBelowTheSum) {
    MediumConfig config;
    config.path_loss = GetParam();
    int disturbed = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Air air(config, Hearing::what_matters, seed);
        Judge judge(air, {0, 0, 5});
        send_all_over(air, seed);
        disturbed += judge.disturbed;
    }
    EXPECT_GT(disturbed, 10) << "too few overlap to judge by: with this path loss, senders are too far apart";
}

INSTANTIATE_TEST_SUITE_P(PathLosses, BoundsOfInterference, testing::ValuesIn(path_loss_names));

TEST(BoundOfInterference, AtAReceiverIsNearTheSumOfThoseThatDisturbIt) {
    Air air;
    Judge judge(air, {0, 0, 0});
    BareRadio& sender = air.add_radio({100, 0, 0}, test::radio_of_power(0.002));
    BareRadio& close = air.add_radio({-600, 0, 0}, test::radio_of_power(0.002));
    BareRadio& far = air.add_radio({0, 9000, 0}, test::radio_of_power(0.002));
    for (BareRadio* each : {&sender, &close, &far}) {
        air.at(us(10), [each] { each->send(us(100)); });
    }
    air.run();
    EXPECT_LE(judge.bound_sum_w, judge.most_sum_w * 1.01);
}

}  // namespace
}  // namespace netsim
