#include "netsim/node/protocol.hpp"

#include "netsim/node/network_context.hpp"
#include "netsim/node/protocol_error.hpp"
#include "netsim/node/replay_recorder.hpp"

namespace netsim {

namespace {

constexpr std::uint64_t packet_word = 0x7061636B6574;  // "packet"; marks packets in the fingerprint

}  // namespace

void Protocol::message_received(const Frame& frame) {
    const SimTime now = context_->simulator.now();
    context_->message_delays.add(message_kind(frame), now - frame.accepted);
    context_->fingerprint.add(packet_word ^ (static_cast<std::uint64_t>(frame.transmitter) << 40) ^
                              static_cast<std::uint64_t>(node_));
    context_->fingerprint.add(context_->payload_hash.of(frame.payload));
    if (context_->recorder != nullptr) {
        context_->recorder->callback_begins("handle_packet");
    }
    context_->active_node = node_;
    call_of_protocol("handle_packet", node_, now, [&] { handle_packet(frame.payload); });
    context_->active_node = NetworkContext::no_node;
}

}  // namespace netsim
