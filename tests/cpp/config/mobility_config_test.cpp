#include "netsim/config/mobility_config.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

// Sets one field of a valid configuration and validates.
template <typename Value>
std::string text_with(Value MobilityConfig::* field, Value value) {
    MobilityConfig config;
    config.*field = std::move(value);
    return error_text([&] { config.validate(); });
}

TEST(MobilityConfig, DefaultsAreValid) {
    EXPECT_NO_THROW(MobilityConfig().validate());
}

TEST(MobilityConfig, ValidateNamesTheField) {
    EXPECT_EQ(text_with<std::string>(&MobilityConfig::type_name, "StaticMobility"),
              "mobility.typename = \"StaticMobility\": expected one of MasslessMobility, StationaryMobility; "
              "did you "
              "mean StationaryMobility?");
    EXPECT_EQ(text_with(&MobilityConfig::speed_mps, -1.0),
              "mobility.speed_mps = -1 m/s: expected at least 0 m/s");
    EXPECT_EQ(text_with(&MobilityConfig::telemetry_interval_s, 1e-9),
              "mobility.telemetry_interval_s = 1e-09 s: expected from 1e-06 s to 1000000 s");
}

TEST(MobilityConfig, NoTelemetryIsAllowed) {
    EXPECT_EQ(text_with(&MobilityConfig::telemetry_interval_s, 0.0), "no error");
}

}  // namespace
}  // namespace netsim
