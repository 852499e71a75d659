// Expected numbers were computed from complex amplitudes with 40 digits (mpmath), not with this
// code.
#include "netsim/propagation/two_ray.hpp"

#include <string>

#include <gtest/gtest.h>

#include "netsim/propagation/path_loss.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;

double loss_db(const MediumConfig& config, const Position& a, const Position& b) {
    return -db_from_ratio(TwoRay(config).gain(a, b, distance(a, b), channel_1_hz));
}

double interference_loss_db(const Position& a, const Position& b, double epsilon_r = 1.02,
                            const std::string& polarization = "horizontal", bool inet_vertical_sign = false) {
    MediumConfig config;
    config.path_loss = "TwoRayInterference";
    config.epsilon_r = epsilon_r;
    config.polarization = polarization;
    config.inet_vertical_sign = inet_vertical_sign;
    return loss_db(config, a, b);
}

double reflection_loss_db(const Position& a, const Position& b, double alpha = 2) {
    MediumConfig config;
    config.path_loss = "TwoRayGroundReflection";
    config.alpha = alpha;
    return loss_db(config, a, b);
}

TEST(TwoRayInterference, IsTheSumOfTwoRays) {
    EXPECT_NEAR(interference_loss_db({0, 0, 1.5}, {100, 0, 1.5}), 76.515662676431545, 1e-9);
    EXPECT_NEAR(interference_loss_db({0, 0, 20}, {300, 400, 60}), 93.550862401958083, 1e-9);
    EXPECT_NEAR(interference_loss_db({0, 0, 20}, {300, 400, 60}, 15), 90.01587644303058, 1e-9);
    EXPECT_NEAR(interference_loss_db({0, 0, 20}, {300, 400, 60}, 15, "vertical"), 93.216756075462540, 1e-9);
    EXPECT_NEAR(interference_loss_db({0, 0, 2}, {5000, 0, 1}, 4, "vertical"), 141.93048013981582, 1e-7);
    EXPECT_NEAR(interference_loss_db({0, 0, 2}, {5000, 0, 1}, 4), 141.94052751792953, 1e-7);
}

TEST(TwoRayInterference, FarAwayIsTheLimitOfTheGroundReflectionForBothPolarizations) {
    for (const char* polarization : {"horizontal", "vertical"}) {
        for (const double distance_m : {2000.0, 20000.0}) {
            const Position a{0, 0, 1.2};
            const Position b{distance_m, 0, 1.2};
            EXPECT_NEAR(interference_loss_db(a, b, 5, polarization), reflection_loss_db(a, b), 0.03)
                << polarization;
        }
    }
}

TEST(TwoRayInterference, TheSignOfInetIsForVerticalPolarizationOnly) {
    const Position a{0, 0, 20};
    const Position b{300, 400, 60};
    EXPECT_NEAR(interference_loss_db(a, b, 15, "vertical", true), 94.682716523795352, 1e-9);
    EXPECT_EQ(interference_loss_db(a, b, 15, "horizontal", true), interference_loss_db(a, b, 15));
}

TEST(TwoRayInterference, WithoutAGroundIsFreeSpace) {
    const Position a{0, 0, 2};
    const Position b{100, 30, 7};
    const double gain = make_path_loss(MediumConfig()).gain(distance(a, b), channel_1_hz);
    EXPECT_NEAR(interference_loss_db(a, b, 1), -db_from_ratio(gain), 1e-9);
    EXPECT_NEAR(interference_loss_db(a, b, 1, "vertical"), -db_from_ratio(gain), 1e-9);
    EXPECT_NEAR(interference_loss_db({0, 0, 0}, {100, 0, 0}, 1),
                -db_from_ratio(make_path_loss(MediumConfig()).gain(100, channel_1_hz)), 1e-9);
}

// Γ is −1 and both rays have the same length.
TEST(TwoRayInterference, OnTheGroundNothingIsLeft) {
    MediumConfig config;
    config.path_loss = "TwoRayInterference";
    EXPECT_EQ(TwoRay(config).gain({0, 0, 0}, {100, 0, 0}, 100, channel_1_hz), 0);
}

TEST(TwoRayGroundReflection, IsFreeSpaceUpToTheCrossover) {
    // At heights of 2 m the distance is 404.4 m.
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {100, 0, 2}), 80.095329291245648, 1e-9);
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {404.4142, 0, 2}),
                reflection_loss_db({0, 0, 2}, {404.4143, 0, 2}), 1e-5);
}

TEST(TwoRayGroundReflection, FallsWithTheFourthPowerBeyondWhateverTheCarrier) {
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {1000, 0, 2}), 107.95880017344075, 1e-9);
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {2000, 0, 2}) - reflection_loss_db({0, 0, 2}, {1000, 0, 2}),
                12.041199826559248, 1e-9);
}

TEST(TwoRayGroundReflection, AlphaIsTheExponentBelowTheCrossover) {
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {100, 0, 2}, 2.5), 80.095329291245648 + 10, 1e-9);
    EXPECT_NEAR(reflection_loss_db({0, 0, 2}, {1000, 0, 2}, 2.5), 107.95880017344075, 1e-9);
}

TEST(TwoRay, NeverAmplifiesAndIsTheSameInBothDirectionsAndMirroredAtTheGround) {
    for (const char* name : {"TwoRayGroundReflection", "TwoRayInterference"}) {
        MediumConfig config;
        config.path_loss = name;
        const TwoRay two_ray(config);
        const Position a{1, 2, 3};
        for (const Position& b : {a, Position{1, 2, 3.001}, Position{70, -20, 11}, Position{1, 2, 100}}) {
            const double gain = two_ray.gain(a, b, distance(a, b), channel_1_hz);
            EXPECT_LE(gain, 1) << name;
            EXPECT_EQ(gain, two_ray.gain(b, a, distance(a, b), channel_1_hz)) << name;
            const Position below_a{a.x, a.y, -a.z};
            const Position below_b{b.x, b.y, -b.z};
            EXPECT_EQ(gain, two_ray.gain(below_a, below_b, distance(a, b), channel_1_hz)) << name;
        }
        EXPECT_EQ(two_ray.gain(a, a, 0, channel_1_hz), 1) << name;
    }
}

}  // namespace
}  // namespace netsim
