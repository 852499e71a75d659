// RTS, CTS and ACK frames, and the duration fields of an exchange.
//
//   RTS --SIFS-- CTS --SIFS-- data --SIFS-- ACK
//
// Each frame announces the time from its own end to the end of the ACK, so that stations that receive
// any of them stay silent.
//
// Source: IEEE 802.11-2020, 9.2.5 (duration fields), 9.3.1 (formats of control frames).
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/mac/response_modes.hpp"
#include "netsim/mac/timing.hpp"

namespace netsim {

inline SimTime data_duration_field(const MacTiming& timing, const ResponseModes& responses,
                                   const Mode& mode) {
    return timing.sifs + responses.to(mode).duration(ack_bytes);
}

inline Frame make_rts(const Frame& data, const MacTiming& timing, const ResponseModes& responses,
                      const Mode& rts_mode, const Mode& data_mode) {
    Frame rts;
    rts.kind = FrameKind::rts;
    rts.transmitter = data.transmitter;
    rts.receiver = data.receiver;
    rts.psdu_bytes = rts_bytes;
    rts.duration_field = timing.sifs + responses.to(rts_mode).duration(cts_bytes) + timing.sifs +
                         data_mode.duration(data.psdu_bytes) + data.duration_field;
    return rts;
}

inline Frame make_cts(const Frame& rts, const MacTiming& timing, const Mode& cts_mode) {
    Frame cts;
    cts.kind = FrameKind::cts;
    cts.transmitter = rts.receiver;
    cts.receiver = rts.transmitter;
    cts.psdu_bytes = cts_bytes;
    cts.duration_field = rts.duration_field - timing.sifs - cts_mode.duration(cts_bytes);
    return cts;
}

inline Frame make_ack(const Frame& data) {
    Frame ack;
    ack.kind = FrameKind::ack;
    ack.transmitter = data.receiver;
    ack.receiver = data.transmitter;
    ack.psdu_bytes = ack_bytes;
    return ack;
}

}  // namespace netsim
