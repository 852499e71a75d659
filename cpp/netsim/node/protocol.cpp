#include "netsim/node/protocol.hpp"

#include "netsim/node/protocol_error.hpp"
#include "netsim/node/surroundings.hpp"

namespace netsim {

namespace {

constexpr std::uint64_t packet_word = 0x7061636B6574;  // of the fingerprint: tells packets from other events

}  // namespace

void Protocol::message_received(const Frame& frame) {
    const SimTime now = surroundings_->simulator.now();
    surroundings_->message_delays.add(message_kind(frame), now - frame.accepted);
    surroundings_->fingerprint.add(packet_word ^ (static_cast<std::uint64_t>(frame.transmitter) << 40) ^
                                   static_cast<std::uint64_t>(node_));
    surroundings_->fingerprint.add(surroundings_->payload_hash.of(frame.payload));
    call_of_protocol("handle_packet", node_, now, [&] { handle_packet(frame.payload); });
}

}  // namespace netsim
