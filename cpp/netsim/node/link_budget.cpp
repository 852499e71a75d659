#include "netsim/node/link_budget.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/medium/background_noise.hpp"
#include "netsim/node/known_formats.hpp"
#include "netsim/phy/antenna.hpp"
#include "netsim/phy/oqpsk_mode.hpp"

namespace netsim {

namespace {

constexpr int states_of_a_random_link = 2000;

MediumConfig without_obstacles(MediumConfig config) {
    config.validate();
    if (config.type_name == unit_disk_medium) {
        throw ConfigError("medium.typename = \"" + config.type_name +
                          "\": expected a medium with a path loss, whose ranges depend on power");
    }
    config.obstacle_loss.clear();
    return config;
}

const NodeConfig& checked(const NodeConfig& config) {
    config.validate();
    return config;
}

const InterfaceConfig& interface_of(const NodeConfig& node, std::size_t index) {
    if (index >= node.wlan.size()) {
        throw ConfigError(node.name + " has no interface wlan[" + std::to_string(index) + "]");
    }
    return node.wlan[index];
}

bool is_narrowband(const InterfaceConfig& interface) {
    return interface.type_name == ieee802154_interface;
}

const Mode& broadcast_mode(const InterfaceConfig& interface) {
    return is_narrowband(interface) ? oqpsk_250_kbps : netsim::broadcast_mode(interface.mac);
}

int psdu_bytes_of(const InterfaceConfig& interface, int payload_bytes) {
    check_at_least("payload_bytes", payload_bytes, 0, "B");
    const bool narrowband = is_narrowband(interface);
    const int mtu_bytes = narrowband ? narrowband_mtu_bytes : interface.mac.mtu_bytes;
    const int most_bytes = mtu_bytes - datagram_bytes(0);
    if (payload_bytes > most_bytes) {
        throw ConfigError(
            "a message of " + text_of(payload_bytes) + " B is too long: expected at most " +
            text_of(most_bytes) + " B, which " +
            (narrowband ? "a frame of 802.15.4" : "mac.mtu_bytes = " + text_of(mtu_bytes) + " B") +
            " leaves beside the headers of IPv4 and UDP");
    }
    return narrowband ? narrowband_psdu_bytes(payload_bytes) : data_psdu_bytes(payload_bytes);
}

double most_antenna_gain(const RadioConfig& radio) {
    const auto pattern = make_antenna(radio.antenna, radio.carrier_hz);
    return pattern ? pattern->max_gain() : 1;
}

}  // namespace

LinkBudget::LinkBudget(const MediumConfig& medium, const NodeConfig& sender, const NodeConfig& receiver,
                       int payload_bytes, std::size_t interface)
    : propagation_(without_obstacles(medium), 0),
      sender_(interface_of(sender, interface)),
      receiver_(interface_of(checked(receiver), interface).radio),
      band_{sender_.radio.carrier_hz, sender_.radio.bandwidth_hz},
      sender_height_m_(checked(sender).initial_position.z),
      receiver_height_m_(receiver.initial_position.z),
      antenna_gain_(most_antenna_gain(sender_.radio) * most_antenna_gain(receiver_)),
      noise_w_(BackgroundNoise(medium).power_w(receiver_.bandwidth_hz, receiver_.noise_figure)),
      error_model_(make_error_model(receiver_)),
      preamble_detection_(receiver_),
      mode_(&broadcast_mode(sender_)),
      psdu_bytes_(psdu_bytes_of(sender_, payload_bytes)),
      states_(propagation_.is_random() ? states_of_a_random_link : 1) {
    if (!band_.fits_in(Band{receiver_.carrier_hz, receiver_.bandwidth_hz})) {
        throw ConfigError("radio.carrier_hz: " + receiver.name + " does not receive the channel of " +
                          sender.name);
    }
    if (!known_formats(interface_of(receiver, interface)).contains(mode_->format)) {
        throw ConfigError("mac.op_mode: " + receiver.name + " cannot decode " + std::string(mode_->name) +
                          ", in which " + sender.name + " broadcasts");
    }
}

std::vector<double> LinkBudget::gains(double distance_m) const {
    check_at_least("distance_m", distance_m, 0, "m");
    const double rise_m = receiver_height_m_ - sender_height_m_;
    const double level_m = std::sqrt(std::max(distance_m * distance_m - rise_m * rise_m, 0.0));
    Transmission sent;
    sent.band = band_;
    sent.origin = {0, 0, sender_height_m_};
    const Position place{level_m, 0, receiver_height_m_};
    std::vector<double> all(static_cast<std::size_t>(states_));
    for (int state = 0; state < states_; ++state) {
        // Each from another pair of nodes, so that they are independent.
        sent.sender.node = 2 * state;
        sent.id = static_cast<std::uint64_t>(state);
        all[static_cast<std::size_t>(state)] =
            antenna_gain_ * propagation_.gain(sent, InterfaceId{2 * state + 1, 0}, place, distance_m);
    }
    return all;
}

double LinkBudget::mean_gain(double distance_m) const {
    const std::vector<double> all = gains(distance_m);
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

double LinkBudget::reception_ratio(double distance_m, double tx_power_w) const {
    check_at_least("tx_power_w", tx_power_w, 0, "W");
    return reception_ratio(gains(distance_m), tx_power_w);
}

double LinkBudget::reception_ratio(const std::vector<double>& gains, double tx_power_w) const {
    double sum = 0;
    for (const double gain : gains) {
        const double power_w = tx_power_w * gain;
        const double snir = power_w / noise_w_;
        if (power_w >= receiver_.sensitivity_w && snir > receiver_.snir_threshold &&
            (!preamble_detection_.is_on() || preamble_detection_.detects(power_w, snir))) {
            sum += error_model_->success_probability(*mode_, snir, psdu_bytes_);
        }
    }
    return sum / static_cast<double>(gains.size());
}

double LinkBudget::tx_power_w_for(double range_m, double ratio) const {
    constexpr double weakest_w = 1e-30;
    constexpr double strongest_w = 1e12;
    constexpr double precision = 1e-9;
    check_greater("range_m", range_m, 0, "m");
    if (!(ratio > 0) || !(ratio < 1)) {
        throw ConfigError("ratio = " + text_of(ratio) + ": expected more than 0 and less than 1");
    }
    const std::vector<double> all = gains(range_m);
    if (reception_ratio(all, strongest_w) < ratio) {
        throw ConfigError("no power reaches " + text_of(range_m) + " m: even of " + text_of(strongest_w) +
                          " W, too little is left there");
    }
    // The share never falls with the power, so the powers that do are all above one: bisection on a logarithmic scale.
    double too_weak_w = weakest_w;
    double enough_w = strongest_w;
    while (enough_w > too_weak_w * (1 + precision)) {
        const double middle_w = std::sqrt(too_weak_w) * std::sqrt(enough_w);
        (reception_ratio(all, middle_w) >= ratio ? enough_w : too_weak_w) = middle_w;
    }
    return enough_w;
}

}  // namespace netsim
