#include "netsim/mobility/mobility.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "netsim/mobility/massless_mobility.hpp"
#include "netsim/mobility/path_mobility.hpp"
#include "netsim/mobility/stationary_mobility.hpp"

namespace netsim {
namespace {

std::unique_ptr<Mobility> mobility_named(const char* type_name) {
    MobilityConfig config;
    config.type_name = type_name;
    config.speed_mps = 3;
    config.area_min = config.center = {5, 0, 0};
    return make_mobility(config, {5, 0, 0});
}

TEST(MakeMobility, EveryNameOfTheConfigurationHasAModel) {
    for (const std::string_view name : mobility_type_names) {
        const auto mobility = mobility_named(std::string(name).c_str());
        EXPECT_EQ(mobility->trajectory().position_at(SimTime()), (Position{5, 0, 0})) << name;
    }
}

TEST(MakeMobility, ChoosesByName) {
    EXPECT_NE(dynamic_cast<MasslessMobility*>(mobility_named("MasslessMobility").get()), nullptr);
    EXPECT_NE(dynamic_cast<StationaryMobility*>(mobility_named("StationaryMobility").get()), nullptr);
    EXPECT_NE(dynamic_cast<PathMobility*>(mobility_named("CircleMobility").get()), nullptr);
}

TEST(MakeMobility, HandsTheSpeedOn) {
    const auto mobility = mobility_named("MasslessMobility");
    mobility->go_to(SimTime(), {105, 0, 0});
    EXPECT_NEAR(mobility->trajectory().position_at(SimTime::from_seconds(10)).x, 35, 1e-9);
}

}  // namespace
}  // namespace netsim
