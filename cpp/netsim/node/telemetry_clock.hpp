// The periodic telemetry of all nodes with the same interval.
//
// It ticks at every multiple of the interval after its start, and then reports to each node its
// position, in the order of ids. A tick is scheduled one interval ahead, but its telemetry only at
// the tick, as in prototype mode. So telemetry comes after timers that were set for that instant
// before it.
#pragma once

#include <utility>
#include <vector>

#include "netsim/kernel/simulator.hpp"
#include "netsim/node/node.hpp"

namespace netsim {

class TelemetryClock {
public:
    TelemetryClock(Simulator& simulator, SimTime interval) : simulator_(simulator), interval_(interval) {}
    TelemetryClock(const TelemetryClock&) = delete;
    TelemetryClock& operator=(const TelemetryClock&) = delete;

    SimTime interval() const { return interval_; }
    void add(Node& node) { nodes_.push_back(&node); }
    void start() {
        if (interval_ < SimTime::never() - simulator_.now()) {
            simulator_.schedule_after(interval_, [this] { tick(); });
        }
    }

private:
    void tick() {
        start();
        simulator_.schedule_after(SimTime{}, [this] { report_positions(); });
    }
    void report_positions() {
        for (Node* node : nodes_) {
            node->report_position();
        }
    }

    Simulator& simulator_;
    SimTime interval_;
    std::vector<Node*> nodes_;
};

}  // namespace netsim
