#include "netsim/medium/links.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "netsim/error.hpp"

namespace netsim {

RadioId Links::add(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna,
                   SimTime now) {
    const RadioId radio = count();
    const Trajectory& trajectory = *receiver.trajectory;
    radios_.push_back(Radio{.listener = receiver.listener,
                            .stream = interface.stream(),
                            .kind = kind_index(receiver.kind) & most_kinds});
    trajectories_.push_back(&trajectory);
    antennas_.add(antenna, trajectory);
    if (first_radio_.empty() || this->interface(first_radio_.back()).node != interface.node) {
        NETSIM_ASSERT(interface.node == static_cast<NodeId>(first_radio_.size()));
        first_radio_.push_back(radio);
        odometer_.watch(trajectory, now);
    }
    Audience& audience = audiences_[audience_of(radio)];
    audience.most_antenna_gain = std::max(audience.most_antenna_gain, antenna.max_gain());
    audience.reach = {};
    audience.ring_reach = {};
    audience.outer_reach = {};
    audience.members.add(radio, trajectory);
    return radio;
}

std::uint32_t Links::kind_index(const ReceiverKind& kind) {
    // Mostly that of the one before. Only the latest are looked at: each radio may have a kind of its own.
    constexpr std::ptrdiff_t most = 16;
    const auto last = kinds_.rbegin() + std::min(most, std::ssize(kinds_));
    const auto known = std::find(kinds_.rbegin(), last, kind);
    if (known != last) {
        return static_cast<std::uint32_t>(kinds_.rend() - known - 1);
    }
    kinds_.push_back(kind);
    audience_of_.push_back(audience_index(kind));
    return static_cast<std::uint32_t>(kinds_.size() - 1);
}

std::uint32_t Links::audience_index(const ReceiverKind& kind) {
    // Less than the difference by what the sum with the noise may be rounded.
    const double energy_w = kind.energy_detection_w - kind.noise_w - 1e-15 * kind.energy_detection_w;
    const double least_w = std::min(kind.sensitivity_w, energy_w);
    const int keenness = least_w > 0 ? std::ilogb(least_w) / 2 : std::numeric_limits<int>::min();
    auto audience = std::find_if(audiences_.begin(), audiences_.end(), [&](const Audience& other) {
        return other.keenness == keenness && other.band == kind.band && other.formats == kind.formats;
    });
    if (audience == audiences_.end()) {
        audiences_.push_back(Audience{.band = kind.band,
                                      .formats = kind.formats,
                                      .keenness = keenness,
                                      .least_w = least_w,
                                      .least_energy_w = energy_w,
                                      .members = Neighbours()});
        audience = audiences_.end() - 1;
    }
    audience->least_w = std::min(audience->least_w, least_w);
    audience->least_energy_w = std::min(audience->least_energy_w, energy_w);
    audience->most_energy_w = std::max(audience->most_energy_w, kind.energy_detection_w);
    return static_cast<std::uint32_t>(audience - audiences_.begin());
}

RadioId Links::addressee_of(const Transmission& sent) const {
    const NodeId node = sent.label.destination;
    if (node < 0 || static_cast<std::size_t>(node) >= first_radio_.size()) {
        return -1;
    }
    for (RadioId radio = first_radio_[node]; radio < count() && interface(radio).node == node; ++radio) {
        if (radio != sent.radio && kind(radio).can_decode(sent)) {
            return radio;
        }
    }
    return -1;
}

double Links::known_reach_m(KnownReach& known, const Transmission& sent, const Audience& audience,
                            double power_w) const {
    const double gain = power_w / most_power_w(sent, audience);
    if (known.gain != gain || known.carrier_hz != sent.band.carrier_hz) {
        known = {gain, sent.band.carrier_hz, reach_of_power_m(sent, audience, power_w)};
    }
    return known.reach_m;
}

double Links::reach_of_power_m(const Transmission& sent, const Audience& audience, double power_w) const {
    // Who is in doubt gets the exact calculation.
    return power_w > 0 ? propagation_.reach_m(power_w / most_power_w(sent, audience), sent.band.carrier_hz) *
                             (1 + rounding_margin)
                       : std::numeric_limits<double>::infinity();
}

double Links::loud_to_all_m(const Transmission& sent, const Audience& audience) const {
    constexpr double more = 1 + 1e-8;  // for rounding
    if (!antennas_.all_isotropic()) {
        return 0;
    }
    return propagation_.sure_reach_m(audience.most_energy_w * more / most_power_w(sent, audience),
                                     sent.band.carrier_hz) /
           more;
}

}  // namespace netsim
