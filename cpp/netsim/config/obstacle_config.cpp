#include "netsim/config/obstacle_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void ObstacleConfig::validate() const {
    if (rings.empty()) {
        throw ConfigError("obstacle.rings = []: expected the footprint, at least one ring of corners");
    }
    for (const Ring& ring : rings) {
        if (ring.size() < 3) {
            throw ConfigError("obstacle.rings: a ring of " + std::to_string(ring.size()) +
                              " corners: expected at least 3");
        }
        for (const Corner& corner : ring) {
            for (const double coordinate : corner) {
                check_between("obstacle.rings", coordinate, -largest_coordinate_m, largest_coordinate_m, "m");
            }
        }
    }
    check_fields(*this);
    check_greater("obstacle.top_m", top_m, base_m, "m");
}

}  // namespace netsim
