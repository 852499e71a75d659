// Networks share nothing: several may run at the same time, each in its own thread. ThreadSanitizer
// (`make test-threads`) also finds shared state without an effect on the result.
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_scenario.hpp"

namespace netsim {
namespace {

std::uint64_t fingerprint_of(std::uint64_t seed) {
    const test::RandomScenario scenario = test::make_random_scenario(seed);
    test::ScenarioRun run(scenario);
    run.network.run_until(SimTime::from_ps(scenario.talk.until.ps() * 2));
    return run.network.fingerprint();
}

TEST(NetworksInThreads, TakeTheSameCourseAsAlone) {
    constexpr std::uint64_t count = 8;
    std::vector<std::uint64_t> alone;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        alone.push_back(fingerprint_of(seed));
    }
    std::vector<std::uint64_t> together(count);
    std::vector<std::thread> threads;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        threads.emplace_back([&together, seed] { together[seed] = fingerprint_of(seed); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(together, alone);
}

}  // namespace
}  // namespace netsim
