#include "netsim/node/replay_recorder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "netsim/phy/modes.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

namespace {

constexpr SimTime longest_chunk = SimTime::from_us(60'000'000);
constexpr std::size_t max_frames = 20'000;  // in a chunk
constexpr std::size_t max_rows = 1'000'000;
constexpr SimTime density_bin = SimTime::from_us(250'000);
constexpr SimTime sampling_interval = SimTime::from_us(200'000);
constexpr std::size_t max_causes = 10'000;

// BELOW_SENSITIVITY and NO_POWER in tables.py.
constexpr std::uint8_t no_longer_noticed = 255;
constexpr std::int16_t no_power = std::numeric_limits<std::int16_t>::min();

constexpr std::uint64_t ns(SimTime time) {
    return static_cast<std::uint64_t>(std::max(time, SimTime{}).ps() / 1000);
}

// In 0.01 dBm.
std::int16_t cdbm(double power_w) {
    if (power_w <= 0) {
        return no_power;
    }
    return static_cast<std::int16_t>(
        std::clamp(std::round(1000 * std::log10(1000 * power_w)), -32767.0, 32767.0));
}

bool is_lost(FrameFate fate) {
    return fate != FrameFate::delivered && fate != FrameFate::below_sensitivity && fate != FrameFate::in_air;
}

// A column of a table: one member of each row.
template <typename Row, typename Get>
ReplayChunk::Column column(const char* name, const std::vector<Row>& rows, Get get, bool delta = false) {
    static_assert(std::endian::native == std::endian::little);
    using Value = std::decay_t<std::invoke_result_t<Get, const Row&>>;
    std::vector<Value> values;
    values.reserve(rows.size());
    Value before{};
    for (const Row& row : rows) {
        const Value value = std::invoke(get, row);
        values.push_back(delta ? static_cast<Value>(value - before) : value);
        before = value;
    }
    return {name, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)}};
}

std::string text_of_value(const TrackedValue& value) {
    if (const bool* const truth = std::get_if<bool>(&value)) {
        return *truth ? "true" : "false";
    }
    return std::get<std::string>(value);
}

}  // namespace

void ReplayRecorder::add_node(const Trajectory& trajectory, bool is_recorded) {
    RecordedNode& node = nodes_.emplace_back();
    node.trajectory = &trajectory;
    node.is_recorded = is_recorded;
    write_leg(static_cast<NodeId>(nodes_.size() - 1));
}

CauseId ReplayRecorder::cause() {
    if (timer_ != nullptr) {
        return cause_of("timer " + *timer_);
    }
    constexpr std::string_view handle = "handle_";
    std::string_view callback = callback_;
    callback.remove_prefix(callback.starts_with(handle) ? handle.size() : 0);
    return cause_of(std::string(callback));
}

CauseId ReplayRecorder::cause_of(const std::string& text) {
    const auto known = cause_ids_.find(text);
    if (known != cause_ids_.end()) {
        return known->second;
    }
    if (causes_.size() == max_causes) {
        return 0;
    }
    causes_.push_back(text);
    return cause_ids_.emplace(text, static_cast<CauseId>(causes_.size() - 1)).first->second;
}

std::uint32_t ReplayRecorder::string(const std::string& text) {
    if (strings_.empty()) {
        strings_.emplace_back();
        string_ids_.emplace("", 0);
    }
    const auto [entry, is_new] = string_ids_.try_emplace(text, static_cast<std::uint32_t>(strings_.size()));
    if (is_new) {
        strings_.push_back(text);
    }
    return entry->second;
}

void ReplayRecorder::timer_due(NodeId node, const std::string& timer) {
    event(node, EventKind::timer, timer);
    timer_ = &timer;
}

void ReplayRecorder::event(NodeId node, EventKind kind, std::string_view text) {
    if (!nodes_[node].is_recorded) {
        return;
    }
    begin_row();
    events_.push_back({ns(now()), static_cast<std::uint32_t>(node), static_cast<std::uint8_t>(kind),
                       string(std::string(text))});
}

void ReplayRecorder::variable_set(NodeId node, std::string_view name, const TrackedValue& value) {
    if (!nodes_[node].is_recorded) {
        return;
    }
    begin_row();
    VariableRow row{
        .time = ns(now()), .node = static_cast<std::uint32_t>(node), .name = string(std::string(name))};
    if (const auto* const integer = std::get_if<std::int64_t>(&value)) {
        row.value = static_cast<double>(*integer);
    } else if (const auto* const number = std::get_if<double>(&value)) {
        row.value = *number;
    } else {
        row.value = std::numeric_limits<double>::quiet_NaN();
        row.text = string(text_of_value(value));
    }
    variables_.push_back(row);
}

void ReplayRecorder::course_changed(NodeId node) {
    RecordedNode& moved = nodes_[node];
    if (!moved.is_sampled) {
        begin_row();
        write_leg(node);
        return;
    }
    if (now() - moved.sampled_at < sampling_interval) {
        return;
    }
    begin_row();
    const Position here = moved.trajectory->position_at(now());
    legs_.push_back({ns(moved.sampled_at), ns(now() - moved.sampled_at), static_cast<std::uint32_t>(node),
                     moved.sampled, here});
    moved.sampled_at = now();
    moved.sampled = here;
}

void ReplayRecorder::write_leg(NodeId node) {
    RecordedNode& there = nodes_[node];
    if (there.is_sampled) {
        there.sampled_at = now();
        there.sampled = there.trajectory->position_at(now());
        legs_.push_back({ns(now()), 0, static_cast<std::uint32_t>(node), there.sampled, there.sampled});
        return;
    }
    const Trajectory::Leg& leg = there.trajectory->newest_leg();
    legs_.push_back({ns(leg.start), ns(leg.arrival - leg.start), static_cast<std::uint32_t>(node), leg.origin,
                     leg.target});
}

void ReplayRecorder::frame_begins(const Transmission& transmission, std::uint64_t noticed,
                                  std::uint64_t too_weak) {
    if (open_.empty()) {
        first_open_ = transmission.id();
    }
    OpenFrame& frame = open_.emplace_back();
    const Frame& content = *transmission.frame;
    frame.row = {.time = ns(transmission.start),
                 .duration = ns(transmission.duration),
                 .node = static_cast<std::uint32_t>(transmission.sender.node),
                 .interface = static_cast<std::uint8_t>(transmission.sender.index),
                 .kind = static_cast<std::uint8_t>(transmission.label.kind),
                 .retry = static_cast<std::uint8_t>(content.retry),
                 .destination = static_cast<std::uint32_t>(transmission.label.destination),
                 .bytes = static_cast<std::uint32_t>(transmission.psdu_bytes),
                 .bitrate_bps = transmission.mode == nullptr
                                    ? 0
                                    : static_cast<std::uint32_t>(transmission.mode->bitrate_bps),
                 .cause = content.cause,
                 .receptions = static_cast<std::uint32_t>(noticed),
                 .unnoticed = static_cast<std::uint32_t>(too_weak)};
    if (transmission.psdu_bytes == 0 && content.payload) {  // on a medium without frames
        frame.row.bytes = static_cast<std::uint32_t>(content.payload->size());
    }
    frame.left = noticed;
    frame.is_recorded = nodes_[transmission.sender.node].is_recorded;
    frame.receptions.reserve(noticed);
    write_complete_frames();
}

void ReplayRecorder::reception_ends(FrameNumber number, NodeId receiver, FrameFate fate) {
    OpenFrame& frame = open(number);
    if (frame.is_recorded || nodes_[receiver].is_recorded) {
        frame.receptions.push_back(reception_of(receiver, fate));
    }
    if (--frame.left == 0 && number == first_open_) {
        write_complete_frames();
    }
}

void ReplayRecorder::frame_lost(FrameNumber number, NodeId receiver, const Loss& loss) {
    OpenFrame& frame = open(number);
    if (!frame.is_recorded && !nodes_[receiver].is_recorded) {
        return;
    }
    const auto lost_by = static_cast<std::uint32_t>(receiver);
    frame.losses.push_back({0, lost_by, cdbm(loss.power_w), cdbm(loss.interference_w)});
    for (const NodeId interferer : loss.interferers) {
        frame.interferers.push_back({0, lost_by, static_cast<std::uint32_t>(interferer)});
    }
}

void ReplayRecorder::write_complete_frames() {
    while (!open_.empty() && open_.front().left == 0) {
        write(open_.front());
        open_.pop_front();
        ++first_open_;
    }
}

void ReplayRecorder::write(OpenFrame& frame) {
    if (!frame.is_recorded && frame.receptions.empty()) {
        return;
    }
    begin_row();
    const auto number = static_cast<std::uint32_t>(frames_.size());
    std::ranges::sort(frame.receptions);
    count(frame);
    write_changes(frame, number);
    for (LossRow& loss : frame.losses) {
        loss.frame = number;
        losses_.push_back(loss);
    }
    for (InterfererRow& interferer : frame.interferers) {
        interferer.frame = number;
        interferers_.push_back(interferer);
    }
    frame.row.cause = string(causes_[frame.row.cause]);
    frames_.push_back(frame.row);
}

void ReplayRecorder::count(const OpenFrame& frame) {
    const std::uint64_t start = ns(chunk_start_);
    const std::uint64_t since = frame.row.time < start ? 0 : frame.row.time - start;
    constexpr std::uint64_t bin_ns = ns(density_bin);
    const std::size_t bin = since / bin_ns;
    if (density_.frames.size() <= bin) {
        density_.frames.resize(bin + 1);
        density_.lost.resize(bin + 1);
    }
    ++density_.frames[bin];
    for (const Reception reception : frame.receptions) {
        const auto fate = static_cast<FrameFate>(reception & 0xFF);
        density_.lost[bin] += is_lost(fate) ? 1 : 0;
        ++nodes_[reception >> 8].outcomes[reception & 0xFF];
    }
}

// Writes the receptions that differ from those of the sender's last frame. Both are sorted.
void ReplayRecorder::write_changes(OpenFrame& frame, std::uint32_t number) {
    std::vector<std::vector<Reception>>& heard_by = nodes_[frame.row.node].heard_by;
    if (heard_by.size() <= frame.row.interface) {
        heard_by.resize(frame.row.interface + 1);
    }
    std::vector<Reception>& before = heard_by[frame.row.interface];
    auto old = before.begin();
    for (const Reception reception : frame.receptions) {
        const Reception receiver = reception >> 8;
        for (; old != before.end() && *old >> 8 < receiver; ++old) {
            receptions_.push_back({number, *old >> 8, no_longer_noticed});
        }
        const bool is_known = old != before.end() && *old >> 8 == receiver;
        if (!is_known || *old != reception) {
            receptions_.push_back({number, receiver, static_cast<std::uint8_t>(reception & 0xFF)});
        }
        old += is_known ? 1 : 0;
    }
    for (; old != before.end(); ++old) {
        receptions_.push_back({number, *old >> 8, no_longer_noticed});
    }
    before.swap(frame.receptions);
}

void ReplayRecorder::begin_row() {
    const bool is_full = frames_.size() >= max_frames || receptions_.size() + events_.size() +
                                                                 variables_.size() + legs_.size() -
                                                                 std::min(legs_.size(), nodes_.size()) >=
                                                             max_rows;
    if (now() - chunk_start_ >= longest_chunk || is_full) {
        close_chunk();
    }
}

void ReplayRecorder::close_chunk() {
    ReplayChunk chunk;
    chunk.start = chunk_start_;
    chunk.end = now();
    string("");  // string 0 exists, even if no other string does
    chunk.strings = std::exchange(strings_, {});
    string_ids_.clear();
    chunk.tables = {
        {"frames",
         {column("time_ns", frames_, &FrameRow::time, true),
          column("duration_ns", frames_, &FrameRow::duration), column("node", frames_, &FrameRow::node),
          column("interface", frames_, &FrameRow::interface), column("kind", frames_, &FrameRow::kind),
          column("retry", frames_, &FrameRow::retry), column("destination", frames_, &FrameRow::destination),
          column("bytes", frames_, &FrameRow::bytes), column("bitrate_bps", frames_, &FrameRow::bitrate_bps),
          column("cause", frames_, &FrameRow::cause), column("receptions", frames_, &FrameRow::receptions),
          column("unnoticed", frames_, &FrameRow::unnoticed)}},
        {"receptions",
         {column("frame", receptions_, &ReceptionRow::frame, true),
          column("receiver", receptions_, &ReceptionRow::receiver),
          column("outcome", receptions_, &ReceptionRow::outcome)}},
        {"losses",
         {column("frame", losses_, &LossRow::frame, true), column("receiver", losses_, &LossRow::receiver),
          column("power_cdbm", losses_, &LossRow::power_cdbm),
          column("interference_cdbm", losses_, &LossRow::interference_cdbm)}},
        {"interferers",
         {column("frame", interferers_, &InterfererRow::frame, true),
          column("receiver", interferers_, &InterfererRow::receiver),
          column("node", interferers_, &InterfererRow::node)}},
        {"legs",
         {column("time_ns", legs_, &LegRow::time), column("duration_ns", legs_, &LegRow::duration),
          column("node", legs_, &LegRow::node),
          column("x0", legs_, [](const LegRow& leg) { return leg.from.x; }),
          column("y0", legs_, [](const LegRow& leg) { return leg.from.y; }),
          column("z0", legs_, [](const LegRow& leg) { return leg.from.z; }),
          column("x1", legs_, [](const LegRow& leg) { return leg.to.x; }),
          column("y1", legs_, [](const LegRow& leg) { return leg.to.y; }),
          column("z1", legs_, [](const LegRow& leg) { return leg.to.z; })}},
        {"variables",
         {column("time_ns", variables_, &VariableRow::time, true),
          column("node", variables_, &VariableRow::node), column("name", variables_, &VariableRow::name),
          column("value", variables_, &VariableRow::value), column("text", variables_, &VariableRow::text)}},
        {"events",
         {column("time_ns", events_, &EventRow::time, true), column("node", events_, &EventRow::node),
          column("kind", events_, &EventRow::kind), column("text", events_, &EventRow::text)}},
    };
    density_.bin = density_bin;
    chunk.density = std::exchange(density_, {});
    for (std::size_t id = 0; id < nodes_.size(); ++id) {
        for (std::size_t fate = 0; fate < frame_fate_count; ++fate) {
            if (const std::uint32_t count = std::exchange(nodes_[id].outcomes[fate], 0); count > 0) {
                chunk.outcomes.push_back({static_cast<NodeId>(id), static_cast<FrameFate>(fate), count});
            }
        }
    }
    chunks_.push_back(std::move(chunk));

    chunk_start_ = now();
    frames_.clear();
    receptions_.clear();
    losses_.clear();
    interferers_.clear();
    legs_.clear();
    variables_.clear();
    events_.clear();
    for (std::size_t id = 0; id < nodes_.size(); ++id) {
        for (std::vector<Reception>& heard : nodes_[id].heard_by) {
            heard.clear();
        }
        write_leg(static_cast<NodeId>(id));
    }
}

void ReplayRecorder::finish() {
    for (OpenFrame& frame : open_) {
        write(frame);
    }
    open_.clear();
    close_chunk();
}

}  // namespace netsim
