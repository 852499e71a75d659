#include "netsim/trace/frame_outcomes.hpp"

#include "netsim/error.hpp"

namespace netsim {

void FrameOutcomes::book(NodeId receiver, FrameLabel label, FrameOutcome outcome) {
    auto& sums = label.is_for(receiver) ? addressed_ : overheard_;
    ++sums[index(label.kind)].counts[index(outcome)];
    Column& column = at_nodes_[index(label.kind)][index(outcome)];
    if (column.size() <= static_cast<std::size_t>(receiver)) {
        column.resize(interferers_.node_count());
    }
    ++column[receiver];
    if (observer_ != nullptr) {
        observer_->reception_ends(label.number, receiver, outcome);
    }
}

void FrameOutcomes::book_interference(NodeId receiver, FrameLabel label,
                                      std::span<const NodeId> interferers) {
    book(receiver, label, FrameOutcome::interference);
    interferers_.note(receiver, interferers);
}

void FrameOutcomes::book_transmission(FrameLabel label, CopyCount addressed, CopyCount overheard) {
    const std::size_t kind = index(label.kind);
    constexpr std::size_t weak = index(FrameOutcome::below_sensitivity);
    ++frames_[kind];
    addressed_[kind].copies += addressed.made;
    addressed_[kind].counts[weak] += addressed.too_weak;
    overheard_[kind].copies += overheard.made;
    overheard_[kind].counts[weak] += overheard.too_weak;
}

FrameOutcomes::Counts FrameOutcomes::counts(FrameKind kind, bool overheard) const {
    const Book& book = (overheard ? overheard_ : addressed_)[index(kind)];
    Counts counts = book.counts;
    std::uint64_t booked = 0;
    for (const std::uint64_t count : counts) {
        booked += count;
    }
    NETSIM_ASSERT(booked <= book.copies);
    counts[index(FrameOutcome::in_air)] = book.copies - booked;
    return counts;
}

FrameOutcomes::Counts FrameOutcomes::counts_at(NodeId receiver, FrameKind kind) const {
    Counts counts{};
    for (std::size_t outcome = 0; outcome < frame_outcome_count; ++outcome) {
        const Column& column = at_nodes_[index(kind)][outcome];
        counts[outcome] = static_cast<std::size_t>(receiver) < column.size() ? column[receiver] : 0;
    }
    return counts;
}

}  // namespace netsim
