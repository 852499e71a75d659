#include "netsim/trace/message_fates.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace netsim {

MessageFates::Counts MessageFates::counts(MessageKind kind) const {
    const auto& ended = ended_[static_cast<std::size_t>(kind)];
    Counts counts{};
    std::ranges::copy(ended, counts.begin());
    counts[static_cast<std::size_t>(MessageFate::queued)] =
        accepted(kind) - std::accumulate(ended.begin(), ended.end(), std::uint64_t{0});
    return counts;
}

void MessageFateSums::add(const MessageFates& fates) {
    for (std::size_t index = 0; index < message_kind_count; ++index) {
        const auto kind = static_cast<MessageKind>(index);
        accepted_[index] += fates.accepted(kind);
        std::ranges::transform(counts_[index], fates.counts(kind), counts_[index].begin(), std::plus<>());
    }
}

}  // namespace netsim
