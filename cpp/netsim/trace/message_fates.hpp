// The ledger of messages: what became of each message that protocols handed to one network interface, or to several.
//
// Each interface keeps its own, beside its queue; a network's is their sum, made when somebody asks. A message is queued until it
// meets its fate, so that messages accepted = sum over the fates; that each is booked once is checked by tests on random
// scenarios.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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
    queued,                  // still waiting or in progress
};
constexpr std::size_t message_fate_count = 7;
constexpr std::array<const char*, message_fate_count> message_fate_names{
    "sent",         "acknowledged",           "retry_limit", "queue_overflow",
    "out_of_range", "channel_access_failure", "queued"};

// Of one interface.
class MessageFates {
public:
    using Counts = std::array<std::uint64_t, message_fate_count>;

    void accept(MessageKind kind) { ++accepted_[static_cast<std::size_t>(kind)]; }
    void book(MessageKind kind, MessageFate fate) {
        ++ended_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(fate)];
    }

    std::uint64_t accepted(MessageKind kind) const { return accepted_[static_cast<std::size_t>(kind)]; }
    // What is in no other fate yet is queued.
    Counts counts(MessageKind kind) const;

private:
    static_assert(static_cast<std::size_t>(MessageFate::queued) == message_fate_count - 1);

    // In 32 bits: an interface of 802.11 that grows by a cache line makes large networks 2 % slower, and a channel that is
    // never free takes days for so many messages of one. Beyond 4,294,967,295 of them the counts begin again at 0.
    using Count = std::uint32_t;
    std::array<Count, message_kind_count> accepted_{};
    // Those in a fate other than queued.
    std::array<std::array<Count, message_fate_count - 1>, message_kind_count> ended_{};
};

// Of several interfaces.
class MessageFateSums {
public:
    using Counts = MessageFates::Counts;

    void add(const MessageFates& fates);

    std::uint64_t accepted(MessageKind kind) const { return accepted_[static_cast<std::size_t>(kind)]; }
    const Counts& counts(MessageKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }

private:
    std::array<std::uint64_t, message_kind_count> accepted_{};
    std::array<Counts, message_kind_count> counts_{};
};

}  // namespace netsim
