// Expected numbers were computed from the formulas independently (Python), not with this code.
#include "netsim/phy/antenna.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;
constexpr double wavelength_m = speed_of_light_mps / channel_1_hz;
constexpr double pi = std::numbers::pi;

std::unique_ptr<const AntennaPattern> make(const AntennaConfig& config) {
    return make_antenna(config, channel_1_hz);
}

AntennaConfig dipole_config(double length_in_wavelengths) {
    AntennaConfig config;
    config.type_name = "DipoleAntenna";
    config.length_m = length_in_wavelengths * wavelength_m;
    return config;
}

AntennaConfig beam(const char* type_name, double max_gain_db, double beam_width_deg) {
    AntennaConfig config;
    config.type_name = type_name;
    config.max_gain = ratio_from_db(max_gain_db);
    config.beam_width_rad = beam_width_deg * pi / 180;
    return config;
}

double gain_db(const AntennaPattern& pattern, const Position& direction) {
    return db_from_ratio(pattern.gain(direction));
}

// In the x-y plane.
Position at_angle(double degrees) {
    return {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0};
}

// Over all directions; midpoint rule in the angle from z and around it.
double mean_gain(const AntennaPattern& pattern) {
    constexpr int steps = 600;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double z = -1 + (i + 0.5) * 2 / steps;
        for (int j = 0; j < steps; ++j) {
            const double around = (j + 0.5) * 2 * pi / steps;
            const double level = std::sqrt(1 - z * z);
            sum += pattern.gain({level * std::cos(around), level * std::sin(around), z});
        }
    }
    return sum / (static_cast<double>(steps) * steps);
}

TEST(IsotropicAntenna, HasNoPattern) {
    EXPECT_EQ(make(AntennaConfig()), nullptr);
    EXPECT_EQ(MountedAntenna().gain_towards({1, 2, 3}, Trajectory({}), SimTime()), 1);
    EXPECT_EQ(MountedAntenna().max_gain(), 1);
}

TEST(ConstantGainAntenna, IsTheSameEverywhere) {
    AntennaConfig config;
    config.type_name = "ConstantGainAntenna";
    config.gain = ratio_from_db(-3);
    EXPECT_DOUBLE_EQ(make(config)->gain({1, -2, 3}), ratio_from_db(-3));
    EXPECT_DOUBLE_EQ(make(config)->max_gain(), ratio_from_db(-3));
}

TEST(DipoleAntenna, OfNoLengthIsTheInfinitesimalDipole) {
    const auto pattern = make(dipole_config(0));
    EXPECT_NEAR(pattern->gain({1, 1, 0}), 1.5, 1e-12);
    EXPECT_NEAR(pattern->gain({1, 0, 1}), 0.75, 1e-12);
    EXPECT_EQ(pattern->gain({0, 0, -2}), 0);
}

TEST(DipoleAntenna, HasTheDirectivityOfItsLength) {
    EXPECT_NEAR(make(dipole_config(0.1))->max_gain(), 1.504959848559, 1e-9);
    EXPECT_NEAR(make(dipole_config(0.5))->max_gain(), 1.640922376985, 1e-9);
    EXPECT_NEAR(make(dipole_config(0.75))->max_gain(), 1.882074452564, 1e-9);
    EXPECT_NEAR(make(dipole_config(1))->max_gain(), 2.410997637497, 1e-9);
    const Position at_60_deg_from_the_wire{std::sin(pi / 3), 0, std::cos(pi / 3)};
    EXPECT_NEAR(make(dipole_config(0.5))->gain(at_60_deg_from_the_wire), 1.093948251323, 1e-9);
}

TEST(DipoleAntenna, LiesAlongItsWireAxis) {
    for (const auto& [axis, wire] : {std::pair{"x", Position{1, 0, 0}}, std::pair{"y", Position{0, 1, 0}},
                                     std::pair{"z", Position{0, 0, 1}}}) {
        AntennaConfig config = dipole_config(0.5);
        config.wire_axis = axis;
        const auto pattern = make(config);
        EXPECT_EQ(pattern->gain(wire), 0) << axis;
        EXPECT_NEAR(pattern->gain({wire.y, wire.z, wire.x}), pattern->max_gain(), 1e-12) << axis;
    }
}

TEST(DipoleAntenna, IsLossless) {
    for (const double length : {0.0, 1e-6, 0.01, 0.25, 0.5, 1.0}) {
        EXPECT_NEAR(mean_gain(*make(dipole_config(length))), 1, 2e-5) << length << " wavelengths";
    }
}

TEST(CosineAntenna, IsHalfAtHalfTheBeamWidth) {
    for (const double beam_width : {10.0, 65.0, 120.0, 300.0}) {
        const auto pattern = make(beam("CosineAntenna", 12, beam_width));
        EXPECT_NEAR(gain_db(*pattern, {1, 0, 0}), 12, 1e-9);
        EXPECT_NEAR(pattern->gain(at_angle(beam_width / 2)), pattern->max_gain() / 2, 1e-9);
        EXPECT_NEAR(pattern->gain(at_angle(-beam_width / 2)), pattern->max_gain() / 2, 1e-9);
    }
}

TEST(CosineAntenna, IsAPowerOfTheCosineOfHalfTheAngle) {
    // n = -ln 2 / ln cos(30°) = 4.8188…; gain at 90° is (½)^(n/2).
    const auto pattern = make(beam("CosineAntenna", 0, 120));
    EXPECT_NEAR(pattern->gain({0, 0, -3}), std::pow(0.5, 4.818841679306418 / 2), 1e-9);
    EXPECT_NEAR(pattern->gain({-1, 0, 0}), 0, 1e-12);
}

TEST(ParabolicAntenna, FallsWithTheSquareOfTheAngleToItsLeast) {
    AntennaConfig config = beam("ParabolicAntenna", 17, 70);
    config.min_gain = ratio_from_db(-8);
    const auto pattern = make(config);
    EXPECT_NEAR(gain_db(*pattern, {5, 0, 0}), 17, 1e-9);
    EXPECT_NEAR(gain_db(*pattern, at_angle(35)), 14, 1e-9);
    EXPECT_NEAR(gain_db(*pattern, at_angle(-70)), 5, 1e-9);
    EXPECT_NEAR(gain_db(*pattern, at_angle(105)), -8, 1e-9);  // 17 - 27 dB
    EXPECT_NEAR(gain_db(*pattern, {-1, 0, 0}), -8, 1e-9);
}

TEST(AntennaPattern, NoDirectionHasMoreThanTheLargestGain) {
    RandomStream draws(3, 0, Purpose{1002});
    for (int i = 0; i < 20000; ++i) {
        AntennaConfig config =
            beam(i % 2 == 0 ? "CosineAntenna" : "ParabolicAntenna", 10, 1 + 350 * draws.uniform());
        if (i % 3 == 0) {
            config = dipole_config(draws.uniform());
        }
        const auto pattern = make(config);
        const auto draw = [&draws] { return draws.uniform() < 0.3 ? 0 : 2000 * draws.uniform() - 1000; };
        const Position direction{draw(), draw(), draw() + 1e-6};
        const double gain = pattern->gain(direction);
        ASSERT_GE(gain, 0);
        ASSERT_LE(gain, pattern->max_gain());
    }
}

TEST(MountedAntenna, IsTurnedWithItsNodeAndOnIt) {
    const auto pattern = make(beam("ParabolicAntenna", 10, 60));
    MobilityConfig mobility;
    mobility.initial_orientation.heading_rad = pi / 2;
    MountedAntenna antenna{pattern.get(), Attitude(mobility),
                           Orientation(EulerAngles{.elevation_rad = -pi / 2})};  // looks down
    const Trajectory trajectory({0, 0, 0});
    EXPECT_NEAR(antenna.gain_towards({0, 0, -4}, trajectory, SimTime()), 10, 1e-9);
    antenna.offset = Orientation();
    EXPECT_NEAR(antenna.gain_towards({0, 4, 0}, trajectory, SimTime()), 10, 1e-9);
    antenna.offset = Orientation(EulerAngles{.heading_rad = pi / 6});  // from y towards -x
    EXPECT_NEAR(antenna.gain_towards({0, 4, 0}, trajectory, SimTime()), 10 * ratio_from_db(-3), 1e-9);
    EXPECT_NEAR(antenna.gain_towards(at_angle(120), trajectory, SimTime()), 10, 1e-9);
}

TEST(MountedAntenna, LooksWhereItsNodeFlies) {
    const auto pattern = make(beam("CosineAntenna", 10, 60));
    MobilityConfig mobility;
    mobility.face_forward = true;
    const MountedAntenna antenna{pattern.get(), Attitude(mobility), Orientation()};
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(SimTime::from_seconds(1), {0, -100, 0}, 10);
    EXPECT_NEAR(antenna.gain_towards({3, 0, 0}, trajectory, SimTime()), 10, 1e-9);
    EXPECT_NEAR(antenna.gain_towards({0, -3, 0}, trajectory, SimTime::from_seconds(2)), 10, 1e-9);
}

TEST(MountedAntenna, WithoutADirectionHasTheLargestGain) {
    const auto pattern = make(dipole_config(0.5));
    const MountedAntenna antenna{pattern.get(), Attitude(), Orientation()};
    EXPECT_EQ(antenna.gain_towards({0, 0, 0}, Trajectory({}), SimTime()), pattern->max_gain());
    EXPECT_EQ(antenna.gain_towards({0, 0, 1e-200}, Trajectory({}), SimTime()), pattern->max_gain());
}

}  // namespace
}  // namespace netsim
