// Success of frames over SNIR in ns-3, as the table of an error model (docs/how-to/choose-a-receiver.md).
//
//     error_rates >python/gradysim/scenario/profiles/ns3_error_rates.csv
//
// Asks ns-3's default error model through its public interface for chunks of the bits that a frame takes: in OFDM with
// service field, tail and padding. ns-3 has two tables for each rate of OFDM: chunks of less than 400 B use one, the
// others the other. So four lengths are enough for OFDM, whose success is that of the table to the power of a ratio.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <ns3/core-module.h>
#include <ns3/wifi-module.h>

namespace {

constexpr double step_db = 0.25;

struct Rate {
    std::string mode;
    double mbps;
    uint64_t bits_per_symbol;  // 0: DSSS or CCK
    uint64_t header_bytes;     // of the PHY header at this rate; 0: it is sent at another one
};

uint64_t bits_of(const Rate& rate, uint64_t bytes) {
    if (bytes == rate.header_bytes || rate.bits_per_symbol == 0) {
        return 8 * bytes;
    }
    const uint64_t bits = 16 + 8 * bytes + 6;
    return (bits + rate.bits_per_symbol - 1) / rate.bits_per_symbol * rate.bits_per_symbol;
}

double success(const ns3::Ptr<ns3::ErrorRateModel>& model, const Rate& rate, double snir_db, uint64_t bits) {
    ns3::WifiTxVector vector;
    vector.SetMode(ns3::WifiMode(rate.mode));
    vector.SetChannelWidth(rate.bits_per_symbol == 0 ? 22 : 20);
    const double snir = std::pow(10, snir_db / 10);
    return model->GetChunkSuccessRate(ns3::WifiMode(rate.mode), vector, snir, bits);
}

void print(const ns3::Ptr<ns3::ErrorRateModel>& model, const Rate& rate, uint64_t bytes) {
    const uint64_t bits = bits_of(rate, bytes);
    std::vector<std::pair<double, double>> points;
    for (double snir_db = -15; snir_db <= 35; snir_db += step_db) {
        points.emplace_back(snir_db, success(model, rate, snir_db, bits));
    }
    // Without the points before the last 0 and after the first 1.
    auto first = points.begin();
    auto last = points.end();
    while (last - first > 2 && (last - 2)->second == 1) {
        --last;
    }
    while (last - first > 2 && (first + 1)->second == 0) {
        ++first;
    }
    for (; first != last; ++first) {
        std::printf("%g,%llu,%g,%.9g\n", rate.mbps, static_cast<unsigned long long>(bytes), first->first,
                    first->second);
    }
}

}  // namespace

int main() {
    ns3::OfdmPhy::GetOfdmRate6Mbps();  // registers the modes
    const std::vector<Rate> rates{
        {"DsssRate1Mbps", 1, 0, 6},     {"DsssRate2Mbps", 2, 0, 0},     {"DsssRate5_5Mbps", 5.5, 0, 0},
        {"DsssRate11Mbps", 11, 0, 0},   {"OfdmRate6Mbps", 6, 24, 3},    {"OfdmRate9Mbps", 9, 36, 0},
        {"OfdmRate12Mbps", 12, 48, 0},  {"OfdmRate18Mbps", 18, 72, 0},  {"OfdmRate24Mbps", 24, 96, 0},
        {"OfdmRate36Mbps", 36, 144, 0}, {"OfdmRate48Mbps", 48, 192, 0}, {"OfdmRate54Mbps", 54, 216, 0}};
    const auto model = ns3::CreateObject<ns3::TableBasedErrorRateModel>();
    std::puts("# Success of frames over SNIR in ns-3 3.44: TableBasedErrorRateModel, and what it uses for DSSS and CCK.");
    std::puts("# Written by tests/verification/ns3/error_rates.cpp.");
    std::puts("bitrate_mbps,psdu_bytes,snir_db,success");
    for (const Rate& rate : rates) {
        std::vector<uint64_t> lengths{14, 100, 399, 400, 1500};
        if (rate.header_bytes > 0) {
            lengths.insert(lengths.begin(), rate.header_bytes);
        }
        for (const uint64_t bytes : lengths) {
            print(model, rate, bytes);
        }
    }
}
