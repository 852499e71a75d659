// Simulated time: a signed 64-bit count of picoseconds (about ±106 days).
//
// An integer, so that sums are exact and equal instants compare equal. A strong type, so that
// seconds and picoseconds cannot be mixed up. Floating-point seconds exist only at the user interface
// (from_seconds, seconds).
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace netsim {

class SimTime {
public:
    // The end of the longest run. The range of int64 ends at 9.223e6 s, after the end of any frame
    // that begins within a run. `sim-time-limit` in python/gradysim/scenario/schema/engine_keys.py has the same
    // bound.
    static constexpr double longest_run_s = 9.2e6;

    constexpr SimTime() = default;

    static constexpr SimTime from_ps(std::int64_t picoseconds) { return SimTime(picoseconds); }
    static constexpr SimTime from_ns(std::int64_t nanoseconds) { return SimTime(nanoseconds * 1'000); }
    static constexpr SimTime from_us(std::int64_t microseconds) { return SimTime(microseconds * 1'000'000); }
    // Rounds to the nearest picosecond. Throws SimulationError for NaN and beyond ±longest_run_s.
    static SimTime from_seconds(double seconds) {
        const bool is_representable = seconds >= -longest_run_s && seconds <= longest_run_s;  // NaN is not
        if (!is_representable) {
            refuse_seconds(seconds);
        }
        const double exact_ps = seconds * 1e12;
        const auto whole_ps = static_cast<std::int64_t>(exact_ps);  // toward zero
        const double rest_ps = exact_ps - static_cast<double>(whole_ps);
        return SimTime(whole_ps + static_cast<int>(rest_ps >= 0.5) - static_cast<int>(rest_ps <= -0.5));
    }
    // The same for the time of an event. Finite times after the end of the longest run give never().
    static SimTime of_event(double seconds) {
        const bool is_too_late = seconds > longest_run_s && seconds <= std::numeric_limits<double>::max();
        return is_too_late ? never() : from_seconds(seconds);
    }
    // The same for a time computed from now().seconds(): the result is not before `now` if
    // `seconds` is not. From 8192 s on, adjacent doubles are more than a picosecond apart, so that
    // now().seconds() may be before `now`.
    static SimTime of_event(double seconds, SimTime now) {
        const SimTime event = of_event(seconds);
        return seconds >= now.seconds() && event < now ? now : event;
    }
    // An instant that no run reaches.
    static constexpr SimTime never() { return from_us(9'210'000'000'000); }
    static constexpr SimTime max() { return SimTime(std::numeric_limits<std::int64_t>::max()); }
    // Before any run. The difference to any instant of a run does not overflow.
    static constexpr SimTime long_ago() { return SimTime(std::numeric_limits<std::int64_t>::min() / 4); }

    constexpr std::int64_t ps() const { return ps_; }
    constexpr double seconds() const { return static_cast<double>(ps_) / 1e12; }

    constexpr auto operator<=>(const SimTime&) const = default;

    constexpr SimTime operator+(SimTime other) const { return SimTime(ps_ + other.ps_); }
    constexpr SimTime operator-(SimTime other) const { return SimTime(ps_ - other.ps_); }
    constexpr SimTime operator*(std::int64_t factor) const { return SimTime(ps_ * factor); }
    constexpr SimTime& operator+=(SimTime other) {
        ps_ += other.ps_;
        return *this;
    }

private:
    explicit constexpr SimTime(std::int64_t ps) : ps_(ps) {}
    [[noreturn]] static void refuse_seconds(double seconds);

    std::int64_t ps_ = 0;
};

}  // namespace netsim
