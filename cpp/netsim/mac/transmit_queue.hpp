// The transmit queue of one interface: waiting frames, the frame in progress, and the outcomes of
// their messages.
//
//   add() -> WAITING --begin_next()--> IN PROGRESS --finish(outcome)--> gone
//     |
//     +--the queue is full--> gone: queue_overflow
//
// A queue that blocks drops nothing: messages wait in front of it, and the interface reports that.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "netsim/kernel/prefetch.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/mac/frame_fifo.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

class TransmitQueue {
public:
    // `node`: of the interface. `capacity`: maximum number of waiting frames, without the one in
    // progress. `blocks`: whether messages wait in front of a full queue.
    TransmitQueue(NodeId node, int capacity, bool blocks)
        : capacity_(capacity), blocks_(blocks), node_(node) {}

    // The frame of a new message from this node, with the next sequence number and without a
    // duration field.
    Frame frame_of(NodeId destination, Payload payload, int psdu_bytes, SimTime now) {
        constexpr std::size_t max_prefetched = 256;
        prefetch_bytes(payload->data(), std::min(payload->size(), max_prefetched));  // receivers will read it
        Frame frame;
        frame.kind = destination == broadcast_id ? FrameKind::broadcast : FrameKind::unicast;
        frame.transmitter = node_;
        frame.receiver = destination;
        frame.sequence = next_sequence_++;
        frame.psdu_bytes = psdu_bytes;
        frame.payload = std::move(payload);
        frame.accepted = now;
        return frame;
    }
    // Accepts the message of a data frame and takes it. Returns false, and leaves it, if it is dropped
    // because the queue is full.
    bool add(Frame& frame) {
        const MessageKind kind = message_kind(frame);
        outcomes_.accept(kind);
        if (!blocks_ && waiting() >= static_cast<std::size_t>(capacity_)) {
            outcomes_.book(kind, MessageOutcome::queue_overflow);
            return false;
        }
        queue_.push(std::make_shared<const Frame>(std::move(frame)));
        return true;
    }

    // Waiting frames and the one in progress.
    std::size_t size() const { return queue_.size(); }
    bool empty() const { return queue_.empty(); }
    const MessageOutcomes& message_outcomes() const { return outcomes_; }

    // Whether one message waits in front of the full queue, so that it has begun to block, or will end.
    bool has_one_in_front() const { return blocks_ && waiting() == static_cast<std::size_t>(capacity_) + 1; }

    // Unless a frame is in progress already, makes the first waiting frame the one in progress. There
    // must be one. Returns whether the last message in front of the queue has entered it.
    bool begin_next() {
        const bool ends_blocking = !is_in_progress_ && has_one_in_front();
        is_in_progress_ = true;
        return ends_blocking;
    }
    bool is_in_progress() const { return is_in_progress_; }
    // Only while a frame is in progress, here and below.
    const std::shared_ptr<const Frame>& in_progress() const { return queue_.front(); }
    // Frames are immutable, so these replace the frame in progress with a modified one.
    void set_retry() {
        if (!in_progress()->retry) {
            change([](Frame& frame) { frame.retry = true; });
        }
    }
    void set_duration_field(SimTime duration) {
        if (in_progress()->duration_field != duration) {
            change([duration](Frame& frame) { frame.duration_field = duration; });
        }
    }
    void finish(MessageOutcome outcome) {
        outcomes_.book(message_kind(*in_progress()), outcome);
        queue_.pop();
        is_in_progress_ = false;
    }

private:
    template <typename Change>
    void change(const Change& change) {
        Frame changed = *in_progress();
        change(changed);
        queue_.front() = std::make_shared<const Frame>(std::move(changed));
    }
    std::size_t waiting() const { return queue_.size() - (is_in_progress_ ? 1 : 0); }

    FrameFifo queue_;
    int capacity_;
    bool blocks_;
    bool is_in_progress_ = false;  // whether the first frame is
    NodeId node_;
    std::uint32_t next_sequence_ = 0;
    MessageOutcomes outcomes_;
};

}  // namespace netsim
