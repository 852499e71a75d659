#include "netsim/config/medium_config.hpp"

#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

TEST(MediumConfig, DefaultIsTheScalar80211Medium) {
    const MediumConfig config;
    EXPECT_EQ(config.type_name, "Ieee80211ScalarRadioMedium");
    EXPECT_EQ(config.path_loss, "FreeSpacePathLoss");
    EXPECT_DOUBLE_EQ(config.background_noise_w, w_from_dbm(-110));
}

TEST(MediumConfig, The802154MediumHasABreakpointAndMoreNoise) {
    const MediumConfig config("Ieee802154NarrowbandScalarRadioMedium");
    EXPECT_EQ(config.path_loss, "BreakpointPathLoss");
    EXPECT_DOUBLE_EQ(config.background_noise_w, w_from_dbm(-96.616));
}

TEST(MediumConfig, EveryTypeIsValidAsItComes) {
    for (const std::string_view type_name : medium_type_names) {
        EXPECT_NO_THROW(MediumConfig(std::string(type_name)).validate()) << type_name;
    }
}

TEST(MediumConfig, UnknownTypeIsAnErrorAtOnce) {
    EXPECT_EQ(
        error_text([] { MediumConfig("UnitDisc"); }),
        "medium.typename = \"UnitDisc\": expected one of Ieee80211ScalarRadioMedium, "
        "Ieee802154NarrowbandScalarRadioMedium, UnitDiskRadioMedium; did you mean UnitDiskRadioMedium?");
}

// Sets one field of a valid configuration and validates.
template <typename Value>
std::string text_with(Value MediumConfig::* field, Value value) {
    MediumConfig config;
    config.*field = std::move(value);
    return error_text([&] { config.validate(); });
}

TEST(MediumConfig, ValidateNamesTheField) {
    EXPECT_EQ(text_with(&MediumConfig::alpha, -1.0), "medium.alpha = -1: expected more than 0");
    EXPECT_EQ(text_with(&MediumConfig::breakpoint_distance_m, 0.0),
              "medium.breakpoint_distance_m = 0 m: expected more than 0 m");
    EXPECT_EQ(text_with(&MediumConfig::l01_db, std::numeric_limits<double>::infinity()),
              "medium.l01_db = inf dB: expected a finite number");
    EXPECT_EQ(text_with(&MediumConfig::l02_db, std::numeric_limits<double>::infinity()),
              "medium.l02_db = inf dB: expected a finite number");
    EXPECT_EQ(text_with(&MediumConfig::alpha1, 0.0), "medium.alpha1 = 0: expected more than 0");
    EXPECT_EQ(text_with(&MediumConfig::alpha2, 0.0), "medium.alpha2 = 0: expected more than 0");
    EXPECT_EQ(text_with<std::string>(&MediumConfig::background_noise, "Thermal"),
              "medium.background_noise = \"Thermal\": expected one of IsotropicScalarBackgroundNoise, "
              "ThermalNoise; "
              "did you mean ThermalNoise?");
    EXPECT_EQ(text_with(&MediumConfig::temperature_k, -1.0),
              "medium.temperature_k = -1 K: expected at least 0 K");
    EXPECT_EQ(text_with(&MediumConfig::background_noise_w, -1e-14),
              "medium.background_noise_w = -1e-14 W: expected at least 0 W");
    EXPECT_EQ(text_with<std::string>(&MediumConfig::path_loss, "TwoRay"),
              "medium.path_loss = \"TwoRay\": expected one of FreeSpacePathLoss, BreakpointPathLoss, "
              "TwoRayGroundReflection, TwoRayInterference, LogNormalShadowing, RayleighFading, RicianFading, "
              "NakagamiFading; did you mean RicianFading?");
    EXPECT_EQ(text_with(&MediumConfig::epsilon_r, 0.9), "medium.epsilon_r = 0.9: expected at least 1");
    EXPECT_EQ(
        text_with<std::string>(&MediumConfig::polarization, "circular"),
        "medium.polarization = \"circular\": expected one of horizontal, vertical; did you mean vertical?");
    EXPECT_EQ(text_with(&MediumConfig::sigma_db, -1.0),
              "medium.sigma_db = -1 dB: expected from 0 dB to 40 dB");
    EXPECT_EQ(text_with(&MediumConfig::k_db, 101.0), "medium.k_db = 101 dB: expected from -100 dB to 100 dB");
    EXPECT_EQ(text_with(&MediumConfig::shape_factor, 0.4),
              "medium.shape_factor = 0.4: expected from 0.5 to 1000");
    EXPECT_EQ(text_with(&MediumConfig::coherence_time_s, 1e-9),
              "medium.coherence_time_s = 1e-09 s: expected from 1e-06 s to 1000000 s, 0 s (new for each "
              "transmission) or -1 s (that of the model)");
    EXPECT_EQ(text_with<std::string>(&MediumConfig::propagation, "Instant"),
              "medium.propagation = \"Instant\": expected ConstantSpeedPropagation");
    EXPECT_NE(text_with<std::string>(&MediumConfig::type_name, "Air"), "no error");
}

TEST(MediumConfig, TheCoherenceTimeIsThatOfTheModelUnlessItIsSet) {
    MediumConfig config;
    config.path_loss = "RayleighFading";
    EXPECT_EQ(config.coherence_time(), 0.005);
    config.path_loss = "LogNormalShadowing";
    EXPECT_EQ(config.coherence_time(), 1);
    for (const double set_s : {0.0, 1e-6, 0.25}) {
        config.coherence_time_s = set_s;
        EXPECT_NO_THROW(config.validate());
        EXPECT_EQ(config.coherence_time(), set_s);
    }
}

TEST(MediumConfig, NoNoiseIsAllowed) {
    EXPECT_EQ(text_with(&MediumConfig::background_noise_w, 0.0), "no error");
}

}  // namespace
}  // namespace netsim
