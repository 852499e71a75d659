#include "netsim/mobility/mobility.hpp"

#include <utility>

#include "netsim/error.hpp"
#include "netsim/mobility/massless_mobility.hpp"
#include "netsim/mobility/path_mobility.hpp"
#include "netsim/mobility/stationary_mobility.hpp"

namespace netsim {

void Mobility::refuse() {
    throw SimulationError(
        "the node does not follow commands: give it a mobility.typename that does, MasslessMobility");
}

std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial) {
    if (config.type_name == "StationaryMobility") {
        return std::make_unique<StationaryMobility>(initial);
    }
    if (std::unique_ptr<Path> path = make_path(config, initial)) {
        return std::make_unique<PathMobility>(std::move(path));
    }
    NETSIM_ASSERT(config.type_name == "MasslessMobility");
    return std::make_unique<MasslessMobility>(initial, config.speed_mps);
}

}  // namespace netsim
