// What the energy in the band of one receiver will be from now on, as far as what is on the air decides it, and how
// much of that it was told of.
//
// Both are functions of time that change where an arrival begins or ends. The receiver finds its channel busy at the
// right moments if, whenever the sum of all reaches the level, that of what it was told of does so, too: `settle` tells
// it of as many as that takes. What is known once stays known, so another transmission costs its own power and a few
// additions. Sums are only added to, never subtracted from: beside 1 W a level of 1e-12 W is lost to rounding.
//
// Kept by the watch over energy (energy_outlooks.hpp) for receivers for which bounds did not tell that the level is not reached.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class EnergyForecast {
public:
    struct Coming {
        std::uint64_t transmission = 0;
        SimTime start;
        SimTime end;
        double power_w = 0;
    };

    // Nothing is on the air. Keeps its memory.
    void begin(double noise_w);
    // What was before `now` is of no interest any more. Of what is added from then on nothing is over before.
    void begin_at(SimTime now);
    // The receiver was not told of it yet.
    void add_untold(const Coming& coming);
    // The receiver is told of it in any case, but need not count it before `sensed_from`. One that is loud (alone enough) is in
    // neither sum until then: up to there the others decide whether the channel is busy.
    void add_told(const Coming& coming, SimTime sensed_from, bool is_loud);

    // Whether all that was added has ended before `now`.
    bool is_over(SimTime now) const { return steps_.back().time < now; }

    // What was told reaches the level from just before now on and until then, or longer if nothing is known to change
    // then; now if it does not reach it.
    SimTime told_until(double level_w) const;
    std::size_t untold_count() const { return untold_.size(); }
    // Tells as many as it takes: calls `tell(coming)` for each. Returns by how many W the sum may still rise before more
    // has to be told; not positive if that is not known.
    template <typename Tell>
    double settle(double level_w, const Tell& tell);

private:
    static constexpr double margin = 1e-9;  // for rounding

    // From its time to that of the next step; or, of several changes in one moment, for the instants between them:
    // then everything counts for `all_w` and nothing for `told_w` that changes there.
    struct Step {
        SimTime time;
        bool is_moment = false;
        double all_w = 0;
        double told_w = 0;

        bool is_within(SimTime start, SimTime end) const { return time >= start && time < end; }
        bool is_told(double level_w) const { return told_w * (1 - margin) >= level_w; }
    };

    void change_at(SimTime time);
    void add_to_all(SimTime start, SimTime end, double power_w);
    void add_to_told(SimTime start, SimTime end, double power_w);
    std::optional<Coming> take_strongest_untold(const Step& step);

    SimTime now_;
    // By time, moments first. The first one holds just before `now_`, and perhaps still: whether what changes now has done so
    // is not known here.
    std::vector<Step> steps_;
    std::vector<Coming> untold_;
};

// From the last step to the first, and of those not yet told the strongest first: that takes the fewest. Frames that began
// together end in the order of their distances. The last ones have to be told in any case, and are enough while the
// others last, too; the other way round it would take nearly all of them. To be told for nothing does no harm.
template <typename Tell>
double EnergyForecast::settle(double level_w, const Tell& tell) {
    double missing_w = std::numeric_limits<double>::infinity();
    for (std::size_t i = steps_.size(); i > 0; --i) {
        const Step& step = steps_[i - 1];
        while (!step.is_told(level_w) && step.all_w * (1 + margin) >= level_w) {
            const std::optional<Coming> strongest = take_strongest_untold(step);
            if (!strongest) {
                break;
            }
            add_to_told(strongest->start, strongest->end, strongest->power_w);
            tell(*strongest);
        }
        if (!step.is_told(level_w)) {
            missing_w = std::min(missing_w, level_w - step.all_w * (1 + margin));
        }
    }
    return missing_w;
}

}  // namespace netsim
