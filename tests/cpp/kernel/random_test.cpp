#include "netsim/kernel/random.hpp"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers of Philox4x32-10, published by its authors.
TEST(Philox, KnownAnswerForZeroes) {
    EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
}

TEST(Philox, KnownAnswerForOnes) {
    EXPECT_EQ(philox4x32({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(Philox, KnownAnswerForTheDigitsOfPi) {
    EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

std::vector<std::uint32_t> first_words(std::uint64_t seed, std::uint32_t node, Purpose purpose,
                                       int count = 40) {
    RandomStream stream(seed, node, purpose);
    std::vector<std::uint32_t> words;
    for (int i = 0; i < count; ++i) {
        words.push_back(stream.next_u32());
    }
    return words;
}

TEST(RandomStream, IsPhiloxOverACountOfBlocks) {
    const std::uint64_t seed = 0x1234567890abcdef;
    const std::vector<std::uint32_t> words = first_words(seed, 7, Purpose::backoff, 8);
    const std::array<std::uint32_t, 2> key{0x90abcdef, 0x12345678};
    const Words first = philox4x32({0, 0, 7, 1}, key);
    const Words second = philox4x32({1, 0, 7, 1}, key);
    EXPECT_EQ(std::vector(words.begin(), words.begin() + 4), std::vector(first.begin(), first.end()));
    EXPECT_EQ(std::vector(words.begin() + 4, words.end()), std::vector(second.begin(), second.end()));
}

TEST(RandomStream, AUniformDrawIsOfTheNextTwoWordsWhereverTheyLie) {
    const std::vector<std::uint32_t> words = first_words(5, 3, Purpose::reception);
    for (std::size_t before = 0; before < 9; ++before) {
        RandomStream stream(5, 3, Purpose::reception);
        for (std::size_t i = 0; i < before; ++i) {
            stream.next_u32();
        }
        const double expected = (words[before] >> 5) * 0x1p-27 + (words[before + 1] >> 6) * 0x1p-53;
        EXPECT_EQ(stream.uniform(), expected) << before;
        EXPECT_EQ(stream.next_u32(), words[before + 2]) << before;
    }
}

TEST(RandomStream, BeginsAfterAsManyDrawsAsItIsToldOf) {
    RandomStream drawn(3, 7, Purpose::reception);
    for (std::uint64_t draws = 0; draws < 5; ++draws) {
        RandomStream begins_there(3, 7, Purpose::reception, draws);
        EXPECT_EQ(begins_there.uniform(), drawn.uniform()) << draws;
    }
}

TEST(RandomStream, HasAStreamForEachName) {
    std::set<std::vector<std::uint32_t>> streams;
    int names = 0;
    for (const std::uint64_t seed : {0ULL, 1ULL, 1ULL << 32}) {
        for (const std::uint32_t node : {0U, 1U, 9U}) {
            for (const Purpose purpose : {Purpose::backoff, Purpose::reception}) {
                streams.insert(first_words(seed, node, purpose));
                ++names;
            }
        }
    }
    EXPECT_EQ(streams.size(), static_cast<std::size_t>(names));
}

TEST(RandomStream, DrawsOfOneStreamDoNotDependOnOthers) {
    const std::vector<std::uint32_t> alone = first_words(5, 3, Purpose::backoff);
    RandomStream stream(5, 3, Purpose::backoff);
    RandomStream other(5, 10, Purpose::backoff);
    for (const std::uint32_t word : alone) {
        other.next_u32();
        EXPECT_EQ(stream.next_u32(), word);
    }
}

TEST(RandomStream, UniformHasTheMomentsOfAUniformDistribution) {
    RandomStream stream(42, 0, Purpose::reception);
    constexpr int draws = 200'000;
    double sum = 0;
    double sum_of_squares = 0;
    for (int i = 0; i < draws; ++i) {
        const double value = stream.uniform();
        ASSERT_GE(value, 0);
        ASSERT_LT(value, 1);
        sum += value;
        sum_of_squares += value * value;
    }
    const double mean = sum / draws;
    const double second_moment = sum_of_squares / draws;
    // Four standard errors: of the mean sqrt(1/12/n), of the second moment sqrt(4/45/n).
    EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1.0 / 12 / draws));
    EXPECT_NEAR(second_moment, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / draws));
}

TEST(RandomStream, UniformUsesFiftyThreeBits) {
    RandomStream stream(42, 0, Purpose::reception);
    bool lowest_bit_seen = false;
    for (int i = 0; i < 100; ++i) {
        const double scaled = stream.uniform() * 0x1p53;
        EXPECT_EQ(scaled, std::floor(scaled));
        lowest_bit_seen = lowest_bit_seen || std::fmod(scaled, 2) == 1;
    }
    EXPECT_TRUE(lowest_bit_seen);
}

// Chi-square of the counts against equal shares; bounds are the 99.9 % quantiles.
double chi_square(std::uint32_t count, int draws) {
    RandomStream stream(7, 1, Purpose::backoff);
    std::vector<int> counts(count);
    for (int i = 0; i < draws; ++i) {
        ++counts.at(stream.uniform_int(count));
    }
    const double expected = static_cast<double>(draws) / count;
    double sum = 0;
    for (const int seen : counts) {
        sum += (seen - expected) * (seen - expected) / expected;
    }
    return sum;
}

TEST(RandomStream, UniformIntHasNoFavourites) {
    EXPECT_LT(chi_square(2, 100'000), 10.83);   // 1 degree of freedom
    EXPECT_LT(chi_square(10, 100'000), 27.88);  // 9
    EXPECT_LT(chi_square(32, 100'000), 61.10);  // 31
}

TEST(RandomStream, UniformIntIsUnbiasedWhereFoldingWouldNotBe) {
    // 2^32 draws folded onto 3 · 2^30 numbers without redrawing would give every third number
    // twice.
    constexpr std::uint32_t count = 3U << 30;
    constexpr int draws = 30'000;
    RandomStream stream(3, 0, Purpose::backoff);
    std::array<int, 3> residues{};
    for (int i = 0; i < draws; ++i) {
        ++residues.at(stream.uniform_int(count) % 3);
    }
    for (const int seen : residues) {
        EXPECT_NEAR(seen, draws / 3.0, 4 * std::sqrt(draws * 2.0 / 9));
    }
}

TEST(RandomStream, UniformIntOfOneIsZero) {
    RandomStream stream(1, 1, Purpose::backoff);
    EXPECT_EQ(stream.uniform_int(1), 0U);
}

}  // namespace
}  // namespace netsim
