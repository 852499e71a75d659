#include "netsim/config/obstacle_config.hpp"

#include <cmath>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

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
    check_between("obstacle.base_m", base_m, -largest_coordinate_m, largest_coordinate_m, "m");
    check_between("obstacle.top_m", top_m, -largest_coordinate_m, largest_coordinate_m, "m");
    check_greater("obstacle.top_m", top_m, base_m, "m");
    check_name("obstacle.material", material, material_names);
    if (relative_permittivity != -1) {
        check_at_least("obstacle.relative_permittivity", relative_permittivity, 1, "");
    }
    if (conductivity_spm != -1) {
        check_at_least("obstacle.conductivity_spm", conductivity_spm, 0, "S/m");
    }
}

}  // namespace netsim
