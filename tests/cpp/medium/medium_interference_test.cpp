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

// Compares the bounds of the interference with the sum, at the end of every lockable arrival.
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
            const double max_w =
                medium_.interference_with(id_, arrival, arrival.start, arrival.end).worst_w();
            const double bound_w = medium_.max_interference_w(id_, arrival);
            EXPECT_LE(max_w, bound_w);
            EXPECT_LE(bound_w, medium_.max_interference_w(arrival) * (1 + 1e-6));
            disturbed += max_w > 0 ? 1 : 0;
            max_sum_w += max_w;
            bound_sum_w += bound_w;
        }
    }

    int disturbed = 0;
    double max_sum_w = 0;
    double bound_sum_w = 0;

private:
    Medium& medium_;
    Trajectory trajectory_;
    RadioId id_ = 0;
};

// Thirty senders in a square of 4 km, and a receiver that checks at its center. Each sends one
// frame within the duration of five.
void send_all_over(Air& air, std::uint64_t seed) {
    RandomStream draws(seed, 0, Purpose{1002});
    for (int i = 0; i < 30; ++i) {
        BareRadio& sender = air.add_radio({draws.uniform(-2000, 2000), draws.uniform(-2000, 2000), 5},
                                          test::radio_of_power(0.1));
        air.at(us(draws.uniform_int(500)), [&sender] { sender.send(us(100)); });
    }
    air.run();
}

class InterferenceBounds : public testing::TestWithParam<std::string_view> {};

TEST_P(InterferenceBounds, AreNeverBelowTheSum) {
    MediumConfig config;
    config.path_loss = GetParam();
    int disturbed = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Air air(config, Culling::enabled, seed);
        Judge judge(air, {0, 0, 5});
        send_all_over(air, seed);
        disturbed += judge.disturbed;
    }
    EXPECT_GT(disturbed, 10) << "too few overlap to judge by: with this path loss, senders are too far apart";
}

INSTANTIATE_TEST_SUITE_P(PathLosses, InterferenceBounds, testing::ValuesIn(path_loss_names));

TEST(InterferenceBound, AtAReceiverIsCloseToTheSum) {
    Air air;
    Judge judge(air, {0, 0, 0});
    BareRadio& sender = air.add_radio({100, 0, 0}, test::radio_of_power(0.002));
    BareRadio& close_interferers = air.add_radio({-600, 0, 0}, test::radio_of_power(0.002));
    BareRadio& far = air.add_radio({0, 9000, 0}, test::radio_of_power(0.002));
    for (BareRadio* each : {&sender, &close_interferers, &far}) {
        air.at(us(10), [each] { each->send(us(100)); });
    }
    air.run();
    EXPECT_LE(judge.bound_sum_w, judge.max_sum_w * 1.01);
}

}  // namespace
}  // namespace netsim
