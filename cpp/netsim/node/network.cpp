#include "netsim/node/network.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/mac/csma_ca_802154.hpp"
#include "netsim/mac/dcf.hpp"

namespace netsim {

namespace {

MediumConfig validated(MediumConfig config) {
    config.validate();
    return config;
}

}  // namespace

Network::Network(const MediumConfig& medium, std::uint64_t seed, Hearing hearing)
    : seed_(seed),
      perfect_channel_(validated(medium).type_name == "UnitDiskRadioMedium"),
      medium_(simulator_, medium, frame_fates_, fingerprint_, hearing, seed) {}

Node& Network::add_node(const NodeConfig& config) {
    config.validate();
    check_with_medium(config);
    if (!perfect_channel_) {
        make_error_model(config.radio);  // before anything is built, so that a refused node leaves no trace
    }
    if (!perfect_channel_ && config.interface_type == ieee80211_interface) {
        Dcf::check(config.mac);
    }
    Node& node = nodes_.emplace_back(simulator_, config, node_count_++, seed_, fingerprint_);
    node.set_node_count(&node_count_);
    frame_fates_.add_node();
    node.set_link(make_link(config, node));
    const SimTime telemetry_interval = SimTime::from_seconds(config.mobility.telemetry_interval_s);
    if (telemetry_interval > SimTime{}) {
        add_to_telemetry_clock(node, telemetry_interval);
    }
    return node;
}

std::unique_ptr<Link> Network::make_link(const NodeConfig& config, Node& node) {
    if (perfect_channel_) {
        return std::make_unique<UnitDiskLink>(simulator_, unit_disk_, config.radio.communication_range_m,
                                              node.trajectory(), frame_fates_, message_fates_, fingerprint_,
                                              node.link_listener());
    }
    interface_types_.try_emplace(config.radio.carrier_hz, config.interface_type);
    Radio& radio = radios_.emplace_back(simulator_, medium_, config.radio, node.trajectory(), seed_,
                                        frame_fates_, fingerprint_, node.attitude());
    if (config.interface_type == ieee802154_interface) {
        link_types_.push_back(LinkType::ieee802154_with_fcs);
        return std::make_unique<CsmaCa802154>(simulator_, radio, config.csma, seed_, message_fates_,
                                              node.link_listener());
    }
    link_types_.push_back(LinkType::radiotap);
    return std::make_unique<Dcf>(simulator_, radio, config.mac, seed_, message_fates_, node.link_listener());
}

void Network::check_with_medium(const NodeConfig& config) const {
    const RadioConfig& radio = config.radio;
    if (perfect_channel_) {
        check_greater("radio.communication_range_m", radio.communication_range_m, 0, "m");
        return;
    }
    const double noise_w = medium_.background_noise().power_w(radio.bandwidth_hz, radio.noise_figure);
    if (radio.energy_detection_w <= noise_w) {
        throw ConfigError("radio.energy_detection_w = " + text_of(radio.energy_detection_w) +
                          " W: expected more than the background noise of " + text_of(noise_w) +
                          " W, which would keep the channel busy for ever");
    }
    // No channel of the one has the centre of a channel of the other: who sets it so has mistaken something, and
    // neither could make anything of what it locks on to.
    const auto there = interface_types_.find(radio.carrier_hz);
    if (there != interface_types_.end() && there->second != config.interface_type) {
        throw ConfigError("radio.carrier_hz = " + text_of(radio.carrier_hz) +
                          " Hz: expected another one for " + config.name + " with its " +
                          config.interface_type + ", as a node with an " + there->second + " is at this one");
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

void Network::capture(NodeId node, const std::string& path) {
    const std::string& name = this->node(node).name();
    if (perfect_channel_) {
        throw ConfigError("cannot capture the frames of " + name +
                          ": a medium of typename UnitDiskRadioMedium has no radios; expected " +
                          "Ieee80211ScalarRadioMedium or another radio medium");
    }
    if (captures_.contains(node)) {
        throw ConfigError("the frames of " + name + " are captured already");
    }
    radios_.at(static_cast<std::size_t>(node))
        .set_observer(&captures_.try_emplace(node, path, link_types_[node]).first->second);
}

void Network::close_captures() {
    std::exception_ptr failure;
    for (auto& [node, capture] : captures_) {
        radios_[static_cast<std::size_t>(node)].set_observer(nullptr);
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

void Network::initialize() {
    for (Node& node : nodes_) {
        if (!perfect_channel_) {
            medium_.set_touched(node.id(), &node.link(), &node, node.protocol());
        }
        node.initialize();
    }
    for (TelemetryClock& clock : telemetry_clocks_) {
        clock.start();
    }
}

void Network::schedule(SimTime time, std::function<void()> call) {
    if (time < now()) {
        throw SimulationError("cannot schedule a call at " + text_of(time.seconds()) + " s: it is " +
                              text_of(now().seconds()) + " s now");
    }
    scheduled_calls_.add(time, std::move(call));
}

void Network::finish() {
    for (Node& node : nodes_) {
        node.finish();
    }
    close_captures();
}

void Network::release_protocols() {
    for (Node& node : nodes_) {
        node.set_protocol(nullptr);
    }
    scheduled_calls_.drop();
}

}  // namespace netsim
