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
                            .parameters = parameters_index(receiver.parameters) & max_parameter_sets});
    trajectories_.push_back(&trajectory);
    antennas_.add(antenna, trajectory);
    if (first_radio_.empty() || this->interface(first_radio_.back()).node != interface.node) {
        NETSIM_ASSERT(interface.node == static_cast<NodeId>(first_radio_.size()));
        first_radio_.push_back(radio);
        displacement_.watch(trajectory, now);
    }
    ReceiverGroup& group = groups_[group_of(radio)];
    group.max_antenna_gain = std::max(group.max_antenna_gain, antenna.max_gain());
    group.reach = {};
    group.zone_reach = {};
    group.outer_zone_reach = {};
    group.members.add(radio, trajectory);
    return radio;
}

std::uint32_t Links::parameters_index(const ReceiverParameters& parameters) {
    // Usually equal to those of the previous radio. Only the latest are compared, since each radio
    // may have its own parameters.
    constexpr std::ptrdiff_t most = 16;
    const auto last = parameters_.rbegin() + std::min(most, std::ssize(parameters_));
    const auto known = std::find(parameters_.rbegin(), last, parameters);
    if (known != last) {
        return static_cast<std::uint32_t>(parameters_.rend() - known - 1);
    }
    parameters_.push_back(parameters);
    group_of_.push_back(group_index(parameters));
    return static_cast<std::uint32_t>(parameters_.size() - 1);
}

std::uint32_t Links::group_index(const ReceiverParameters& parameters) {
    // The difference, minus the possible rounding error of its sum with the noise.
    const double energy_w =
        parameters.energy_detection_w - parameters.noise_w - 1e-15 * parameters.energy_detection_w;
    const double min_w = std::min(parameters.sensitivity_w, energy_w);
    const int sensitivity_class = min_w > 0 ? std::ilogb(min_w) / 2 : std::numeric_limits<int>::min();
    auto group = std::find_if(groups_.begin(), groups_.end(), [&](const ReceiverGroup& other) {
        return other.sensitivity_class == sensitivity_class && other.band == parameters.band &&
               other.formats == parameters.formats;
    });
    if (group == groups_.end()) {
        groups_.push_back(ReceiverGroup{.band = parameters.band,
                                        .formats = parameters.formats,
                                        .sensitivity_class = sensitivity_class,
                                        .min_power_w = min_w,
                                        .min_energy_w = energy_w,
                                        .members = NeighborSearch()});
        group = groups_.end() - 1;
    }
    group->min_power_w = std::min(group->min_power_w, min_w);
    group->min_energy_w = std::min(group->min_energy_w, energy_w);
    group->max_energy_w = std::max(group->max_energy_w, parameters.energy_detection_w);
    return static_cast<std::uint32_t>(group - groups_.begin());
}

RadioId Links::addressee_of(const Transmission& sent) const {
    return decoder_at(sent.label.destination, sent);
}

RadioId Links::decoder_at(NodeId node, const Transmission& sent) const {
    if (node < 0 || static_cast<std::size_t>(node) >= first_radio_.size()) {
        return -1;
    }
    for (RadioId radio = first_radio_[node]; radio < count() && interface(radio).node == node; ++radio) {
        if (radio != sent.radio && receiver(radio).can_decode(sent)) {
            return radio;
        }
    }
    return -1;
}

double Links::known_reach_m(KnownReach& known, const Transmission& sent, const ReceiverGroup& group,
                            double power_w) const {
    const double gain = power_w / max_power_w(sent, group);
    if (known.gain != gain || known.carrier_hz != sent.band.carrier_hz) {
        known = {gain, sent.band.carrier_hz, reach_of_power_m(sent, group, power_w)};
    }
    return known.reach_m;
}

double Links::reach_of_power_m(const Transmission& sent, const ReceiverGroup& group, double power_w) const {
    // With the margin, receivers near the limit get the exact computation.
    return power_w > 0 ? propagation_.reach_m(power_w / max_power_w(sent, group), sent.band.carrier_hz) *
                             (1 + rounding_margin)
                       : std::numeric_limits<double>::infinity();
}

PowerBudget Links::power_budget(const Transmission& sent, RadioId radio, const Position& place) const {
    PowerBudget budget{.sent_w = sent.power_w * sent.band.share_in(receiver(radio).band)};
    if (!antennas_.all_isotropic()) {
        budget.sender_antenna = antennas_.sender_gain(sent, place);
        budget.receiver_antenna = antennas_.receiver_gain(sent, radio, place);
    }
    propagation_.explain(sent, interface(radio), place, distance(sent.origin, place), budget);
    return budget;
}

std::optional<FrameObserver::Loss> Links::below_sensitivity(const Transmission& sent, RadioId radio,
                                                            const Position& place) const {
    const double received_w = arrival(sent, 1, radio, place).power_w;
    const double sensitivity_w = receiver(radio).sensitivity_w;
    if (received_w >= sensitivity_w) {
        return std::nullopt;
    }
    return FrameObserver::Loss{.receiver = interface(radio).node,
                               .power_w = received_w,
                               .budget = power_budget(sent, radio, place),
                               .needed = sensitivity_w};
}

bool Links::is_in_steady_reach(const Transmission& sent, RadioId radio, const Position& place) const {
    const double best_w = sent.power_w * sent.band.share_in(receiver(radio).band) *
                          antennas_.max_gain(sent.radio) * antennas_.max_gain(radio);
    return best_w > 0 &&
           distance(sent.origin, place) <=
               propagation_.steady_reach_m(receiver(radio).sensitivity_w / best_w, sent.band.carrier_hz);
}

double Links::steady_reach_m(const Transmission& sent, const ReceiverGroup& group) const {
    return propagation_.steady_reach_m(group.min_power_w / max_power_w(sent, group), sent.band.carrier_hz) *
           (1 + rounding_margin);
}

double Links::ed_radius_m(const Transmission& sent, const ReceiverGroup& group) const {
    constexpr double more = 1 + 1e-8;  // for rounding
    if (!antennas_.all_isotropic()) {
        return 0;
    }
    return propagation_.sure_reach_m(group.max_energy_w * more / max_power_w(sent, group),
                                     sent.band.carrier_hz) /
           more;
}

}  // namespace netsim
