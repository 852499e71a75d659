#include "netsim/geometry/orientation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr double quarter = std::numbers::pi / 2;

void expect_near(const Position& position, const Position& expected, double tolerance = 1e-12) {
    EXPECT_NEAR(position.x, expected.x, tolerance);
    EXPECT_NEAR(position.y, expected.y, tolerance);
    EXPECT_NEAR(position.z, expected.z, tolerance);
}

TEST(Orientation, NotTurnedLooksAlongX) {
    expect_near(Orientation().to_scene({1, 2, 3}), {1, 2, 3}, 0);
    expect_near(Orientation(EulerAngles{}).to_scene({1, 2, 3}), {1, 2, 3}, 0);
}

TEST(Orientation, HeadingTurnsXTowardsY) {
    const Orientation turned(EulerAngles{.heading_rad = quarter});
    expect_near(turned.to_scene({1, 0, 0}), {0, 1, 0});
    expect_near(turned.to_scene({0, 0, 1}), {0, 0, 1});
}

TEST(Orientation, ElevationRaisesTheNose) {
    const Orientation raised(EulerAngles{.elevation_rad = quarter / 3});
    expect_near(raised.to_scene({1, 0, 0}), {std::cos(quarter / 3), 0, std::sin(quarter / 3)});
    expect_near(raised.to_scene({0, 1, 0}), {0, 1, 0});
}

TEST(Orientation, BankTurnsYTowardsZ) {
    const Orientation banked(EulerAngles{.bank_rad = quarter});
    expect_near(banked.to_scene({0, 1, 0}), {0, 0, 1});
    expect_near(banked.to_scene({1, 0, 0}), {1, 0, 0});
}

TEST(Orientation, TurnsFirstByHeadingThenByElevationAboutItsOwnSideThenByBankAboutItsOwnNose) {
    const Orientation turned(
        EulerAngles{.heading_rad = quarter, .elevation_rad = quarter / 2, .bank_rad = quarter});
    const double diagonal = std::sqrt(0.5);
    expect_near(turned.to_scene({1, 0, 0}), {0, diagonal, diagonal});
    expect_near(turned.to_scene({0, 1, 0}), {0, -diagonal, diagonal});
    expect_near(turned.to_scene({0, 0, 1}), {1, 0, 0});
}

TEST(Orientation, ToOwnUndoesToScene) {
    RandomStream draws(1, 0, Purpose{1002});
    for (int i = 0; i < 1000; ++i) {
        const auto draw = [&draws] { return 20 * draws.uniform() - 10; };
        const Orientation turned(EulerAngles{draw(), draw(), draw()});
        const Position place{draw(), draw(), draw()};
        expect_near(turned.to_own(turned.to_scene(place)), place);
        EXPECT_NEAR(distance(turned.to_scene(place), {}), distance(place, {}), 1e-12);
    }
}

TEST(Orientation, FacingIsHeadingAndElevationWithoutBank) {
    RandomStream draws(2, 0, Purpose{1002});
    for (int i = 0; i < 1000; ++i) {
        const EulerAngles angles{4 * quarter * draws.uniform(), quarter * (1.98 * draws.uniform() - 0.99), 0};
        const Orientation turned(angles);
        const Orientation facing = Orientation::facing(turned.to_scene({7, 0, 0}));
        for (const Position& axis : {Position{1, 0, 0}, Position{0, 1, 0}, Position{0, 0, 1}}) {
            expect_near(facing.to_scene(axis), turned.to_scene(axis));
        }
    }
}

TEST(Orientation, FacingStraightUpHasHeadingZero) {
    expect_near(Orientation::facing({0, 0, 5}).to_scene({1, 2, 3}), {-3, 2, 1});
    expect_near(Orientation::facing({0, 0, -5}).to_scene({1, 2, 3}), {3, 2, -1});
}

TEST(Orientation, FacingTakesDirectionsOfAnyLength) {
    expect_near(Orientation::facing({0, 1e-300, 0}).to_scene({1, 0, 0}), {0, 1, 0});
    expect_near(Orientation::facing({0, 1e300, 0}).to_scene({1, 0, 0}), {0, 1, 0});
}

TEST(Orientation, OfAMountedPartIsSeenFromTheBody) {
    const Orientation body(EulerAngles{.heading_rad = quarter});
    const Orientation part(EulerAngles{.elevation_rad = quarter});
    expect_near(body.mounted(part).to_scene({1, 0, 0}), {0, 0, 1});
    expect_near(body.mounted(part).to_scene({0, 0, 1}), {0, -1, 0});
    expect_near(body.mounted(part).to_own({1, 2, 3}), part.to_own(body.to_own({1, 2, 3})));
}

}  // namespace
}  // namespace netsim
