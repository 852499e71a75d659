#include "netsim/node/replay_recorder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "netsim/phy/modes.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

constexpr SimTime longest_chunk = SimTime::from_us(60'000'000);
constexpr std::size_t max_frames = 20'000;  // in a chunk
constexpr std::size_t max_rows = 1'000'000;
constexpr SimTime density_bin = SimTime::from_us(250'000);
constexpr SimTime sampling_interval = SimTime::from_us(200'000);
constexpr std::size_t max_causes = 10'000;
constexpr std::size_t max_missed = 50;           // of a frame
constexpr std::size_t max_bytes_of_text = 2000;  // of a message
constexpr std::size_t max_text_bytes = 500'000;  // of a chunk

// BELOW_SENSITIVITY, TEXT_LEFT_OUT and NO_POWER in tables.py.
constexpr std::uint8_t no_longer_noticed = 255;
constexpr std::uint32_t text_left_out = 0xFFFFFFFF;
constexpr std::int16_t no_power = std::numeric_limits<std::int16_t>::min();

constexpr std::uint64_t ns(SimTime time) {
    return static_cast<std::uint64_t>(std::max(time, SimTime{}).ps() / 1000);
}

// In 0.01 dB; a ratio of 0 is the smallest value.
std::int16_t cdb(double ratio) {
    return static_cast<std::int16_t>(std::clamp(std::round(100 * db_from_ratio(ratio)), -32767.0, 32767.0));
}

// In 0.01 dBm. Powers too small for that are none.
std::int16_t cdbm(double power_w) {
    constexpr double least_w = 1e-33;
    constexpr double w_per_mw = 1e-3;
    return power_w < least_w ? no_power : cdb(power_w / w_per_mw);
}

// Receptions below the sensitivity are recorded only if they are losses.
bool is_lost(FrameOutcome outcome) {
    return outcome != FrameOutcome::delivered && outcome != FrameOutcome::in_air;
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

std::uint32_t ReplayRecorder::text_row(const std::string& message) {
    const auto known = text_ids_.find(message);
    if (known != text_ids_.end()) {
        return known->second;
    }
    if (text_bytes_.size() >= max_text_bytes) {
        return text_left_out;
    }
    std::size_t size = std::min(message.size(), max_bytes_of_text);
    constexpr unsigned continues = 0x80;  // a byte within a character of UTF-8
    constexpr unsigned mask = 0xC0;
    while (size > 0 && size < message.size() &&
           (static_cast<unsigned char>(message[size]) & mask) == continues) {
        --size;
    }
    text_bytes_.append(message, 0, size);
    texts_.push_back({static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(message.size())});
    return text_ids_.emplace(message, static_cast<std::uint32_t>(texts_.size())).first->second;
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
                                  std::uint64_t too_weak, std::span<const Loss> missed) {
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
                 .power_cdbm = cdbm(transmission.power_w),
                 .cause = content.cause,
                 .receptions = static_cast<std::uint32_t>(noticed),
                 .unnoticed = static_cast<std::uint32_t>(too_weak)};
    frame.message = content.payload;
    if (transmission.psdu_bytes == 0 && content.payload) {  // on a medium without frames
        frame.row.bytes = static_cast<std::uint32_t>(content.payload->size());
    }
    frame.left = noticed;
    frame.is_recorded = nodes_[transmission.sender.node].is_recorded;
    frame.receptions.reserve(noticed);
    std::vector<const Loss*> strongest;
    for (const Loss& loss : missed) {
        strongest.push_back(&loss);
    }
    std::ranges::stable_sort(strongest, std::ranges::greater{}, &Loss::power_w);
    strongest.resize(std::min(strongest.size(), max_missed));
    for (const Loss* const loss : strongest) {
        frame.receptions.push_back(reception_of(loss->receiver, FrameOutcome::below_sensitivity));
        add_loss(frame, *loss);
    }
    write_complete_frames();
}

void ReplayRecorder::reception_ends(FrameNumber number, NodeId receiver, FrameOutcome outcome) {
    OpenFrame& frame = open(number);
    if (frame.is_recorded || nodes_[receiver].is_recorded) {
        frame.receptions.push_back(reception_of(receiver, outcome));
    }
    if (--frame.left == 0 && number == first_open_) {
        write_complete_frames();
    }
}

void ReplayRecorder::frame_lost(FrameNumber number, const Loss& loss) {
    add_loss(open(number), loss);
}

void ReplayRecorder::add_loss(OpenFrame& frame, const Loss& loss) {
    const auto receiver = static_cast<std::uint32_t>(loss.receiver);
    const PowerBudget& budget = loss.budget;
    const std::int16_t power = cdbm(loss.power_w);
    frame.losses.push_back({.receiver = receiver,
                            .power_cdbm = power,
                            .needed_cdb = loss.noise_w > 0 ? cdb(loss.needed) : cdbm(loss.needed),
                            .noise_cdbm = cdbm(loss.noise_w),
                            .interference_cdbm = cdbm(loss.interference_w),
                            .distance_cdb = power == no_power ? cdb(budget.distance) : std::int16_t{0},
                            .sender_antenna_cdb = cdb(budget.sender_antenna),
                            .receiver_antenna_cdb = cdb(budget.receiver_antenna),
                            .ground_cdb = cdb(budget.ground),
                            .shadowing_cdb = cdb(budget.shadowing),
                            .fading_cdb = cdb(budget.fading)});
    for (const PowerBudget::Obstacle& obstacle : budget.obstacles) {
        frame.obstructions.push_back({.receiver = receiver,
                                      .obstacle = static_cast<std::uint32_t>(obstacle.index),
                                      .gain_cdb = cdb(obstacle.gain)});
    }
    for (const Interferer& interferer : loss.interferers) {
        frame.interferers.push_back({.receiver = receiver,
                                     .node = static_cast<std::uint32_t>(interferer.node),
                                     .power_cdbm = cdbm(interferer.power_w)});
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
    for (ObstructionRow& obstruction : frame.obstructions) {
        obstruction.frame = number;
        obstructions_.push_back(obstruction);
    }
    for (InterfererRow& interferer : frame.interferers) {
        interferer.frame = number;
        interferers_.push_back(interferer);
    }
    frame.row.cause = string(causes_[frame.row.cause]);
    frame.row.text = frame.message == nullptr ? 0 : text_row(*frame.message);
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
        const auto outcome = static_cast<FrameOutcome>(reception & 0xFF);
        density_.lost[bin] += is_lost(outcome) ? 1 : 0;
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
          column("power_cdbm", frames_, &FrameRow::power_cdbm), column("cause", frames_, &FrameRow::cause),
          column("text", frames_, &FrameRow::text), column("receptions", frames_, &FrameRow::receptions),
          column("unnoticed", frames_, &FrameRow::unnoticed)}},
        {"receptions",
         {column("frame", receptions_, &ReceptionRow::frame, true),
          column("receiver", receptions_, &ReceptionRow::receiver),
          column("outcome", receptions_, &ReceptionRow::outcome)}},
        {"losses",
         {column("frame", losses_, &LossRow::frame, true), column("receiver", losses_, &LossRow::receiver),
          column("power_cdbm", losses_, &LossRow::power_cdbm),
          column("needed_cdb", losses_, &LossRow::needed_cdb),
          column("noise_cdbm", losses_, &LossRow::noise_cdbm),
          column("interference_cdbm", losses_, &LossRow::interference_cdbm),
          column("distance_cdb", losses_, &LossRow::distance_cdb),
          column("sender_antenna_cdb", losses_, &LossRow::sender_antenna_cdb),
          column("receiver_antenna_cdb", losses_, &LossRow::receiver_antenna_cdb),
          column("ground_cdb", losses_, &LossRow::ground_cdb),
          column("shadowing_cdb", losses_, &LossRow::shadowing_cdb),
          column("fading_cdb", losses_, &LossRow::fading_cdb)}},
        {"obstructions",
         {column("frame", obstructions_, &ObstructionRow::frame, true),
          column("receiver", obstructions_, &ObstructionRow::receiver),
          column("obstacle", obstructions_, &ObstructionRow::obstacle),
          column("gain_cdb", obstructions_, &ObstructionRow::gain_cdb)}},
        {"interferers",
         {column("frame", interferers_, &InterfererRow::frame, true),
          column("receiver", interferers_, &InterfererRow::receiver),
          column("node", interferers_, &InterfererRow::node),
          column("power_cdbm", interferers_, &InterfererRow::power_cdbm)}},
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
        {"texts", {column("recorded", texts_, &TextRow::recorded), column("bytes", texts_, &TextRow::bytes)}},
        {"text_bytes", {{"byte", std::exchange(text_bytes_, {})}}},
    };
    density_.bin = density_bin;
    chunk.density = std::exchange(density_, {});
    for (std::size_t id = 0; id < nodes_.size(); ++id) {
        for (std::size_t outcome = 0; outcome < frame_outcome_count; ++outcome) {
            if (const std::uint32_t count = std::exchange(nodes_[id].outcomes[outcome], 0); count > 0) {
                chunk.outcomes.push_back(
                    {static_cast<NodeId>(id), static_cast<FrameOutcome>(outcome), count});
            }
        }
    }
    chunks_.push_back(std::move(chunk));

    chunk_start_ = now();
    frames_.clear();
    receptions_.clear();
    losses_.clear();
    obstructions_.clear();
    interferers_.clear();
    legs_.clear();
    variables_.clear();
    events_.clear();
    texts_.clear();
    text_ids_.clear();
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
