// An error model from a file of measured values: packet success ratio over SNIR.
//
// The file is CSV. Its first line is "bitrate_mbps,psdu_bytes,snir_db,success". A byte order mark,
// empty lines and lines that begin with # are ignored. The lines of one bitrate and length form a
// curve, in rising order of SNIR. Between two points, the success ratio is interpolated linearly
// over the SNIR in dB. Outside, it is that of the nearest point. For a PSDU of another length n, the
// curve with the length m nearest by ratio is used, raised to the power of n/m.
//
// The PHY header counts as a PSDU of its own length at its own rate: 3 bytes at 6 Mbps (OFDM), 6
// bytes at 1 Mbps (DSSS and CCK). Bitrates without a curve in the file use the NIST model.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "netsim/phy/error_rate.hpp"

namespace netsim {

class BerTableErrorModel final : public ErrorModel {
public:
    // Throws ConfigError if the file cannot be read, or with the line if it is malformed.
    explicit BerTableErrorModel(const std::string& path);

    double success_probability(const Mode& mode, double snir, int psdu_bytes) const override;
    double log_header_success(const Mode& mode, double snir) const override;
    double log_data_success(const Mode& mode, double snir, int psdu_bytes) const override;

private:
    struct Point {
        double snir_db = 0;
        double success = 0;
    };
    using Curve = std::vector<Point>;
    using Curves = std::map<int, Curve>;  // by PSDU length in bytes

    static double log_success(const Curves& curves, double snir, double bytes);
    static double success_at(const Curve& curve, double snir_db);

    std::map<std::int64_t, Curves> rates_;  // by bitrate in bps
    NistErrorModel nist_{despreading_rates};
};

}  // namespace netsim
