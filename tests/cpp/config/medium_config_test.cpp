#include "netsim/config/medium_config.hpp"

#include <string>

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

TEST(MediumConfig, ACoherenceTimeBelowAMicrosecondIsRejected) {
    MediumConfig config;
    config.coherence_time_s = 1e-9;
    EXPECT_EQ(
        error_text([&] { config.validate(); }),
        "medium.coherence_time_s = 1e-09 s: expected at least 1e-06 s, or 0 s (new for each transmission)");
    config.coherence_time_s = 0;
    config.shadowing_decorrelation_time_s = 1e-9;
    EXPECT_EQ(
        error_text([&] { config.validate(); }),
        "medium.shadowing_decorrelation_time_s = 1e-09 s: expected at least 1e-06 s, or 0 s (new for each "
        "transmission)");
}

}  // namespace
}  // namespace netsim
