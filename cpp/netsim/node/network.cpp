#include "netsim/node/network.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/mac/csma_ca_802154.hpp"
#include "netsim/mac/dcf.hpp"
#include "netsim/node/known_formats.hpp"
#include "netsim/phy/oqpsk_mode.hpp"

namespace netsim {

namespace {

MediumConfig validated(MediumConfig config) {
    config.validate();
    return config;
}

// A power of a bitrate that no frame has is a mistake. One of another operation mode is not: profiles of
// hardware have the powers of all modes.
void check_powers(const InterfaceConfig& config) {
    for (const auto& [bitrate_bps, power_w] : config.radio.tx_power_by_bitrate_w) {
        if (config.type_name == ieee80211_interface) {
            constexpr std::string_view with_all_bitrates = "g(mixed)";
            mode_set(with_all_bitrates).mode_for_bitrate(bitrate_bps, "radio.tx_power_by_bitrate_w");
        } else if (bitrate_bps != static_cast<double>(oqpsk_250_kbps.bitrate_bps)) {
            throw ConfigError(
                {.field = "radio.tx_power_by_bitrate_w",
                 .value = Quantity{bitrate_bps, "bps"},
                 .message = {"expected ", Quantity{static_cast<double>(oqpsk_250_kbps.bitrate_bps), "bps"}},
                 .compared_with = {"interface.typename"}});
        }
    }
}

}  // namespace

Network::Network(const MediumConfig& medium, std::uint64_t seed, Culling culling)
    : seed_(seed),
      timing_(validated(medium).timing),
      is_ideal_(timing_ != mac_timing),
      has_powers_(medium.type_name != unit_disk_medium),
      medium_(simulator_, medium, frame_outcomes_, fingerprint_, culling, seed) {
    if (is_ideal_ && has_powers_) {
        ideal_channel_.links.emplace(medium, seed);
    }
}

Node& Network::add_node(const NodeConfig& config) {
    if (initialized_) {
        throw SimulationError(config.name + " comes too late: expected all nodes before initialize()");
    }
    config.validate();
    check_with_medium(config);  // before anything is built, so that a rejected node changes nothing
    Node& node = nodes_.emplace_back(context_, config, context_.node_count++, seed_);
    frame_outcomes_.add_node();
    for (std::size_t index = 0; index < config.wlan.size(); ++index) {
        const InterfaceId id{node.id(), static_cast<std::int32_t>(index)};
        node.add_interface(make_interface(config.wlan[index], id, node));
    }
    const SimTime telemetry_interval = SimTime::from_seconds(config.mobility.telemetry_interval_s);
    if (telemetry_interval > SimTime{}) {
        add_to_telemetry_clock(node, telemetry_interval);
    }
    if (node.flies()) {
        flight_clock_.add(node);
    }
    return node;
}

std::unique_ptr<NetworkInterface> Network::make_interface(const InterfaceConfig& config, InterfaceId id,
                                                          const Node& node) {
    if (is_ideal_) {
        std::optional<IdealRadio> radio;
        if (has_powers_) {
            radio.emplace(IdealRadio{radio_model(config.radio), config.radio.tx_power_w,
                                     known_formats(config), node.attitude()});
        }
        return std::make_unique<IdealInterface>(
            simulator_, ideal_channel_, id, config.radio.communication_range_m, std::move(radio),
            IdealTiming(timing_, config), node.trajectory(), frame_outcomes_, fingerprint_, seed_);
    }
    interface_types_.try_emplace(config.radio.carrier_hz, config.type_name);
    Radio& radio = radios_.emplace_back(id, radio_model(config.radio), config.radio.tx_power_w,
                                        node.trajectory(), node.attitude(), known_formats(config));
    if (config.type_name == ieee802154_interface) {
        link_types_.push_back(LinkType::ieee802154_with_fcs);
        return std::make_unique<CsmaCa802154>(simulator_, radio, config.csma, seed_);
    }
    link_types_.push_back(LinkType::radiotap);
    return std::make_unique<Dcf>(radio, dcf_parameters(config.mac), seed_);
}

std::shared_ptr<const RadioModel> Network::radio_model(RadioConfig config) {
    // These are not part of the model: nodes with different powers share it.
    config.tx_power_w = 0;
    config.communication_range_m = 0;
    return radio_models_.of(config, [this](const RadioConfig& radio) {
        return std::make_shared<const RadioModel>(radio, medium_, seed_);
    });
}

std::shared_ptr<const DcfParameters> Network::dcf_parameters(const MacConfig& config) {
    return dcf_parameters_.of(config, [this](const MacConfig& mac) {
        return std::make_shared<const DcfParameters>(simulator_, mac);
    });
}

void Network::check_with_medium(const NodeConfig& config) {
    if (node_count() == InterfaceId::max_nodes) {
        throw ConfigError("there are " + text_of(node_count()) + " nodes: no network can have more");
    }
    for (std::size_t index = 0; index < config.wlan.size(); ++index) {
        try {
            check_with_medium(config.name, config.wlan[index]);
        } catch (const ConfigError& error) {
            throw config.error_of_interface(index, error);
        }
        check_with_others(config, index);
    }
}

void Network::check_with_others(const NodeConfig& config, std::size_t index) const {
    if (!has_powers_) {
        return;  // one channel for all center frequencies
    }
    // Two radios on one channel would both receive each frame for the node, and acknowledge it at
    // the same time.
    const double carrier_hz = config.wlan[index].radio.carrier_hz;
    for (std::size_t before = 0; before < index; ++before) {
        if (config.wlan[before].radio.carrier_hz == carrier_hz) {
            throw ConfigError({.field = "radio.carrier_hz",
                               .value = Quantity{carrier_hz, "Hz"},
                               .message = {"expected another channel than that of wlan[" +
                                           std::to_string(before) + "] of " + config.name},
                               .compared_with = {"node.num_wlan_interfaces", "interface.typename"},
                               .interface = static_cast<int>(index)});
        }
    }
}

void Network::check_with_medium(const std::string& node, const InterfaceConfig& config) {
    const RadioConfig& radio = config.radio;
    if (is_ideal_) {
        const IdealTiming checked(timing_, config);
    }
    if (!has_powers_) {
        check_greater("radio.communication_range_m", radio.communication_range_m, 0, "m");
        return;
    }
    const double noise_w = medium_.background_noise().power_w(radio.bandwidth_hz, radio.noise_figure);
    if (radio.energy_detection_w <= noise_w) {
        throw ConfigError(
            {.field = "radio.energy_detection_w",
             .value = Quantity{radio.energy_detection_w, "W"},
             .message = {"expected more than the background noise of ", Quantity{noise_w, "W"},
                         ", which would keep the channel busy forever"},
             .compared_with = {"medium.background_noise_w", "medium.temperature_k", "radio.noise_figure",
                               "radio.bandwidth_hz", "medium.background_noise", "interface.typename"}});
    }
    check_powers(config);
    radio_model(radio);
    if (config.type_name == ieee80211_interface && !is_ideal_) {
        dcf_parameters(config.mac);
    }
    // 802.11 and 802.15.4 channels never have equal center frequencies, so this is a mistake.
    const auto there = interface_types_.find(radio.carrier_hz);
    if (there != interface_types_.end() && there->second != config.type_name) {
        throw ConfigError(
            {.field = "radio.carrier_hz",
             .value = Quantity{radio.carrier_hz, "Hz"},
             .message = {"expected another frequency for " + node + " with its " + config.type_name +
                         ": a node with an " + there->second + " uses this one"},
             .compared_with = {"interface.typename"}});
    }
}

void Network::add_to_telemetry_clock(Node& node, SimTime interval) {
    auto clock =
        std::find_if(telemetry_clocks_.begin(), telemetry_clocks_.end(),
                     [interval](const TelemetryClock& other) { return other.interval() == interval; });
    if (clock == telemetry_clocks_.end()) {
        telemetry_clocks_.emplace_back(simulator_, interval);
        clock = telemetry_clocks_.end() - 1;
    }
    clock->add(node);
}

Radio& Network::radio(InterfaceId id) {
    const auto found = std::ranges::lower_bound(radios_, id, {}, &Radio::interface);
    NETSIM_ASSERT(found != radios_.end() && found->interface() == id);
    return *found;
}

void Network::capture(NodeId node, const std::string& path, std::int32_t interface) {
    const std::string& name = this->node(node).name();
    if (!has_powers_) {
        throw ConfigError(
            {.message = {"cannot capture the frames of " + name + ": ", FieldName{"medium.typename"},
                         " = \"" + std::string(unit_disk_medium) +
                             "\" has no radios; expected Ieee80211ScalarRadioMedium or another radio"
                             " medium"}});
    }
    if (is_ideal_) {
        throw ConfigError(
            {.message = {
                 "cannot capture the frames of " + name + ": with ", FieldName{"medium.timing"},
                 " = \"" + timing_ + "\" there is no MAC; expected \"" + std::string(mac_timing) + "\""}});
    }
    const std::size_t count = this->node(node).interfaces().size();
    if (interface < 0 || static_cast<std::size_t>(interface) >= count) {
        throw ConfigError("cannot capture the frames of wlan[" + std::to_string(interface) + "] of " + name +
                          ", which has " + std::to_string(count) + " interfaces, from wlan[0] on");
    }
    const InterfaceId id{node, interface};
    if (captures_.contains(id)) {
        throw ConfigError("the frames of wlan[" + std::to_string(interface) + "] of " + name +
                          " are captured already");
    }
    Radio& captured = radio(id);
    captured.set_observer(&captures_.try_emplace(id, path, link_types_[captured.id()]).first->second);
}

void Network::close_captures() {
    std::exception_ptr failure;
    for (auto& [id, capture] : captures_) {
        radio(id).set_observer(nullptr);
        try {
            capture.close();
        } catch (const SimulationError&) {
            failure = std::current_exception();
        }
    }
    captures_.clear();
    if (failure) {
        std::rethrow_exception(failure);
    }
}

ReplayRecorder& Network::record(const std::vector<NodeId>& recorded) {
    std::vector<bool> is_recorded(nodes_.size());
    for (const NodeId id : recorded) {
        is_recorded[place_of(id)] = true;
    }
    recorder_ = std::make_unique<ReplayRecorder>(simulator_);
    for (const Node& node : nodes_) {
        recorder_->add_node(node.trajectory(), is_recorded[place_of(node.id())]);
    }
    context_.recorder = recorder_.get();
    frame_outcomes_.set_observer(recorder_.get());
    return *recorder_;
}

std::size_t Network::place_of(NodeId node) const {
    if (node < 0 || node >= node_count()) {
        throw SimulationError("there is no node " + std::to_string(node) + ": there are " +
                              std::to_string(node_count()) + ", from 0 on");
    }
    return static_cast<std::size_t>(node);
}

void Network::check_runs(const char* call) const {
    if (!initialized_) {
        throw SimulationError("nothing runs before initialize(): call it before " + std::string(call) + "()");
    }
    check_not_finished(call);
}

void Network::check_not_finished(const char* call) const {
    if (finished_) {
        throw SimulationError("finish() has ended the run: expected " + std::string(call) + "() before it");
    }
}

void Network::initialize() {
    if (initialized_) {
        throw SimulationError("initialize() was called before: expected once");
    }
    for (const Node& node : nodes_) {
        node.check_protocol();
    }
    initialized_ = true;
    for (const Radio& radio : radios_) {
        Node& node = nodes_[radio.node()];
        medium_.set_prefetch_targets(radio.id(), node.interfaces()[radio.interface().index].get(),
                                     node.protocol());
    }
    for (Node& node : nodes_) {
        node.begin_path();
    }
    for (Node& node : nodes_) {
        node.initialize();
    }
    for (TelemetryClock& clock : telemetry_clocks_) {
        clock.start();
    }
    flight_clock_.start();
}

void Network::schedule(SimTime time, std::function<void()> call) {
    if (time < now()) {
        throw SimulationError("cannot schedule a call at " + text_of(time.seconds()) + " s: it is " +
                              text_of(now().seconds()) + " s now");
    }
    scheduled_calls_.add(time, std::move(call));
}

void Network::finish() {
    check_not_finished("finish");
    finished_ = true;
    if (initialized_) {
        for (Node& node : nodes_) {
            node.finish();
        }
    }
    close_captures();
}

MessageOutcomeSums Network::message_outcomes() const {
    MessageOutcomeSums sum;
    for (const Node& node : nodes_) {
        for (const auto& interface : node.interfaces()) {
            sum.add(interface->message_outcomes());
        }
    }
    return sum;
}

void Network::release_protocols() {
    for (Node& node : nodes_) {
        node.set_protocol(nullptr);
    }
    scheduled_calls_.drop();
}

}  // namespace netsim
