// Time to read a cache line in random order, of 80 kB and of 8 MB: about the memory that frames use
// in the networks of 100 and of 10,000 nodes of beacon_bench. It is one reason why a frame costs
// more in the large network, and the one that depends on the machine.
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

struct alignas(64) Line {
    std::size_t next = 0;
};

std::vector<std::size_t> random_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
    return order;
}

// The address of each line comes from the line before, like the path from a timer to its node, its
// link and its radio.
void dependent_lines(benchmark::State& state) {
    const std::vector<std::size_t> order =
        random_order(static_cast<std::size_t>(state.range(0)) / sizeof(Line));
    std::vector<Line> lines(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        lines[order[i]].next = order[(i + 1) % order.size()];
    }
    std::size_t at = 0;
    for (auto _ : state) {
        at = lines[at].next;
        benchmark::DoNotOptimize(at);
    }
}
BENCHMARK(dependent_lines)->Arg(80'000)->Arg(8'000'000);

// Many reads are in flight, like the prefetched receivers of a transmission.
void independent_lines(benchmark::State& state) {
    const std::vector<std::size_t> order =
        random_order(static_cast<std::size_t>(state.range(0)) / sizeof(Line));
    std::vector<Line> lines(order.size());
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(++lines[order[i]].next);
        i = i + 1 == order.size() ? 0 : i + 1;
    }
}
BENCHMARK(independent_lines)->Arg(80'000)->Arg(8'000'000);

}  // namespace
