// The time that a computer takes for an event: log-normal, with a random stream of its own.
//
// gradysim.simulator.handler.computer draws the same numbers.
#pragma once

#include "netsim/config/computer_config.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class ProcessingTime {
public:
    ProcessingTime(const ComputerConfig& config, RandomStream stream)
        : median_s_(config.processing_time_s), spread_(config.processing_time_spread), stream_(stream) {}

    bool is_any() const { return median_s_ > 0; }
    // Of the next event.
    SimTime draw();

private:
    double median_s_;
    double spread_;  // standard deviation of the natural logarithm
    RandomStream stream_;
};

}  // namespace netsim
