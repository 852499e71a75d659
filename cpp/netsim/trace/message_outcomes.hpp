// Outcomes of the messages that network interfaces accepted.
//
// Each interface counts its own messages, next to its queue. The counts of a network are the sums,
// computed on demand. A message is queued until it has another outcome, so accepted messages = sum
// over the outcomes. Tests on random scenarios check that each message is counted once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace netsim {

enum class MessageKind : std::uint8_t { broadcast, unicast };
constexpr std::size_t message_kind_count = 2;
constexpr std::array<const char*, message_kind_count> message_kind_names{"broadcast", "unicast"};

enum class MessageOutcome : std::uint8_t {
    sent,                    // broadcast, or unicast without ACK: was on the air once
    acknowledged,            // unicast: the ACK came back
    retry_limit,             // unicast: dropped after the last retry
    queue_overflow,          // dropped: the queue was full
    out_of_range,            // unicast on a perfect channel: the receiver was out of range
    channel_access_failure,  // 802.15.4: dropped, the channel was busy too often
    queued,                  // still waiting or in progress
};
constexpr std::size_t message_outcome_count = 7;
constexpr std::array<const char*, message_outcome_count> message_outcome_names{
    "sent",         "acknowledged",           "retry_limit", "queue_overflow",
    "out_of_range", "channel_access_failure", "queued"};

// Counts of one interface.
class MessageOutcomes {
public:
    using Counts = std::array<std::uint64_t, message_outcome_count>;

    void accept(MessageKind kind) { ++accepted_[static_cast<std::size_t>(kind)]; }
    void book(MessageKind kind, MessageOutcome outcome) {
        ++ended_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(outcome)];
    }

    std::uint64_t accepted(MessageKind kind) const { return accepted_[static_cast<std::size_t>(kind)]; }
    Counts counts(MessageKind kind) const;

private:
    static_assert(static_cast<std::size_t>(MessageOutcome::queued) == message_outcome_count - 1);

    // 32 bits: one more cache line per 802.11 interface makes large networks 2 % slower. Overflow,
    // after 4,294,967,295 messages, takes days of simulated time on a saturated channel.
    using Count = std::uint32_t;
    std::array<Count, message_kind_count> accepted_{};
    // All outcomes but queued.
    std::array<std::array<Count, message_outcome_count - 1>, message_kind_count> ended_{};
};

// Sums over several interfaces.
class MessageOutcomeSums {
public:
    using Counts = MessageOutcomes::Counts;

    void add(const MessageOutcomes& outcomes);

    std::uint64_t accepted(MessageKind kind) const { return accepted_[static_cast<std::size_t>(kind)]; }
    const Counts& counts(MessageKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }

private:
    std::array<std::uint64_t, message_kind_count> accepted_{};
    std::array<Counts, message_kind_count> counts_{};
};

}  // namespace netsim
