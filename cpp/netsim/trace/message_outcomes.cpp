#include "netsim/trace/message_outcomes.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace netsim {

MessageOutcomes::Counts MessageOutcomes::counts(MessageKind kind) const {
    const auto& ended = ended_[static_cast<std::size_t>(kind)];
    Counts counts{};
    std::ranges::copy(ended, counts.begin());
    counts[static_cast<std::size_t>(MessageOutcome::queued)] =
        accepted(kind) - std::accumulate(ended.begin(), ended.end(), std::uint64_t{0});
    return counts;
}

void MessageOutcomeSums::add(const MessageOutcomes& outcomes) {
    for (std::size_t index = 0; index < message_kind_count; ++index) {
        const auto kind = static_cast<MessageKind>(index);
        accepted_[index] += outcomes.accepted(kind);
        std::ranges::transform(counts_[index], outcomes.counts(kind), counts_[index].begin(), std::plus<>());
    }
}

}  // namespace netsim
