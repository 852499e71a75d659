// A node: its protocol, its mobility and its network interfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "netsim/config/node_config.hpp"
#include "netsim/kernel/instant_count.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mobility/attitude.hpp"
#include "netsim/mobility/mobility.hpp"
#include "netsim/node/network_context.hpp"
#include "netsim/node/processing_time.hpp"
#include "netsim/node/protocol.hpp"
#include "netsim/node/timers.hpp"
#include "netsim/node/tracked_variables.hpp"

namespace netsim {

class Computer;  // node/computer.hpp

class alignas(64) Node final {
public:
    Node(NetworkContext& context, const NodeConfig& config, NodeId id, std::uint64_t seed);
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    NodeId id() const { return id_; }
    const std::string& name() const { return name_; }
    Position position() const { return mobility_->trajectory().position_at(now()); }
    const Trajectory& trajectory() const { return mobility_->trajectory(); }
    const Attitude& attitude() const { return attitude_; }

    // Setup before the run: the interfaces, wlan[0] first, and the protocol that receives their
    // messages, if any.
    void add_interface(std::unique_ptr<NetworkInterface> interface);
    void set_protocol(std::unique_ptr<Protocol> protocol);
    Protocol* protocol() { return protocol_.get(); }
    const std::vector<std::unique_ptr<NetworkInterface>>& interfaces() const { return interfaces_; }

    // Sets a callback for each telemetry, called before the protocol, and one for the tracked
    // variables of a native protocol. Either may be null.
    using OnTelemetry = std::function<void(const Position& position)>;
    void observe(OnTelemetry on_telemetry, TrackedVariables::OnSet on_variable);

    // Life cycle, driven by the Network. Errors of the protocol's callbacks become ProtocolErrors.
    void check_protocol() const;
    void initialize();
    // Starts the motion, if the mobility follows a given path.
    void begin_path();
    // Whether it flies step by step, by fly().
    bool flies() const { return mobility_->flies(); }
    // Flies from now to the next update.
    void fly(SimTime until);
    void report_position();
    void finish();

    // Queries that are also allowed before the run.
    std::int32_t node_count() const { return context_.node_count; }
    bool can_move() const { return mobility_->can_move(); }

    // Commands and queries of a protocol. All throw SimulationError for invalid commands.
    SimTime now() const { return context_.simulator.now(); }
    // Through wlan[interface].
    void broadcast(Payload payload, std::int32_t interface = 0);
    void send(NodeId destination, Payload payload, std::int32_t interface = 0);
    // The vehicle obeys after the command delay of its mobility.
    void go_to(Position target);
    void set_speed(double speed_mps);
    // `time` must not be in the past. The same name may be pending several times. Also throws for an
    // endless loop at one instant.
    void schedule_timer(std::string timer, SimTime time);
    // Cancels all pending timers of that name, if any.
    void cancel_timer(const std::string& timer);
    // Through wlan[0].
    std::size_t longest_message_bytes() { return interface_at(0).longest_message_bytes(); }
    // The protocol's own random numbers: IProvider.random in Python.
    RandomStream& random() { return random_; }
    // A string of `bytes` octets for messages without content, shared between nodes.
    Payload padding(std::int64_t bytes) { return context_.padding.of(static_cast<std::size_t>(bytes)); }
    // Values for the results of the run. They outlive the protocol.
    TrackedVariables& tracked_variables() { return tracked_variables_; }
    const TrackedVariables& tracked_variables() const { return tracked_variables_; }

private:
    void obey(Position target);
    void obey_speed(double speed_mps);
    NetworkInterface& interface_at(std::int32_t index);
    void send_through(std::int32_t interface, NodeId destination, Payload payload);
    template <typename Call>
    void call_protocol(const char* callback, const Call& call);
    struct TimerDue {
        Node* node;
        std::size_t number;

        void operator()() const { node->timer_due(number); }
        void prefetch(int step) const { node->prefetch_for_timer(step); }
    };
    void timer_due(std::size_t number);
    // Also prefetches what sending reads, since most timers send.
    void prefetch_for_timer(int step) const;

    // The members that every timer reads come first: one cache line.
    NetworkContext& context_;
    std::unique_ptr<Protocol> protocol_;
    NetworkInterface* first_interface_ = nullptr;  // interfaces_[0], the one used most
    std::unique_ptr<Mobility> mobility_;
    [[no_unique_address]] Timers timers_;  // its padding holds the id
    NodeId id_;

    bool observed_ = false;  // most nodes are not
    bool has_blocking_queue_;
    Computer* computer_ = nullptr;  // protocol_, if its events may have to wait
    InstantCount timers_for_now_;
    std::vector<std::unique_ptr<NetworkInterface>> interfaces_;
    std::string name_;
    Attitude attitude_;
    RandomStream random_;
    TrackedVariables tracked_variables_;
    OnTelemetry on_telemetry_;
    ProcessingTime processing_time_;
    SimTime command_delay_;  // from a command to the vehicle until it obeys
};

}  // namespace netsim
