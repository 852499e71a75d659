#include "netsim/config/computer_config.hpp"

namespace netsim {
namespace {

constexpr Field fields[] = {
    {NETSIM_FIELD(ComputerConfig, processing_time_s), "processingTime",
     quantity("s").shown_in("ms").at_least(0).at_most(100),
     "Median of the time that the computer of a node takes for each event of its protocol, one after the "
     "other (docs/how-to/model-a-board.md); 0s: none"},
    {NETSIM_FIELD(ComputerConfig, processing_time_spread), "processingTimeSpread",
     number().at_least(0).at_most(5),
     "Standard deviation of the natural logarithm of that time, which has a log-normal distribution; 0: "
     "always the median"},
};

}  // namespace

const Schema ComputerConfig::schema{"computer", "computer", true, fields};

}  // namespace netsim
