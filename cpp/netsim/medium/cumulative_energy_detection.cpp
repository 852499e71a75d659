// Each transmission has watch zones in each group of receivers. While the transmission lasts at a
// watched receiver, one of two conditions holds at any time: the radio was notified of enough
// arrivals to find its channel busy, or the energy is below its ED threshold by at least the known
// headroom. If bounds cannot show the headroom, the sum of the powers does (energy_timeline.hpp).
//
// The evaluation of a radio is deferred while nothing depends on it: until the reported arrivals no
// longer suffice, or the next frame arrives. By then, more frames are known, or the radio is
// transmitting.
#include "netsim/medium/cumulative_energy_detection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace netsim {

void CumulativeEnergyDetection::begin_zones(ActiveTransmission& here, std::size_t index) {
    ReceiverGroup& group = links_.groups()[index];
    const Transmission& sent = here.transmission;
    WatchZones& zones = here.zones[index];
    const double level_w = group.min_noticed_energy_w();
    if (level_w < std::numeric_limits<double>::min()) {  // too small to divide into zones
        zones.begin_without_zones();
        return;
    }
    zones.begin(level_w,
                links_.known_reach_m(group.zone_reach, sent, group, WatchZones::first_zone_w(level_w)),
                links_.known_reach_m(group.outer_zone_reach, sent, group, WatchZones::outer_zone_w(level_w)));
    here.zone_radius_m = std::max(here.zone_radius_m, zones.radius_m());
}

void CumulativeEnergyDetection::evaluate(ActiveTransmission& newest,
                                         const std::vector<ActiveTransmission*>& concurrent) {
    for (std::size_t group = 0; group < links_.groups().size(); ++group) {
        if (newest.shares[group] > 0) {
            evaluate_group(newest, concurrent, group);
        }
    }
}

// Many transmissions may start at one instant, such as those of stations whose slots end together.
// By the end of the instant, most of the watching radios transmit, too, and need no evaluation. So
// all but the first few transmissions are evaluated at the end of the instant. They arrive later,
// except at a radio at the same position.
void CumulativeEnergyDetection::add(ActiveTransmission& newest,
                                    const std::vector<ActiveTransmission*>& concurrent) {
    constexpr std::size_t few = 4;
    if (concurrent.size() < few ||
        concurrent[concurrent.size() - few]->transmission.start < newest.transmission.start) {
        evaluate(newest, concurrent);
        return;
    }
    started_now_.push_back(&newest);
    if (!std::exchange(evaluates_at_end_of_instant_, true)) {
        const auto at_its_end = [this] {
            evaluates_at_end_of_instant_ = false;
            evaluate_started_now();
        };
        simulator_.schedule_at(simulator_.now(), at_its_end, Priority::last);
    }
    if (newest.arrives_immediately) {
        evaluate_started_now();
    }
}

void CumulativeEnergyDetection::evaluate_started_now() {
    for (ActiveTransmission* each : started_now_) {
        active_transmissions_.find_concurrent(*each, concurrent_);
        evaluate(*each, concurrent_);
    }
    started_now_.clear();
}

void CumulativeEnergyDetection::evaluate_group(ActiveTransmission& newest,
                                               const std::vector<ActiveTransmission*>& concurrent,
                                               std::size_t group) {
    for (ActiveTransmission* other : concurrent) {
        if (other->shares[group] > 0) {
            add_to_zones(*other, newest, group);
            if (other->zones[group].is_too_narrow()) {
                widen_zones(*other, newest, concurrent, group);
            }
            add_to_zones(newest, *other, group);
        }
    }
    if (newest.zones[group].is_too_narrow()) {
        widen_zones(newest, newest, concurrent, group);
    }
}

void CumulativeEnergyDetection::add_to_zones(ActiveTransmission& here, const ActiveTransmission& there,
                                             std::size_t group) {
    WatchZones& zones = here.zones[group];
    const auto bound_w = active_transmissions_.max_received_w(
        there, here, links_.max_power_w(there.transmission, links_.groups()[group]));
    const double max_w = bound_w(zones.radius_m());
    std::erase_if(zones.watched(), [this](const WatchZones::Watched& watched) {
        return !links_.watches_energy(watched.radio);
    });
    for (WatchZones::Watched& watched : zones.watched()) {
        if (watched.headroom_w > max_w) {
            watched.headroom_w -= max_w;
            continue;
        }
        // The bound is too loose; the exact power may be small enough.
        if (!timelines_.has(watched.radio)) {
            watched.headroom_w -= power_at(there, watched.radio, watched.place);
            if (watched.headroom_w > 0) {
                continue;
            }
        }
        watched.headroom_w = headroom_at(watched.radio, watched.place);
    }
    zones.add(bound_w);
}

void CumulativeEnergyDetection::widen_zones(ActiveTransmission& here, const ActiveTransmission& newest,
                                            const std::vector<ActiveTransmission*>& concurrent,
                                            std::size_t index) {
    ReceiverGroup& group = links_.groups()[index];
    const Transmission& sent = here.transmission;
    WatchZones& zones = here.zones[index];
    const auto visit_others = [&](const auto& visitor) {
        if (&newest != &here) {
            visitor(newest);
        }
        for (const ActiveTransmission* other : concurrent) {
            if (other != &here && other->shares[index] > 0) {
                visitor(*other);
            }
        }
    };
    zones.reset_others(concurrent.size(),
                       [&](double power_w) { return links_.reach_of_power_m(sent, group, power_w); });
    visit_others([&](const ActiveTransmission& other) {
        zones.add(
            active_transmissions_.max_received_w(other, here, links_.max_power_w(other.transmission, group)));
    });
    if (!zones.is_too_narrow()) {
        return;
    }
    const double min_watched_w = zones.min_power_w();
    zones.widen();
    const double radius_m = zones.radius_m();
    here.zone_radius_m = std::max(here.zone_radius_m, radius_m);
    bounds_.clear();
    visit_others([&](const ActiveTransmission& other) {
        const double max_sent_w = links_.max_power_w(other.transmission, group);
        bounds_.push_back({&other, active_transmissions_.max_received_w(other, here, max_sent_w)(radius_m)});
    });
    // The largest bounds belong to the nearest transmissions, and are the loosest.
    std::ranges::sort(bounds_, std::greater(), &Bound::max_w);
    double sum_w = 0;
    std::for_each(bounds_.rbegin(), bounds_.rend(),
                  [&](Bound& bound) { sum_w = bound.sum_w = sum_w + bound.max_w; });
    const double share = here.shares[index];
    const double moved_m = links_.displacement().total_m(simulator_.now()) - here.displacement_m;
    const double ed_radius_m = std::max(links_.ed_radius_m(sent, group) - moved_m, 0.0);
    for (const auto& [place, radio] : group.members.near(sent.origin, radius_m + moved_m)) {
        if (!links_.watches_energy(radio) ||
            squared_distance(sent.origin, place) < ed_radius_m * ed_radius_m || radio == sent.radio) {
            continue;
        }
        ++evaluation_count_;
        const double power_w = moved_m > 0 || !links_.displacement().all_stand()
                                   ? active_transmissions_.arrival_at(here, radio).power_w
                                   : links_.power_w(sent, share, radio, place, distance(sent.origin, place),
                                                    zones.min_power_w());
        if (power_w >= zones.min_power_w() && power_w < min_watched_w &&
            !links_.receiver(radio).surely_exceeds_ed(power_w)) {
            zones.watched().push_back({radio, place, headroom_by_bounds(radio, place, power_w)});
        }
    }
}

// Replaces bounds by exact powers, one after the other, until there is headroom.
double CumulativeEnergyDetection::headroom_by_bounds(RadioId radio, const Position& place, double power_w) {
    if (!timelines_.has(radio)) {
        const ReceiverParameters& receiver = links_.receiver(radio);
        const double threshold_w = receiver.energy_detection_w * (1 - rounding_margin);
        double energy_w = receiver.noise_w + power_w;
        auto bound = bounds_.begin();
        for (; bound != bounds_.end() && energy_w + bound->sum_w >= threshold_w; ++bound) {
            energy_w += power_at(*bound->from, radio, place);
        }
        const double headroom_w = threshold_w - (energy_w + (bound == bounds_.end() ? 0 : bound->sum_w));
        if (headroom_w > 0) {
            return headroom_w;
        }
    }
    return headroom_at(radio, place);
}

double CumulativeEnergyDetection::headroom_at(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    ReceiverTimeline& state = timelines_.of(radio, links_.receiver(radio).noise_w, now);
    if (state.next_id == active_transmissions_.next_id() && state.deferred_until == SimTime::long_ago()) {
        return state.headroom_w;
    }
    if (now < state.deferred_until) {
        return unknown_w;
    }
    state.timeline.begin_at(now);
    for (std::uint64_t id = std::max(state.next_id, active_transmissions_.first_id());
         id < active_transmissions_.next_id(); ++id) {
        const ActiveTransmission& other = active_transmissions_.of_id(id);
        if (other.last_end > now) {
            add_to_timeline(state.timeline, radio, place, other);
        }
    }
    state.next_id = active_transmissions_.next_id();
    const SimTime deferred_until =
        just_before(state.timeline.reported_until(links_.receiver(radio).energy_detection_w));
    if (now < deferred_until && state.timeline.unreported_count() >= min_deferred) {
        state.deferred_until = deferred_until;
        evaluate_at(radio, deferred_until);
        return unknown_w;
    }
    state.deferred_until = SimTime::long_ago();
    state.headroom_w = state.timeline.report_missing(
        links_.receiver(radio).energy_detection_w, [&](const EnergyTimeline::Signal& signal) {
            ActiveTransmission& other = active_transmissions_.of_id(signal.transmission);
            // For a moving radio, `place` is approximate. Only lockable arrivals use it.
            listener_.arrival_needed(
                radio, other,
                Arrival{&other.transmission, signal.start, signal.end, signal.power_w, place, false, &other});
        });
    return state.headroom_w;
}

void CumulativeEnergyDetection::evaluate_at(RadioId radio, SimTime time) {
    const auto look = [this, radio] {
        if (links_.watches_energy(radio)) {
            headroom_at(radio, links_.position(radio, simulator_.now()));
        }
    };
    simulator_.schedule_at(time, look, Priority::last);
}

void CumulativeEnergyDetection::add_to_timeline(EnergyTimeline& timeline, RadioId radio,
                                                const Position& place, const ActiveTransmission& active) {
    const Transmission& sent = active.transmission;
    if (sent.radio == radio || active_transmissions_.share_at(active, radio) == 0) {
        return;
    }
    ++evaluation_count_;
    const Arrival arrival = active_transmissions_.arrival_at(active, radio, place, simulator_.now());
    if (has_ended(active, arrival, radio)) {
        return;
    }
    const EnergyTimeline::Signal signal{sent.id(), arrival.start, arrival.end, arrival.power_w};
    const bool exceeds_ed_alone = links_.receiver(radio).exceeds_ed(arrival.power_w);
    if (arrival.lockable || exceeds_ed_alone) {
        timeline.add_reported(
            signal, arrival.lockable ? arrival.start + links_.receiver(radio).detection_time : arrival.start,
            exceeds_ed_alone);
    } else {
        timeline.add_unreported(signal);
    }
}

SimTime CumulativeEnergyDetection::watch(RadioId radio, SimTime since) {
    if (active_transmissions_.empty()) {
        return SimTime::long_ago();
    }
    const Position place = links_.position(radio, simulator_.now());
    if (!may_be_in_watch_zone(place, since)) {
        return SimTime::long_ago();  // usually, all transmissions are far away
    }
    const double max_sum_w = find_recent(radio, place, since);
    if (std::ranges::none_of(recent_, &RecentSignal::is_in_watch_zone)) {
        return SimTime::long_ago();
    }
    const bool was_busy = since < simulator_.now() && links_.receiver(radio).headroom_w(max_sum_w) <= 0;
    const SimTime over = was_busy ? last_busy_end(radio, place, since) : SimTime::long_ago();
    watch_recent(radio, place);
    return over;
}

// Whether a radio now at `place` may have been in a watch zone after `since`. Outside all zones,
// several transmissions cannot make its channel busy together.
bool CumulativeEnergyDetection::may_be_in_watch_zone(const Position& place, SimTime since) const {
    const double displacement_m = links_.displacement().total_m(simulator_.now());
    // Branch-free: the processor cannot predict which of them have ended.
    int zone_count = 0;
    for (const std::unique_ptr<ActiveTransmission>& active : active_transmissions_.entries()) {
        const double within_m =
            (active->zone_radius_m + (displacement_m - active->displacement_m)) * (1 + rounding_margin);
        const double squared_m2 = squared_distance(active->transmission.origin, place);
        zone_count +=
            static_cast<int>(active->last_end > since) & static_cast<int>(squared_m2 <= within_m * within_m);
    }
    return zone_count > 0;
}

// Fills `recent_` with the signals after `since`. Returns an upper bound for their sum at any time.
double CumulativeEnergyDetection::find_recent(RadioId radio, const Position& place, SimTime since) {
    const std::uint32_t group = links_.group_of(radio);
    // A signal of this power makes the channel busy alone. Larger terms would lose the others to
    // rounding when they are subtracted again.
    const double threshold_w = links_.receiver(radio).energy_detection_w;
    recent_.clear();
    std::size_t first = 0;  // in recent_: the first signal that may overlap with the current one
    double sum_w = 0;
    double max_sum_w = 0;
    for (const std::unique_ptr<ActiveTransmission>& active : active_transmissions_.entries()) {
        const Transmission& sent = active->transmission;
        if (active->last_end <= since || active->shares[group] == 0 || sent.radio == radio) {
            continue;
        }
        const double power_w = power_at(*active, radio, place);
        recent_.push_back({active.get(), power_w, power_w >= active->zones[group].min_power_w()});
        sum_w += std::min(power_w, threshold_w);
        for (; recent_[first].active->last_end <= sent.start; ++first) {
            sum_w -= std::min(recent_[first].power_w, threshold_w);
        }
        max_sum_w = std::max(max_sum_w, sum_w);
    }
    return max_sum_w;
}

// Adds the radio to the watch zones that contain it. Only transmissions in `recent_` that are still
// on the air count.
void CumulativeEnergyDetection::watch_recent(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    const ReceiverParameters& here = links_.receiver(radio);
    const std::uint32_t group = links_.group_of(radio);
    // Drop signals that have ended at all receivers, and those in a watch zone that have ended here.
    std::erase_if(recent_, [&](const RecentSignal& recent) {
        return recent.active->last_end <= now ||
               (recent.is_in_watch_zone &&
                has_ended(*recent.active, active_transmissions_.arrival_at(*recent.active, radio, place, now),
                          radio));
    });
    double sum_w = 0;
    for (const RecentSignal& recent : recent_) {
        sum_w += recent.power_w;
    }
    double headroom_w = here.headroom_w(sum_w);
    if (headroom_w <= 0) {
        headroom_w = headroom_before_next(radio, place);
    }
    for (const auto& [active, power_w, is_in_watch_zone] : recent_) {
        if (is_in_watch_zone && !here.surely_exceeds_ed(power_w)) {
            const Position then = active_transmissions_.arrival_at(*active, radio, place, now).place;
            active->zones[group].watched().push_back({radio, then, headroom_w});
        }
    }
}

// Like headroom_at, but the evaluation is deferred if several signals in `recent_` have not arrived
// yet and it depends on them.
double CumulativeEnergyDetection::headroom_before_next(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    const ReceiverParameters& here = links_.receiver(radio);
    double sum_w = 0;
    double arrived_sum_w = 0;
    SimTime next_start = SimTime::never();
    std::size_t unarrived = 0;
    for (const RecentSignal& recent : recent_) {
        const Arrival arrival = active_transmissions_.arrival_at(*recent.active, radio, place, now);
        if (has_ended(*recent.active, arrival, radio)) {
            continue;
        }
        sum_w += arrival.power_w;
        if (simulator_.has_passed(arrival.start,
                                  recent.active->sequence_number(radio, ActiveTransmission::begins))) {
            arrived_sum_w += arrival.power_w;
        } else {
            next_start = std::min(next_start, arrival.start);
            ++unarrived;
        }
    }
    const double headroom_w = here.headroom_w(sum_w);
    if (headroom_w > 0) {
        return headroom_w;
    }
    if (next_start > now && here.headroom_w(arrived_sum_w) > 0 && unarrived >= min_deferred) {
        evaluate_at(radio, just_before(next_start));
        return unknown_w;
    }
    return headroom_at(radio, place);
}

// Sums powers in the order of the transmissions, as the radio does.
SimTime CumulativeEnergyDetection::last_busy_end(RadioId radio, const Position& place, SimTime since) {
    const ReceiverParameters& here = links_.receiver(radio);
    const SimTime now = simulator_.now();
    changes_.clear();
    for (const RecentSignal& recent : recent_) {
        const Arrival arrival = active_transmissions_.arrival_at(*recent.active, radio, place, now);
        if (arrival.end > since) {
            const ActiveTransmission& active = *recent.active;
            changes_.push_back(
                {arrival.start, active.sequence_number(radio, ActiveTransmission::begins), &recent, true});
            changes_.push_back(
                {arrival.end, active.sequence_number(radio, ActiveTransmission::ends), &recent, false});
        }
    }
    std::ranges::sort(changes_, [](const Change& a, const Change& b) {
        return a.time != b.time ? a.time < b.time : a.number < b.number;
    });
    present_.clear();
    SimTime over = SimTime::long_ago();
    bool was_busy = false;
    for (const Change& change : changes_) {
        if (!simulator_.has_passed(change.time, change.number)) {
            break;
        }
        if (change.begins) {
            present_.insert(std::ranges::upper_bound(present_, change.recent), change.recent);
        } else {
            std::erase(present_, change.recent);
        }
        double energy_w = here.noise_w;
        for (const RecentSignal* recent : present_) {
            energy_w += recent->power_w;
        }
        const bool is_busy = !present_.empty() && energy_w >= here.energy_detection_w;
        if (was_busy && !is_busy) {
            over = change.time;
        }
        was_busy = is_busy;
    }
    return over;
}

}  // namespace netsim
