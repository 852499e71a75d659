#include "netsim/mac/response_modes.hpp"

#include <algorithm>
#include <functional>

namespace netsim {

ResponseModes::ResponseModes(const MacConfig& config) : modes_(mode_set(config.op_mode)) {
    for (const double bitrate_bps : config.basic_bitrates_bps) {
        basic_.push_back(&modes_.mode_for_bitrate(bitrate_bps, "mac.basic_bitrates_bps"));
    }
    std::ranges::sort(basic_, std::greater(), &Mode::bitrate_bps);
}

const Mode& ResponseModes::to(const Mode& received) const {
    const auto response = std::ranges::find_if(basic_, [&received](const Mode* mode) {
        return mode->bitrate_bps <= received.bitrate_bps && mode->format == received.format;
    });
    return response == basic_.end() ? modes_.response_mode(received) : **response;
}

}  // namespace netsim
