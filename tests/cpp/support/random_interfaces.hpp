// Draws channels that overlap, and further interfaces, for a scenario.
#pragma once

#include <algorithm>
#include <array>

#include "support/random_scenario.hpp"

namespace netsim::test {

inline RandomScenario with_random_interfaces(RandomScenario scenario) {
    RandomStream draws(scenario.seed, 0, Purpose{1006});
    const auto chance = [&draws](double share) { return draws.uniform() < share; };
    constexpr std::array carriers_hz{2.412e9, 2.417e9, 2.427e9, 2.437e9};

    const double share_of_others = draws.uniform();
    const double share_of_pairs = draws.uniform();
    for (NodeConfig& node : scenario.nodes) {
        if (chance(share_of_others)) {
            node.wlan[0].radio.carrier_hz = carriers_hz[draws.uniform_int(carriers_hz.size())];
        }
        while (node.wlan.size() < 3 && chance(share_of_pairs)) {
            InterfaceConfig further = node.wlan[0];
            further.radio.tx_power_w *= ratio_from_db(10 * draws.uniform() - 5);
            further.radio.carrier_hz = carriers_hz[draws.uniform_int(carriers_hz.size())];
            const bool is_taken = std::ranges::any_of(node.wlan, [&](const InterfaceConfig& other) {
                return other.radio.carrier_hz == further.radio.carrier_hz;
            });
            if (!is_taken) {
                node.wlan.push_back(further);
            }
        }
    }
    return scenario;
}

}  // namespace netsim::test
