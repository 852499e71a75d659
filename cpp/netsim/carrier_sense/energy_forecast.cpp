#include "netsim/carrier_sense/energy_forecast.hpp"

#include <iterator>

namespace netsim {

void EnergyForecast::begin(double noise_w) {
    now_ = SimTime::long_ago();
    steps_.assign(1, Step{now_, false, noise_w, noise_w});
    untold_.clear();
}

void EnergyForecast::begin_at(SimTime now) {
    now_ = now;
    const auto last_before =
        std::prev(std::lower_bound(steps_.begin() + 1, steps_.end(), now,
                                   [](const Step& step, SimTime time) { return step.time < time; }));
    steps_.erase(steps_.begin(), last_before);
    steps_.front().time = now - SimTime::from_ps(1);
    std::erase_if(untold_, [now](const Coming& coming) { return coming.end < now; });
}

void EnergyForecast::add_untold(const Coming& coming) {
    change_at(coming.start);
    change_at(coming.end);
    add_to_all(coming.start, coming.end, coming.power_w);
    untold_.push_back(coming);
}

void EnergyForecast::add_told(const Coming& coming, SimTime sensed_from, bool is_loud) {
    const SimTime counts_from = is_loud ? sensed_from : coming.start;
    if (counts_from < coming.end) {
        change_at(counts_from);
        change_at(coming.end);
        add_to_all(counts_from, coming.end, coming.power_w);
    }
    if (sensed_from < coming.end) {
        if (sensed_from != counts_from) {
            change_at(sensed_from);
        }
        add_to_told(sensed_from, coming.end, coming.power_w);
    }
}

SimTime EnergyForecast::told_until(double level_w) const {
    for (const Step& step : steps_) {
        if (!step.is_told(level_w)) {
            return std::max(step.time, now_);
        }
    }
    return std::max(steps_.back().time, now_);
}

void EnergyForecast::change_at(SimTime time) {
    if (time < now_) {
        return;
    }
    const auto next = std::lower_bound(steps_.begin(), steps_.end(), time,
                                       [](const Step& step, SimTime other) { return step.time < other; });
    const Step& before = *std::prev(next);
    if (next == steps_.end() || next->time > time) {
        steps_.insert(next, Step{time, false, before.all_w, before.told_w});
    } else if (!next->is_moment) {
        steps_.insert(next, Step{time, true, std::max(before.all_w, next->all_w),
                                 std::min(before.told_w, next->told_w)});
    }
}

void EnergyForecast::add_to_all(SimTime start, SimTime end, double power_w) {
    for (Step& step : steps_) {
        if (step.is_within(start, end) || (step.is_moment && step.time == end)) {
            step.all_w += power_w;
        }
    }
}

void EnergyForecast::add_to_told(SimTime start, SimTime end, double power_w) {
    for (Step& step : steps_) {
        if (step.is_within(start, end) && !(step.is_moment && step.time == start)) {
            step.told_w += power_w;
        }
    }
}

std::optional<EnergyForecast::Coming> EnergyForecast::take_strongest_untold(const Step& step) {
    auto strongest = untold_.end();
    for (auto coming = untold_.begin(); coming != untold_.end(); ++coming) {
        const bool is_there =
            step.is_within(coming->start, coming->end) || (step.is_moment && step.time == coming->end);
        if (is_there && (strongest == untold_.end() || coming->power_w > strongest->power_w)) {
            strongest = coming;
        }
    }
    if (strongest == untold_.end()) {
        return std::nullopt;
    }
    const Coming taken = *strongest;
    *strongest = untold_.back();
    untold_.pop_back();
    return taken;
}

}  // namespace netsim
