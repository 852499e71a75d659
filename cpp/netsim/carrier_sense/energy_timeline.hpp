// The energy that the active transmissions will cause in the band of one receiver, and the part of
// it that was reported to the receiver. carrier_sense/README.md explains it with a drawing.
//
// Both are step functions of time that change where an arrival starts or ends. The receiver finds
// its channel busy at the right times if the reported energy reaches the level whenever the total
// energy does. `report_missing` reports the arrivals needed for that. The timeline is kept, so one
// more transmission costs one power computation and a few additions. Powers are added, never
// subtracted: rounding next to 1 W would swallow 1e-12 W.
//
// Used by the cumulative energy detection for the few receivers where bounds do not exclude a busy
// channel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class EnergyTimeline {
public:
    struct Signal {
        std::uint64_t transmission = 0;
        SimTime start;
        SimTime end;
        double power_w = 0;
    };

    // Resets the timeline to noise alone. Keeps its allocated memory.
    void begin(double noise_w);
    // Drops everything before `now`. No arrival added later may end before `now`.
    void begin_at(SimTime now);
    // Adds an arrival that has not been reported to the receiver.
    void add_unreported(const Signal& signal);
    // Adds an arrival that is always reported. The receiver may ignore it before `sensed_from`. An
    // arrival that exceeds the ED threshold alone is in neither sum before that time.
    void add_reported(const Signal& signal, SimTime sensed_from, bool exceeds_ed);

    // Whether all added arrivals ended before `now`.
    bool is_over(SimTime now) const { return steps_.back().time < now; }

    // The time until which the reported energy stays at or above the level, starting just before
    // now. Returns now if it is below the level already.
    SimTime reported_until(double level_w) const;
    std::size_t unreported_count() const { return unreported_.size(); }
    // Calls `report(signal)` for each arrival that must be reported. Returns the headroom in W: how
    // far the sum may rise before more must be reported. Not positive if unknown.
    template <typename Report>
    double report_missing(double level_w, const Report& report);

private:
    static constexpr double margin = 1e-9;  // for rounding

    // Values from `time` to the time of the next step. A step with `is_moment` stands for one
    // instant with several changes in unknown order: all arrivals that change then count in
    // `all_w`, and none in `reported_w`.
    struct Step {
        SimTime time;
        bool is_moment = false;
        double all_w = 0;
        double reported_w = 0;

        bool is_within(SimTime start, SimTime end) const { return time >= start && time < end; }
        bool reports_busy(double level_w) const { return reported_w * (1 - margin) >= level_w; }
    };

    void change_at(SimTime time);
    void add_to_all(SimTime start, SimTime end, double power_w);
    void add_to_reported(SimTime start, SimTime end, double power_w);
    std::optional<Signal> take_strongest_unreported(const Step& step);

    SimTime now_;
    // Sorted by time, moments first. The first step holds just before `now_` and possibly at `now_`:
    // the timeline does not know whether a change at `now_` has happened.
    std::vector<Step> steps_;
    std::vector<Signal> unreported_;
};

// Goes from the last step to the first, and reports the strongest arrival first, to report few.
// Frames that began together end in the order of their distances. The last ones must be reported in
// any case, and often suffice for the earlier steps, too. In forward order, nearly all arrivals
// would be reported. A superfluous report does no harm.
template <typename Report>
double EnergyTimeline::report_missing(double level_w, const Report& report) {
    double headroom_w = std::numeric_limits<double>::infinity();
    for (std::size_t i = steps_.size(); i > 0; --i) {
        const Step& step = steps_[i - 1];
        while (!step.reports_busy(level_w) && step.all_w * (1 + margin) >= level_w) {
            const std::optional<Signal> strongest = take_strongest_unreported(step);
            if (!strongest) {
                break;
            }
            add_to_reported(strongest->start, strongest->end, strongest->power_w);
            report(*strongest);
        }
        if (!step.reports_busy(level_w)) {
            headroom_w = std::min(headroom_w, level_w - step.all_w * (1 + margin));
        }
    }
    return headroom_w;
}

}  // namespace netsim
