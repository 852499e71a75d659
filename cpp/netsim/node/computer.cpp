#include "netsim/node/computer.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/node/run_callback.hpp"

namespace netsim {

Computer::Computer(std::unique_ptr<Protocol> protocol, const ProcessingTime& time)
    : protocol_(std::move(protocol)),
      time_(time),
      wants_failed_messages_(protocol_->wants_failed_messages()) {
    context_ = protocol_->context_;
    node_ = protocol_->node_;
}

Computer::~Computer() {
    context_->simulator.cancel(end_);
}

void Computer::handle_telemetry(const Position& position) {
    const auto waiting =
        std::find_if(events_.begin() + (is_busy_ ? 1 : 0), events_.end(),
                     [](const Event& event) { return std::holds_alternative<Position>(event); });
    if (waiting == events_.end()) {
        add(position);
    } else {
        *waiting = position;
    }
}

void Computer::cancel_timer(const std::string& timer) {
    for (Event& event : events_) {
        if (const auto* name = std::get_if<std::string>(&event); name != nullptr && *name == timer) {
            event = Canceled();
        }
    }
}

// It reaches the protocol in an event of its own, since the interface is in the middle of something.
void Computer::message_failed(const Frame& frame, MessageOutcome outcome) {
    if (!wants_failed_messages_) {
        return;
    }
    const SimTime now = context_->simulator.now();
    if (failures_for_now_.exceeds(now)) {
        throw SimulationError("node " + std::to_string(node_) + " has had " +
                              std::to_string(max_per_instant) + " failed messages at " +
                              std::to_string(now.seconds()) +
                              " s: time stands still; expected a later time for the next attempt");
    }
    events_.emplace_back(Failure{frame.payload, frame.receiver, outcome});
    begin_next();
}

void Computer::queue_blocks(bool blocks) {
    blocking_queues_ += blocks ? 1 : -1;
    begin_next();
}

void Computer::add(const Event& event) {
    const bool waits = is_busy_ || !events_.empty() || blocking_queues_ > 0 || time_.is_any();
    events_.push_back(event);
    if (waits) {
        begin_next();
    } else {
        is_busy_ = true;
        processed();
    }
}

void Computer::begin_next() {
    if (is_busy_ || blocking_queues_ > 0) {
        return;
    }
    while (!events_.empty() && std::holds_alternative<Canceled>(events_.front())) {
        events_.pop_front();
    }
    if (!events_.empty()) {
        is_busy_ = true;
        const SimTime time = time_.is_any() ? time_.draw() : SimTime{};
        end_ = context_->simulator.schedule_after(time, [this] { processed(); });
    }
}

void Computer::processed() {
    struct BeginsNext {  // also after an error
        Computer& computer;
        ~BeginsNext() {
            computer.is_busy_ = false;
            computer.begin_next();
        }
    };
    const Event event = std::exchange(events_.front(), Canceled());  // so that others wait meanwhile
    const BeginsNext afterwards{*this};
    run(event);
}

void Computer::run(const Event& event) {
    if (const auto* timer = std::get_if<std::string>(&event)) {
        run_callback(*context_, node_, "handle_timer", [&] {
            if (context_->recorder != nullptr) {
                context_->recorder->timer_due(node_, *timer);
            }
            protocol_->handle_timer(*timer);
        });
    } else if (const auto* frame = std::get_if<Frame>(&event)) {
        protocol_->message_received(*frame);
    } else if (const auto* position = std::get_if<Position>(&event)) {
        run_callback(*context_, node_, "handle_telemetry", [&] { protocol_->handle_telemetry(*position); });
    } else if (const auto* failure = std::get_if<Failure>(&event)) {
        run_callback(*context_, node_, "handle_failed_message", [&] {
            protocol_->handle_failed_message(failure->message, failure->destination, failure->reason);
        });
    }
}

}  // namespace netsim
