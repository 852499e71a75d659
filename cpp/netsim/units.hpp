// Conversions between decibels and linear quantities, and the physical constants.
//
// The only place of the engine that takes logarithms of powers. Inside, powers are in watts and
// ratios are linear. Decibels occur in configurations and messages only. 0 dBm is 1 mW.
#pragma once

namespace netsim {

// In vacuum; exact by the definition of the meter.
inline constexpr double speed_of_light_mps = 299'792'458.0;

// 10^(db/10).
double ratio_from_db(double ratio_db);
// 10 log10(ratio); 0 gives minus infinity.
double db_from_ratio(double ratio);

double w_from_dbm(double power_dbm);
// 0 W gives minus infinity.
double dbm_from_w(double power_w);

}  // namespace netsim
