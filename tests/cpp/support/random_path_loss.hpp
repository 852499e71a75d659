// Draws a path loss or fading model for a scenario with one of the two power laws.
#pragma once

#include <cmath>
#include <string>

#include "support/drawn_path_loss.hpp"
#include "support/random_scenario.hpp"

namespace netsim::test {

// Each model with the same probability, and heights that affect it.
inline RandomScenario with_random_path_loss(RandomScenario scenario) {
    RandomStream draws(scenario.seed, 0, Purpose{1004});
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto log_between = [&](double low, double high) {
        return low * std::pow(high / low, draws.uniform());
    };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };

    MediumConfig& medium = scenario.medium;
    medium.path_loss = std::string(path_loss_names[draws.uniform_int(path_loss_names.size())]);
    draw_path_loss_parameters(medium, draws);
    // About the duration of a frame, of a run, or any other.
    const double until_s = scenario.talk.until.seconds();
    const double coherence_time_s = chance(0.5) ? log_between(1e-4, 1e-1) : until_s * between(0.1, 3);
    medium.coherence_time_s = chance(0.25) ? 0 : coherence_time_s;
    medium.shadowing_decorrelation_time_s = chance(0.25) ? 0 : until_s * between(0.1, 3);
    const double lowest_m = chance(0.5) ? 0 : 1;
    const double highest_m = log_between(2, 200);
    for (NodeConfig& node : scenario.nodes) {
        node.initial_position.z += between(lowest_m, highest_m);
    }
    return scenario;
}

}  // namespace netsim::test
