#include "netsim/kernel/simulator.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

TEST(Simulator, TheClockStandsAtTheEventThatRuns) {
    Simulator simulator;
    SimTime seen;
    simulator.schedule_at(us(5), [&] { seen = simulator.now(); });
    simulator.run_until(us(10));
    EXPECT_EQ(seen, us(5));
}

TEST(Simulator, RunUntilSetsTheClockToItsLimit) {
    Simulator simulator;
    EXPECT_TRUE(simulator.run_until(us(10)));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, TheLimitIsInclusive) {
    Simulator simulator;
    std::vector<int> ran;
    simulator.schedule_at(us(10), [&] { ran.push_back(10); });
    simulator.schedule_at(us(10) + SimTime::from_ps(1), [&] { ran.push_back(11); });
    simulator.run_until(us(10));
    EXPECT_EQ(ran, std::vector{10});
    EXPECT_EQ(simulator.pending_count(), 1U);
}

TEST(Simulator, ALimitInThePastLeavesTheClock) {
    Simulator simulator;
    simulator.run_until(us(10));
    EXPECT_TRUE(simulator.run_until(us(3)));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, ScheduleAfterCountsFromNow) {
    Simulator simulator;
    SimTime seen;
    simulator.schedule_at(us(5), [&] { simulator.schedule_after(us(2), [&] { seen = simulator.now(); }); });
    simulator.run_until(us(10));
    EXPECT_EQ(seen, us(7));
}

TEST(Simulator, AnEventOfThePresentInstantRunsInIt) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(5), [&] { simulator.schedule_after(SimTime(), [&] { ++runs; }); });
    simulator.run_until(us(5));
    EXPECT_EQ(runs, 1);
}

TEST(Simulator, LastRunsAfterWhatItsInstantBringsForth) {
    Simulator simulator;
    std::vector<int> ran;
    simulator.schedule_at(us(5), [&] { ran.push_back(3); }, Priority::last);
    simulator.schedule_at(us(5), [&] {
        ran.push_back(1);
        simulator.schedule_after(SimTime(), [&] { ran.push_back(2); });
    });
    simulator.run_until(us(5));
    EXPECT_EQ(ran, (std::vector{1, 2, 3}));
}

TEST(Simulator, MaxEventsStopsAtTheLastEventThatRan) {
    Simulator simulator;
    for (int time = 1; time <= 3; ++time) {
        simulator.schedule_at(us(time), [] {});
    }
    EXPECT_FALSE(simulator.run_until(us(10), 2));
    EXPECT_EQ(simulator.now(), us(2));
    EXPECT_EQ(simulator.event_count(), 2U);
    EXPECT_TRUE(simulator.run_until(us(10), 2));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, MaxEventsThatAreJustEnoughReachTheLimit) {
    Simulator simulator;
    simulator.schedule_at(us(1), [] {});
    simulator.schedule_at(us(20), [] {});
    EXPECT_TRUE(simulator.run_until(us(10), 1));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, CancelledEventsDoNotCount) {
    Simulator simulator;
    const EventHandle handle = simulator.schedule_at(us(1), [] {});
    EXPECT_TRUE(simulator.is_pending(handle));
    EXPECT_TRUE(simulator.cancel(handle));
    simulator.run_until(us(10));
    EXPECT_EQ(simulator.event_count(), 0U);
}

TEST(Simulator, AnEventIsNotPendingWhileItRuns) {
    Simulator simulator;
    EventHandle handle;
    bool pending = true;
    handle = simulator.schedule_at(us(1), [&] { pending = simulator.is_pending(handle); });
    simulator.run_until(us(1));
    EXPECT_FALSE(pending);
}

TEST(Simulator, KnowsWhichTurnsOfAnInstantHavePassed) {
    Simulator simulator;
    const SequenceNumber before = simulator.reserve_sequence_numbers(1);
    std::vector<bool> passed;
    simulator.schedule_at(us(1), [&] {
        const SequenceNumber after = simulator.reserve_sequence_numbers(1);
        for (const SequenceNumber number : {before, after}) {
            passed.push_back(simulator.has_passed(us(1), number));
        }
        passed.push_back(simulator.has_passed(us(2), before));
        passed.push_back(simulator.has_passed(us(0), after));
    });
    simulator.run_until(us(1));
    EXPECT_EQ(passed, (std::vector{true, false, false, true}));
}

TEST(Simulator, AtTheEndOfAnInstantAllTurnsOfBeforeHavePassed) {
    Simulator simulator;
    SequenceNumber earlier = 0;
    bool passed = false;
    bool new_one_passed = true;
    const auto at_its_end = [&] {
        passed = simulator.has_passed(us(1), earlier);
        new_one_passed = simulator.has_passed(us(1), simulator.reserve_sequence_numbers(1));
    };
    simulator.schedule_at(us(1), at_its_end, Priority::last);
    earlier = simulator.reserve_sequence_numbers(1);
    simulator.run_until(us(1));
    EXPECT_TRUE(passed);
    EXPECT_FALSE(new_one_passed);
    EXPECT_TRUE(simulator.has_passed(us(1), earlier));
}

// An event at 1 µs and its successors, one per microsecond up to 5 µs. They bypass the queue if
// possible.
class Chain {
public:
    explicit Chain(Simulator& simulator)
        : simulator_(simulator), first_sequence_number_(simulator.reserve_sequence_numbers(6)) {
        schedule(1);
    }

    std::vector<std::int64_t> ran_at_us;
    int passed_by_the_queue = 0;

private:
    void schedule(int number) {
        simulator_.schedule_reserved(us(number), sequence_number(number), [this, number] { run(number); });
    }
    void run(int number) {
        for (;; ++number) {
            ran_at_us.push_back(simulator_.now().ps() / 1'000'000);
            if (number == 5) {
                return;
            }
            if (!simulator_.try_run_inline(us(number + 1), sequence_number(number + 1))) {
                schedule(number + 1);
                return;
            }
            ++passed_by_the_queue;
        }
    }
    SequenceNumber sequence_number(int number) const {
        return first_sequence_number_ + static_cast<SequenceNumber>(number);
    }

    Simulator& simulator_;
    SequenceNumber first_sequence_number_;
};

TEST(Simulator, GoesOnWithWhatWouldRunNext) {
    Simulator simulator;
    Chain chain(simulator);
    simulator.schedule_at(us(7), [] {});
    simulator.run_until(us(10));
    EXPECT_EQ(chain.ran_at_us, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(chain.passed_by_the_queue, 4);
    EXPECT_EQ(simulator.event_count(), 6U);
}

TEST(Simulator, DoesNotGoOnPastAnotherEvent) {
    Simulator simulator;
    Chain chain(simulator);
    std::size_t ran_before = 0;
    simulator.schedule_at(us(3), [&] { ran_before = chain.ran_at_us.size(); });
    simulator.run_until(us(10));
    EXPECT_EQ(ran_before, 3U);  // at equal times, by sequence number
    EXPECT_EQ(chain.passed_by_the_queue, 3);
}

TEST(Simulator, DoesNotGoOnPastTheLimit) {
    Simulator simulator;
    Chain chain(simulator);
    simulator.run_until(us(2));
    EXPECT_EQ(chain.ran_at_us, (std::vector<std::int64_t>{1, 2}));
    simulator.run_until(us(10));
    EXPECT_EQ(chain.ran_at_us, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
}

TEST(Simulator, DoesNotGoOnPastMaxEvents) {
    Simulator simulator;
    Chain chain(simulator);
    EXPECT_FALSE(simulator.run_until(us(10), 3));
    EXPECT_EQ(chain.ran_at_us, (std::vector<std::int64_t>{1, 2, 3}));
    EXPECT_EQ(simulator.now(), us(3));
    EXPECT_EQ(simulator.event_count(), 3U);
}

TEST(Simulator, AStepDoesNotGoOn) {
    Simulator simulator;
    Chain chain(simulator);
    simulator.run_until(us(1));
    EXPECT_TRUE(simulator.step(us(10)));
    EXPECT_EQ(chain.ran_at_us, (std::vector<std::int64_t>{1, 2}));
}

TEST(Simulator, AnExceptionLeavesItUsable) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(1), [] { throw std::runtime_error("of the protocol"); });
    simulator.schedule_at(us(2), [&] { ++runs; });
    EXPECT_THROW(simulator.run_until(us(10)), std::runtime_error);
    EXPECT_EQ(simulator.now(), us(1));
    EXPECT_EQ(simulator.pending_count(), 1U);
    EXPECT_TRUE(simulator.run_until(us(10)));
    EXPECT_EQ(runs, 1);
}

TEST(Simulator, AStepIsOneEventAndTheClockStandsAtIt) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(1), [&] { ++runs; });
    simulator.schedule_at(us(2), [&] { ++runs; });
    EXPECT_TRUE(simulator.step(us(10)));
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(simulator.now(), us(1));
    EXPECT_EQ(simulator.event_count(), 1U);
}

TEST(Simulator, WithoutAnEventUpToTheLimitThereIsNoStep) {
    Simulator simulator;
    EXPECT_FALSE(simulator.step(us(10)));
    simulator.schedule_at(us(2), [] {});
    EXPECT_FALSE(simulator.step(us(1)));
    EXPECT_EQ(simulator.now(), SimTime{});
    EXPECT_TRUE(simulator.step(us(2)));
    EXPECT_FALSE(simulator.step(us(10)));
    EXPECT_EQ(simulator.now(), us(2));
}

TEST(SimulatorDeathTest, SchedulingInThePastIsAnInternalError) {
    Simulator simulator;
    simulator.run_until(us(10));
    EXPECT_DEATH(simulator.schedule_at(us(9), [] {}), "internal error: time >= now_ does not hold");
}

}  // namespace
}  // namespace netsim
