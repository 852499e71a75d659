#include "netsim/kernel/event_queue.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/prefetch.hpp"

namespace netsim {
namespace {

constexpr SimTime at(std::int64_t ps) {
    return SimTime::from_ps(ps);
}

// A queue whose events append their names to a log.
class LoggingQueue {
public:
    EventHandle push(SimTime time, Priority priority, int name) {
        return queue.push(time, priority, [this, name] { log.push_back(name); });
    }
    std::vector<int> drain() {
        while (!queue.empty()) {
            Action action = queue.pop();
            action();
        }
        return std::exchange(log, {});
    }

    EventQueue queue;
    std::vector<int> log;
};

TEST(EventQueue, IsEmptyAtFirst) {
    EventQueue queue;
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.size(), 0U);
}

TEST(EventQueue, GoesByTime) {
    LoggingQueue events;
    events.push(at(30), Priority::normal, 3);
    events.push(at(10), Priority::normal, 1);
    events.push(at(20), Priority::normal, 2);
    EXPECT_EQ(events.drain(), (std::vector{1, 2, 3}));
}

TEST(EventQueue, LastComesAfterNormalOfItsInstantOnly) {
    LoggingQueue events;
    events.push(at(10), Priority::last, 2);
    events.push(at(10), Priority::normal, 1);
    events.push(at(11), Priority::normal, 3);
    EXPECT_EQ(events.drain(), (std::vector{1, 2, 3}));
}

TEST(EventQueue, EqualTimesGoInTheOrderOfScheduling) {
    LoggingQueue events;
    for (int name = 0; name < 100; ++name) {
        events.push(at(10), Priority::normal, name);
    }
    const std::vector<int> order = events.drain();
    for (int name = 0; name < 100; ++name) {
        EXPECT_EQ(order[static_cast<std::size_t>(name)], name);
    }
}

TEST(EventQueue, AReservedPlaceIsThatOfItsReservation) {
    LoggingQueue events;
    events.push(at(10), Priority::normal, 1);
    const SequenceNumber first = events.queue.reserve_sequence_numbers(2);
    events.push(at(10), Priority::normal, 4);
    for (const int name : {3, 2}) {
        events.queue.push_reserved(at(10), Priority::normal, first + static_cast<SequenceNumber>(name) - 2,
                                   [&events, name] { events.log.push_back(name); });
    }
    EXPECT_EQ(events.drain(), (std::vector{1, 2, 3, 4}));
}

TEST(EventQueue, TimeGoesBeforePlace) {
    LoggingQueue events;
    const SequenceNumber first = events.queue.reserve_sequence_numbers(1);
    events.push(at(9), Priority::normal, 1);
    events.queue.push_reserved(at(10), Priority::normal, first, [&events] { events.log.push_back(2); });
    EXPECT_EQ(events.drain(), (std::vector{1, 2}));
}

TEST(EventQueue, NextTimeIsThatOfTheEarliestLivingEvent) {
    LoggingQueue events;
    const EventHandle first = events.push(at(10), Priority::normal, 1);
    events.push(at(20), Priority::normal, 2);
    EXPECT_EQ(events.queue.next_time(), at(10));
    events.queue.cancel(first);
    EXPECT_EQ(events.queue.next_time(), at(20));
}

TEST(EventQueue, ACancelledEventDoesNotRun) {
    LoggingQueue events;
    events.push(at(10), Priority::normal, 1);
    const EventHandle second = events.push(at(20), Priority::normal, 2);
    events.push(at(30), Priority::normal, 3);
    EXPECT_TRUE(events.queue.cancel(second));
    EXPECT_EQ(events.queue.size(), 2U);
    EXPECT_EQ(events.drain(), (std::vector{1, 3}));
}

TEST(EventQueue, CancellingTwiceIsHarmless) {
    LoggingQueue events;
    const EventHandle handle = events.push(at(10), Priority::normal, 1);
    EXPECT_TRUE(events.queue.cancel(handle));
    EXPECT_FALSE(events.queue.cancel(handle));
    EXPECT_TRUE(events.queue.empty());
}

TEST(EventQueue, TheEmptyHandleNamesNoEvent) {
    LoggingQueue events;
    EXPECT_FALSE(events.queue.is_pending(EventHandle()));
    EXPECT_FALSE(events.queue.cancel(EventHandle()));
}

TEST(EventQueue, AHandleDiesWithItsEvent) {
    LoggingQueue events;
    const EventHandle handle = events.push(at(10), Priority::normal, 1);
    EXPECT_TRUE(events.queue.is_pending(handle));
    events.drain();
    EXPECT_FALSE(events.queue.is_pending(handle));
    EXPECT_FALSE(events.queue.cancel(handle));
}

TEST(EventQueue, AnOldHandleDoesNotTouchTheEventThatTookItsPlace) {
    LoggingQueue events;
    const EventHandle old = events.push(at(10), Priority::normal, 1);
    events.queue.cancel(old);
    const EventHandle reused = events.push(at(10), Priority::normal, 2);
    ASSERT_EQ(old.slot, reused.slot);
    EXPECT_FALSE(events.queue.is_pending(old));
    EXPECT_FALSE(events.queue.cancel(old));
    EXPECT_TRUE(events.queue.is_pending(reused));
    EXPECT_EQ(events.drain(), std::vector{2});
}

TEST(EventQueue, ManyCancellationsLeaveTheOrder) {
    LoggingQueue events;
    std::vector<EventHandle> handles;
    for (int name = 0; name < 1000; ++name) {
        handles.push_back(events.push(at(1000 - name), Priority::normal, name));
    }
    std::vector<int> expected;
    for (int name = 999; name >= 0; --name) {
        if (name % 10 == 0) {
            expected.push_back(name);
        } else {
            events.queue.cancel(handles[static_cast<std::size_t>(name)]);
        }
    }
    EXPECT_EQ(events.queue.size(), 100U);
    EXPECT_EQ(events.drain(), expected);
}

TEST(EventQueue, CancellingEverythingLeavesAUsableQueue) {
    LoggingQueue events;
    std::vector<EventHandle> handles;
    for (int name = 0; name < 1000; ++name) {
        handles.push_back(events.push(at(name), Priority::normal, name));
    }
    for (const EventHandle handle : handles) {
        events.queue.cancel(handle);
    }
    EXPECT_TRUE(events.queue.empty());
    events.push(at(5), Priority::normal, 7);
    EXPECT_EQ(events.drain(), std::vector{7});
}

TEST(EventQueue, WhatIsEarlierThanAllWouldBeNext) {
    LoggingQueue events;
    EXPECT_TRUE(events.queue.would_be_next(at(9), 0));
    events.push(at(5), Priority::normal, 1);
    EXPECT_TRUE(events.queue.would_be_next(at(4), 2));
    EXPECT_FALSE(events.queue.would_be_next(at(6), 2));
}

TEST(EventQueue, AtOneTimeThePlaceTellsWhatWouldBeNext) {
    LoggingQueue events;
    const SequenceNumber before = events.queue.reserve_sequence_numbers(1);
    events.push(at(5), Priority::normal, 1);
    const SequenceNumber after = events.queue.reserve_sequence_numbers(1);
    EXPECT_TRUE(events.queue.would_be_next(at(5), before));
    EXPECT_FALSE(events.queue.would_be_next(at(5), after));
}

TEST(EventQueue, WhatIsBeforeAllThatWaitBehindTheOneTakenOutWouldBeNext) {
    LoggingQueue events;
    for (int name = 1; name <= 3; ++name) {
        events.push(at(std::int64_t{10} * name), Priority::normal, name);
    }
    const SequenceNumber number = events.queue.reserve_sequence_numbers(1);
    events.queue.pop();
    EXPECT_TRUE(events.queue.would_be_next(at(15), number));
    EXPECT_FALSE(events.queue.would_be_next(at(25), number));
    EXPECT_FALSE(events.queue.would_be_next(at(35), number));
}

struct Prefetched {
    int name;
    int step;
};

struct Prefetching {
    std::vector<Prefetched>* prefetched;
    int name;

    void operator()() const {}
    void prefetch(int step) const { prefetched->push_back({name, step}); }
};

TEST(EventQueue, ALargeOneSaysWhatIsDueSoonBeforeItRuns) {
    constexpr int count = 5000;
    EventQueue queue;
    std::vector<Prefetched> prefetched;
    std::vector<int> steps(count);  // [name]
    for (int name = 0; name < count; ++name) {
        queue.push(at(std::int64_t{1000} * name), Priority::normal, Prefetching{&prefetched, name});
    }
    for (int name = 0; name < count; ++name) {
        ASSERT_EQ(queue.next_time(), at(std::int64_t{1000} * name));
        for (const Prefetched& each : std::exchange(prefetched, {})) {
            EXPECT_GE(each.name, name);
            EXPECT_EQ(each.step, steps[each.name]++) << each.name;
        }
        EXPECT_EQ(steps[name], prefetch_steps) << name;
        queue.pop();
    }
}

TEST(EventQueue, SaysSoStepByStepForAllThatAreDueSoon) {
    EventQueue queue;
    std::vector<Prefetched> prefetched;
    for (int name = 0; name < 5000; ++name) {
        queue.push(at(std::int64_t{1000} * name), Priority::normal, Prefetching{&prefetched, name});
    }
    std::size_t most = 0;
    for (; !queue.empty(); queue.pop()) {
        queue.next_time();
        EXPECT_TRUE(std::ranges::is_sorted(prefetched, {}, &Prefetched::step));
        most = std::max(most, prefetched.size());
        prefetched.clear();
    }
    EXPECT_GT(most, 5U * prefetch_steps);
}

TEST(EventQueue, SaysNothingOfWhatWasCancelled) {
    constexpr int count = 5000;
    EventQueue queue;
    std::vector<Prefetched> prefetched;
    std::vector<EventHandle> odd;
    for (int name = 0; name < count; ++name) {
        const EventHandle handle =
            queue.push(at(std::int64_t{1000} * name), Priority::normal, Prefetching{&prefetched, name});
        if (name % 2 == 1) {
            odd.push_back(handle);
        }
    }
    for (const EventHandle handle : odd) {
        queue.cancel(handle);
    }
    while (!queue.empty()) {
        queue.pop();
    }
    EXPECT_FALSE(prefetched.empty());
    EXPECT_TRUE(std::ranges::none_of(prefetched, [](const Prefetched& each) { return each.name % 2 == 1; }));
}

// Random pushes, cancellations and pops against a sorted map, which is slow and obvious.
class EventQueueOracle : public testing::TestWithParam<unsigned> {};

TEST_P(EventQueueOracle, AgreesWithASortedMap) {
    using Key = std::tuple<SimTime, Priority, int>;  // the name is the order of scheduling
    std::mt19937 random(GetParam());
    const auto draw = [&random](int count) {
        return static_cast<int>(random() % static_cast<unsigned>(count));
    };
    const int push_weight = 30 + draw(50);
    const int cancel_weight = draw(40);
    // From few events, all of which are in the heap, to many, most of which are not; and from one
    // instant to hours ahead.
    const int pushed_first = draw(3000);
    const std::int64_t max_ahead = std::int64_t{1} << (2 + draw(50));
    const auto draw_ahead = [&] {
        const std::int64_t most = draw(2) == 0 ? max_ahead : 50;
        return static_cast<std::int64_t>(random()) * 0x10001 % most;
    };
    LoggingQueue events;
    std::multimap<Key, EventHandle> oracle;
    std::vector<EventHandle> spent;
    std::int64_t now = 0;
    for (int name = 0; name < 5000; ++name) {
        const int choice = name < pushed_first ? 0 : draw(130);
        if (choice < push_weight) {
            const SimTime time = at(now + draw_ahead());
            const Priority priority = draw(4) == 0 ? Priority::last : Priority::normal;
            oracle.emplace(Key{time, priority, name}, events.push(time, priority, name));
        } else if (choice < push_weight + cancel_weight && !oracle.empty()) {
            const auto victim = std::next(oracle.begin(), draw(static_cast<int>(oracle.size())));
            ASSERT_TRUE(events.queue.cancel(victim->second));
            spent.push_back(victim->second);
            oracle.erase(victim);
        } else if (!oracle.empty()) {
            const auto [time, priority, expected] = oracle.begin()->first;
            ASSERT_EQ(events.queue.next_time(), time);
            now = time.ps();
            Action action = events.queue.pop();
            action();
            ASSERT_EQ(events.log.back(), expected);
            spent.push_back(oracle.begin()->second);
            oracle.erase(oracle.begin());
        }
        ASSERT_EQ(events.queue.size(), oracle.size());
        const SimTime time = at(now + draw_ahead());
        if (events.queue.would_be_next(time, events.queue.reserve_sequence_numbers(1)) && !oracle.empty()) {
            const Key first = oracle.begin()->first;
            ASSERT_LT(std::tuple(time, Priority::normal, name + 1), first);
        }
        if (!spent.empty()) {
            ASSERT_FALSE(events.queue.is_pending(
                spent[static_cast<std::size_t>(draw(static_cast<int>(spent.size())))]));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, EventQueueOracle, testing::Range(1U, 61U));

}  // namespace
}  // namespace netsim
