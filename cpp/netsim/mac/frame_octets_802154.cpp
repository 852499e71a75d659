#include "netsim/mac/frame_octets_802154.hpp"

#include <cstddef>
#include <span>

#include "netsim/error.hpp"
#include "netsim/mac/checksums.hpp"
#include "netsim/mac/datagram_octets.hpp"
#include "netsim/mac/frame_802154.hpp"

namespace netsim {

namespace {

// Frame control field: type, acknowledgment request, addressing mode of the destination.
constexpr unsigned data_type = 0x0001;
constexpr unsigned ack_type = 0x0002;
constexpr unsigned ack_request = 0x0020;
constexpr unsigned short_destination = 0x0800;

constexpr unsigned pan = 1;

}  // namespace

void append_narrowband_frame(Octets& octets, const Frame& frame, bool intact) {
    const std::size_t start = octets.size();
    if (frame.kind == FrameKind::ack) {
        append_le16(octets, ack_type);
        append_u8(octets, frame.sequence);
    } else {
        append_le16(octets, data_type | short_destination | (asks_for_ack(frame) ? ack_request : 0));
        append_u8(octets, frame.sequence);
        append_le16(octets, pan);
        append_le16(octets, static_cast<unsigned>(frame.receiver) & 0xffff);  // a broadcast: 0xffff
        append_datagram(octets, frame);
    }
    const std::uint16_t fcs = narrowband_check_sequence(std::span(octets).subspan(start));
    append_le16(octets, intact ? fcs : ~unsigned{fcs});
    NETSIM_ASSERT(octets.size() - start == static_cast<std::size_t>(frame.psdu_bytes));
}

}  // namespace netsim
