// What other frames bring to a receiver while it gets one: their sum, a step function of time.
//
// The medium adds those that the receiver gets beside the wanted one, the radio asks for the worst moment or for the
// whole function. The sum rises and falls only where a frame starts or ends, so a sweep over the sorted starts and
// ends finds all of it: O(m log m) for m frames.
#pragma once

#include <optional>
#include <vector>

#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// From `start` on until the next step, or the end of the period, the others bring `power_w` together.
struct InterferenceStep {
    SimTime start;
    double power_w = 0;

    bool operator==(const InterferenceStep&) const = default;
};

class InterferenceSum {
public:
    // Begins a new period, from `start` until just before `end`, in which nothing disturbs.
    void begin(SimTime start, SimTime end) {
        start_ = start;
        end_ = end;
        others_.clear();
        worst_moment_.reset();
    }
    // One that does, in the order of transmissions; no matter whether it lasts into the period. In the header, so that
    // nothing of an arrival is worked out that is not asked for here.
    void add(const Arrival& other) {
        if (other.start < end_ && other.end > start_ && other.power_w > 0) {
            others_.push_back({other.transmission, other.start, other.end, other.power_w});
            worst_moment_.reset();
        }
    }

    // The largest sum over the period, in W, without background noise.
    double worst_w();
    // Who is to blame for that: of those on the air when the sum is largest, the strongest, as many as outweigh all the others
    // together, and who is just as strong as the last of them. Nodes, each once, from strong to weak; none if nothing disturbs. Of
    // several moments equally bad, that of the earliest transmission's start. Valid until the next call of begin or interferers.
    const std::vector<NodeId>& interferers();
    // At least one, the first at the start of the period, and each different from the one before. Valid until the
    // next call of begin or steps.
    const std::vector<InterferenceStep>& steps();

private:
    struct Other {
        const Transmission* transmission = nullptr;
        SimTime start;
        SimTime end;
        double power_w = 0;
    };
    struct Change {  // of the sum
        SimTime time;
        double power_w = 0;
    };
    struct Moment {
        SimTime time;
        double sum_w = 0;
    };

    // Sorts the starts and the ends within the period.
    void find_changes();
    // When the others begin, with the sums from then on: right but for rounding, in proportion to the largest of them.
    void find_moments();
    // Of at least one other; worked out once.
    SimTime worst_moment();
    SimTime find_worst_moment();
    // Exactly what adding up in the order of transmissions gives.
    double sum_w_at(SimTime moment) const;

    SimTime start_;
    SimTime end_;
    std::vector<Other> others_;
    std::vector<Change> starts_;
    std::vector<Change> ends_;
    std::vector<Moment> moments_;
    std::vector<InterferenceStep> steps_;
    std::optional<SimTime> worst_moment_;
    std::vector<const Other*> strongest_;
    std::vector<NodeId> interferers_;
};

}  // namespace netsim
