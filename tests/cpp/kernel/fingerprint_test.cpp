#include "netsim/kernel/fingerprint.hpp"

#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

std::uint64_t of_words(std::initializer_list<std::uint64_t> words) {
    Fingerprint fingerprint;
    for (const std::uint64_t word : words) {
        fingerprint.add(word);
    }
    return fingerprint.value();
}

std::uint64_t of_texts(std::initializer_list<std::string> texts) {
    Fingerprint fingerprint;
    for (const std::string& text : texts) {
        fingerprint.add_text(text);
    }
    return fingerprint.value();
}

TEST(Fingerprint, IsTheSameForTheSameCourse) {
    EXPECT_EQ(of_words({1, 2, 3}), of_words({1, 2, 3}));
    EXPECT_EQ(of_texts({"one", "two"}), of_texts({"one", "two"}));
}

// Recorded: fingerprints are stored in files, so the hash must not change.
TEST(Fingerprint, IsTheSameInEveryVersion) {
    EXPECT_EQ(of_words({}), 0x243F6A8885A308D3U);
    EXPECT_EQ(of_words({1, 2, 3}), 0x3A740D7336B91E8FU);
    EXPECT_EQ(of_texts({"a text of 23 characters"}), 0xFFDA49A76F4F217EU);
}

TEST(Fingerprint, DependsOnOrder) {
    EXPECT_NE(of_words({1, 2}), of_words({2, 1}));
    EXPECT_NE(of_texts({"a", "b"}), of_texts({"b", "a"}));
}

TEST(Fingerprint, DependsOnWhatSeemsNothing) {
    EXPECT_NE(of_words({}), of_words({0}));
    EXPECT_NE(of_words({0}), of_words({0, 0}));
    EXPECT_NE(of_texts({}), of_texts({""}));
}

TEST(Fingerprint, TellsWhereATextEnds) {
    EXPECT_NE(of_texts({"ab", "c"}), of_texts({"a", "bc"}));
    EXPECT_NE(of_texts({std::string(1, '\0')}), of_texts({""}));
}

TEST(Fingerprint, EveryCharacterOfATextCounts) {
    std::set<std::uint64_t> seen;
    const std::string text(40, 'x');
    seen.insert(of_texts({text}));
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string changed = text;
        changed[i] = 'y';
        seen.insert(of_texts({changed}));
    }
    EXPECT_EQ(seen.size(), text.size() + 1);
}

TEST(Fingerprint, EveryLengthOfATextCounts) {
    std::set<std::uint64_t> seen;
    for (std::size_t length = 0; length < 600; ++length) {
        seen.insert(of_texts({std::string(length, '\0')}));
    }
    EXPECT_EQ(seen.size(), 600U);
}

TEST(Fingerprint, EveryBitOfAWordCounts) {
    std::set<std::uint64_t> seen{of_words({0})};
    for (int bit = 0; bit < 64; ++bit) {
        seen.insert(of_words({std::uint64_t{1} << bit}));
    }
    EXPECT_EQ(seen.size(), 65U);
}

}  // namespace
}  // namespace netsim
