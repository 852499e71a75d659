// A whole simulation: clock, medium, nodes and statistics. It owns everything and shares nothing
// with other networks.
//
// Several networks may run interleaved, step by step, in one process. Use: add_node and set_protocol
// for each node, initialize(), run_until() any number of times, finish(), then read the statistics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/ideal_interface.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/node/flight_clock.hpp"
#include "netsim/node/network_context.hpp"
#include "netsim/node/node.hpp"
#include "netsim/node/radio_capture.hpp"
#include "netsim/node/replay_recorder.hpp"
#include "netsim/node/scheduled_calls.hpp"
#include "netsim/node/shared_models.hpp"
#include "netsim/node/telemetry_clock.hpp"
#include "netsim/phy/radio.hpp"
#include "netsim/phy/radio_model.hpp"
#include "netsim/trace/frame_outcomes.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

class Network {
public:
    // Throws ConfigError for values out of range.
    Network(const MediumConfig& medium, std::uint64_t seed, Culling culling = Culling::enabled);
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;

    // Nodes get the ids 0, 1, … in the order of calls. The reference is valid as long as the network.
    // Throws ConfigError for values out of range, and SimulationError after initialize().
    Node& add_node(const NodeConfig& config);
    // Throws SimulationError for an id without a node.
    Node& node(NodeId id) { return nodes_[place_of(id)]; }
    const Node& node(NodeId id) const { return nodes_[place_of(id)]; }
    std::int32_t node_count() const { return context_.node_count; }

    // Captures the frames that the node's wlan[interface] sends and receives from now on in a pcap
    // file, until close_captures() or the destruction of the network. Throws ConfigError for a path
    // that cannot be written, an interface that does not exist or is captured already, and the unit
    // disk medium, which has no radios.
    void capture(NodeId node, const std::string& path, std::int32_t interface = 0);
    // Closes the capture files. Throws SimulationError, after all are closed, if one could not be
    // written.
    void close_captures();

    // Records the run for a replay: the paths of all nodes, and the frames, variables and events of
    // the `recorded` ones. Call it when all nodes exist, before initialize(). Throws SimulationError
    // for an id without a node.
    ReplayRecorder& record(const std::vector<NodeId>& recorded);

    // Calls the protocols' check, then their initialize at time 0, in the order of ids. Throws
    // ConfigError if a check fails, and SimulationError on the second call.
    void initialize();
    // Runs the events up to and including `limit`. Returns false if `max_events` ran before that. No
    // effect if `limit` is in the past.
    bool run_until(SimTime limit, std::uint64_t max_events = ~std::uint64_t{0}) {
        check_runs("run_until");
        return simulator_.run_until(limit, max_events);
    }
    // Runs one event up to and including `limit`. Returns false if there is none.
    bool step(SimTime limit) {
        check_runs("step");
        return simulator_.step(limit);
    }
    // Schedules `call` as an event at `time`, after the events scheduled for that time so far. Its
    // exceptions propagate out of run_until. Throws SimulationError for a time in the past.
    void schedule(SimTime time, std::function<void()> call);
    // Calls the protocols' finish in the order of ids, if they were initialized, and closes the
    // captures. Ends the run: later calls throw SimulationError, including a second finish.
    void finish();
    // Destroys the protocols and scheduled calls. They may own Python objects that refer to the
    // network, which would keep it alive.
    void release_protocols();

    SimTime now() const { return simulator_.now(); }
    // The node whose protocol is running, or was running when it threw an exception; otherwise
    // NetworkContext::no_node.
    NodeId active_node() const { return context_.active_node; }
    std::uint64_t event_count() const { return simulator_.event_count(); }
    std::size_t pending_count() const { return simulator_.pending_count(); }
    std::uint64_t fingerprint() const { return fingerprint_.value(); }
    const FrameOutcomes& frame_outcomes() const { return frame_outcomes_; }
    // The sum over all interfaces. For one of them: node(0).interfaces()[1]->message_outcomes().
    MessageOutcomeSums message_outcomes() const;
    const MessageDelays& message_delays() const { return context_.message_delays; }

private:
    std::size_t place_of(NodeId node) const;
    void check_runs(const char* call) const;
    void check_not_finished(const char* call) const;
    // Objects shared by nodes with the same configuration, created for the first of them. Both throw
    // ConfigError for invalid values.
    std::shared_ptr<const RadioModel> radio_model(RadioConfig config);
    std::shared_ptr<const DcfParameters> dcf_parameters(const MacConfig& config);
    void check_with_medium(const NodeConfig& config);
    void check_with_medium(const std::string& node, const InterfaceConfig& config);
    void check_with_others(const NodeConfig& config, std::size_t index) const;
    std::unique_ptr<NetworkInterface> make_interface(const InterfaceConfig& config, InterfaceId id,
                                                     const Node& node);
    Radio& radio(InterfaceId id);
    void add_to_telemetry_clock(Node& node, SimTime interval);

    Simulator simulator_;
    std::uint64_t seed_;
    Fingerprint fingerprint_;
    NetworkContext context_{simulator_, fingerprint_};
    FrameOutcomes frame_outcomes_;
    std::string timing_;  // MediumConfig::timing
    bool is_ideal_;       // whether interfaces are IdealInterfaces
    bool has_powers_;     // whether the medium computes the power of frames
    Medium medium_;
    IdealChannel ideal_channel_;
    SharedModels<RadioConfig, RadioModel> radio_models_;
    SharedModels<MacConfig, DcfParameters> dcf_parameters_;
    std::deque<Radio> radios_;                       // sorted by interface id
    std::deque<LinkType> link_types_;                // of the radios
    std::map<double, std::string> interface_types_;  // {center frequency in Hz: type of the interfaces there}
    std::map<InterfaceId, RadioCapture> captures_;
    std::unique_ptr<ReplayRecorder> recorder_;
    std::deque<Node> nodes_;
    std::deque<TelemetryClock> telemetry_clocks_;  // one for each interval
    FlightClock flight_clock_{simulator_};
    ScheduledCalls scheduled_calls_{simulator_};
    bool initialized_ = false;
    bool finished_ = false;
};

}  // namespace netsim
