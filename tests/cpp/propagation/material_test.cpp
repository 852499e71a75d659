// Expected numbers were computed from the formulas with complex arithmetic in Python, not with this
// code.
#include "netsim/propagation/material.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;

Material material(const char* name) {
    ObstacleConfig config;
    config.material = name;
    return make_material(config, channel_1_hz);
}

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180);
}

TEST(Material, WeakensByTheLengthInside) {
    EXPECT_NEAR(-db_from_ratio(material("concrete").gain_through(1)), 65.60900864270671, 1e-9);
    EXPECT_NEAR(-db_from_ratio(material("glass").gain_through(0.01)), 0.07625151589879945, 1e-12);
    EXPECT_EQ(material("metal").gain_through(0.01), 0);
    EXPECT_EQ(material("metal").gain_through(0), 1);
}

TEST(Material, ReflectsAtFaces) {
    EXPECT_NEAR(material("concrete").gain_at_face(1), 0.8439471514728277, 1e-12);
    EXPECT_NEAR(material("concrete").gain_at_face(cosine(60)), 0.8011202829333058, 1e-12);
    EXPECT_NEAR(material("concrete").gain_at_face(cosine(89)), 0.09799590583140749, 1e-12);
    EXPECT_NEAR(material("glass").gain_at_face(cosine(60)), 0.7782088757348409, 1e-12);
    EXPECT_NEAR(material("metal").gain_at_face(1), 0.00032758710721325635, 1e-12);
}

TEST(Material, ReflectsAllAtGrazingIncidence) {
    EXPECT_EQ(material("concrete").gain_at_face(0), 0);
}

TEST(Material, AirIsNothing) {
    const Material air(1, 0, channel_1_hz);
    EXPECT_EQ(air.gain_through(1e6), 1);
    for (const double degrees : {0.0, 30.0, 89.9}) {
        EXPECT_NEAR(air.gain_at_face(cosine(degrees)), 1, 1e-12);
    }
}

TEST(Material, WithoutLossesAtBrewstersAngleReflectsOnePolarisationOnly) {
    // tan θ = n: nothing of the one is reflected, ((n² - 1) / (n² + 1))² of the other.
    const Material lossless(4, 0, channel_1_hz);
    EXPECT_NEAR(lossless.gain_at_face(1 / std::sqrt(5.0)), 1 - 0.36 / 2, 1e-12);
}

TEST(Material, OfAnObstacleCanBeItsOwn) {
    ObstacleConfig config;
    config.relative_permittivity = 1;
    config.conductivity_spm = 0;
    EXPECT_EQ(make_material(config, channel_1_hz).gain_through(100), 1);
}

TEST(Material, EveryNameIsInTheTable) {
    for (const std::string_view name : material_names) {
        ObstacleConfig config;
        config.material = name;
        const double gain = make_material(config, channel_1_hz).gain_through(0.1);
        EXPECT_GE(gain, 0) << name;
        EXPECT_LT(gain, 1) << name;
    }
}

}  // namespace
}  // namespace netsim
