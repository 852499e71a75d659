#include "netsim/phy/ber_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr std::string_view first_line = "bitrate_mbps,psdu_bytes,snir_db,success";

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

struct Row {
    double bitrate_mbps = 0;
    double psdu_bytes = 0;
    double snir_db = 0;
    double success = 0;
};

const std::set<std::int64_t>& bitrates_of_modes_bps() {
    static const std::set<std::int64_t> all = [] {
        std::set<std::int64_t> bitrates_bps;
        for (const std::string_view op_mode : op_mode_names) {
            for (const Mode& mode : mode_set(op_mode).modes()) {
                bitrates_bps.insert(mode.bitrate_bps);
            }
        }
        return bitrates_bps;
    }();
    return all;
}

bool is_bitrate_of_a_mode(double mbps) {
    return std::ranges::any_of(bitrates_of_modes_bps(), [mbps](std::int64_t bitrate_bps) {
        return static_cast<double>(bitrate_bps) == mbps * 1e6;
    });
}

std::string bitrates_of_modes_mbps() {
    std::string text;
    for (const std::int64_t bitrate_bps : bitrates_of_modes_bps()) {
        text.append(text.empty() ? "" : ", ").append(text_of(static_cast<double>(bitrate_bps) / 1e6));
    }
    return text;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw ConfigError({"radio.ber_table_file", "\"" + path + "\"", {what}});
}

[[noreturn]] void refuse(const std::string& path, int line, const std::string& what) {
    refuse(path, "line " + std::to_string(line) + ": " + what);
}

// Rejects files of another type or encoding here: messages about their lines would be unreadable.
void check_ascii(const std::string& path, int number, std::string_view text) {
    for (const char character : text) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte > 126 || (byte < 32 && byte != '\t')) {
            std::array<char, 8> code{};
            std::snprintf(code.data(), code.size(), "0x%02X", byte);
            refuse(path, number,
                   std::string("the byte ") + code.data() +
                       " is not a character of a number: expected a CSV file, a text with the line " +
                       std::string(first_line));
        }
    }
}

// Reads one line of the file, and rejects invalid values.
class Line {
public:
    Line(const std::string& path, int number, std::string_view text)
        : path_(path), number_(number), text_(text) {}

    [[noreturn]] void refuse(const std::string& what) const { netsim::refuse(path_, number_, what); }

    Row row() const {
        std::array<double, 4> values{};
        std::string_view rest = text_;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t comma = rest.find(',');
            if ((comma == std::string_view::npos) != (i + 1 == values.size())) {
                refuse("\"" + std::string(text_) + "\": expected four numbers, " + std::string(first_line));
            }
            const std::string_view field = rest.substr(0, comma);
            const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[i]);
            if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(values[i])) {
                refuse("\"" + std::string(field) + "\": expected a number");
            }
            rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
        }
        const Row row{values[0], values[1], values[2], values[3]};
        require(is_bitrate_of_a_mode(row.bitrate_mbps), "bitrate_mbps", row.bitrate_mbps,
                "the bitrate of a mode, one of " + bitrates_of_modes_mbps());
        require(row.psdu_bytes >= 1 && row.psdu_bytes <= 1e6 && std::trunc(row.psdu_bytes) == row.psdu_bytes,
                "psdu_bytes", row.psdu_bytes, "an integer number of bytes >= 1");
        require(row.success >= 0 && row.success <= 1, "success", row.success, "from 0 to 1");
        return row;
    }

private:
    void require(bool holds, const char* name, double value, const std::string& expected) const {
        if (!holds) {
            refuse(std::string(name) + " = " + text_of(value) + ": expected " + expected);
        }
    }

    const std::string& path_;
    int number_;
    std::string_view text_;
};

}  // namespace

BerTableErrorModel::BerTableErrorModel(const std::string& path) {
    std::error_code ignored;
    const bool is_directory = std::filesystem::is_directory(path, ignored);
    std::ifstream file(path);
    if (!file || is_directory) {
        refuse(path,
               std::string("expected a file that can be read") + (is_directory ? ", not a folder" : ""));
    }
    bool is_first = true;
    int number = 0;
    for (std::string text; std::getline(file, text);) {
        ++number;
        if (number == 1 && text.starts_with(byte_order_mark)) {  // Excel writes one
            text.erase(0, byte_order_mark.size());
        }
        if (!text.empty() && text.back() == '\r') {
            text.pop_back();
        }
        if (text.empty() || text.front() == '#') {
            continue;
        }
        check_ascii(path, number, text);
        const Line line(path, number, text);
        if (std::exchange(is_first, false)) {
            if (text != first_line) {
                line.refuse("\"" + text + "\": expected the line " + std::string(first_line));
            }
            continue;
        }
        const Row row = line.row();
        Curve& curve = rates_[std::llround(row.bitrate_mbps * 1e6)][static_cast<int>(row.psdu_bytes)];
        if (!curve.empty() && row.snir_db <= curve.back().snir_db) {
            line.refuse("snir_db = " + text_of(row.snir_db) + ": expected more than the " +
                        text_of(curve.back().snir_db) + " before it, of the same bitrate and length");
        }
        curve.push_back({row.snir_db, row.success});
    }
    if (number == 0) {
        refuse(path, "the file is empty; expected the line " + std::string(first_line) +
                         ", and at least one line below");
    }
    if (rates_.empty()) {
        refuse(path, number, "expected at least one line below " + std::string(first_line));
    }
}

double BerTableErrorModel::success_probability(const Mode& mode, double snir, int psdu_bytes) const {
    const double log_of_both = log_header_success(mode, snir) + log_data_success(mode, snir, psdu_bytes);
    return log_of_both == 0 ? 1 : std::exp(log_of_both);
}

double BerTableErrorModel::log_header_success(const Mode& mode, double snir) const {
    const auto curves = rates_.find(mode.header_bitrate_bps);
    return curves == rates_.end() ? nist_.log_header_success(mode, snir)
                                  : log_success(curves->second, snir, mode.header_bits / 8.0);
}

double BerTableErrorModel::log_data_success(const Mode& mode, double snir, int psdu_bytes) const {
    const auto curves = rates_.find(mode.bitrate_bps);
    return curves == rates_.end() ? nist_.log_data_success(mode, snir, psdu_bytes)
                                  : log_success(curves->second, snir, psdu_bytes);
}

double BerTableErrorModel::log_success(const Curves& curves, double snir, double bytes) {
    if (bytes <= 0) {
        return 0;
    }
    const auto by_ratio = [bytes](const auto& curve) { return std::abs(std::log(curve.first / bytes)); };
    const auto nearest = std::ranges::min_element(curves, {}, by_ratio);
    const double success = success_at(nearest->second, db_from_ratio(snir));
    return success > 0 ? std::log(success) * bytes / nearest->first
                       : -std::numeric_limits<double>::infinity();
}

double BerTableErrorModel::success_at(const Curve& curve, double snir_db) {
    const auto above = std::ranges::upper_bound(curve, snir_db, {}, &Point::snir_db);
    if (above == curve.begin()) {
        return curve.front().success;
    }
    if (above == curve.end()) {
        return curve.back().success;
    }
    const auto below = above - 1;
    const double share = (snir_db - below->snir_db) / (above->snir_db - below->snir_db);
    return below->success + share * (above->success - below->success);
}

}  // namespace netsim
