// Searches for bytes whose scenario crashes, hangs or leaves outcomes out of balance. `make fuzz`
// runs it.
#include <cstdio>
#include <cstdlib>

#include "support/fuzzed_scenario.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string imbalance = netsim::test::FuzzedScenario({data, size}).run();
    if (!imbalance.empty()) {
        std::fprintf(stderr, "the ledger does not balance: %s\n", imbalance.c_str());
        std::abort();
    }
    return 0;
}
