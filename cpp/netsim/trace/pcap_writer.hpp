// A classic pcap file with time stamps in nanoseconds, of 802.11 frames with radiotap headers, or
// of 802.15.4 frames.
//
// It is opened before a run, so that an invalid path is reported then. If the disk becomes full, the
// run continues without writing further packets, and close() throws an error.
//
// Source: IETF draft-ietf-opsawg-pcap (magic 0xa1b23c4d). Little-endian on every machine.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "netsim/kernel/sim_time.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

// The link-layer header type of the packets in a file, as registered at tcpdump.org.
enum class LinkType : std::uint32_t { radiotap = 127, ieee802154_with_fcs = 195 };

class PcapWriter {
public:
    // Creates or truncates the file. Throws ConfigError, with the path and the reason, if that fails.
    PcapWriter(std::string path, LinkType link_type);

    // Adds a packet. `time`: simulated time ≥ 0, truncated to nanoseconds.
    void write(SimTime time, const Octets& packet);
    // Flushes and closes the file. Throws SimulationError, with the path and the reason, if part of
    // the file could not be written. The destructor does the same without reporting errors.
    void close();

private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void write_octets(const Octets& octets);

    std::string path_;
    std::unique_ptr<std::FILE, Closer> file_;
    int error_ = 0;  // errno of the first write that failed
    Octets record_header_;
};

}  // namespace netsim
