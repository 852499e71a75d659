// Numbers, flags and names decoded from bytes; zeros after their end. Used by the fuzzer's
// scenarios.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace netsim::test {

class ByteReader {
public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }
    std::uint8_t byte() {
        if (bytes_.empty()) {
            return 0;
        }
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    bool flag() { return (byte() & 1) != 0; }
    std::uint32_t below(std::uint32_t count) {
        return (static_cast<std::uint32_t>(byte()) << 8 | byte()) % count;
    }
    // Any double for some bytes; otherwise the usual value times a power of ten.
    double number(double usual) {
        const std::uint8_t kind = byte();
        if (kind < 128) {
            return usual;
        }
        if (kind < 240) {
            constexpr double tenth = 0.1;
            double value = usual;
            for (int power = kind % 16; power > 0; --power) {
                value *= (kind & 16) != 0 ? 1 / tenth : tenth;
            }
            return value * (1 + byte() / 256.0);
        }
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) {
            bits = bits << 8 | byte();
        }
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    int integer(int usual) {
        constexpr double most = 1e9;
        const double value = number(usual);
        return value >= -most && value <= most ? static_cast<int>(value) : usual;
    }
    // From `low` to `high`, or any number as above.
    double between(double low, double high) { return number(low + (high - low) * byte() / 255.0); }
    template <typename Names>
    std::string name(const Names& names) {
        return std::string(names[below(static_cast<std::uint32_t>(names.size()))]);
    }

private:
    std::span<const std::uint8_t> bytes_;
};

}  // namespace netsim::test
