#include "netsim/medium/fading.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "netsim/units.hpp"

namespace netsim {
namespace {

MediumConfig config_of(const std::string& path_loss) {
    MediumConfig config;
    config.path_loss = path_loss;
    config.coherence_time_s = 0;
    return config;
}

double mean_gain(const MediumConfig& config) {
    const Fading fading(config, 3);
    constexpr std::uint64_t draws = 20'000;
    double sum = 0;
    for (std::uint64_t id = 0; id < draws; ++id) {
        sum += fading.gain(0, 1, SimTime(), id);
    }
    return sum / draws;
}

TEST(Fading, ThereIsNoneInThePureModelsOfPathLoss) {
    for (const char* name :
         {"FreeSpacePathLoss", "BreakpointPathLoss", "TwoRayGroundReflection", "TwoRayInterference"}) {
        const Fading fading(config_of(name), 1);
        EXPECT_TRUE(fading.is_none()) << name;
        EXPECT_EQ(fading.gain(0, 1, SimTime(), 0), 1) << name;
        EXPECT_EQ(fading.most(), 1) << name;
    }
}

TEST(Fading, IsCutOffAtWhatComesOnceInABillionDraws) {
    // −ln 10⁻⁹, and the quantile of m = 2.5 (mpmath).
    EXPECT_NEAR(Fading(config_of("RayleighFading"), 1).most(), 20.72326583694641, 1e-12);
    EXPECT_NEAR(Fading(config_of("NakagamiFading"), 1).most(), 20.72326583694641, 1e-12);
    MediumConfig nakagami = config_of("NakagamiFading");
    nakagami.shape_factor = 2.5;
    EXPECT_NEAR(Fading(nakagami, 1).most(), 25.346096850771514 / 2.5, 1e-11);
    MediumConfig shadowing = config_of("LogNormalShadowing");
    shadowing.sigma_db = 4;
    EXPECT_NEAR(db_from_ratio(Fading(shadowing, 1).most()), 4 * 5.9978070150076869, 1e-11);
}

TEST(Fading, WithoutALineOfSightRicianIsRayleigh) {
    MediumConfig rician = config_of("RicianFading");
    rician.k_db = -100;
    const Fading scattered(rician, 1);
    const Fading rayleigh(config_of("RayleighFading"), 1);
    for (std::uint64_t id = 0; id < 100; ++id) {
        EXPECT_NEAR(scattered.gain(0, 1, SimTime(), id), rayleigh.gain(0, 1, SimTime(), id), 2e-4);
    }
}

TEST(Fading, AStrongLineOfSightLeavesNothingToChance) {
    MediumConfig rician = config_of("RicianFading");
    rician.k_db = 100;
    EXPECT_NEAR(Fading(rician, 1).gain(0, 1, SimTime(), 5), 1, 1e-4);
}

TEST(Fading, MeanPowerIsUnchanged) {
    // Five standard errors; the variance of the power is at most 2.
    EXPECT_NEAR(mean_gain(config_of("RayleighFading")), 1, 5 / std::sqrt(20'000));
    EXPECT_NEAR(mean_gain(config_of("RicianFading")), 1, 5 / std::sqrt(20'000));
    for (const double shape : {0.5, 1.0, 3.7}) {
        MediumConfig nakagami = config_of("NakagamiFading");
        nakagami.shape_factor = shape;
        EXPECT_NEAR(mean_gain(nakagami), 1, 5 * std::sqrt(1 / shape / 20'000)) << shape;
    }
}

// Whether a link is looked at closely must not show in any result.
TEST(Fading, WhereALeastGainIsGivenEitherItIsTheSameOrThereIsLess) {
    MediumConfig config;
    config.k_db = 3;
    config.shape_factor = 1.7;
    config.sigma_db = 5;
    for (const char* name : {"LogNormalShadowing", "RayleighFading", "RicianFading", "NakagamiFading"}) {
        config.path_loss = name;
        for (const double coherence_time_s : {0.0, 0.005}) {
            config.coherence_time_s = coherence_time_s;
            const Fading fading(config, 9);
            int left_out = 0;
            for (std::uint64_t id = 0; id < 3000; ++id) {
                const SimTime time = SimTime::from_us(static_cast<std::int64_t>(37 * id));
                const double gain = fading.gain(0, 1, time, id);
                for (const double least : {gain / 2, gain, 2.0, 5.0, fading.most()}) {
                    const double found = fading.gain(0, 1, time, id, least);
                    left_out += found == gain ? 0 : 1;
                    ASSERT_TRUE(found == gain || (found == 0 && gain < least))
                        << name << ": " << found << " for " << gain << ", at least " << least;
                }
            }
            EXPECT_GT(left_out, 3000) << name;
        }
    }
}

TEST(Fading, ShadowingWithoutASpreadIsNone) {
    MediumConfig shadowing = config_of("LogNormalShadowing");
    shadowing.sigma_db = 0;
    const Fading fading(shadowing, 1);
    EXPECT_EQ(fading.gain(0, 1, SimTime(), 5), 1);
    EXPECT_EQ(fading.most(), 1);
}

}  // namespace
}  // namespace netsim
