#include "netsim/node/flight_clock.hpp"

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::Recorder;

SimTime ms(double milliseconds) {
    return SimTime::from_seconds(milliseconds / 1000);
}

struct Flight {
    explicit Flight(double telemetry_interval_s = 0.01) {
        NodeConfig config = test::silent_node();
        config.mobility.type_name = "QuadcopterMobility";
        config.mobility.telemetry_interval_s = telemetry_interval_s;
        config.initial_position = {0, 0, 20};
        recorder = &test::add_recorder(network, config);
    }
    double x_at(SimTime time) {
        network.run_until(time);
        return recorder->node.position().x;
    }
    void go() const { recorder->node.go_to({100, 0, 20}); }

    Network network{MediumConfig(), 1};
    Recorder* recorder;
};

TEST(FlightClock, ACommandOfTheStartHoldsAtOnce) {
    Flight flight;
    flight.recorder->on_initialize = [](Recorder& self) { self.node.go_to({100, 0, 20}); };
    flight.network.initialize();
    flight.network.run_until(ms(100));
    Flight idle;
    idle.network.initialize();
    EXPECT_EQ(idle.x_at(ms(100)), 0);
    EXPECT_GT(flight.recorder->node.position().x, 0);
}

TEST(FlightClock, ACommandHoldsFromTheNextUpdateOn) {
    // It tilts during the first update that it holds for, and moves from the second one on.
    Flight flight;
    flight.network.initialize();
    flight.network.run_until(ms(105));
    flight.go();
    EXPECT_EQ(flight.x_at(ms(110)), 0);
    EXPECT_GT(flight.x_at(ms(120)), 0);
}

TEST(FlightClock, AnAnswerToTelemetryHoldsAtOnce) {
    for (const double interval_s : {0.01, 0.002}) {
        Flight flight(interval_s);
        flight.recorder->on_telemetry = [](Recorder& self) {
            if (self.node.now() == ms(100)) {
                self.node.go_to({100, 0, 20});
            }
        };
        flight.network.initialize();
        EXPECT_EQ(flight.x_at(ms(100)), 0);
        EXPECT_GT(flight.x_at(ms(110)), 0) << interval_s;
    }
}

}  // namespace
}  // namespace netsim
