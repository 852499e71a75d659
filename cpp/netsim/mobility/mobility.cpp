#include "netsim/mobility/mobility.hpp"

#include "netsim/error.hpp"
#include "netsim/mobility/massless_mobility.hpp"
#include "netsim/mobility/stationary_mobility.hpp"

namespace netsim {

std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial) {
    if (config.type_name == "StationaryMobility") {
        return std::make_unique<StationaryMobility>(initial);
    }
    NETSIM_ASSERT(config.type_name == "MasslessMobility");
    return std::make_unique<MasslessMobility>(initial, config.speed_mps);
}

}  // namespace netsim
