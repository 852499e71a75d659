// Random scenarios for the neighbor search: more nodes than hear each other, on and around the
// borders of any grid, anywhere in the world. Some are fast, and bands, powers and thresholds
// differ.
#pragma once

#include "support/random_scenario.hpp"

namespace netsim::test {

inline constexpr double largest_m = 1e7;  // a configuration's limit for coordinates

inline RandomScenario make_far_flung_scenario(std::uint64_t seed) {
    RandomStream draws(seed, 0, Purpose{1003});
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto log_between = [&](double low, double high) {
        return low * std::pow(high / low, draws.uniform());
    };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };

    RandomScenario scenario;
    scenario.seed = seed;
    const bool narrowband = chance(0.4);
    scenario.medium =
        MediumConfig(std::string(narrowband ? ieee802154_scalar_medium : ieee80211_scalar_medium));
    if (chance(0.3)) {
        scenario.medium.alpha = between(2, 4);
        scenario.medium.l02_db += between(-10, 10);  // the two laws of the breakpoint model do not meet
    }
    const RadioConfig usual;
    const double reach_m =
        make_path_loss(scenario.medium).reach_m(usual.sensitivity_w / usual.tx_power_w, usual.carrier_hz);
    const int count = 33 + static_cast<int>(draws.uniform_int(chance(0.2) ? 300 : 100));
    const double neighbors = log_between(0.3, 30);
    const double area_m = reach_m * std::sqrt(3.14 * count / neighbors);
    const double lattice_m = chance(0.3) ? reach_m / (1 + draws.uniform_int(4)) : 0;
    const Position corner =
        chance(0.5) ? Position{}
                    : Position{between(-1, 1), between(-1, 1), 0} * log_between(1e3, largest_m / 2);
    const double outliers = chance(0.2) ? 0.05 : 0;

    const std::uint32_t channels = chance(0.5) ? 1 : 1 + draws.uniform_int(4);
    const bool two_bandwidths = chance(0.2);
    const double power_spread_db = chance(0.5) ? 0 : 15;
    const double sensitivity_spread_db = chance(0.5) ? 0 : 12;
    const double detection_offset_db = between(-8, 8);
    const double detection_spread_db = chance(0.5) ? 0 : 10;
    const bool slow_frames = chance(0.5);  // many on the air at the same time
    const double movers = chance(0.5) ? 0 : draws.uniform();

    for (int id = 0; id < count; ++id) {
        NodeConfig node("node " + std::to_string(id));
        Position place{between(0, area_m), between(0, area_m), chance(0.7) ? 0 : between(0, reach_m)};
        if (lattice_m > 0) {
            place = {std::round(place.x / lattice_m) * lattice_m, std::round(place.y / lattice_m) * lattice_m,
                     0};
        }
        if (chance(outliers)) {
            place = Position{place.x, place.y, 0} * log_between(10, 1e5);
        }
        const auto within = [](double coordinate_m) {
            return std::clamp(coordinate_m, -largest_m, largest_m);
        };
        node.initial_position = {within(corner.x + place.x), within(corner.y + place.y), place.z};
        RadioConfig& radio = node.wlan[0].radio;
        MacConfig& mac = node.wlan[0].mac;
        radio.tx_power_w *= ratio_from_db(between(-power_spread_db, power_spread_db / 2));
        radio.sensitivity_w *= ratio_from_db(between(-sensitivity_spread_db, sensitivity_spread_db));
        radio.energy_detection_w *=
            ratio_from_db(detection_offset_db + between(-detection_spread_db, detection_spread_db));
        radio.energy_detection_w =
            std::max(radio.energy_detection_w, 1.01 * scenario.medium.background_noise_w);
        radio.carrier_hz += 25e6 * draws.uniform_int(channels);
        if (two_bandwidths && chance(0.5)) {
            radio.bandwidth_hz = 20e6;
        }
        mac.bitrate_bps = slow_frames ? 1e6 : -1;
        mac.short_retry_limit = 2;
        node.mobility.telemetry_interval_s = 0;
        scenario.nodes.push_back(node);
    }

    scenario.talk.seed = seed;
    scenario.talk.node_count = count;
    scenario.talk.rounds = 1 + draws.uniform_int(3);
    scenario.talk.longest_text = 500;
    scenario.talk.broadcast_share = chance(0.5) ? 1 : 0.5;
    scenario.talk.until = SimTime::from_seconds(count * log_between(3e-5, 1e-3));
    scenario.talk.corner = corner;
    scenario.talk.area_m = area_m;
    // Across a cell and back within a run.
    scenario.talk.top_speed_mps = log_between(0.1, 30) * reach_m / scenario.talk.until.seconds();
    scenario.talk.moves = movers > 0;
    scenario.talk.movers = movers;
    scenario.talk.beat = chance(0.2) ? SimTime::from_ps(scenario.talk.until.ps() / 3) : SimTime();
    return scenario;
}

}  // namespace netsim::test
