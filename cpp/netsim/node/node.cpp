#include "netsim/node/node.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/node/computer.hpp"
#include "netsim/node/replay_recorder.hpp"
#include "netsim/node/run_callback.hpp"

// GCC warns of offsetof in classes with private members, but computes it.
#pragma GCC diagnostic ignored "-Winvalid-offsetof"

namespace netsim {

namespace {

bool blocks(const InterfaceConfig& interface) {
    const bool is_802154 = interface.type_name == ieee802154_interface;
    return (is_802154 ? interface.csma.queue_when_full : interface.mac.queue_when_full) == block_when_full;
}

constexpr std::uint64_t timer_word = 0x74696D6572;  // "timer"; marks timers in the fingerprint

}  // namespace

Node::Node(NetworkContext& context, const NodeConfig& config, NodeId id, std::uint64_t seed)
    : context_(context),
      mobility_(make_mobility(config.mobility, config.initial_position, config.wind, seed,
                              static_cast<std::uint32_t>(id))),
      id_(id),
      has_blocking_queue_(std::ranges::any_of(config.wlan, blocks)),
      name_(config.name),
      attitude_(config.mobility),
      random_(seed, static_cast<std::uint32_t>(id), Purpose::protocol),
      processing_time_(config.computer,
                       RandomStream(seed, static_cast<std::uint32_t>(id), Purpose::processing)),
      command_delay_(SimTime::from_seconds(config.mobility.command_delay_s)) {
    // The compiler uses the padding of timers_.
    static_assert(offsetof(Node, observed_) == cache_line_bytes);
}

void Node::add_interface(std::unique_ptr<NetworkInterface> interface) {
    interface->set_listener(protocol_.get());
    interfaces_.push_back(std::move(interface));
    first_interface_ = interfaces_.front().get();
}

void Node::set_protocol(std::unique_ptr<Protocol> protocol) {
    computer_ = nullptr;
    protocol_ = std::move(protocol);
    if (protocol_) {
        protocol_->context_ = &context_;
        protocol_->node_ = id_;
        if (processing_time_.is_any() || has_blocking_queue_ || protocol_->wants_failed_messages()) {
            auto computer = std::make_unique<Computer>(std::move(protocol_), processing_time_);
            computer_ = computer.get();
            protocol_ = std::move(computer);
        }
    }
    for (const auto& interface : interfaces_) {
        interface->set_listener(protocol_.get());
    }
}

template <typename Call>
void Node::call_protocol(const char* callback, const Call& call) {
    if (protocol_) {
        run_callback(context_, id_, callback, [&] { call(*protocol_); });
    }
}

void Node::send_through(std::int32_t interface, NodeId destination, Payload payload) {
    NetworkInterface& through = interface_at(interface);
    if (!payload) {
        throw SimulationError("node " + std::to_string(id_) + " cannot send nothing: the payload is null");
    }
    through.send(destination, std::move(payload),
                 context_.recorder == nullptr ? 0 : context_.recorder->cause());
}

void Node::observe(OnTelemetry on_telemetry, TrackedVariables::OnSet on_variable) {
    on_telemetry_ = std::move(on_telemetry);
    tracked_variables_.observe(std::move(on_variable));
    observed_ = on_telemetry_ != nullptr;
}

void Node::check_protocol() const {
    if (protocol_) {
        protocol_->check();
    }
}

void Node::initialize() {
    call_protocol("initialize", [](Protocol& protocol) { protocol.initialize(); });
}

void Node::begin_path() {
    const SimTime end = mobility_->begin_leg(now());
    if (end == SimTime::never()) {
        return;
    }
    if (context_.recorder != nullptr) {
        context_.recorder->course_changed(id_);
    }
    context_.simulator.schedule_at(end, [this] { begin_path(); });
}

void Node::fly(SimTime until) {
    mobility_->fly(now(), until);
    if (context_.recorder != nullptr) {
        context_.recorder->course_changed(id_);
    }
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
    if (destination < 0 || destination >= node_count()) {
        throw SimulationError("cannot send to node " + std::to_string(destination) + ": nodes are 0 … " +
                              std::to_string(node_count() - 1));
    }
    if (destination == id_) {
        throw SimulationError("node " + std::to_string(id_) + " cannot send a message to itself");
    }
    send_through(interface, destination, std::move(payload));
}

void Node::go_to(Position target) {
    if (command_delay_ > SimTime{}) {
        mobility_->check_target(target);
        context_.simulator.schedule_after(command_delay_, [this, target] { obey(target); });
    } else {
        obey(target);
    }
    if (context_.recorder != nullptr) {
        context_.recorder->event(
            id_, ReplayRecorder::EventKind::command,
            "go to " + text_of(target.x) + ", " + text_of(target.y) + ", " + text_of(target.z) + " m");
    }
}

void Node::set_speed(double speed_mps) {
    if (command_delay_ > SimTime{}) {
        mobility_->check_speed(speed_mps);
        context_.simulator.schedule_after(command_delay_, [this, speed_mps] { obey_speed(speed_mps); });
    } else {
        obey_speed(speed_mps);
    }
    if (context_.recorder != nullptr) {
        context_.recorder->event(id_, ReplayRecorder::EventKind::command,
                                 "fly at " + text_of(speed_mps) + " m/s");
    }
}

void Node::obey(Position target) {
    mobility_->go_to(now(), target);
    if (context_.recorder != nullptr) {
        context_.recorder->course_changed(id_);
    }
}

void Node::obey_speed(double speed_mps) {
    mobility_->set_speed(now(), speed_mps);
    if (context_.recorder != nullptr) {
        context_.recorder->course_changed(id_);
    }
}

void Node::schedule_timer(std::string timer, SimTime time) {
    if (time < now()) {
        throw SimulationError("timer '" + timer + "' at " + std::to_string(time.seconds()) +
                              " s is in the past: it is " + std::to_string(now().seconds()) +
                              " s now (timers take absolute simulated time)");
    }
    if (time == now() && timers_for_now_.exceeds(time)) {
        throw SimulationError("node " + std::to_string(id_) + " has set " + std::to_string(max_per_instant) +
                              " timers for now, " + std::to_string(time.seconds()) + " s, and this one, '" +
                              timer +
                              "', is one more: time stands still; expected a later time (timers take "
                              "absolute simulated time: current_time() + 1, not 1)");
    }
    const std::size_t number = timers_.add(std::move(timer));
    timers_.set_event(number, context_.simulator.schedule_at(time, TimerDue{this, number}));
}

void Node::cancel_timer(const std::string& timer) {
    timers_.cancel(timer, [this](EventHandle event) { context_.simulator.cancel(event); });
    if (computer_ != nullptr) {
        computer_->cancel_timer(timer);
    }
}

void Node::prefetch_for_timer(int step) const {
    if (step == 0) {
        prefetch_before(*this, observed_);
    } else if (step == 1) {
        timers_.prefetch();
        prefetch_bytes(protocol_.get(), 2 * cache_line_bytes);
        prefetch_bytes(&trajectory(), cache_line_bytes);
        prefetch_bytes(first_interface_, cache_line_bytes);
    } else if (step == 2) {
        if (protocol_) {
            protocol_->prefetch();
        }
        if (first_interface_ != nullptr) {
            first_interface_->prefetch(0);
        }
    } else if (first_interface_ != nullptr) {
        first_interface_->prefetch(step - 2);
    }
}

void Node::timer_due(std::size_t number) {
    const std::string timer = timers_.take(number);
    Fingerprint& fingerprint = context_.fingerprint;
    fingerprint.add(timer_word ^ static_cast<std::uint64_t>(id_));
    fingerprint.add(static_cast<std::uint64_t>(now().ps()));
    fingerprint.add_text(timer);
    call_protocol("handle_timer", [&](Protocol& protocol) {
        if (context_.recorder != nullptr && computer_ == nullptr) {
            context_.recorder->timer_due(id_, timer);
        }
        protocol.handle_timer(timer);
    });
}

void Node::report_position() {
    if (observed_) {
        on_telemetry_(position());
    }
    call_protocol("handle_telemetry", [this](Protocol& protocol) {
        protocol.handle_telemetry(mobility_->reported_position(now()));
    });
}

}  // namespace netsim
