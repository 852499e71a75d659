#include "support/fuzzed_scenario.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

class RandomBytes : public testing::TestWithParam<std::uint64_t> {};

// A small part of the fuzzer's inputs, in every run of the tests.
TEST_P(RandomBytes, NeverBreakTheEngine) {
    constexpr std::uint64_t scenarios = 500;
    constexpr std::uint32_t longest = 1500;
    for (std::uint64_t i = 0; i < scenarios; ++i) {
        const std::uint64_t seed = GetParam() * scenarios + i;
        RandomStream draws(seed, 0, Purpose{1004});
        const bool mostly_usual = draws.uniform() < 0.5;  // otherwise few configurations are valid
        std::vector<std::uint8_t> bytes(draws.uniform_int(longest));
        for (std::uint8_t& byte : bytes) {
            byte = static_cast<std::uint8_t>(
                draws.uniform_int(mostly_usual && draws.uniform() < 0.98 ? 128 : 256));
        }
        EXPECT_EQ(test::FuzzedScenario(bytes).run(), "") << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Batches, RandomBytes, testing::Range<std::uint64_t>(0, 4));

}  // namespace
}  // namespace netsim
