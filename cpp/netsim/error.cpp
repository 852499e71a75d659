#include "netsim/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace netsim {

void assertion_failed(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "netsim: internal error: %s does not hold (%s:%d); please report it\n", expression,
                 file, line);
    std::abort();
}

}  // namespace netsim
