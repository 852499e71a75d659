#include "netsim/node/computer.hpp"

#include <algorithm>
#include <utility>

#include "netsim/node/run_callback.hpp"

namespace netsim {

Computer::Computer(std::unique_ptr<Protocol> protocol, const ProcessingTime& time)
    : protocol_(std::move(protocol)), time_(time) {
    context_ = protocol_->context_;
    node_ = protocol_->node_;
}

Computer::~Computer() {
    context_->simulator.cancel(end_);
}

void Computer::handle_telemetry(const Position& position) {
    const auto waits = [](const Event& event) { return std::holds_alternative<Position>(event); };
    const auto waiting =
        events_.empty() ? events_.end() : std::find_if(events_.begin() + 1, events_.end(), waits);
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

void Computer::add(Event event) {
    events_.push_back(std::move(event));
    if (events_.size() == 1) {
        begin_next();
    }
}

void Computer::begin_next() {
    while (!events_.empty() && std::holds_alternative<Canceled>(events_.front())) {
        events_.pop_front();
    }
    if (!events_.empty()) {
        end_ = context_->simulator.schedule_after(time_.draw(), [this] { processed(); });
    }
}

void Computer::processed() {
    struct BeginsNext {  // also after an error
        Computer& computer;
        ~BeginsNext() { computer.begin_next(); }
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
    }
}

}  // namespace netsim
