// The computer that runs a node's protocol: it takes time for each event, and events wait in order.
//
// It is a protocol in front of the node's own one. A timer, a message or telemetry begins to be
// processed when the events before it have been, and the protocol gets it when the processing time
// has passed. The start and the end of the run take no time. Without a computer, nothing is slower.
//
// Of telemetry, only the latest waits: like a driver that keeps the last value, it takes the place of
// the one that waits.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <variant>

#include "netsim/kernel/event_queue.hpp"
#include "netsim/node/processing_time.hpp"
#include "netsim/node/protocol.hpp"

namespace netsim {

class Computer final : public Protocol {
public:
    // `protocol`: of a node; its context is set.
    Computer(std::unique_ptr<Protocol> protocol, const ProcessingTime& time);
    Computer(const Computer&) = delete;
    Computer& operator=(const Computer&) = delete;
    ~Computer() override;

    void check() const override { protocol_->check(); }
    void initialize() override { protocol_->initialize(); }
    void handle_timer(const std::string& timer) override { add(timer); }
    void handle_packet(const Payload& message) override { protocol_->handle_packet(message); }
    void handle_telemetry(const Position& position) override;
    void finish() override { protocol_->finish(); }

    // Drops the timers of that name that are due and wait.
    void cancel_timer(const std::string& timer);

private:
    using Canceled = std::monostate;
    using Event = std::variant<Canceled, std::string, Frame, Position>;  // a timer is its name

    void message_received(const Frame& frame) override { add(frame); }
    void add(Event event);
    void begin_next();
    void processed();
    void run(const Event& event);

    std::unique_ptr<Protocol> protocol_;
    ProcessingTime time_;
    std::deque<Event> events_;  // the first one is being processed
    EventHandle end_;           // of the processing
};

}  // namespace netsim
