#include "netsim/trace/message_fates.hpp"

namespace netsim {

MessageFates::Counts MessageFates::counts(MessageKind kind) const {
    Counts counts = counts_[static_cast<std::size_t>(kind)];
    std::uint64_t booked = 0;
    for (const std::uint64_t count : counts) {
        booked += count;
    }
    counts[static_cast<std::size_t>(MessageFate::queued)] += accepted(kind) - booked;
    return counts;
}

}  // namespace netsim
