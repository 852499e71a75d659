#include "netsim/trace/pcap_writer.hpp"

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "netsim/error.hpp"

namespace netsim {

namespace {

constexpr std::uint32_t nanosecond_magic = 0xa1b23c4d;
constexpr std::uint32_t longest_packet_bytes = 262'144;

std::string cannot_write(const std::string& path, int error) {
    return "cannot write the capture file '" + path + "': " + std::generic_category().message(error);
}

}  // namespace

PcapWriter::PcapWriter(std::string path, LinkType link_type)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
    if (file_ == nullptr) {
        throw ConfigError(cannot_write(path_, errno));
    }
    Octets header;
    append_le32(header, nanosecond_magic);
    append_le16(header, 2);  // version 2.4
    append_le16(header, 4);
    append_le32(header, 0);  // two reserved fields
    append_le32(header, 0);
    append_le32(header, longest_packet_bytes);
    append_le32(header, static_cast<std::uint32_t>(link_type));
    write_octets(header);
    if (error_ == 0 && std::fflush(file_.get()) != 0) {  // detects a full disk now
        error_ = errno;
    }
    if (error_ != 0) {
        throw ConfigError(cannot_write(path_, error_));
    }
}

void PcapWriter::write(SimTime time, const Octets& packet) {
    constexpr std::int64_t ps_per_ns = 1'000;
    constexpr std::int64_t ns_per_s = 1'000'000'000;
    NETSIM_ASSERT(time >= SimTime{} && packet.size() <= longest_packet_bytes);
    const std::int64_t ns = time.ps() / ps_per_ns;
    const auto length = static_cast<std::uint32_t>(packet.size());
    record_header_.clear();
    append_le32(record_header_, static_cast<std::uint32_t>(ns / ns_per_s));
    append_le32(record_header_, static_cast<std::uint32_t>(ns % ns_per_s));
    append_le32(record_header_, length);  // captured length
    append_le32(record_header_, length);  // original length
    write_octets(record_header_);
    write_octets(packet);
}

void PcapWriter::write_octets(const Octets& octets) {
    if (file_ == nullptr || error_ != 0) {
        return;
    }
    if (std::fwrite(octets.data(), 1, octets.size(), file_.get()) != octets.size()) {
        error_ = errno;
    }
}

void PcapWriter::close() {
    if (file_ == nullptr) {
        return;
    }
    if (std::fclose(file_.release()) != 0 && error_ == 0) {
        error_ = errno;
    }
    if (error_ != 0) {
        throw SimulationError(cannot_write(path_, error_) + "; it lacks the last frames");
    }
}

}  // namespace netsim
