#include "protocols/native_protocols.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/node/network.hpp"

namespace netsim {
namespace {

class NativeProtocols : public testing::Test {
protected:
    std::string error_of(std::string_view name, const Parameters& parameters) {
        return error_text([&] { set_native_protocol(node, name, parameters); });
    }

    Network network{MediumConfig(), 1};
    Node& node = network.add_node(NodeConfig("node"));
};

TEST_F(NativeProtocols, HaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const NativeProtocol& protocol : native_protocols()) {
        EXPECT_TRUE(names.insert(protocol.name).second) << protocol.name;
    }
}

TEST_F(NativeProtocols, TellWhatTheirParametersMean) {
    for (const NativeProtocol& protocol : native_protocols()) {
        EXPECT_FALSE(protocol.meaning.empty()) << protocol.name;
        for (const Parameter& parameter : protocol.parameters) {
            EXPECT_FALSE(parameter.meaning.empty()) << protocol.name << "." << parameter.name;
        }
    }
}

TEST_F(NativeProtocols, CanBeMadeWithTheDefaultsThatTheyTell) {
    for (const NativeProtocol& protocol : native_protocols()) {
        Parameters defaults;
        for (const Parameter& parameter : protocol.parameters) {
            defaults.emplace(parameter.name, parameter.default_value);
        }
        set_native_protocol(node, protocol.name, defaults);
        EXPECT_NE(node.protocol(), nullptr) << protocol.name;
    }
}

TEST_F(NativeProtocols, AnUnknownNameIsRefusedWithTheNearest) {
    EXPECT_EQ(error_of("BeaconProtokol", {}),
              "there is no native protocol `BeaconProtokol`; did you mean `BeaconProtocol`?");
}

TEST_F(NativeProtocols, AnUnknownParameterIsRefusedWithTheNearest) {
    EXPECT_EQ(error_of("BeaconProtocol", {{"first_sent", 1.0}}),
              "`first_sent` is not a parameter of BeaconProtocol; did you mean `first_send`?");
    EXPECT_EQ(error_of("ZigZagSensorProtocol", {{"speed", 1.0}}),
              "`speed` is not a parameter of ZigZagSensorProtocol, which has none");
}

TEST_F(NativeProtocols, AValueOfAnotherKindIsRefused) {
    EXPECT_EQ(error_of("BeaconProtocol", {{"payload_bytes", 1.5}}),
              "protocol.payload_bytes: expected an integer");
    EXPECT_EQ(error_of("BeaconProtocol", {{"interval", true}}), "protocol.interval: expected a number");
}

TEST_F(NativeProtocols, AWholeNumberWillDoForANumber) {
    EXPECT_EQ(error_of("BeaconProtocol", {{"interval", std::int64_t{1}}}), "no error");
    EXPECT_EQ(error_of("BeaconProtocol", {{"interval", std::int64_t{0}}}),
              error_of("BeaconProtocol", {{"interval", 0.0}}));
}

// The error of each protocol with messages of variable size, if they are one byte too long. There
// must be none for the longest valid size.
class LongestMessage : public testing::Test {
protected:
    static void expect_limit(const MediumConfig& medium, const NodeConfig& config,
                             std::int64_t longest_bytes) {
        Network network(medium, 1);
        Node& node = network.add_node(config);
        int protocols = 0;
        for (const NativeProtocol& protocol : native_protocols()) {
            for (const Parameter& parameter : protocol.parameters) {
                if (parameter.name == "payload_bytes") {
                    ++protocols;
                    EXPECT_NO_THROW(protocol.make(node, {{"payload_bytes", longest_bytes}})) << protocol.name;
                    EXPECT_EQ(
                        error_text([&] { protocol.make(node, {{"payload_bytes", longest_bytes + 1}}); }),
                        "protocol.payload_bytes = " + std::to_string(longest_bytes + 1) +
                            " B: expected from 0 B to " + std::to_string(longest_bytes) +
                            " B, the longest message of node (what its wlan[0] takes, less IPv4 and UDP "
                            "headers)")
                        << protocol.name;
                }
            }
        }
        EXPECT_GE(protocols, 3);
    }
};

TEST_F(LongestMessage, IsWhatTheMtuTakes) {
    expect_limit(MediumConfig(), NodeConfig("node"), 2276);
    NodeConfig narrow("node");
    narrow.wlan[0].mac.mtu_bytes = 500;
    expect_limit(MediumConfig(), narrow, 472);
}

TEST_F(LongestMessage, IsWhatAFrameOf802154Takes) {
    expect_limit(MediumConfig(), NodeConfig("node", {std::string(ieee802154_interface)}), 90);
}

TEST_F(LongestMessage, IsThatOfUdpWithoutRadios) {
    expect_limit(MediumConfig(std::string(unit_disk_medium)), NodeConfig("node"), 65'507);
}

TEST_F(NativeProtocols, AValueOutOfRangeIsRefused) {
    EXPECT_EQ(error_of("BeaconProtocol", {{"interval", 0.0}}),
              "protocol.interval = 0 s: expected more than 0 s");
}

}  // namespace
}  // namespace netsim
