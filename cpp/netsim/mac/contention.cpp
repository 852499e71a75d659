#include "netsim/mac/contention.hpp"

#include <algorithm>

#include "netsim/error.hpp"

namespace netsim {

namespace {

// A frame that begins within this time before the end of a slot cannot be sensed by then, and does
// not prevent the grant. Real sensing takes microseconds; this only compensates for rounding to
// picoseconds. It matters for stations on a line that drew the same backoff: the frame of one
// reaches the next station just when its slot ends.
constexpr SimTime min_sensing = SimTime::from_ns(1);

}  // namespace

void Contention::start(int contention_window) {
    NETSIM_ASSERT(state_ == State::idle);
    slots_left_ = static_cast<int>(draws_.uniform_int(static_cast<std::uint32_t>(contention_window) + 1));
    if (busy_) {
        state_ = State::deferring;
        return;
    }
    state_ = State::waiting;
    schedule_grant(parameters_.config.backoff_optimization ? std::max(free_since_, idle_since_)
                                                           : simulator().now());
}

void Contention::start_without_backoff_if_free(int contention_window) {
    if (busy_) {
        start(contention_window);
        return;
    }
    NETSIM_ASSERT(state_ == State::idle);
    slots_left_ = 0;
    state_ = State::waiting;
    schedule_grant(simulator().now());
}

void Contention::channel_busy_changed(bool busy) {
    busy_ = busy;
    if (!busy) {
        free_since_ = simulator().now();
        if (state_ == State::deferring) {
            state_ = State::waiting;
            schedule_grant(free_since_);
        }
        return;
    }
    if (state_ == State::waiting && grant_time_ - simulator().now() > min_sensing) {
        simulator().cancel(grant_);
        state_ = State::deferring;
        // A partial slot does not count down, and neither does the interframe space.
        const std::int64_t remaining_ps = (grant_time_ - simulator().now()).ps();
        const std::int64_t slot_ps = parameters_.timing.slot.ps();
        slots_left_ = std::min(slots_left_, static_cast<int>((remaining_ps + slot_ps - 1) / slot_ps));
    }
}

// The end of the interframe space of a channel that has been free since `idle_since`.
SimTime Contention::space_over(SimTime idle_since) const {
    const SimTime difs_over = idle_since + parameters_.timing.difs;
    if (!parameters_.config.inet_eifs) {
        return std::max(difs_over, eifs_until_);
    }
    const bool is_within_eifs = eifs_until_ > simulator().now() + parameters_.timing.difs;
    return is_within_eifs ? idle_since + parameters_.timing.eifs : difs_over;
}

void Contention::schedule_grant(SimTime idle_since) {
    grant_time_ = std::max(space_over(idle_since) + parameters_.timing.slot * slots_left_, simulator().now());
    grant_ = simulator().schedule_at(grant_time_, [this] { granted(); }, Priority::last);
}

void Contention::granted() {
    state_ = State::idle;
    idle_since_ = simulator().now();
    listener_.channel_granted();
}

}  // namespace netsim
