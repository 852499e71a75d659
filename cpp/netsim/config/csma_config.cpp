#include "netsim/config/csma_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void CsmaConfig::validate() const {
    constexpr int largest_exponent = 20;
    constexpr double shortest_s = 1e-6;
    constexpr double longest_s = 1;

    check_between("csma.max_frame_retries", max_frame_retries, 0, 255, "");
    check_between("csma.ack_wait_s", ack_wait_s, shortest_s, longest_s, "s");
    check_between("csma.sifs_s", sifs_s, 0, longest_s, "s");
    check_between("csma.lifs_s", lifs_s, 0, longest_s, "s");
    check_name("csma.backoff_method", backoff_method, backoff_method_names);
    check_between("csma.max_backoffs", max_backoffs, 0, 255, "");
    check_between("csma.max_be", max_be, 0, largest_exponent, "");
    check_between("csma.min_be", min_be, 0, max_be, "");
    check_between("csma.contention_window", contention_window, 1, 32767, "");
    check_between("csma.unit_backoff_s", unit_backoff_s, shortest_s, longest_s, "s");
    check_between("csma.cca_s", cca_s, 0, longest_s, "s");
    check_between("csma.turnaround_s", turnaround_s, 0, longest_s, "s");
    check_between("csma.queue_capacity", queue_capacity, 1, 1'000'000, "frames");
}

}  // namespace netsim
