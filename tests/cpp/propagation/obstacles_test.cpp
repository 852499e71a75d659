#include "netsim/propagation/obstacles.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr double channel_1_hz = 2.412e9;

ObstacleConfig box(double x, double y, double width_m, double depth_m, double height_m,
                   const std::string& material = "concrete") {
    ObstacleConfig config;
    config.rings = {{{x, y}, {x + width_m, y}, {x + width_m, y + depth_m}, {x, y + depth_m}}};
    config.top_m = height_m;
    config.material = material;
    return config;
}

MediumConfig medium(const char* obstacle_loss, std::vector<ObstacleConfig> obstacles) {
    MediumConfig config;
    config.obstacle_loss = obstacle_loss;
    config.obstacles = std::move(obstacles);
    return config;
}

// A box of wood in the way, 10 m from wall to wall.
double gain_through_wood(MediumConfig config, const Position& a = {-5, 5, 2},
                         const Position& b = {15, 5, 2}) {
    config.obstacles = {box(0, 0, 10, 10, 5, "wood")};
    return Obstacles(config).gain(a, b, channel_1_hz);
}

TEST(Obstacles, WithoutAModelAreAsNothing) {
    EXPECT_TRUE(Obstacles(medium("", {box(0, 0, 10, 10, 5)})).empty());
    EXPECT_EQ(Obstacles(medium("", {box(0, 0, 10, 10, 5)})).gain({-5, 5, 2}, {15, 5, 2}, channel_1_hz), 1);
    EXPECT_TRUE(Obstacles(medium("IdealObstacleLoss", {})).empty());
}

TEST(IdealObstacleLoss, BlocksWhatCrosses) {
    EXPECT_EQ(gain_through_wood(medium("IdealObstacleLoss", {})), 0);
    EXPECT_EQ(gain_through_wood(medium("IdealObstacleLoss", {}), {-5, 5, 6}, {15, 5, 6}), 1);
}

TEST(DielectricObstacleLoss, IsTheLengthInsideAndBothFaces) {
    const Material wood = make_material(box(0, 0, 1, 1, 1, "wood"), channel_1_hz);
    MediumConfig config = medium("DielectricObstacleLoss", {});
    const double through = wood.gain_through(10);
    const double face = wood.gain_at_face(1);
    EXPECT_NEAR(gain_through_wood(config), through * face * face, 1e-12 * through);
    config.enable_reflection_loss = false;
    EXPECT_NEAR(gain_through_wood(config), through, 1e-12 * through);
    config.enable_dielectric_loss = false;
    EXPECT_EQ(gain_through_wood(config), 1);
    config.enable_reflection_loss = true;
    EXPECT_NEAR(gain_through_wood(config), face * face, 1e-12);
    EXPECT_NEAR(gain_through_wood(config, {5, 5, 2}, {15, 5, 2}), face, 1e-12);
}

TEST(DielectricObstacleLoss, DependsOnTheCarrier) {
    const Obstacles obstacles(medium("DielectricObstacleLoss", {box(0, 0, 1, 10, 5)}));
    const double low = obstacles.gain({-5, 5, 2}, {15, 5, 2}, 2.4e9);
    const double high = obstacles.gain({-5, 5, 2}, {15, 5, 2}, 5.2e9);
    EXPECT_GT(low, 10 * high);
    EXPECT_EQ(obstacles.gain({-5, 5, 2}, {15, 5, 2}, 2.4e9), low);
}

// A town of boxes, turned, of different heights and materials.
std::vector<ObstacleConfig> town(RandomStream& draws, int count) {
    std::vector<ObstacleConfig> obstacles;
    for (int i = 0; i < count; ++i) {
        const double x = 1000 * draws.uniform();
        const double y = 1000 * draws.uniform();
        const double angle = 7 * draws.uniform();
        const double width_m = 2 + 30 * draws.uniform();
        ObstacleConfig obstacle;
        Ring ring;
        for (const auto& [east, north] : {Corner{-1, -1}, Corner{1, -1}, Corner{1, 0.7}, Corner{-1, 1}}) {
            ring.push_back({x + width_m * (east * std::cos(angle) - north * std::sin(angle)),
                            y + width_m * (east * std::sin(angle) + north * std::cos(angle))});
        }
        obstacle.rings = {ring};
        obstacle.base_m = draws.uniform() < 0.1 ? 5 : 0;
        obstacle.top_m = 6 + 30 * draws.uniform();
        obstacle.material = i % 3 == 0 ? "glass" : "wood";
        obstacle.conductivity_spm = i % 2 == 0 ? 1e-4 : -1;
        obstacles.push_back(obstacle);
    }
    return obstacles;
}

Position random_place(RandomStream& draws) {
    return {1000 * draws.uniform(), 1000 * draws.uniform(), 40 * draws.uniform()};
}

TEST(Obstacles, TheTreeMissesNone) {
    RandomStream draws(9, 0, Purpose{1002});
    for (const int count : {1, 2, 3, 7, 100, 1000}) {
        const auto obstacles = town(draws, count);
        for (const char* model : {"IdealObstacleLoss", "DielectricObstacleLoss"}) {
            const Obstacles all(medium(model, obstacles));
            std::vector<Obstacles> each;
            for (const ObstacleConfig& obstacle : obstacles) {
                each.emplace_back(medium(model, {obstacle}));
            }
            for (int i = 0; i < 200; ++i) {
                const Position a = random_place(draws);
                const Position b = draws.uniform() < 0.5
                                       ? random_place(draws)
                                       : a + 0.1 * (random_place(draws) - Position{500, 500, 20});
                double product = 1;
                for (const Obstacles& one : each) {
                    product *= one.gain(a, b, channel_1_hz);
                }
                EXPECT_NEAR(all.gain(a, b, channel_1_hz), product, 1e-12 * product) << count << ", " << i;
            }
        }
    }
}

TEST(Obstacles, BothWaysAreTheSameToTheLastDigit) {
    RandomStream draws(10, 0, Purpose{1002});
    const Obstacles obstacles(medium("DielectricObstacleLoss", town(draws, 300)));
    for (int i = 0; i < 5000; ++i) {
        const Position a = random_place(draws);
        const Position b = random_place(draws);
        EXPECT_EQ(obstacles.gain(a, b, channel_1_hz), obstacles.gain(b, a, channel_1_hz)) << i;
    }
}

TEST(Obstacles, GainsAreShares) {
    RandomStream draws(11, 0, Purpose{1002});
    const Obstacles obstacles(medium("DielectricObstacleLoss", town(draws, 300)));
    int in_sight = 0;
    int weakened = 0;
    for (int i = 0; i < 5000; ++i) {
        const double gain = obstacles.gain(random_place(draws), random_place(draws), channel_1_hz);
        ASSERT_GE(gain, 0);
        ASSERT_LE(gain, 1);
        in_sight += gain == 1 ? 1 : 0;
        weakened += gain > 0 && gain < 1 ? 1 : 0;
    }
    EXPECT_GT(in_sight, 100);
    EXPECT_GT(weakened, 100);
}

TEST(Obstacles, MovedAlongLeaveTheSame) {
    RandomStream draws(12, 0, Purpose{1002});
    auto houses = town(draws, 100);
    const Obstacles here(medium("DielectricObstacleLoss", houses));
    const Position shift{12345, -54321, 0};
    for (ObstacleConfig& house : houses) {
        for (Corner& corner : house.rings[0]) {
            corner = {corner[0] + shift.x, corner[1] + shift.y};
        }
    }
    const Obstacles there(medium("DielectricObstacleLoss", houses));
    for (int i = 0; i < 2000; ++i) {
        const Position a = random_place(draws);
        const Position b = random_place(draws);
        const double gain = here.gain(a, b, channel_1_hz);
        EXPECT_NEAR(there.gain(a + shift, b + shift, channel_1_hz), gain, 1e-6 * gain) << i;
    }
}

}  // namespace
}  // namespace netsim
