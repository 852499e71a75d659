// The ledger of messages: what became of each message that a protocol handed to its network interface, and how long it was
// on its way.
//
// accepted = sum over the fates; the balance is checked by tests on random scenarios.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "netsim/trace/delay_histogram.hpp"

namespace netsim {

enum class MessageKind : std::uint8_t { broadcast, unicast };
constexpr std::size_t message_kind_count = 2;
constexpr std::array<const char*, message_kind_count> message_kind_names{"broadcast", "unicast"};

enum class MessageFate : std::uint8_t {
    sent,                    // broadcast, or unicast for which no ACK is asked: was on the air once
    acknowledged,            // unicast: its receiver's ACK came back
    retry_limit,             // unicast: given up after the last retry
    queue_overflow,          // dropped, the queue was full
    out_of_range,            // unicast on a perfect channel: its receiver was too far away
    channel_access_failure,  // 802.15.4: given up, the channel was found busy too often
    queued,                  // still waiting or in progress when the run ended
};
constexpr std::size_t message_fate_count = 7;
constexpr std::array<const char*, message_fate_count> message_fate_names{
    "sent",         "acknowledged",           "retry_limit", "queue_overflow",
    "out_of_range", "channel_access_failure", "queued"};

class MessageFates {
public:
    using Counts = std::array<std::uint64_t, message_fate_count>;

    void accept(MessageKind kind) { ++accepted_[static_cast<std::size_t>(kind)]; }
    void book(MessageKind kind, MessageFate fate) {
        ++counts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(fate)];
    }
    // The protocol of a receiver gets one, so long after it was handed to its sender's interface.
    void receive(MessageKind kind, SimTime delay) { delays_[static_cast<std::size_t>(kind)].add(delay); }

    std::uint64_t accepted(MessageKind kind) const { return accepted_[static_cast<std::size_t>(kind)]; }
    // What is in no other fate yet is queued.
    Counts counts(MessageKind kind) const;
    // A broadcast has one for each of its receivers.
    const DelayHistogram& delays(MessageKind kind) const { return delays_[static_cast<std::size_t>(kind)]; }

private:
    std::array<std::uint64_t, message_kind_count> accepted_{};
    std::array<Counts, message_kind_count> counts_{};
    std::array<DelayHistogram, message_kind_count> delays_;
};

}  // namespace netsim
