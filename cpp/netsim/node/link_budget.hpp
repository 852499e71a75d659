// The chances of one broadcast frame from one node to another over a distance, with nobody else on the air: what a run
// shows on average, worked out with the run's own models of path loss, noise and errors. Used to find the transmitter
// power for a wanted range.
//
// Where the gain is random, the share is the mean over all states of the link. Each frame needs some power to be decoded: a
// share s(p) of them no more than p, the chance of success without fading. With C(x) the chance that the fading is at least
// x, and q the power that would arrive without it, the share is ∫ C(p / q) ds(p): integration by parts of the mean of
// s(x q). Antennas look at each other with their largest gain, and no obstacle is between them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/propagation/propagation.hpp"

namespace netsim {

class LinkBudget {
public:
    // For messages of `payload_bytes` ≥ 0 through wlan[interface] of both. The heights of the nodes are the z of their initial positions. Throws
    // ConfigError for a value out of its range, for a medium without path loss (UnitDiskRadioMedium), for nodes of
    // different bands and for a message that does not fit into a frame.
    LinkBudget(const MediumConfig& medium, const NodeConfig& sender, const NodeConfig& receiver,
               int payload_bytes, std::size_t interface = 0);

    // The share of frames sent with `tx_power_w` ≥ 0 that are decoded at `distance_m` ≥ 0, from 0 to 1.
    double reception_ratio(double distance_m, double tx_power_w) const;

    // The least power in W at which at least the share `ratio` (0 < ratio < 1) is decoded at `range_m`, to 0.01 dB where
    // the gain is random, and elsewhere a few billionths more, lest it be too little by rounding. Throws ConfigError for
    // numbers out of their range, and if no power would do.
    double tx_power_w_for(double range_m, double ratio) const;

    double bitrate_bps() const { return static_cast<double>(mode_->bitrate_bps); }
    int psdu_bytes() const { return psdu_bytes_; }
    // The mean power that arrives over the power that is sent.
    double mean_gain(double distance_m) const;
    // At the receiver, in W.
    double noise_w() const { return noise_w_; }

private:
    // What a share of the frames needs to be decoded.
    struct Need {
        double power_w;
        double share;
    };

    // Less is too little for any frame, whatever it is above the noise.
    double least_power_w() const;
    // Of a frame that arrives with at least that.
    double success_probability(double power_w) const;
    std::vector<Need> needs() const;
    // The part of the mean gain that does not fade.
    double steady_gain(double distance_m) const;
    // Of frames that would arrive with `power_w` if nothing faded.
    double ratio_at(double power_w) const;

    Propagation propagation_;
    InterfaceConfig sender_;
    RadioConfig receiver_;
    Band band_;
    double sender_height_m_;
    double receiver_height_m_;
    double antenna_gain_ = 1;
    double noise_w_;
    std::shared_ptr<const ErrorModel> error_model_;
    const Mode* mode_;
    int psdu_bytes_;
    std::vector<Need> needs_;  // where the gain is random
};

}  // namespace netsim
