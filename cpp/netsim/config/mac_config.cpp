#include "netsim/config/mac_config.hpp"

#include <algorithm>

#include "netsim/config/check.hpp"

namespace netsim {
namespace {

void check_bitrate(std::string_view field, double value) {
    if (value != -1) {
        check_greater(field, value, 0, "bps");
    }
}

}  // namespace

void MacConfig::validate() const {
    constexpr int largest_window = 32767;
    constexpr std::string_view of_the_mode = "that of the operation mode";

    check_name("mac.op_mode", op_mode, op_mode_names);
    check_bitrate("mac.bitrate_bps", bitrate_bps);
    check_bitrate("mac.multicast_bitrate_bps", multicast_bitrate_bps);
    check_bitrate("mac.control_bitrate_bps", control_bitrate_bps);
    check_between("mac.rts_threshold_bytes", rts_threshold_bytes, 0, 1'000'000, "B");
    check_between("mac.short_retry_limit", short_retry_limit, 1, 255, "");
    check_between("mac.long_retry_limit", long_retry_limit, 1, 255, "");
    check_default_or_between("mac.cw_min", cw_min, of_the_mode, 0, largest_window);
    check_default_or_between("mac.cw_max", cw_max, of_the_mode, std::max(cw_min, 0), largest_window);
    check_between("mac.queue_capacity", queue_capacity, 1, 1'000'000, "frames");
    check_between("mac.mtu_bytes", mtu_bytes, 29, 2304, "B");
}

}  // namespace netsim
