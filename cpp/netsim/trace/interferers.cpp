#include "netsim/trace/interferers.hpp"

#include <algorithm>

#include "netsim/kernel/prefetch.hpp"

namespace netsim {

void Interferers::note(NodeId receiver, std::span<const NodeId> nodes) {
    constexpr std::size_t max_noted = 512;
    for (const NodeId node : nodes) {
        noted_.push_back({receiver, node});
    }
    if (noted_.size() >= max_noted) {
        count_noted();
    }
}

void Interferers::count_noted() {
    for (const Pair& pair : noted_) {
        prefetch(counts_[pair.receiver]);
    }
    for (const Pair& pair : noted_) {
        const std::vector<Count>& known = counts_[pair.receiver];
        prefetch_bytes(known.data(), known.size() * sizeof(Count));
    }
    for (const auto [receiver, node] : noted_) {
        std::vector<Count>& known = counts_[receiver];
        auto place = std::ranges::lower_bound(known, node, {}, &Count::node);
        if (place == known.end() || place->node != node) {
            if (known.size() == known.capacity()) {
                const auto offset = place - known.begin();
                known.reserve(known.size() + known.size() / 4 + 2);
                place = known.begin() + offset;
            }
            place = known.insert(place, Count{node});
        }
        ++place->copies;
    }
    noted_.clear();
}

std::map<NodeId, std::uint64_t> Interferers::at(NodeId receiver) const {
    std::map<NodeId, std::uint64_t> copies;
    for (const Count& count : counts_[receiver]) {
        copies.emplace_hint(copies.end(), count.node, count.copies);
    }
    for (const Pair& pair : noted_) {
        if (pair.receiver == receiver) {
            ++copies[pair.node];
        }
    }
    return copies;
}

}  // namespace netsim
