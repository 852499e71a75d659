#include "netsim/medium/medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "netsim/units.hpp"

namespace netsim {

namespace {

SimTime propagation_delay(double distance_m) {
    return SimTime::from_seconds(distance_m / speed_of_light_mps);
}

}  // namespace

Medium::Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
               Hearing hearing)
    : simulator_(simulator),
      fates_(fates),
      fingerprint_(fingerprint),
      path_loss_(make_path_loss(config)),
      background_noise_w_(config.background_noise_w),
      hearing_(hearing) {}

NodeId Medium::attach(const Receiver& receiver) {
    attached_.push_back(Attached{receiver});
    return static_cast<NodeId>(attached_.size()) - 1;
}

void Medium::transmit(Transmission transmission) {
    forget_the_past();
    const SimTime now = simulator_.now();
    transmission.id = next_id_++;
    transmission.start = now;
    transmission.origin = attached_[transmission.sender].receiver.trajectory->position_at(now);
    const bool overlaps_others = may_overlap(transmission);
    fingerprint_.add(static_cast<std::uint64_t>(now.ps()));
    fingerprint_.add((static_cast<std::uint64_t>(transmission.sender) << 32) ^ transmission.psdu_bytes);

    OnAir& entry = on_air_.emplace_back(
        OnAir{std::move(transmission), now, simulator_.reserve_places(2 * attached_.size()), {}});
    const Transmission& sent = entry.transmission;
    CopyCount addressed;
    CopyCount overheard;
    double farthest_m2 = 0;
    for (NodeId node = 0; node < static_cast<NodeId>(attached_.size()); ++node) {
        Attached& attached = attached_[node];
        const Receiver& receiver = attached.receiver;
        if (node == sent.sender || !sent.band.fits_in(receiver.band)) {
            continue;
        }
        CopyCount& count = sent.label.is_for(node) ? addressed : overheard;
        ++count.made;
        const double distance_m2 = squared_distance(sent.origin, receiver.trajectory->position_at(now));
        farthest_m2 = std::max(farthest_m2, distance_m2);
        if (!overlaps_others && distance_m2 > squared_reach_m2(attached, sent)) {
            ++count.too_weak;
            continue;
        }
        const Arrival arrival = arrival_at(sent, receiver);
        if (arrival.power_w < receiver.sensitivity_w) {
            ++count.too_weak;
        }
        if (is_told_alone(receiver, arrival.power_w)) {
            tell(node, entry, arrival);
        }
        if (overlaps_others && background_noise_w_ + arrival.power_w < receiver.energy_detection_w) {
            tell_if_energy_adds_up(node, entry, arrival);
        }
    }
    entry.last_end = now + propagation_delay(std::sqrt(farthest_m2)) + sent.duration;
    fates_.book_transmission(sent.label, addressed, overheard);
}

bool Medium::may_overlap(const Transmission& newest) const {
    // At any receiver, the ends of two frames are shifted against each other by at most the distance of their
    // senders (triangle inequality), and by what the receiver moves in between, for which the slack is ample.
    static constexpr SimTime slack = SimTime::from_us(1);
    return std::any_of(on_air_.begin(), on_air_.end(), [&newest](const OnAir& other) {
        const SimTime shift = propagation_delay(distance(other.transmission.origin, newest.origin));
        return other.transmission.start + other.transmission.duration + shift + slack > newest.start;
    });
}

double Medium::squared_reach_m2(Attached& attached, const Transmission& transmission) const {
    if (attached.tx_power_w != transmission.power_w || attached.carrier_hz != transmission.band.carrier_hz) {
        const Receiver& receiver = attached.receiver;
        const double least_w =
            std::min(receiver.sensitivity_w, receiver.energy_detection_w - background_noise_w_);
        // Out of reach is said only with a margin for rounding; who is in doubt gets the exact calculation.
        constexpr double margin = 1 + 1e-9;
        const double reach_m =
            least_w > 0 && hearing_ == Hearing::what_matters
                ? path_loss_.reach_m(least_w / transmission.power_w, transmission.band.carrier_hz) * margin
                : std::numeric_limits<double>::infinity();
        attached.tx_power_w = transmission.power_w;
        attached.carrier_hz = transmission.band.carrier_hz;
        attached.squared_reach_m2 = reach_m * reach_m;
    }
    return attached.squared_reach_m2;
}

Arrival Medium::arrival_at(const Transmission& transmission, const Receiver& receiver) const {
    const Position there = receiver.trajectory->position_at(transmission.start);
    const double distance_m = distance(transmission.origin, there);
    const SimTime start = transmission.start + propagation_delay(distance_m);
    return Arrival{&transmission, start, start + transmission.duration,
                   transmission.power_w * path_loss_.gain(distance_m, transmission.band.carrier_hz)};
}

// The events of an arrival have their places in the order of equal times since its transmission began: the
// course of a run does not depend on when, or whether, a radio is told.
void Medium::tell(NodeId node, const OnAir& on_air, const Arrival& arrival) {
    if (arrival.start < simulator_.now()) {
        // It came to matter after it had begun: nothing that the radio could have noticed happened in
        // between.
        begin(node, on_air, arrival);
        return;
    }
    simulator_.schedule_at_place(
        arrival.start, on_air.first_place + 2 * static_cast<Place>(node),
        [this, node, &on_air, power_w = arrival.power_w] {
            const SimTime start = simulator_.now();
            const Transmission& transmission = on_air.transmission;
            begin(node, on_air, Arrival{&transmission, start, start + transmission.duration, power_w});
        });
}

void Medium::begin(NodeId node, const OnAir& on_air, const Arrival& arrival) {
    attached_[node].receiver.listener->arrival_started(arrival);
    simulator_.schedule_at_place(
        arrival.end, on_air.first_place + 2 * static_cast<Place>(node) + 1,
        [this, node, transmission = arrival.transmission, power_w = arrival.power_w] {
            const SimTime end = simulator_.now();
            attached_[node].receiver.listener->arrival_ended(
                Arrival{transmission, end - transmission->duration, end, power_w});
        });
}

void Medium::tell_if_energy_adds_up(NodeId node, OnAir& newest, const Arrival& arrival) {
    const Receiver& receiver = attached_[node].receiver;
    double sum_w = background_noise_w_ + arrival.power_w;
    together_.clear();
    if (!is_told_alone(receiver, arrival.power_w)) {
        together_.emplace_back(&newest, arrival);
    }
    for (OnAir& other : on_air_) {
        if (&other == &newest || other.transmission.sender == node ||
            !other.transmission.band.fits_in(receiver.band)) {
            continue;
        }
        const Arrival beside = arrival_at(other.transmission, receiver);
        if (beside.end <= arrival.start || beside.start >= arrival.end ||
            background_noise_w_ + beside.power_w >= receiver.energy_detection_w) {
            continue;
        }
        sum_w += beside.power_w;
        if (!is_told_alone(receiver, beside.power_w) &&
            std::find(other.told_later.begin(), other.told_later.end(), node) == other.told_later.end()) {
            together_.emplace_back(&other, beside);
        }
    }
    if (sum_w < receiver.energy_detection_w) {
        return;
    }
    for (auto& [on_air, unnoticed] : together_) {
        on_air->told_later.push_back(node);
        tell(node, *on_air, unnoticed);
    }
}

const Interference& Medium::interference_with(NodeId receiver, const Arrival& arrival) {
    interference_.max_power_w = 0;
    interference_.interferers.clear();
    if (on_air_.size() <= 1) {
        return interference_;
    }
    const Receiver& here = attached_[receiver].receiver;
    overlapping_.clear();
    for (const OnAir& other : on_air_) {
        if (&other.transmission == arrival.transmission || other.transmission.sender == receiver ||
            !other.transmission.band.fits_in(here.band) || other.last_end <= arrival.start ||
            other.transmission.start >= arrival.end) {
            continue;
        }
        const Arrival beside = arrival_at(other.transmission, here);
        if (beside.start < arrival.end && beside.end > arrival.start) {
            overlapping_.push_back(beside);
        }
    }
    // The sum is a step function that only rises where an arrival starts: look there.
    SimTime worst;
    for (const Arrival& candidate : overlapping_) {
        const SimTime moment = std::max(candidate.start, arrival.start);
        double sum_w = 0;
        for (const Arrival& beside : overlapping_) {
            if (beside.start <= moment && moment < beside.end) {
                sum_w += beside.power_w;
            }
        }
        if (sum_w > interference_.max_power_w) {
            interference_.max_power_w = sum_w;
            worst = moment;
        }
    }
    for (const Arrival& beside : overlapping_) {
        const NodeId sender = beside.transmission->sender;
        auto& interferers = interference_.interferers;
        if (beside.start <= worst && worst < beside.end &&
            std::find(interferers.begin(), interferers.end(), sender) == interferers.end()) {
            interferers.push_back(sender);
        }
    }
    return interference_;
}

void Medium::forget_the_past() {
    const SimTime now = simulator_.now();
    const auto active = std::find_if(on_air_.begin(), on_air_.end(),
                                     [now](const OnAir& entry) { return entry.last_end >= now; });
    const SimTime needed_from = active == on_air_.end() ? now : active->transmission.start;
    while (!on_air_.empty() && on_air_.front().last_end < needed_from) {
        on_air_.pop_front();
    }
}

}  // namespace netsim
