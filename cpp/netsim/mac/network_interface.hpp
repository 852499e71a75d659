// What a node asks of its network interface, and what it hears from it.
//
// Three interfaces exist: Dcf (an 802.11 station), CsmaCa802154 (an 802.15.4 device) and UnitDiskInterface (a perfect
// channel).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "netsim/interface_id.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/trace/message_fates.hpp"

namespace netsim {

class NetworkInterfaceListener {
public:
    // A message for this node, in the frame that carried it.
    virtual void message_received(const Frame& frame) = 0;

protected:
    ~NetworkInterfaceListener() = default;
};

class NetworkInterface {
public:
    virtual ~NetworkInterface() = default;

    // Who gets the messages; nobody, if null.
    void set_listener(NetworkInterfaceListener* listener) { listener_ = listener; }
    // Takes a message for `destination` (broadcast_id: for all in reach). Throws SimulationError if it is longer than
    // longest_message_bytes().
    virtual void send(NodeId destination, Payload payload) = 0;
    virtual std::size_t longest_message_bytes() const = 0;
    // A message will probably be sent soon: has what that touches brought into the cache (kernel/fetch.hpp). Its first line is
    // there; in step 0 what it leads to is asked for, in step 1 what that leads to.
    virtual void fetch(int step) const = 0;
    // What became of the messages that this interface took.
    virtual const MessageFates& message_fates() const = 0;
    // Messages that wait or are in progress: a census to check the ledger with.
    virtual std::size_t queued_messages() const = 0;
    // {bitrate in bps: unicast frames sent with it, retries included} of a station that has a rate control.
    virtual std::map<std::int64_t, std::uint64_t> frames_by_bitrate() const { return {}; }

protected:
    void pass_on_message(const Frame& frame) const {
        if (listener_ != nullptr) {
            listener_->message_received(frame);
        }
    }

private:
    NetworkInterfaceListener* listener_ = nullptr;
};

}  // namespace netsim
