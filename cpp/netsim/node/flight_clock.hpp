// The updates of all nodes that fly step by step.
//
// They are always one update ahead: at an update, after its telemetry, each of them flies to the
// next one. So its path is known up to there, and what a protocol answers to its telemetry counts.
// As in prototype mode.
#pragma once

#include <vector>

#include "netsim/kernel/simulator.hpp"
#include "netsim/node/node.hpp"

namespace netsim {

class FlightClock {
public:
    static constexpr SimTime interval = SimTime::from_us(10'000);

    explicit FlightClock(Simulator& simulator) : simulator_(simulator) {}
    FlightClock(const FlightClock&) = delete;
    FlightClock& operator=(const FlightClock&) = delete;

    void add(Node& node) { nodes_.push_back(&node); }
    // After the protocols have been initialized.
    void start() {
        if (!nodes_.empty()) {
            fly();
        }
    }

private:
    void fly() {
        const SimTime until = simulator_.now() + interval;
        for (Node* node : nodes_) {
            node->fly(until);
        }
        // At `until`, two events pass the telemetry: one its clock, one its reports.
        simulator_.schedule_at(until, [this] {
            simulator_.schedule_after(SimTime{},
                                      [this] { simulator_.schedule_after(SimTime{}, [this] { fly(); }); });
        });
    }

    Simulator& simulator_;
    std::vector<Node*> nodes_;
};

}  // namespace netsim
