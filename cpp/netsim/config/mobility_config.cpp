#include "netsim/config/mobility_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void MobilityConfig::validate() const {
    check_name("mobility.typename", type_name, mobility_type_names);
    check_at_least("mobility.speed_mps", speed_mps, 0, "m/s");
    if (telemetry_interval_s != 0) {
        // Shorter ones would be nothing but telemetry, longer ones do not fit into simulated time.
        check_between("mobility.telemetry_interval_s", telemetry_interval_s, 1e-6, 1e6, "s");
    }
    check_finite("mobility.initial_heading_rad", initial_orientation.heading_rad, "rad");
    check_finite("mobility.initial_elevation_rad", initial_orientation.elevation_rad, "rad");
    check_finite("mobility.initial_bank_rad", initial_orientation.bank_rad, "rad");
}

}  // namespace netsim
