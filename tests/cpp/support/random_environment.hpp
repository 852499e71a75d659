// Draws antennas, their orientations, and obstacles for a scenario.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/random_scenario.hpp"

namespace netsim::test {

inline RandomScenario with_random_environment(RandomScenario scenario) {
    RandomStream draws(scenario.seed, 0, Purpose{1005});
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };
    const auto angles = [&] { return EulerAngles{between(-4, 4), between(-2, 2), between(-4, 4)}; };

    double area_m = 1;
    for (const NodeConfig& node : scenario.nodes) {
        area_m = std::max({area_m, std::abs(node.initial_position.x), std::abs(node.initial_position.y)});
    }
    const double share_of_patterns = chance(0.2) ? 0 : between(0.1, 1);
    const double highest_gain_db = between(0, 25);
    for (NodeConfig& node : scenario.nodes) {
        if (chance(share_of_patterns)) {
            AntennaConfig& antenna = node.wlan[0].radio.antenna;
            antenna.type_name = antenna_type_names[draws.uniform_int(antenna_type_names.size())];
            antenna.gain = ratio_from_db(between(-10, highest_gain_db));
            antenna.max_gain = ratio_from_db(between(-3, highest_gain_db));
            antenna.min_gain = chance(0.3) ? 0 : antenna.max_gain * between(0.001, 1);
            antenna.beam_width_rad = between(0.1, 6);
            antenna.wire_axis = wire_axis_names[draws.uniform_int(wire_axis_names.size())];
            antenna.length_m = chance(0.3) ? 0 : between(0, 0.12);
            antenna.offset = angles();
        }
        node.mobility.initial_orientation = angles();
        node.mobility.face_forward = chance(0.5);
    }
    // Ends inside of obstacles, on their corners and along their walls are likely: some positions
    // are on a lattice.
    MediumConfig& medium = scenario.medium;
    medium.obstacle_loss = obstacle_loss_names[draws.uniform_int(obstacle_loss_names.size())];
    medium.enable_reflection_loss = chance(0.8);
    medium.enable_dielectric_loss = chance(0.8);
    const auto count = draws.uniform_int(60);
    for (std::uint32_t i = 0; i < count; ++i) {
        ObstacleConfig obstacle;
        double x = between(-0.2, 1.2) * area_m;
        double y = between(-0.2, 1.2) * area_m;
        double size_m = between(0.005, 0.1) * area_m;
        if (chance(0.2)) {
            x = std::round(4 * x / area_m) * area_m / 4;
            y = std::round(4 * y / area_m) * area_m / 4;
            size_m = area_m / 4;
        }
        obstacle.rings = {{{x, y}, {x + size_m, y}, {x + size_m, y + size_m}, {x, y + size_m}}};
        if (chance(0.3)) {
            obstacle.rings[0][2] = {x + between(0, 1) * size_m, y + between(0, 1) * size_m};
        }
        obstacle.base_m = chance(0.7) ? -1 : between(-5, 5);
        obstacle.top_m = obstacle.base_m + between(1, 50);
        obstacle.material = material_names[draws.uniform_int(material_names.size())];
        for (Corner& corner : obstacle.rings[0]) {
            for (double& coordinate : corner) {
                coordinate = std::clamp(coordinate, -largest_coordinate_m, largest_coordinate_m);
            }
        }
        if (chance(0.5)) {
            obstacle.conductivity_spm = between(0, 0.001) / size_m;
        }
        medium.obstacles.push_back(obstacle);
    }
    return scenario;
}

}  // namespace netsim::test
