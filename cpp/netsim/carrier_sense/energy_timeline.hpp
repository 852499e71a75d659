// The future energy in the band of one receiver, as far as the active transmissions determine it,
// and the part of it that was reported to the receiver. carrier_sense/README.md explains it with a
// drawing.
//
// Both are step functions of time that change where an arrival starts or ends. The receiver finds
// its channel busy at the right times if the reported energy reaches the level whenever the total
// energy does. `report_missing` reports as many arrivals as that takes. The timeline is kept, so
// one more transmission costs its own power and a few additions. Sums are only added to, never
// subtracted from: beside 1 W, a level of 1e-12 W is lost to rounding.
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

    // Resets it to noise alone. Keeps its memory.
    void begin(double noise_w);
    // Drops what was before `now`. No arrival added later may end before `now`.
    void begin_at(SimTime now);
    // Adds an arrival that was not reported to the receiver yet.
    void add_unreported(const Signal& signal);
    // Adds an arrival that is reported in any case. The receiver may ignore it before
    // `sensed_from`. One that exceeds the ED threshold alone is in neither sum until then: before
    // that, the others decide.
    void add_reported(const Signal& signal, SimTime sensed_from, bool exceeds_ed);

    // Whether all that was added has ended before `now`.
    bool is_over(SimTime now) const { return steps_.back().time < now; }

    // The reported energy reaches the level from just before now until the returned time, at least.
    // Now, if it does not reach the level.
    SimTime reported_until(double level_w) const;
    std::size_t unreported_count() const { return unreported_.size(); }
    // Reports as many arrivals as needed: calls `report(signal)` for each. Returns the headroom:
    // how many W the sum may rise before more must be reported. Not positive if unknown.
    template <typename Report>
    double report_missing(double level_w, const Report& report);

private:
    static constexpr double margin = 1e-9;  // for rounding

    // Holds from its time to that of the next step. A step with `is_moment` holds between several
    // changes at one instant, whose order is unknown: all changing arrivals count for `all_w`, and
    // none for `reported_w`.
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
    // By time, moments first. The first step holds just before `now_`, and perhaps still: whether a
    // change at `now_` has happened yet is unknown here.
    std::vector<Step> steps_;
    std::vector<Signal> unreported_;
};

// From the last step to the first, and the strongest unreported arrival first: this reports the
// fewest. Frames that began together end in the order of their distances. The last ones must be
// reported in any case, and often suffice while the others last, too. From first to last, nearly
// all would be reported. A superfluous report does no harm.
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
