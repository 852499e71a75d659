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

void check_rate_control(const MacConfig& mac) {
    constexpr int most = 1'000'000;
    constexpr double almost_one = 0.999999;
    check_name("mac.rate_control", mac.rate_control, rate_control_names);
    check_bitrate("mac.initial_rate_bps", mac.initial_rate_bps);
    check_between("mac.rate_interval_s", mac.rate_interval_s, 1e-6, 1e6, "s");
    check_between("mac.increase_threshold", mac.increase_threshold, 1, most, "");
    check_between("mac.decrease_threshold", mac.decrease_threshold, 1, most, "");
    check_between("mac.increase_threshold_factor", mac.increase_threshold_factor, 1, 1000, "");
    // ARF has no bound, and must not be refused for one that is too low.
    const int lowest_bound = mac.rate_control == "AarfRateControl" ? mac.increase_threshold : 1;
    check_between("mac.max_increase_threshold", mac.max_increase_threshold, lowest_bound, most, "");
    check_between("mac.rate_update_interval_s", mac.rate_update_interval_s, 1e-6, 1e6, "s");
    check_between("mac.look_around_share", mac.look_around_share, 0, 1, "");
    check_between("mac.ewma_weight", mac.ewma_weight, 0, almost_one, "");
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
    check_rate_control(*this);
}

}  // namespace netsim
