#include "protocols/flat_json.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(FlatJson, ReadsNumbersTruthValuesAndTexts) {
    const FlatJson expected{{"a", std::int64_t{-12}}, {"b", true}, {"c", std::string("text")}};
    EXPECT_EQ(parse_flat_json(R"({"a":-12,"b":true,"c":"text"})"), expected);
}

TEST(FlatJson, BlanksDoNotMatter) {
    const FlatJson expected{{"a", false}};
    EXPECT_EQ(parse_flat_json(" { \"a\" :\n false } "), expected);
    EXPECT_EQ(parse_flat_json("{ }"), FlatJson());
}

TEST(FlatJson, OfEqualNamesTheLastHolds) {
    const FlatJson expected{{"a", std::int64_t{2}}};
    EXPECT_EQ(parse_flat_json(R"({"a":1,"a":2})"), expected);
}

TEST(FlatJson, NothingElseIsRead) {
    for (const char* text :
         {"", "1", "{", R"({"a"})", R"({"a":})", R"({"a":1)", R"({"a":1,})", R"({"a":1}x)", R"({"a":[1]})",
          R"({"a\n":1})", R"({"a":"b)", "{a:1}", R"({"a":99999999999999999999})", R"({"a":1.5})"}) {
        EXPECT_FALSE(parse_flat_json(text)) << text;
    }
}

}  // namespace
}  // namespace netsim
