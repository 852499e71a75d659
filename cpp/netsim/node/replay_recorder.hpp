// Records a run for a replay: frames with the outcome of each reception, paths, tracked variables
// and events of protocols.
//
// The recorder adds rows to tables. From time to time, it closes them as a chunk, which the caller
// takes and stores, so that memory does not grow with simulated time. The columns are also declared
// in python/gradysim/replay/tables.py; a test compares them.
//
// A frame is written when its last reception has ended and all earlier frames are written. Only
// receptions that differ from those of the sender's last frame are written: most receivers decode
// frame after frame.
//
// Receivers that a frame did not reach are counted. Of those within its steady reach
// (Links::is_in_steady_reach), the strongest are written: there, something else than distance took
// the power.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/node/tracked_variables.hpp"
#include "netsim/trace/frame_observer.hpp"
#include "netsim/trace/frame_outcomes.hpp"

namespace netsim {

// A closed part of the record: columns as little-endian octets.
struct ReplayChunk {
    struct Column {
        std::string name;
        std::string octets;  // differences of successive values where tables.py says so
    };
    struct Table {
        std::string name;
        std::vector<Column> columns;
    };
    struct Density {  // [bin]: counts in successive time bins
        SimTime bin;
        std::vector<std::uint32_t> frames;
        std::vector<std::uint32_t> lost;
    };
    struct OutcomeCount {
        NodeId node = 0;
        FrameOutcome outcome = FrameOutcome::delivered;
        std::uint32_t count = 0;
    };

    SimTime start;
    SimTime end;
    std::vector<std::string> strings;
    std::vector<Table> tables;
    Density density;
    std::vector<OutcomeCount> outcomes;
};

class ReplayRecorder final : public FrameObserver {
public:
    // A log line has its level as its kind.
    enum class EventKind : std::uint8_t { timer, command, debug, info, warning, error };

    explicit ReplayRecorder(const Simulator& simulator) : simulator_(simulator) {}
    ReplayRecorder(const ReplayRecorder&) = delete;
    ReplayRecorder& operator=(const ReplayRecorder&) = delete;
    // Add nodes in the order of their ids. `is_recorded`: whether to record the frames that the node
    // sends or notices, and its variables and events. The path of every node is recorded.
    void add_node(const Trajectory& trajectory, bool is_recorded);

    // Records the path of a node as periodic positions, for a node with very many legs.
    void sample_path(NodeId node) { nodes_.at(node).is_sampled = true; }

    // A callback of a protocol begins. It is the cause of the messages that it sends.
    void callback_begins(const char* callback) {
        callback_ = callback;
        timer_ = nullptr;
    }
    // Records a timer as an event and as the cause. Call it after callback_begins. `timer` must live
    // as long as the callback.
    void timer_due(NodeId node, const std::string& timer);
    // The id of the current cause; 0 if there are too many causes.
    CauseId cause();

    void course_changed(NodeId node);
    void variable_set(NodeId node, std::string_view name, const TrackedValue& value);
    void event(NodeId node, EventKind kind, std::string_view text);

    bool explains(NodeId sender, NodeId receiver) const override {
        return nodes_[sender].is_recorded || nodes_[receiver].is_recorded;
    }
    void frame_begins(const Transmission& transmission, std::uint64_t noticed, std::uint64_t too_weak,
                      std::span<const Loss> missed) override;
    void reception_ends(FrameNumber number, NodeId receiver, FrameOutcome outcome) override;
    void frame_lost(FrameNumber number, const Loss& loss) override;

    // Closes the chunk now. Frames with receptions in progress go to the next chunk.
    void close_chunk();
    // At the end of the run: closes the last chunk, with the frames that are on the air.
    void finish();
    // Returns the closed chunks and forgets them.
    std::vector<ReplayChunk> take() { return std::exchange(chunks_, {}); }

private:
    // Rows of the tables. Times in ns.
    struct FrameRow {
        std::uint64_t time = 0;
        std::uint64_t duration = 0;
        std::uint32_t node = 0;
        std::uint8_t interface = 0;
        std::uint8_t kind = 0;
        std::uint8_t retry = 0;
        std::uint32_t destination = 0;
        std::uint32_t bytes = 0;
        std::uint32_t bitrate_bps = 0;
        std::int16_t power_cdbm = 0;
        std::uint32_t cause = 0;
        std::uint32_t text = 0;
        std::uint32_t receptions = 0;
        std::uint32_t unnoticed = 0;
    };
    struct ReceptionRow {
        std::uint32_t frame = 0;
        std::uint32_t receiver = 0;
        std::uint8_t outcome = 0;
    };
    struct LossRow {
        std::uint32_t frame = 0;
        std::uint32_t receiver = 0;
        std::int16_t power_cdbm = 0;
        std::int16_t needed_cdb = 0;
        std::int16_t noise_cdbm = 0;
        std::int16_t interference_cdbm = 0;
        std::int16_t distance_cdb = 0;
        std::int16_t sender_antenna_cdb = 0;
        std::int16_t receiver_antenna_cdb = 0;
        std::int16_t ground_cdb = 0;
        std::int16_t shadowing_cdb = 0;
        std::int16_t fading_cdb = 0;
    };
    struct ObstructionRow {
        std::uint32_t frame = 0;
        std::uint32_t receiver = 0;
        std::uint32_t obstacle = 0;
        std::int16_t gain_cdb = 0;
    };
    struct InterfererRow {
        std::uint32_t frame = 0;
        std::uint32_t receiver = 0;
        std::uint32_t node = 0;
        std::int16_t power_cdbm = 0;
    };
    struct LegRow {
        std::uint64_t time = 0;
        std::uint64_t duration = 0;
        std::uint32_t node = 0;
        Position from;
        Position to;
    };
    struct VariableRow {
        std::uint64_t time = 0;
        std::uint32_t node = 0;
        std::uint32_t name = 0;
        double value = 0;
        std::uint32_t text = 0;
    };
    struct EventRow {
        std::uint64_t time = 0;
        std::uint32_t node = 0;
        std::uint8_t kind = 0;
        std::uint32_t text = 0;
    };

    struct TextRow {
        std::uint32_t recorded = 0;  // octets
        std::uint32_t bytes = 0;     // of the message
    };

    // A reception in 32 bits, which sorts by receiver.
    using Reception = std::uint32_t;
    static Reception reception_of(NodeId receiver, FrameOutcome outcome) {
        return static_cast<Reception>(receiver) << 8 | static_cast<Reception>(outcome);
    }

    // A frame that is still on the air, or that waits for an earlier one.
    struct OpenFrame {
        FrameRow row;
        Payload message;         // of data frames
        std::uint64_t left = 0;  // receptions that have not ended
        bool is_recorded = false;
        std::vector<Reception> receptions;
        std::vector<LossRow> losses;
        std::vector<ObstructionRow> obstructions;
        std::vector<InterfererRow> interferers;
    };
    struct RecordedNode {
        const Trajectory* trajectory = nullptr;
        bool is_recorded = false;
        bool is_sampled = false;
        SimTime sampled_at;
        Position sampled;
        std::vector<std::vector<Reception>> heard_by;  // [interface] of the last frame in this chunk
        std::array<std::uint32_t, frame_outcome_count> outcomes{};  // in this chunk
    };

    SimTime now() const { return simulator_.now(); }
    // Closes the chunk if it is large enough. Call it before each row.
    void begin_row();
    void write_complete_frames();
    void write(OpenFrame& frame);
    void add_loss(OpenFrame& frame, const Loss& loss);
    void write_changes(OpenFrame& frame, std::uint32_t number);
    void write_leg(NodeId node);
    void count(const OpenFrame& frame);
    CauseId cause_of(const std::string& text);
    std::uint32_t string(const std::string& text);
    // The row of a message in the table of texts; `text_left_out` if there are too many.
    std::uint32_t text_row(const std::string& message);
    OpenFrame& open(FrameNumber frame) { return open_[static_cast<std::size_t>(frame - first_open_)]; }

    const Simulator& simulator_;
    std::vector<RecordedNode> nodes_;
    std::vector<std::string> causes_{""};  // by CauseId
    std::unordered_map<std::string, CauseId> cause_ids_;
    const char* callback_ = "";           // the last one that began
    const std::string* timer_ = nullptr;  // of handle_timer
    std::deque<OpenFrame> open_;
    FrameNumber first_open_ = 0;

    SimTime chunk_start_;
    std::vector<FrameRow> frames_;
    std::vector<ReceptionRow> receptions_;
    std::vector<LossRow> losses_;
    std::vector<ObstructionRow> obstructions_;
    std::vector<InterfererRow> interferers_;
    std::vector<LegRow> legs_;
    std::vector<VariableRow> variables_;
    std::vector<EventRow> events_;
    std::vector<std::string> strings_;
    std::unordered_map<std::string, std::uint32_t> string_ids_;
    std::vector<TextRow> texts_;
    std::string text_bytes_;
    std::unordered_map<std::string, std::uint32_t> text_ids_;
    ReplayChunk::Density density_;
    std::vector<ReplayChunk> chunks_;
};

}  // namespace netsim
