// The base class of network interfaces.
//
// There are three: Dcf (an 802.11 station), CsmaCa802154 (an 802.15.4 device) and IdealInterface
// (a perfect channel).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "netsim/interface_id.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

class NetworkInterfaceListener {
public:
    // A message for this node, in the frame that carried it.
    virtual void message_received(const Frame& frame) = 0;
    // A message from this node has failed, as the outcome says: the queue was full, or no ACK came.
    virtual void message_failed(const Frame&, MessageOutcome) {}
    // A message waits in front of the full queue, or no message does any more.
    virtual void queue_blocks(bool) {}

protected:
    ~NetworkInterfaceListener() = default;
};

class NetworkInterface {
public:
    virtual ~NetworkInterface() = default;

    // Sets the receiver of messages; null for none.
    void set_listener(NetworkInterfaceListener* listener) { listener_ = listener; }
    // Accepts a message for `destination` (broadcast_id: for all nodes in reach). Throws
    // SimulationError if it is longer than longest_message_bytes().
    virtual void send(NodeId destination, Payload payload, CauseId cause) = 0;
    virtual std::size_t longest_message_bytes() const = 0;
    // A message will probably be sent soon: prefetches what sending reads (kernel/prefetch.hpp). The
    // first line of the interface is already in the cache. Step 0 prefetches what that line points
    // to, and step 1 what the result points to.
    virtual void prefetch(int step) const = 0;
    virtual const MessageOutcomes& message_outcomes() const = 0;
    // Number of messages that wait or are in progress, to check that the outcomes add up.
    virtual std::size_t queued_messages() const = 0;
    // {bitrate in bps: unicast frames sent with it, including retries}; empty without adaptive rate
    // control.
    virtual std::map<std::int64_t, std::uint64_t> frames_by_bitrate() const { return {}; }

protected:
    void pass_on_message(const Frame& frame) const {
        if (listener_ != nullptr) {
            listener_->message_received(frame);
        }
    }
    void report_failure(const Frame& frame, MessageOutcome outcome) const {
        if (listener_ != nullptr) {
            listener_->message_failed(frame, outcome);
        }
    }
    void report_blocking(bool blocks) const {
        if (listener_ != nullptr) {
            listener_->queue_blocks(blocks);
        }
    }

private:
    NetworkInterfaceListener* listener_ = nullptr;
};

}  // namespace netsim
