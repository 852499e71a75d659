#include "netsim/mac/contention.hpp"

#include <algorithm>

#include "netsim/error.hpp"

namespace netsim {

void Contention::start(int contention_window) {
    NETSIM_ASSERT(state_ == State::idle);
    slots_left_ = static_cast<int>(draws_.uniform_int(static_cast<std::uint32_t>(contention_window) + 1));
    if (busy_) {
        state_ = State::deferring;
        return;
    }
    state_ = State::waiting;
    const SimTime already_idle = simulator_.now() - std::max(free_since_, idle_since_);
    schedule_grant(backoff_optimization_ ? already_idle : SimTime{});
}

void Contention::channel_busy_changed(bool busy) {
    busy_ = busy;
    if (!busy) {
        free_since_ = simulator_.now();
        if (state_ == State::deferring) {
            state_ = State::waiting;
            schedule_grant(SimTime{});
        }
        return;
    }
    if (state_ == State::waiting) {
        simulator_.cancel(grant_);
        state_ = State::deferring;
        // Slots begun count as not waited; the interframe space does not count as slots.
        const std::int64_t remaining_ps = (grant_time_ - simulator_.now()).ps();
        const std::int64_t slot_ps = timing_.slot.ps();
        slots_left_ = std::min(slots_left_, static_cast<int>((remaining_ps + slot_ps - 1) / slot_ps));
    }
}

void Contention::frame_corrupted() {
    if (state_ == State::idle) {
        return;
    }
    eifs_until_ = simulator_.now() + timing_.eifs;
    if (state_ == State::waiting) {
        simulator_.cancel(grant_);
        schedule_grant(SimTime{});
    }
}

void Contention::schedule_grant(SimTime credit) {
    const SimTime now = simulator_.now();
    const SimTime space = eifs_until_ > now + timing_.difs ? timing_.eifs : timing_.difs;
    const SimTime wait = space + timing_.slot * slots_left_;
    grant_time_ = now + std::max(wait - credit, SimTime{});
    grant_ = simulator_.schedule_at(grant_time_, [this] { granted(); }, Priority::last);
}

void Contention::granted() {
    state_ = State::idle;
    idle_since_ = simulator_.now();
    listener_.channel_granted();
}

}  // namespace netsim
