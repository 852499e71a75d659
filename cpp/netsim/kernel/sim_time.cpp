#include "netsim/kernel/sim_time.hpp"

#include <string>

#include "netsim/error.hpp"

namespace netsim {

void SimTime::refuse_seconds(double seconds) {
    throw SimulationError("time " + std::to_string(seconds) +
                          " s is not representable: expected a number from -9.2e6 s to 9.2e6 s");
}

}  // namespace netsim
