// The success probability of one broadcast frame between two nodes at a distance, with no other
// frame on the air. It is the expected value for a run, computed with the same models of path loss,
// noise and errors. Used to find the transmit power for a range.
//
// If the gain is random, the ratio is the mean over all states of the link. Let s(p) be the success
// probability at received power p, C(x) the probability that the fading gain is at least x, and q
// the received power without fading. The ratio is the mean of s(x q) over x: ∫ C(p / q) ds(p), by
// integration by parts. With other systems (medium/other_systems.hpp), s(p) is the mean over their power O: a
// frame that needs the SNR r is decoded if O ≤ p / r - noise. It assumes that O is constant during a frame.
// Shadowing divides the power p that is needed, so it spreads ds. Antennas face
// each other with their largest gain, without obstacles between them.
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
    // For messages of `payload_bytes` ≥ 0 through wlan[interface] of both nodes. The z coordinates of
    // the initial positions are the heights. Throws ConfigError for a value out of range, a medium
    // without path loss (UnitDiskRadioMedium), a receiver that cannot decode the sender's broadcasts,
    // and a message that does not fit into a frame.
    LinkBudget(const MediumConfig& medium, const NodeConfig& sender, const NodeConfig& receiver,
               int payload_bytes, std::size_t interface = 0);

    // The fraction, 0 to 1, of frames sent with `tx_power_w` ≥ 0 that are decoded at `distance_m` ≥ 0.
    double reception_ratio(double distance_m, double tx_power_w) const;

    // The least power in W at which the fraction `ratio` (0 < ratio < 1) of frames is decoded at
    // `range_m` > 0. Accurate to 0.01 dB if the gain is random; otherwise a few billionths too large,
    // for rounding. Throws ConfigError for numbers out of range, and if no power suffices.
    double tx_power_w_for(double range_m, double ratio) const;

    // Of the sender's frames, in W.
    double tx_power_w() const {
        return netsim::tx_power_w(bitrate_bps(), sender_.radio.tx_power_w,
                                  sender_.radio.tx_power_by_bitrate_w);
    }
    double bitrate_bps() const { return static_cast<double>(mode_->bitrate_bps); }
    int psdu_bytes() const { return psdu_bytes_; }
    // The ratio of the mean received power to the transmitted power.
    double mean_gain(double distance_m) const;
    // At the receiver, in W, without other systems.
    double noise_w() const { return noise_w_; }

private:
    // The power that a fraction of the frames needs to be decoded.
    struct Need {
        double power_w;
        double share;
    };

    // The SNR that a fraction of the frames needs to be decoded.
    struct SnrNeed {
        double snr;
        double share;
    };

    // The least power with which any frame is decoded.
    double min_power_w() const;
    // For a frame that arrives with at least min_power_w().
    double success_probability(double power_w) const;
    // The same for the power of other systems at one moment, as a fraction of all moments.
    double success_with_other_systems(double power_w) const;
    std::vector<SnrNeed> snr_needs() const;
    std::vector<Need> needs() const;
    // The same needs, divided by all gains of the shadowing.
    std::vector<Need> shadowed(const std::vector<Need>& needs) const;
    // The gain without shadowing and fading: antennas and path loss.
    double steady_gain(double distance_m) const;
    // The ratio for frames that would arrive with `power_w` without shadowing and fading.
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
    double other_systems_w_;
    double other_systems_standard_deviation_db_;
    std::vector<SnrNeed> snr_needs_;  // empty without other systems
    std::vector<Need> needs_;         // empty if the gain is not random
};

}  // namespace netsim
