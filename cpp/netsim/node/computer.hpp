// The computer that runs a node's protocol: it takes time for each event, and events wait in order.
//
// It is a protocol in front of the node's own one. A timer, a message, telemetry or a failed message
// begins to be processed when the events before it have been, and the protocol gets it when the
// processing time has passed. The start and the end of the run take no time. Nodes whose events never
// wait have no computer, and are not slower.
//
// Of telemetry, only the latest waits: like a driver that keeps the last value, it takes the place of
// the one that waits.
//
// While a message waits in front of a full queue that blocks, no event begins, as if the protocol had
// not returned from its call to send.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <variant>

#include "netsim/kernel/event_queue.hpp"
#include "netsim/kernel/instant_count.hpp"
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
    struct Failure {
        Payload message;
        NodeId destination;
        MessageOutcome reason;
    };
    using Canceled = std::monostate;
    using Event = std::variant<Canceled, std::string, Frame, Position, Failure>;  // a timer is its name

    void message_received(const Frame& frame) override { add(frame); }
    void message_failed(const Frame& frame, MessageOutcome outcome) override;
    void queue_blocks(bool blocks) override;
    void add(const Event& event);
    void begin_next();
    void processed();
    void run(const Event& event);

    std::unique_ptr<Protocol> protocol_;
    ProcessingTime time_;
    bool wants_failed_messages_;
    bool is_busy_ = false;  // the first event is being processed
    int blocking_queues_ = 0;
    std::deque<Event> events_;
    EventHandle end_;  // of the processing
    InstantCount failures_for_now_;
};

}  // namespace netsim
