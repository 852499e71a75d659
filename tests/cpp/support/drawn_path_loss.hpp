// Draws the parameters of the models of path loss and fading, within and beyond their usual
// values.
#pragma once

#include <cmath>
#include <string>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/random.hpp"

namespace netsim::test {

// All except the name and the coherence times, for any model.
inline void draw_path_loss_parameters(MediumConfig& config, RandomStream& draws) {
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto log_between = [&draws](double low, double high) {
        return low * std::pow(high / low, draws.uniform());
    };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };
    config.alpha = chance(0.3) ? 2 : between(1.5, 4);
    config.system_loss = chance(0.5) ? 1 : log_between(1, 100);
    config.breakpoint_distance_m = log_between(0.5, 500);
    config.l01_db = between(30, 50);
    config.alpha1 = between(1.5, 4);
    // The two laws meet, or there is a step up or down.
    config.l02_db = config.l01_db + 10 * config.alpha1 * std::log10(config.breakpoint_distance_m) +
                    (chance(0.3) ? 0 : between(-6, 6));
    config.alpha2 = between(1.5, 5);
    config.epsilon_r = chance(0.1) ? 1 : log_between(1, 20);
    config.polarization = std::string(polarization_names[draws.uniform_int(2)]);
    config.inet_vertical_sign = chance(0.2);
    config.sigma_db = chance(0.1) ? 0 : between(0, 10);
    config.k_db = between(-20, 30);
    config.shape_factor = chance(0.2) ? 1 : log_between(0.5, 50);
    config.shadowing_standard_deviation_db = chance(0.5) ? 0 : between(0, 10);
}

}  // namespace netsim::test
