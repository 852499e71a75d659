#include "netsim/config/csma_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void CsmaConfig::validate() const {
    check_fields(*this);
    check_at_most("csma.min_be", min_be, "csma.max_be", max_be);
}

}  // namespace netsim
