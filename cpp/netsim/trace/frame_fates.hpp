// The ledger of frames: what became of each copy of each frame.
//
// A transmission makes one copy for every other radio that knows its format and listens to its band, however far away, and
// every copy ends in exactly one fate, so that for each kind of frame: copies made = sum over the fates. The medium books
// copies too weak to be received in bulk, the radios book the rest one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "netsim/kernel/fetch.hpp"
#include "netsim/node_id.hpp"
#include "netsim/trace/frame_label.hpp"
#include "netsim/trace/interferers.hpp"

namespace netsim {

enum class FrameFate : std::uint8_t {
    delivered,              // decoded by that radio, whoever it was for
    below_sensitivity,      // too weak for that radio to notice
    noise,                  // locked on, lost, and would have been lost without interference
    interference,           // locked on, lost, and would have been decoded without interference
    receiver_transmitting,  // the receiver was transmitting when it came, or began to while it lasted
    receiver_locked,        // the receiver was locked on another frame when it came
    preamble_undetected,  // its beginning was too weak, in itself or beside others: ThresholdPreambleDetection
    header_error,         // locked on, but its PHY header could not be decoded: SNIR by chunks
    captured,             // locked on, given up for a stronger one: SimpleFrameCapture
    in_air,               // still on its way when the run ended
};
constexpr std::size_t frame_fate_count = 10;
constexpr std::array<const char*, frame_fate_count> frame_fate_names{
    "delivered",       "below_sensitivity",   "noise",        "interference", "receiver_transmitting",
    "receiver_locked", "preamble_undetected", "header_error", "captured",     "in_air"};

// How many copies a transmission made, and how many of them are below sensitivity.
struct CopyCount {
    std::uint64_t made = 0;
    std::uint64_t too_weak = 0;
};

class FrameFates {
public:
    // counts[fate] of the copies of one kind, at their addressees or overheard by others.
    using Counts = std::array<std::uint64_t, frame_fate_count>;

    void add_node() { interferers_.add_node(); }

    // One copy of `label`'s frame ended at `receiver`.
    void book(NodeId receiver, FrameLabel label, FrameFate fate);
    // That copy was lost to interference by frames of `interferers` (nodes; each once).
    void book_interference(NodeId receiver, FrameLabel label, std::span<const NodeId> interferers);
    // A frame went on the air and made these copies, of which some are below sensitivity at their receivers.
    void book_transmission(FrameLabel label, CopyCount addressed, CopyCount overheard);

    // Something is going to be booked there soon: has it brought into the cache.
    void fetch(NodeId receiver, FrameKind kind, FrameFate fate) const {
        const Column& column = at_nodes_[index(kind)][index(fate)];
        if (static_cast<std::size_t>(receiver) < column.size()) {
            netsim::fetch(column[receiver]);
        }
    }

    std::uint64_t frames(FrameKind kind) const { return frames_[index(kind)]; }
    std::uint64_t copies(FrameKind kind, bool overheard) const {
        return (overheard ? overheard_ : addressed_)[index(kind)].copies;
    }
    // Sums over all receivers. The copies that are in no other fate yet are in_air. `overheard` selects the copies
    // that were not for their receiver; broadcast frames are for everybody.
    Counts counts(FrameKind kind, bool overheard) const;
    // Of the copies that could be received at one receiver (below_sensitivity is not kept for each node).
    Counts counts_at(NodeId receiver, FrameKind kind) const;
    // {interfering node: copies lost at `receiver` with its help}
    std::map<NodeId, std::uint64_t> interferers_at(NodeId receiver) const {
        return interferers_.at(receiver);
    }

private:
    struct Book {
        std::uint64_t copies = 0;
        Counts counts{};
    };

    static constexpr std::size_t index(FrameKind kind) { return static_cast<std::size_t>(kind); }
    static constexpr std::size_t index(FrameFate fate) { return static_cast<std::size_t>(fate); }

    // Of one kind and one fate, by receiver.
    using Column = std::vector<std::uint64_t>;
    // [kind][fate]: each copy of a frame adds to one number, mostly among those delivered; side by side, eight of them are in
    // one cache line. What never happens has none.
    std::array<std::array<Column, frame_fate_count>, frame_kind_count> at_nodes_;
    Interferers interferers_;
    std::array<std::uint64_t, frame_kind_count> frames_{};
    std::array<Book, frame_kind_count> addressed_{};
    std::array<Book, frame_kind_count> overheard_{};
};

}  // namespace netsim
