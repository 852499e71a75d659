// The wind: settings `*.wind.…` of an .ini file. It acts on vehicles with inertia. The meaning and
// range of each field are in wind_config.cpp.
#pragma once

#include "netsim/config/field.hpp"

namespace netsim {

struct WindConfig {
    double speed_mps = 0;
    double heading_rad = 0;
    double gusts_mps = 0;
    double gust_time_s = 10;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "wind.speed_mps = -1 mps: expected …".
    void validate() const { check_fields(*this); }
};

}  // namespace netsim
