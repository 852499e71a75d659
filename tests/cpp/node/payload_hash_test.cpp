#include "netsim/node/payload_hash.hpp"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace netsim {
namespace {

Payload payload(const std::string& text) {
    return std::make_shared<const std::string>(text);
}

TEST(PayloadHash, DependsOnTheTextAlone) {
    PayloadHash hash;
    const std::uint64_t one = hash.of(payload("position 1"));
    EXPECT_NE(hash.of(payload("position 2")), one);
    EXPECT_EQ(hash.of(payload("position 1")), one);
    EXPECT_EQ(PayloadHash().of(payload("position 1")), one);
}

TEST(PayloadHash, DoesNotTakeANewTextForTheOneThatLayInItsPlace) {
    PayloadHash hash;
    for (int i = 0; i < 100; ++i) {  // each is freed, except for its hash, before the next one is made
        const std::string text = std::to_string(i);
        EXPECT_EQ(hash.of(payload(text)), PayloadHash().of(payload(text)));
    }
}

TEST(PayloadHash, OfAnEmptyTextIsOne) {
    PayloadHash hash;
    const std::uint64_t empty = hash.of(payload(""));
    EXPECT_NE(empty, hash.of(payload(std::string(1, '\0'))));
    EXPECT_EQ(empty, hash.of(payload("")));
}

}  // namespace
}  // namespace netsim
