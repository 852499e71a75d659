// Events per second of the kernel, scheduled and run, for several numbers of pending events.
//
// Goal: 10 million events per second with 1,000 pending.
#include <cstdint>

#include <benchmark/benchmark.h>

#include "netsim/kernel/random.hpp"
#include "netsim/kernel/simulator.hpp"

namespace {

using netsim::SimTime;
using netsim::Simulator;

// Each event schedules the next of its chain after a random time, like the timers of protocols.
struct Chain {
    Simulator* simulator;
    netsim::RandomStream* draws;

    void operator()() const {
        const SimTime delay = SimTime::from_ps(1 + draws->next_u32());
        simulator->schedule_after(delay, Chain{simulator, draws});
    }
};

void run_events(benchmark::State& state) {
    Simulator simulator;
    netsim::RandomStream draws(1, 0, netsim::Purpose::backoff);
    for (std::int64_t pending = 0; pending < state.range(0); ++pending) {
        Chain{&simulator, &draws}();
    }
    constexpr std::uint64_t batch = 10'000;
    for (auto _ : state) {
        simulator.run_until(SimTime::max(), batch);
    }
    const auto events = static_cast<double>(simulator.event_count());
    state.counters["events/s"] = benchmark::Counter(events, benchmark::Counter::kIsRate);
    state.SetLabel(state.range(0) == 1'000 ? "goal: 10 M events/s" : "");
}
BENCHMARK(run_events)->Arg(100)->Arg(1'000)->Arg(100'000);

void schedule_and_cancel(benchmark::State& state) {
    Simulator simulator;
    for (auto _ : state) {
        simulator.cancel(simulator.schedule_after(SimTime::from_us(1), [] {}));
    }
}
BENCHMARK(schedule_and_cancel);

}  // namespace
