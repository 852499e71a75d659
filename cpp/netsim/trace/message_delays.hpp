// Delays of messages, from the sender's command to the handler of the receiver's protocol.
#pragma once

#include <array>
#include <cstddef>

#include "netsim/trace/delay_histogram.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

class MessageDelays {
public:
    // A broadcast has one delay per receiver.
    void add(MessageKind kind, SimTime delay) { delays_[static_cast<std::size_t>(kind)].add(delay); }

    const DelayHistogram& of(MessageKind kind) const { return delays_[static_cast<std::size_t>(kind)]; }

private:
    std::array<DelayHistogram, message_kind_count> delays_;
};

}  // namespace netsim
