#include "netsim/carrier_sense/energy_timeline.hpp"

#include <iterator>

namespace netsim {

void EnergyTimeline::begin(double noise_w) {
    now_ = SimTime::long_ago();
    steps_.assign(1, Step{now_, false, noise_w, noise_w});
    unreported_.clear();
}

void EnergyTimeline::begin_at(SimTime now) {
    now_ = now;
    const auto last_before =
        std::prev(std::lower_bound(steps_.begin() + 1, steps_.end(), now,
                                   [](const Step& step, SimTime time) { return step.time < time; }));
    steps_.erase(steps_.begin(), last_before);
    steps_.front().time = now - SimTime::from_ps(1);
    std::erase_if(unreported_, [now](const Signal& signal) { return signal.end < now; });
}

void EnergyTimeline::add_unreported(const Signal& signal) {
    change_at(signal.start);
    change_at(signal.end);
    add_to_all(signal.start, signal.end, signal.power_w);
    unreported_.push_back(signal);
}

void EnergyTimeline::add_reported(const Signal& signal, SimTime sensed_from, bool exceeds_ed) {
    const SimTime counts_from = exceeds_ed ? sensed_from : signal.start;
    if (counts_from < signal.end) {
        change_at(counts_from);
        change_at(signal.end);
        add_to_all(counts_from, signal.end, signal.power_w);
    }
    if (sensed_from < signal.end) {
        if (sensed_from != counts_from) {
            change_at(sensed_from);
        }
        add_to_reported(sensed_from, signal.end, signal.power_w);
    }
}

SimTime EnergyTimeline::reported_until(double level_w) const {
    for (const Step& step : steps_) {
        if (!step.reports_busy(level_w)) {
            return std::max(step.time, now_);
        }
    }
    return std::max(steps_.back().time, now_);
}

void EnergyTimeline::change_at(SimTime time) {
    if (time < now_) {
        return;
    }
    const auto next = std::lower_bound(steps_.begin(), steps_.end(), time,
                                       [](const Step& step, SimTime other) { return step.time < other; });
    const Step& before = *std::prev(next);
    if (next == steps_.end() || next->time > time) {
        steps_.insert(next, Step{time, false, before.all_w, before.reported_w});
    } else if (!next->is_moment) {
        steps_.insert(next, Step{time, true, std::max(before.all_w, next->all_w),
                                 std::min(before.reported_w, next->reported_w)});
    }
}

void EnergyTimeline::add_to_all(SimTime start, SimTime end, double power_w) {
    for (Step& step : steps_) {
        if (step.is_within(start, end) || (step.is_moment && step.time == end)) {
            step.all_w += power_w;
        }
    }
}

void EnergyTimeline::add_to_reported(SimTime start, SimTime end, double power_w) {
    for (Step& step : steps_) {
        if (step.is_within(start, end) && !(step.is_moment && step.time == start)) {
            step.reported_w += power_w;
        }
    }
}

std::optional<EnergyTimeline::Signal> EnergyTimeline::take_strongest_unreported(const Step& step) {
    auto strongest = unreported_.end();
    for (auto signal = unreported_.begin(); signal != unreported_.end(); ++signal) {
        const bool is_there =
            step.is_within(signal->start, signal->end) || (step.is_moment && step.time == signal->end);
        if (is_there && (strongest == unreported_.end() || signal->power_w > strongest->power_w)) {
            strongest = signal;
        }
    }
    if (strongest == unreported_.end()) {
        return std::nullopt;
    }
    const Signal taken = *strongest;
    *strongest = unreported_.back();
    unreported_.pop_back();
    return taken;
}

}  // namespace netsim
