#include "netsim/node/node.hpp"

#include <exception>
#include <stdexcept>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/kernel/fetch.hpp"
#include "netsim/node/protocol_error.hpp"

namespace netsim {

namespace {

// Words of the fingerprint that tell kinds of events apart.
constexpr std::uint64_t packet_word = 0x7061636B6574;
constexpr std::uint64_t timer_word = 0x74696D6572;

}  // namespace

Node::Node(Simulator& simulator, const NodeConfig& config, NodeId id, std::uint64_t seed,
           Fingerprint& fingerprint, PayloadHash& payload_hash, MessageDelays& message_delays)
    : simulator_(simulator),
      fingerprint_(fingerprint),
      payload_hash_(payload_hash),
      message_delays_(message_delays),
      id_(id),
      mobility_(make_mobility(config.mobility, config.initial_position)),
      name_(config.name),
      attitude_(config.mobility),
      random_(seed, static_cast<std::uint32_t>(id), Purpose::protocol) {}

template <typename Call>
void Node::call_protocol(const char* callback, Call call) {
    if (!protocol_) {
        return;
    }
    try {
        call(*protocol_);
    } catch (const std::runtime_error& error) {  // a SimulationError is one
        std::throw_with_nested(ProtocolError(error.what(), id_, callback, now()));
    } catch (const std::logic_error& error) {
        std::throw_with_nested(ProtocolError(error.what(), id_, callback, now()));
    }
}

void Node::send_through(std::int32_t interface, NodeId destination, Payload payload) {
    NetworkInterface& through = interface_at(interface);
    if (!payload) {
        throw SimulationError("node " + std::to_string(id_) + " cannot send nothing: the payload is null");
    }
    through.send(destination, std::move(payload));
}

void Node::observe(OnTelemetry on_telemetry, TrackedVariables::OnSet on_variable) {
    on_telemetry_ = std::move(on_telemetry);
    tracked_variables_.observe(std::move(on_variable));
    observed_ = true;
}

void Node::check_protocol() const {
    if (protocol_) {
        protocol_->check();
    }
}

void Node::initialize() {
    call_protocol("initialize", [](Protocol& protocol) { protocol.initialize(); });
}

void Node::finish() {
    call_protocol("finish", [](Protocol& protocol) { protocol.finish(); });
}

NetworkInterface& Node::interface_at(std::int32_t index) {
    if (index == 0 && first_interface_ != nullptr) {
        return *first_interface_;
    }
    if (index < 0 || static_cast<std::size_t>(index) >= interfaces_.size()) {
        throw SimulationError("node " + std::to_string(id_) + " has no interface wlan[" +
                              std::to_string(index) + "]: it has " + std::to_string(interfaces_.size()) +
                              (interfaces_.size() == 1 ? ", wlan[0]" : ", from wlan[0] on"));
    }
    return *interfaces_[index];
}

void Node::broadcast(Payload payload, std::int32_t interface) {
    send_through(interface, broadcast_id, std::move(payload));
}

void Node::send(NodeId destination, Payload payload, std::int32_t interface) {
    if (destination < 0 || destination >= *node_count_) {
        throw SimulationError("cannot send to node " + std::to_string(destination) + ": nodes are 0 … " +
                              std::to_string(*node_count_ - 1));
    }
    if (destination == id_) {
        throw SimulationError("node " + std::to_string(id_) + " cannot send a message to itself");
    }
    send_through(interface, destination, std::move(payload));
}

void Node::schedule_timer(std::string timer, SimTime time) {
    if (time < simulator_.now()) {
        throw SimulationError("timer '" + timer + "' at " + std::to_string(time.seconds()) +
                              " s is in the past: it is " + std::to_string(simulator_.now().seconds()) +
                              " s now (timers take absolute simulated time)");
    }
    if (time == simulator_.now() && timers_for_now_.exceeds(time)) {
        throw SimulationError("node " + std::to_string(id_) + " has set " +
                              std::to_string(most_at_one_instant) + " timers for now, " +
                              std::to_string(time.seconds()) + " s, and this one, '" + timer +
                              "', is one more: time stands still; expected a later time");
    }
    const std::size_t number = timers_.add(std::move(timer));
    timers_.set_event(number, simulator_.schedule_at(time, TimerDue{this, number}));
}

void Node::cancel_timer(const std::string& timer) {
    timers_.cancel(timer, [this](EventHandle event) { simulator_.cancel(event); });
}

void Node::message_received(const Frame& frame) {
    if (!protocol_) {
        return;
    }
    message_delays_.add(message_kind(frame), now() - frame.accepted);
    fingerprint_.add(packet_word ^ (static_cast<std::uint64_t>(frame.transmitter) << 40) ^
                     static_cast<std::uint64_t>(id_));
    fingerprint_.add(payload_hash_.of(frame.payload));
    call_protocol("handle_packet", [&frame](Protocol& protocol) { protocol.handle_packet(frame.payload); });
}

void Node::fetch_for_timer(int step) const {
    if (step == 0) {
        fetch_before(*this, interfaces_);
    } else if (step == 1) {
        timers_.fetch();
        fetch_bytes(protocol_.get(), 2 * cache_line_bytes);
        fetch_bytes(&trajectory(), cache_line_bytes);
        fetch_bytes(first_interface_, cache_line_bytes);
    } else if (step == 2) {
        if (protocol_) {
            protocol_->fetch();
        }
        if (first_interface_ != nullptr) {
            first_interface_->fetch(0);
        }
    } else if (first_interface_ != nullptr) {
        first_interface_->fetch(step - 2);
    }
}

void Node::timer_due(std::size_t number) {
    const std::string timer = timers_.take(number);
    fingerprint_.add(timer_word ^ static_cast<std::uint64_t>(id_));
    fingerprint_.add(static_cast<std::uint64_t>(simulator_.now().ps()));
    fingerprint_.add_text(timer);
    call_protocol("handle_timer", [&timer](Protocol& protocol) { protocol.handle_timer(timer); });
}

void Node::report_position() {
    if (observed_) {
        on_telemetry_(position());
    }
    call_protocol("handle_telemetry", [this](Protocol& protocol) { protocol.handle_telemetry(position()); });
}

}  // namespace netsim
