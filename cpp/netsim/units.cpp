#include "netsim/units.hpp"

#include <cmath>

namespace netsim {

double ratio_from_db(double ratio_db) {
    return std::pow(10.0, ratio_db / 10);
}

double db_from_ratio(double ratio) {
    return 10 * std::log10(ratio);
}

double w_from_dbm(double power_dbm) {
    return ratio_from_db(power_dbm) / 1000;
}

double dbm_from_w(double power_w) {
    return db_from_ratio(power_w * 1000);
}

}  // namespace netsim
