// The computer that runs a node's protocol: settings `*.<node>.computer.…` of an .ini file. Each field has a row below the struct.
#pragma once

#include "netsim/config/field.hpp"

namespace netsim {

struct ComputerConfig {
    double processing_time_s = 0;  // 0: none
    double processing_time_spread = 0;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "computer.processing_time_s = -1 s: expected …".
    void validate() const { check_fields(*this); }
};

inline constexpr Field computer_fields[] = {
    {NETSIM_FIELD(ComputerConfig, processing_time_s), "processingTime",
     quantity("s").shown_in("ms").at_least(0).at_most(100),
     "Median of the time that the computer of a node takes for each event of its protocol, one after the "
     "other (docs/how-to/model-a-board.md); 0s: none"},
    {NETSIM_FIELD(ComputerConfig, processing_time_spread), "processingTimeSpread",
     number().at_least(0).at_most(5),
     "Standard deviation of the natural logarithm of that time, which has a log-normal distribution; 0: "
     "always the median"},
};

inline constexpr Schema ComputerConfig::schema{"computer", "computer", true, computer_fields};

}  // namespace netsim
