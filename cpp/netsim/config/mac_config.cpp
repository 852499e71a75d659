#include "netsim/config/mac_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void MacConfig::validate() const {
    check_fields(*this);
    if (cw_max != -1) {
        check_at_most("mac.cw_min", cw_min, "mac.cw_max", cw_max);
    }
    // ARF has no upper bound, so the bound of AARF must not reject its threshold.
    if (model_named(rate_control, rate_controls).does_read("max_increase_threshold")) {
        check_at_most("mac.increase_threshold", increase_threshold, "mac.max_increase_threshold",
                      max_increase_threshold);
    }
}

}  // namespace netsim
