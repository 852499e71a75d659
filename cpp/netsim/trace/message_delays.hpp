// How long messages were on their way in a network: from their sender's command until a receiver's protocol got them.
#pragma once

#include <array>
#include <cstddef>

#include "netsim/trace/delay_histogram.hpp"
#include "netsim/trace/message_fates.hpp"

namespace netsim {

class MessageDelays {
public:
    // A broadcast has one for each of its receivers.
    void add(MessageKind kind, SimTime delay) { delays_[static_cast<std::size_t>(kind)].add(delay); }

    const DelayHistogram& of(MessageKind kind) const { return delays_[static_cast<std::size_t>(kind)]; }

private:
    std::array<DelayHistogram, message_kind_count> delays_;
};

}  // namespace netsim
