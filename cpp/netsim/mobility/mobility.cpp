#include "netsim/mobility/mobility.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/mobility/massless_mobility.hpp"
#include "netsim/mobility/path_mobility.hpp"
#include "netsim/mobility/quadcopter_mobility.hpp"
#include "netsim/mobility/stationary_mobility.hpp"

namespace netsim {

void Mobility::check_accepts_commands() const {
    if (!can_move()) {
        throw SimulationError(
            "the node does not follow commands: give it a mobility.typename that does, MasslessMobility");
    }
}

void Mobility::check_target(Position target) const {
    check_accepts_commands();
    if (!is_in_scene(target)) {
        throw SimulationError("cannot go to (" + std::to_string(target.x) + ", " + std::to_string(target.y) +
                              ", " + std::to_string(target.z) +
                              "): expected three numbers of meters, each from -1e7 to 1e7");
    }
}

void Mobility::check_speed(double speed_mps) const {
    check_accepts_commands();
    if (!std::isfinite(speed_mps) || speed_mps < 0) {
        throw SimulationError("cannot fly at " + std::to_string(speed_mps) +
                              " m/s: expected a finite speed of at least 0 m/s");
    }
}

namespace {

struct Place {
    Position initial;
    const WindConfig& wind;
    std::uint64_t seed = 0;
    std::uint32_t node = 0;
};
using Made = std::unique_ptr<Mobility>;

Made on_path(const MobilityConfig& config, const Place& place) {
    return std::make_unique<PathMobility>(make_path(config, place.initial));
}

constexpr Factory<Made (*)(const MobilityConfig&, const Place&)> factories[] = {
    {"MasslessMobility",
     [](const MobilityConfig& config, const Place& place) -> Made {
         return std::make_unique<MasslessMobility>(place.initial, config.speed_mps);
     }},
    {"StationaryMobility",
     [](const MobilityConfig&, const Place& place) -> Made {
         return std::make_unique<StationaryMobility>(place.initial);
     }},
    {"LinearMobility", on_path},
    {"CircleMobility", on_path},
    {"RectangleMobility", on_path},
    {"QuadcopterMobility",
     [](const MobilityConfig& config, const Place& place) -> Made {
         const Airframe airframe{.acceleration_mps2 = config.acceleration_mps2,
                                 .drag_kgps = config.drag_kgps};
         return std::make_unique<QuadcopterMobility>(place.initial, config.speed_mps, airframe,
                                                     Wind(place.wind, place.seed, place.node));
     }},
};
static_assert(makes_all(factories, std::span(mobility_models).first<mobility_type_names.size()>()));

// Slow, as that of a satellite receiver.
std::unique_ptr<GaussMarkov> make_position_error(const MobilityConfig& config, std::uint64_t seed,
                                                 std::uint32_t node) {
    constexpr double interval_s = 1;
    const double deviation_m = config.position_error_m;
    return std::make_unique<GaussMarkov>(
        RandomStream(seed, node, Purpose::position_error),
        Position{deviation_m, deviation_m, config.position_error_ratio * deviation_m},
        config.position_error_time_s, interval_s);
}

}  // namespace

std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial,
                                        const WindConfig& wind, std::uint64_t seed, std::uint32_t node) {
    std::unique_ptr<Mobility> model =
        factory_of(config.type_name, factories)(config, {initial, wind, seed, node});
    if (config.position_error_m > 0) {
        model->set_position_error(make_position_error(config, seed, node));
    }
    return model;
}

}  // namespace netsim
