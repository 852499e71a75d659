#include "netsim/node/protocol.hpp"

#include "netsim/node/network_context.hpp"
#include "netsim/node/run_callback.hpp"

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
    run_callback(*context_, node_, "handle_packet", [&] { handle_packet(frame.payload); });
}

}  // namespace netsim
