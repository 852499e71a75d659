#include "netsim/medium/background_noise.hpp"

#include <gtest/gtest.h>

#include "netsim/units.hpp"

namespace netsim {
namespace {

TEST(BackgroundNoise, IsEqualForAllReceiversByDefault) {
    const BackgroundNoise noise{MediumConfig()};
    EXPECT_EQ(noise.power_w(22e6, 1), MediumConfig().background_noise_w);
    EXPECT_EQ(noise.power_w(1e6, 5), MediumConfig().background_noise_w);
}

MediumConfig thermal(double temperature_k) {
    MediumConfig config;
    config.background_noise = "ThermalNoise";
    config.temperature_k = temperature_k;
    return config;
}

// The textbook value: -174 dBm in 1 Hz at 290 K.
TEST(BackgroundNoise, ThermalNoiseMatchesTheTextbookFormula) {
    EXPECT_NEAR(dbm_from_w(BackgroundNoise(thermal(290)).power_w(1, 1)), -173.98, 0.005);
    EXPECT_NEAR(dbm_from_w(BackgroundNoise(thermal(290)).power_w(20e6, ratio_from_db(7))), -93.965, 0.005);
}

TEST(BackgroundNoise, ThermalNoiseGrowsWithTemperatureBandwidthAndNoiseFigure) {
    const double noise_w = BackgroundNoise(thermal(145)).power_w(11e6, 2);
    EXPECT_DOUBLE_EQ(BackgroundNoise(thermal(290)).power_w(11e6, 2), 2 * noise_w);
    EXPECT_DOUBLE_EQ(BackgroundNoise(thermal(145)).power_w(22e6, 2), 2 * noise_w);
    EXPECT_DOUBLE_EQ(BackgroundNoise(thermal(145)).power_w(11e6, 4), 2 * noise_w);
    EXPECT_EQ(BackgroundNoise(thermal(0)).power_w(22e6, 2), 0);
}

}  // namespace
}  // namespace netsim
