#include "netsim/mobility/stationary_mobility.hpp"

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim {
namespace {

TEST(StationaryMobility, StandsWhereItWasPut) {
    const StationaryMobility mobility({1, 2, 3});
    EXPECT_EQ(mobility.trajectory().position_at(SimTime::from_seconds(100)), (Position{1, 2, 3}));
}

TEST(StationaryMobility, RefusesToGo) {
    StationaryMobility mobility({1, 2, 3});
    EXPECT_THROW(mobility.go_to(SimTime(), {0, 0, 0}), SimulationError);
}

TEST(StationaryMobility, RefusesASpeed) {
    StationaryMobility mobility({1, 2, 3});
    EXPECT_THROW(mobility.set_speed(SimTime(), 0), SimulationError);
}

}  // namespace
}  // namespace netsim
