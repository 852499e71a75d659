#include "netsim/kernel/sim_time.hpp"

#include <cmath>
#include <string>

#include "netsim/error.hpp"

namespace netsim {

SimTime SimTime::from_seconds(double seconds) {
    constexpr double limit_s = 9.2e6;  // int64 picoseconds end at 9.223e6 s
    if (!(std::abs(seconds) <= limit_s)) {
        throw SimulationError("time " + std::to_string(seconds) +
                              " s is not representable: expected a number from -9.2e6 s to 9.2e6 s");
    }
    return SimTime(static_cast<std::int64_t>(std::llround(seconds * 1e12)));
}

}  // namespace netsim
