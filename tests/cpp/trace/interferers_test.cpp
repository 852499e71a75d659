#include "netsim/trace/interferers.hpp"

#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

TEST(Interferers, CountsOfNobodyAreEmpty) {
    Interferers interferers;
    interferers.add_node();
    EXPECT_EQ(interferers.node_count(), 1U);
    EXPECT_TRUE(interferers.at(0).empty());
}

// Losses are counted in batches; the reported counts must not depend on the batches.
TEST(Interferers, AfterEachOfManyLossesCountsAreThoseOfAMap) {
    constexpr std::uint32_t nodes = 7;
    Interferers interferers;
    for (std::uint32_t node = 0; node < nodes; ++node) {
        interferers.add_node();
    }
    std::map<NodeId, std::map<NodeId, std::uint64_t>> expected;
    RandomStream draws(1, 0, Purpose{1001});
    const auto draw_node = [&draws] { return static_cast<NodeId>(draws.uniform_int(nodes)); };
    for (int loss = 0; loss < 1500; ++loss) {
        const NodeId receiver = draw_node();
        std::vector<NodeId> others;
        for (NodeId node = draw_node(); node < static_cast<NodeId>(nodes); node += 3) {
            others.push_back(node);
            ++expected[receiver][node];
        }
        interferers.note(receiver, others);
        ASSERT_EQ(interferers.at(receiver), expected[receiver]) << "after loss " << loss;
    }
    for (const auto& [receiver, counts] : expected) {
        EXPECT_EQ(interferers.at(receiver), counts);
    }
}

}  // namespace
}  // namespace netsim
