// Outcomes of frames: one for each reception of each frame.
//
// A transmission counts as one reception at every other radio that knows its format and listens to
// its band, at any distance. Every reception has exactly one outcome. So for each kind of frame,
// receptions = sum over the outcomes. The medium counts receptions below the sensitivity in bulk; the
// radios count the others one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "netsim/kernel/prefetch.hpp"
#include "netsim/node_id.hpp"
#include "netsim/trace/frame_label.hpp"
#include "netsim/trace/frame_observer.hpp"
#include "netsim/trace/interferers.hpp"

namespace netsim {

enum class FrameOutcome : std::uint8_t {
    delivered,              // decoded by that radio, addressed to it or not
    below_sensitivity,      // below the sensitivity of that radio
    noise,                  // locked on and lost; would have been lost without interference
    interference,           // locked on and lost; would have been decoded without interference
    receiver_transmitting,  // the receiver was transmitting when it arrived, or started to transmit during it
    receiver_locked,        // the receiver locked on to another frame
    preamble_undetected,    // its preamble was too weak, absolutely or relative to others: preamble detection
    header_error,           // locked on, but its PHY header was lost: SNIR by chunks
    captured,               // locked on, then dropped for a stronger frame: frame capture
    in_air,                 // no outcome yet: still on the air
};
constexpr std::size_t frame_outcome_count = 10;
constexpr std::array<const char*, frame_outcome_count> frame_outcome_names{
    "delivered",       "below_sensitivity",   "noise",        "interference", "receiver_transmitting",
    "receiver_locked", "preamble_undetected", "header_error", "captured",     "in_air"};

// Numbers of receptions of a transmission: all, and those below the sensitivity.
struct CopyCount {
    std::uint64_t made = 0;
    std::uint64_t too_weak = 0;
};

class FrameOutcomes {
public:
    // [outcome]: number of receptions of one kind of frame.
    using Counts = std::array<std::uint64_t, frame_outcome_count>;

    void add_node() { interferers_.add_node(); }

    // Sets the observer of every frame from now on; null for none.
    void set_observer(FrameObserver* observer) { observer_ = observer; }
    FrameObserver* observer() const { return observer_; }

    // The reception of `label`'s frame at `receiver` ended.
    void book(NodeId receiver, FrameLabel label, FrameOutcome outcome);
    // The same for a reception lost to interference by frames of `interferers` (nodes; each once).
    void book_interference(NodeId receiver, FrameLabel label, std::span<const NodeId> interferers);
    // A frame was transmitted, with these numbers of receptions.
    void book_transmission(FrameLabel label, CopyCount addressed, CopyCount overheard);

    // Prefetches the count of that outcome, which will be incremented soon.
    void prefetch(NodeId receiver, FrameKind kind, FrameOutcome outcome) const {
        const Column& column = at_nodes_[index(kind)][index(outcome)];
        if (static_cast<std::size_t>(receiver) < column.size()) {
            netsim::prefetch(column[receiver]);
        }
    }

    std::uint64_t frames(FrameKind kind) const { return frames_[index(kind)]; }
    std::uint64_t copies(FrameKind kind, bool overheard) const {
        return (overheard ? overheard_ : addressed_)[index(kind)].copies;
    }
    // Sums over all receivers. Receptions without an outcome so far are in_air. `overheard`: whether
    // to count receptions of frames for other nodes; a broadcast frame is for all nodes.
    Counts counts(FrameKind kind, bool overheard) const;
    // Receptions at one node that reached its sensitivity (below_sensitivity is not counted per
    // node).
    Counts counts_at(NodeId receiver, FrameKind kind) const;
    // {interfering node: receptions lost at `receiver` because of it}
    std::map<NodeId, std::uint64_t> interferers_at(NodeId receiver) const {
        return interferers_.at(receiver);
    }

private:
    struct Book {
        std::uint64_t copies = 0;
        Counts counts{};
    };

    static constexpr std::size_t index(FrameKind kind) { return static_cast<std::size_t>(kind); }
    static constexpr std::size_t index(FrameOutcome outcome) { return static_cast<std::size_t>(outcome); }

    // [receiver]: number of receptions of one kind and one outcome. Empty if there are none.
    using Column = std::vector<std::uint64_t>;
    // [kind][outcome]. In this layout, a cache line has eight of the most used counts, `delivered`.
    std::array<std::array<Column, frame_outcome_count>, frame_kind_count> at_nodes_;
    FrameObserver* observer_ = nullptr;
    Interferers interferers_;
    std::array<std::uint64_t, frame_kind_count> frames_{};
    std::array<Book, frame_kind_count> addressed_{};
    std::array<Book, frame_kind_count> overheard_{};
};

}  // namespace netsim
