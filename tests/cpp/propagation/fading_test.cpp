#include "netsim/propagation/fading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

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
        EXPECT_EQ(fading.max(), 1) << name;
    }
}

TEST(Fading, IsCutOffAtWhatComesOnceInABillionDraws) {
    // −ln 10⁻⁹, and the quantile of m = 2.5 (mpmath).
    EXPECT_NEAR(Fading(config_of("RayleighFading"), 1).max(), 20.72326583694641, 1e-12);
    EXPECT_NEAR(Fading(config_of("NakagamiFading"), 1).max(), 20.72326583694641, 1e-12);
    MediumConfig nakagami = config_of("NakagamiFading");
    nakagami.shape_factor = 2.5;
    EXPECT_NEAR(Fading(nakagami, 1).max(), 25.346096850771514 / 2.5, 1e-11);
    MediumConfig shadowing = config_of("LogNormalShadowing");
    shadowing.sigma_db = 4;
    EXPECT_NEAR(db_from_ratio(Fading(shadowing, 1).max()), 4 * 5.9978070150076869, 1e-11);
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

// Computing a link with more or less precision must not affect results.
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
                for (const double least : {gain / 2, gain, 2.0, 5.0, fading.max()}) {
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
    EXPECT_EQ(fading.max(), 1);
    EXPECT_TRUE(fading.is_none());
    EXPECT_TRUE(Fading::shadowing(shadowing, 1).is_none());
}

TEST(Fading, ChancesOfShadowingAreThoseOfANormalNumber) {
    for (const double sigma_db : {0.05, 1.0, 6.0, 40.0}) {
        MediumConfig shadowing = config_of("LogNormalShadowing");
        shadowing.sigma_db = sigma_db;
        const Fading fading(shadowing, 1);
        for (const double z : {-5.0, -1.0, 0.0, 0.3, 5.0}) {
            EXPECT_NEAR(fading.chance_of(ratio_from_db(sigma_db * z)), std::erfc(z / std::numbers::sqrt2) / 2,
                        1e-12)
                << sigma_db << " dB, " << z;
        }
    }
}

// Γ(m, x) / Γ(m) for whole and half m. Source: M. Abramowitz, I. A. Stegun, "Handbook of
// Mathematical Functions", 1964, 6.5.13, 6.5.17 and 6.5.22.
double gamma_above(double shape, double x) {
    const bool is_whole = shape == std::floor(shape);
    double above = is_whole ? std::exp(-x) : std::erfc(std::sqrt(x));
    const double first = is_whole ? 1 : 0.5;
    for (int step = 0; first + step < shape; ++step) {
        const double m = first + step;
        above += std::exp(m * std::log(x) - x - std::lgamma(m + 1));
    }
    return above;
}

TEST(Fading, ChancesOfNakagamiAreClosedFormsForWholeAndHalfShapes) {
    for (const double shape : {0.5, 1.0, 1.5, 2.0, 3.0, 7.5, 20.0}) {
        MediumConfig nakagami = config_of("NakagamiFading");
        nakagami.shape_factor = shape;
        const Fading fading(nakagami, 1);
        for (const double gain : {1e-6, 0.01, 0.3, 1.0, 2.5, 2.8}) {
            EXPECT_NEAR(fading.chance_of(gain), gamma_above(shape, shape * gain), 1e-12)
                << shape << " " << gain;
        }
    }
}

TEST(Fading, ChancesOfRayleighAreExponentialAndThoseOfNakagamiWithAShapeOf1) {
    const Fading rayleigh(config_of("RayleighFading"), 1);
    const Fading nakagami(config_of("NakagamiFading"), 1);
    for (const double gain : {0.0, 1e-6, 0.01, 0.3, 1.0, 2.5, 20.0}) {
        EXPECT_DOUBLE_EQ(rayleigh.chance_of(gain), std::exp(-gain));
        EXPECT_EQ(nakagami.chance_of(gain), rayleigh.chance_of(gain));
    }
}

// The power of k + 1 complex numbers, k drawn from Poisson's distribution of mean K. Source: M.
// Abramowitz, I. A. Stegun, as above, 26.4.25.
TEST(Fading, ChancesOfRicianAreThoseOfGammaWithAShapeFromPoisson) {
    for (const double k_db : {-100.0, -10.0, 0.0, 8.0, 20.0}) {
        MediumConfig rician = config_of("RicianFading");
        rician.k_db = k_db;
        const Fading fading(rician, 1);
        const double k = ratio_from_db(k_db);
        for (const double gain : {1e-6, 0.01, 0.1, 0.3, 0.7, 1.0, 1.3, 2.5, 6.0}) {
            double expected = 0;
            for (int drawn = 0; drawn < 300; ++drawn) {
                expected += std::exp(drawn * std::log(k) - k - std::lgamma(drawn + 1)) *
                            gamma_above(drawn + 1, (k + 1) * gain);
            }
            if (gain < fading.max()) {
                EXPECT_NEAR(fading.chance_of(gain), expected, 1e-12) << k_db << " dB, " << gain;
            }
        }
    }
}

TEST(Fading, ChancesOfAStrongLineOfSightAreThoseOfANormalNumber) {
    MediumConfig rician = config_of("RicianFading");
    rician.k_db = 100;
    const Fading fading(rician, 1);
    for (const double z : {-5.0, -1.0, 0.0, 0.3, 5.0}) {
        const double gain = 1 + z * std::sqrt(2 / ratio_from_db(100));
        EXPECT_NEAR(fading.chance_of(gain), std::erfc(z / std::numbers::sqrt2) / 2, 1e-5) << z;
    }
}

TEST(Fading, NothingHasAChanceBeyondWhereItIsCutOff) {
    for (const char* name : {"LogNormalShadowing", "RayleighFading", "RicianFading", "NakagamiFading"}) {
        const Fading fading(config_of(name), 1);
        EXPECT_GT(fading.chance_of(fading.max()), 0) << name;
        EXPECT_EQ(fading.chance_of(fading.max() * 1.001), 0) << name;
        EXPECT_EQ(fading.chance_of(0), 1) << name;
    }
    EXPECT_EQ(Fading(config_of("FreeSpacePathLoss"), 1).chance_of(1), 1);
    EXPECT_EQ(Fading(config_of("FreeSpacePathLoss"), 1).chance_of(1.001), 0);
}

MediumConfig with_parameters(const char* name) {
    MediumConfig config = config_of(name);
    config.k_db = 3;
    config.shape_factor = 1.7;
    config.sigma_db = 5;
    return config;
}

TEST(Fading, GainsAreDrawnWithTheChancesThatItTells) {
    constexpr int draws = 20'000;
    for (const char* name : {"LogNormalShadowing", "RayleighFading", "RicianFading", "NakagamiFading"}) {
        const Fading fading(with_parameters(name), 3);
        std::vector<double> gains;
        for (int id = 0; id < draws; ++id) {
            gains.push_back(fading.gain(0, 1, SimTime(), static_cast<std::uint64_t>(id)));
        }
        std::ranges::sort(gains, std::greater());
        double farthest = 0;
        for (int i = 0; i < draws; ++i) {
            const double share = (i + 0.5) / draws;  // probability of at least that gain
            farthest =
                std::max(farthest, std::abs(share - fading.chance_of(gains[static_cast<std::size_t>(i)])));
        }
        // Kolmogorov's limit: exceeded once in a million samples.
        EXPECT_LT(farthest, 2.7 / std::sqrt(draws)) << name;
    }
}

TEST(Fading, TheMeanIsThatOfTheChances) {
    MediumConfig wide = config_of("LogNormalShadowing");
    wide.sigma_db = 40;
    for (const MediumConfig& config :
         {with_parameters("LogNormalShadowing"), with_parameters("RayleighFading"),
          with_parameters("RicianFading"), with_parameters("NakagamiFading"), wide}) {
        const Fading fading(config, 1);
        constexpr double step = 0.005;  // of the natural logarithm
        double sum = 0;
        for (int i = 0; i < 10'000; ++i) {
            const double log = std::log(fading.max()) - step * (i + 0.5);
            sum += fading.chance_of(std::exp(log)) * std::exp(log) * step;
        }
        EXPECT_NEAR(sum / fading.mean(), 1, 1e-5) << config.path_loss;
    }
    EXPECT_DOUBLE_EQ(Fading(config_of("FreeSpacePathLoss"), 1).mean(), 1);
}

}  // namespace
}  // namespace netsim
