#include "protocols/zigzag_message.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim::zigzag {
namespace {

// As `encode` of examples/zigzag/message.py writes them.
std::vector<std::pair<Message, std::string>> examples() {
    return {
        {UavHeartbeat{3, true, false},
         R"({"type":"UavHeartbeat","sender":3,"homeward":true,"available":false})"},
        {GroundHeartbeat{7}, R"({"type":"GroundHeartbeat","sender":7})"},
        {SensorData{4}, R"({"type":"SensorData","sender":4})"},
        {PairRequest{1, 2, 30}, R"({"type":"PairRequest","sender":1,"carrier":2,"given":30})"},
        {PairConfirmation{1, 2, 0}, R"({"type":"PairConfirmation","sender":1,"carrier":2,"given":0})"},
    };
}

TEST(ZigZagMessage, IsWrittenAsInPython) {
    for (const auto& [message, text] : examples()) {
        EXPECT_EQ(*encode(message), text);
    }
}

TEST(ZigZagMessage, IsReadAsItWasWritten) {
    for (const auto& [message, text] : examples()) {
        EXPECT_EQ(decode(text), message) << text;
    }
}

TEST(ZigZagMessage, AnyOtherTextIsAnError) {
    for (const char* text :
         {"", "hello", "{}", R"({"type":"SensorData"})", R"({"type":"Other","sender":4})",
          R"({"type":"SensorData","sender":4,"more":1})", R"({"type":"SensorData","sender":-1})",
          R"({"type":3,"sender":4})", R"({"type":"SensorData","sender":true})"}) {
        EXPECT_THROW(decode(text), SimulationError) << text;
    }
}

}  // namespace
}  // namespace netsim::zigzag
