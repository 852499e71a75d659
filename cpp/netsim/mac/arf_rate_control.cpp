#include "netsim/mac/arf_rate_control.hpp"

#include <algorithm>

namespace netsim {

ArfRateControl::Link& ArfRateControl::link_to(NodeId destination, SimTime now) {
    const auto [place, is_new] = links_.try_emplace(destination);
    if (is_new) {
        place->second.mode = modes_.index_of(initial_);
        place->second.changed = now;
        place->second.increase_threshold = parameters_.increase_threshold;
    }
    return place->second;
}

const Mode& ArfRateControl::mode_for(const RateAttempt& attempt, SimTime now) {
    Link& link = link_to(attempt.destination, now);
    if (now - link.changed >= parameters_.interval) {
        increase(link, now);
    }
    return modes_.modes()[link.mode];
}

void ArfRateControl::succeeded(const RateAttempt& attempt, const Mode&, SimTime now) {
    Link& link = link_to(attempt.destination, now);
    link.probing = false;
    link.failures = 0;
    if (++link.successes >= link.increase_threshold) {
        increase(link, now);
    }
}

void ArfRateControl::failed(const RateAttempt& attempt, const Mode&, SimTime now) {
    Link& link = link_to(attempt.destination, now);
    link.successes = 0;
    ++link.failures;
    if (link.probing) {
        const double grown = parameters_.increase_threshold_factor * link.increase_threshold;
        const int bound = std::max(parameters_.max_increase_threshold, link.increase_threshold);
        link.increase_threshold = static_cast<int>(std::min(grown, static_cast<double>(bound)));
        decrease(link, now);
    } else if (link.failures >= parameters_.decrease_threshold) {
        link.increase_threshold = parameters_.increase_threshold;
        decrease(link, now);
    }
}

void ArfRateControl::increase(Link& link, SimTime now) const {
    link.changed = now;
    link.successes = 0;
    if (link.mode + 1 < modes_.modes().size()) {
        ++link.mode;
        link.failures = 0;
        link.probing = true;
    }
}

void ArfRateControl::decrease(Link& link, SimTime now) const {
    link.changed = now;
    link.failures = 0;
    link.probing = false;
    if (link.mode > 0) {
        --link.mode;
    }
}

}  // namespace netsim
