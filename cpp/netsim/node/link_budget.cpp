#include "netsim/node/link_budget.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/medium/background_noise.hpp"
#include "netsim/node/known_formats.hpp"
#include "netsim/phy/antenna.hpp"
#include "netsim/phy/oqpsk_mode.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

MediumConfig without_obstacles(MediumConfig config) {
    config.validate();
    if (config.type_name == unit_disk_medium) {
        throw ConfigError({"medium.typename",
                           "\"" + config.type_name + "\"",
                           {"expected a medium with a path loss, whose ranges depend on power"}});
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
        std::vector<MessagePart> message{"a message of ", Quantity{1.0 * payload_bytes, "B"},
                                         " is too long: expected at most ", Quantity{1.0 * most_bytes, "B"}};
        if (narrowband) {
            message.emplace_back(", which a frame of 802.15.4");
        } else {
            message.insert(message.end(),
                           {", which ", FieldName{"mac.mtu_bytes"}, " = ", Quantity{1.0 * mtu_bytes, "B"}});
        }
        message.emplace_back(" leaves beside the headers of IPv4 and UDP");
        throw ConfigError({"", "", std::move(message)});
    }
    return narrowband ? narrowband_psdu_bytes(payload_bytes) : data_psdu_bytes(payload_bytes);
}

double max_antenna_gain(const RadioConfig& radio) {
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
      antenna_gain_(max_antenna_gain(sender_.radio) * max_antenna_gain(receiver_)),
      noise_w_(BackgroundNoise(medium).power_w(receiver_.bandwidth_hz, receiver_.noise_figure)),
      error_model_(make_error_model(receiver_)),
      mode_(&broadcast_mode(sender_)),
      psdu_bytes_(psdu_bytes_of(sender_, payload_bytes)),
      other_systems_w_(medium.other_systems_w),
      other_systems_standard_deviation_db_(medium.other_systems_standard_deviation_db) {
    if (!band_.fits_in(Band{receiver_.carrier_hz, receiver_.bandwidth_hz})) {
        throw ConfigError(
            {"radio.carrier_hz", "", {receiver.name + " does not receive the channel of " + sender.name}});
    }
    if (!known_formats(interface_of(receiver, interface)).contains(mode_->format)) {
        throw ConfigError({"mac.op_mode",
                           "",
                           {receiver.name + " cannot decode " + std::string(mode_->name) + ", in which " +
                            sender.name + " broadcasts"}});
    }
    if (other_systems_w_ > 0) {
        snr_needs_ = snr_needs();
    }
    if (propagation_.is_random()) {
        needs_ = shadowed(needs());
    }
}

double LinkBudget::min_power_w() const {
    double min_w = std::max(receiver_.sensitivity_w, receiver_.snir_threshold * noise_w_);
    if (!receiver_.preamble_detection.empty()) {
        min_w =
            std::max({min_w, receiver_.preamble_minimum_power_w, receiver_.preamble_threshold * noise_w_});
    }
    return min_w;
}

double LinkBudget::success_probability(double power_w) const {
    if (other_systems_w_ > 0) {
        return success_with_other_systems(power_w);
    }
    return error_model_->success_probability(*mode_, power_w / noise_w_, psdu_bytes_);
}

// Steps of the needed power. So powers derived from it are accurate to half a step, for any fading.
constexpr double step_db = 0.02;

// At more than this below or above the noise, no probability changes.
constexpr double far_db = 100;
constexpr double too_small = 1e-12;

std::vector<LinkBudget::SnrNeed> LinkBudget::snr_needs() const {
    const double least = std::max(receiver_.snir_threshold,
                                  receiver_.preamble_detection.empty() ? 0 : receiver_.preamble_threshold);
    std::vector<SnrNeed> all;
    double known = 0;
    const int steps = static_cast<int>(2 * far_db / step_db);
    for (int step = 0; step <= steps; ++step) {
        const double snr = ratio_from_db(step_db * step - far_db);
        const double success = snr > least ? error_model_->success_probability(*mode_, snr, psdu_bytes_) : 0;
        if (success - known > too_small) {
            all.push_back({snr / ratio_from_db(step_db / 2), success - known});
            known = success;
        }
    }
    return all;
}

double LinkBudget::success_with_other_systems(double power_w) const {
    double sum = 0;
    for (const SnrNeed& need : snr_needs_) {
        const double tolerated_w = power_w / need.snr - noise_w_;
        if (tolerated_w <= 0) {
            break;
        }
        const double above_median_db = db_from_ratio(tolerated_w / other_systems_w_);
        // The share of the normal distribution below that.
        sum +=
            need.share *
            (other_systems_standard_deviation_db_ > 0
                 ? std::erfc(-above_median_db / other_systems_standard_deviation_db_ / std::numbers::sqrt2) /
                       2
                 : (above_median_db >= 0 ? 1.0 : 0.0));
    }
    return sum;
}

std::vector<LinkBudget::Need> LinkBudget::needs() const {
    const double min_w = min_power_w();
    double known = success_probability(min_w);
    std::vector<Need> all{{min_w, known}};
    const double whole_noise_w = noise_w_ + other_systems_w_;
    const double first_w = std::max(min_w, whole_noise_w * ratio_from_db(-far_db));
    const double steps = (db_from_ratio(whole_noise_w / first_w) + far_db) / step_db;  // none without noise
    for (int step = 1; step <= steps; ++step) {
        const double success = success_probability(first_w * ratio_from_db(step_db * step));
        if (std::abs(success - known) > too_small) {
            all.push_back({first_w * ratio_from_db(step_db * (step - 0.5)), success - known});
            known = success;
        }
    }
    return all;
}

std::vector<LinkBudget::Need> LinkBudget::shadowed(const std::vector<Need>& needs) const {
    const Fading& shadowing = propagation_.shadowing();
    if (shadowing.is_none()) {
        return needs;
    }
    const auto side = static_cast<std::size_t>(std::ceil(db_from_ratio(shadowing.max()) / step_db));
    // shares[i]: of gains within half a step of (i − side) steps.
    std::vector<double> shares;
    double above = 1;
    for (std::size_t i = 0; i <= 2 * side; ++i) {
        const double below = above;
        above = shadowing.chance_of(
            ratio_from_db((static_cast<double>(i) - static_cast<double>(side) + 0.5) * step_db));
        shares.push_back(below - above);
    }
    const double last_w = needs.back().power_w;
    // spread[i]: of needs that are i steps below the largest one, last_w · shadowing.max().
    std::vector<double> spread;
    for (const Need& need : needs) {
        const auto steps_below_last =
            static_cast<std::size_t>(std::lround(db_from_ratio(last_w / need.power_w) / step_db));
        spread.resize(std::max(spread.size(), steps_below_last + shares.size()));
        for (std::size_t i = 0; i < shares.size(); ++i) {
            spread[steps_below_last + i] += need.share * shares[i];
        }
    }
    std::vector<Need> all;
    for (std::size_t i = 0; i < spread.size(); ++i) {
        all.push_back({last_w * ratio_from_db((static_cast<double>(side) - static_cast<double>(i)) * step_db),
                       spread[i]});
    }
    return all;
}

double LinkBudget::steady_gain(double distance_m) const {
    check_at_least("distance_m", distance_m, 0, "m");
    const double rise_m = receiver_height_m_ - sender_height_m_;
    const double level_m = std::sqrt(std::max(distance_m * distance_m - rise_m * rise_m, 0.0));
    return antenna_gain_ * propagation_.path_gain({0, 0, sender_height_m_}, {level_m, 0, receiver_height_m_},
                                                  distance_m, band_.carrier_hz);
}

double LinkBudget::mean_gain(double distance_m) const {
    return steady_gain(distance_m) * propagation_.shadowing().mean() * propagation_.fading().mean();
}

double LinkBudget::reception_ratio(double distance_m, double tx_power_w) const {
    check_at_least("tx_power_w", tx_power_w, 0, "W");
    return ratio_at(tx_power_w * steady_gain(distance_m));
}

double LinkBudget::ratio_at(double power_w) const {
    if (!propagation_.is_random()) {
        return power_w >= min_power_w() ? success_probability(power_w) : 0;
    }
    double sum = 0;
    for (const Need& need : needs_) {
        sum += need.share * propagation_.fading().chance_of(need.power_w / power_w);
    }
    return std::clamp(sum, 0.0, 1.0);
}

double LinkBudget::tx_power_w_for(double range_m, double ratio) const {
    constexpr double weakest_w = 1e-30;
    constexpr double precision = 1e-9;
    check_greater("range_m", range_m, 0, "m");
    if (!(ratio > 0) || !(ratio < 1)) {
        throw ConfigError("ratio = " + text_of(ratio) + ": expected more than 0 and less than 1");
    }
    const double gain = steady_gain(range_m);
    if (ratio_at(largest_tx_power_w * gain) < ratio) {
        throw ConfigError({"",
                           "",
                           {"no power reaches ", Quantity{range_m, "m"}, ": even of ",
                            Quantity{largest_tx_power_w, "W"}, ", too little is left there"}});
    }
    // The ratio never falls with the power. Bisection on a logarithmic scale.
    double too_weak_w = weakest_w;
    double enough_w = largest_tx_power_w;
    while (enough_w > too_weak_w * (1 + precision)) {
        const double middle_w = std::sqrt(too_weak_w) * std::sqrt(enough_w);
        (ratio_at(middle_w * gain) >= ratio ? enough_w : too_weak_w) = middle_w;
    }
    // A run may round differently. At a threshold, the last bit decides whether all frames are
    // received or none.
    return std::min(enough_w * (1 + precision), largest_tx_power_w);
}

}  // namespace netsim
