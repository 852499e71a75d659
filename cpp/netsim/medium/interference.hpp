// The interference at a receiver during a reception: the sum of the other frames' powers and of noise that
// changes, a step function of time.
//
// The medium adds the other frames. The radio asks for the worst moment or for the whole function.
// The sum changes only where a frame starts or ends, so one sweep over sorted starts and ends
// computes it: O(m log m) for m frames.
#pragma once

#include <optional>
#include <vector>

#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// Interference of `power_w` from `start` until the next step or the end of the period.
struct InterferenceStep {
    SimTime start;
    double power_w = 0;

    bool operator==(const InterferenceStep&) const = default;
};

class InterferenceSum {
public:
    // Starts a new period, from `start` until just before `end`, without interference.
    void begin(SimTime start, SimTime end) {
        start_ = start;
        end_ = end;
        others_.clear();
        noise_.clear();
        worst_moment_.reset();
    }
    // Adds an interfering frame. Ignores a frame outside the period. Call it in the order of
    // transmissions. Inline, so that the compiler does not compute unused parts of an arrival.
    void add(const Arrival& other) {
        if (other.start < end_ && other.end > start_ && other.power_w > 0) {
            others_.push_back({other.transmission, other.start, other.end, other.power_w});
            worst_moment_.reset();
        }
    }

    // Adds noise from `start` until the next noise or the end of the period. Call it in the order of time, the
    // first time for the start of the period.
    void add_noise(SimTime start, double power_w) {
        noise_.push_back({start, power_w});
        worst_moment_.reset();
    }

    // The largest sum over the period, in W, with the added noise.
    double worst_w();
    // The parts of that sum. With frames, those of the worst moment with one.
    double worst_frames_w() { return others_.empty() ? 0 : sum_w_at(worst_moment()); }
    double worst_noise_w() { return others_.empty() ? max_noise_w() : noise_w_at(worst_moment()); }
    // The nodes that caused the largest sum of frames and noise at a moment with frames, strongest first, each once. They sent the strongest
    // frames on the air at that moment: as many as outweigh the rest together, and any as strong as
    // the last of these. Of several equally bad moments, the start of the earliest transmission
    // counts. Empty without interference. Valid until the next call of begin or interferers.
    const std::vector<NodeId>& interferers();
    // The power in W that this node contributes to the largest sum.
    double worst_w_of(NodeId node);
    // The whole step function. The first step is at the start of the period, and each differs from
    // the one before. Valid until the next call of begin or steps.
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
    // Finds the moments when frames start, and the sums from then on. The rounding error is relative
    // to the largest sum.
    void find_moments();
    // Only with at least one frame; computed once.
    SimTime worst_moment();
    SimTime find_worst_moment();
    // The sum in the order of transmissions, for reproducible rounding.
    double sum_w_at(SimTime moment) const;
    double noise_w_at(SimTime moment) const;
    double max_noise_w() const;
    SimTime find_worst_moment_with_noise() const;
    void add_noise_to_steps();

    SimTime start_;
    SimTime end_;
    std::vector<Other> others_;
    std::vector<InterferenceStep> noise_;
    std::vector<Change> starts_;
    std::vector<Change> ends_;
    std::vector<Moment> moments_;
    std::vector<InterferenceStep> steps_;
    std::vector<InterferenceStep> frame_steps_;
    std::optional<SimTime> worst_moment_;
    std::vector<const Other*> strongest_;
    std::vector<NodeId> interferers_;
};

}  // namespace netsim
