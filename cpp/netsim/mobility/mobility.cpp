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

std::unique_ptr<Mobility> make_model(const MobilityConfig& config, Position initial, const WindConfig& wind,
                                     std::uint64_t seed, std::uint32_t node) {
    if (config.type_name == "StationaryMobility") {
        return std::make_unique<StationaryMobility>(initial);
    }
    if (std::unique_ptr<Path> path = make_path(config, initial)) {
        return std::make_unique<PathMobility>(std::move(path));
    }
    if (config.type_name == "QuadcopterMobility") {
        const Airframe airframe{.acceleration_mps2 = config.acceleration_mps2, .drag_kgps = config.drag_kgps};
        return std::make_unique<QuadcopterMobility>(initial, config.speed_mps, airframe,
                                                    Wind(wind, seed, node));
    }
    NETSIM_ASSERT(config.type_name == "MasslessMobility");
    return std::make_unique<MasslessMobility>(initial, config.speed_mps);
}

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
    std::unique_ptr<Mobility> model = make_model(config, initial, wind, seed, node);
    if (config.position_error_m > 0) {
        model->set_position_error(make_position_error(config, seed, node));
    }
    return model;
}

}  // namespace netsim
