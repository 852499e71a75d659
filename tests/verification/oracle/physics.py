"""Physics of the oracle: path loss, delay, noise, and airtime.

Sources: H. T. Friis, "A note on a simple transmission formula", 1946 (free space). IEEE 802.15.4-2006, annex
E (breakpoint). H. Nyquist, "Thermal agitation of electric charge in conductors", 1928. IEEE 802.11-2020,
15.2, 16.2, 17.4, 18.5 (durations of DSSS, CCK, OFDM and ERP-OFDM frames).
"""

from dataclasses import dataclass
from math import ceil, floor, inf, log1p, log10, pi

from verification.nist import DSSS_RATES_MBPS, SPEED_OF_LIGHT_MPS, bit_error
from verification.oracle.case import Air, Station

BOLTZMANN_J_PER_K = 1.380649e-23


def gain(air: Air, distance_m: float, carrier_hz: float) -> float:
    """Return the ratio of received power after a distance, at most 1."""
    if distance_m == 0:
        return 1.0
    if air.free_space_alpha is not None:
        wavelength_m = SPEED_OF_LIGHT_MPS / carrier_hz
        return float(min(1.0, wavelength_m**2 / (16 * pi**2 * distance_m**air.free_space_alpha)))
    breakpoint_m, near_db, far_db, near_exponent, far_exponent = air.breakpoint
    if distance_m < breakpoint_m:
        loss_db = near_db + 10 * near_exponent * log10(distance_m)
    else:
        loss_db = far_db + 10 * far_exponent * log10(distance_m / breakpoint_m)
    return float(min(1.0, 10 ** (-loss_db / 10)))


def delay_ps(distance_m: float) -> int:
    """Return the propagation delay, to the nearest picosecond."""
    return floor(distance_m / SPEED_OF_LIGHT_MPS * 1e12 + 0.5)


def noise_w(air: Air, station: Station) -> float:
    """Return the power at a station's radio without transmissions."""
    if air.temperature_k is None:
        return air.noise_w
    return BOLTZMANN_J_PER_K * air.temperature_k * station.bandwidth_hz * station.receiver.noise_figure


@dataclass(frozen=True)
class FrameFormat:
    """Parts of a frame on the air: bits and times."""

    rate_mbps: float
    header_rate_mbps: float
    header_bits: int
    data_bits: int
    preamble_us: int
    header_us: int
    data_us: int
    silence_us: int
    """Time at the end, in the 2.4 GHz band."""

    @property
    def duration_us(self) -> int:
        """Total duration."""
        return self.preamble_us + self.header_us + self.data_us + self.silence_us

    def log_header_success(self, snir: float) -> float:
        """Return the logarithm of the probability that the PHY header survives that SNIR."""
        return _log_success(self.header_rate_mbps, self.header_bits, snir)

    def log_data_success(self, snir: float) -> float:
        """Return the logarithm of the probability that the part after the PHY header survives that SNIR."""
        return _log_success(self.rate_mbps, self.data_bits, snir)


def _log_success(rate_mbps: float, bits: int, snir: float) -> float:
    error = bit_error(rate_mbps, snir)
    return -inf if error >= 1 else bits * log1p(-error)


def frame_format(op_mode: str, rate_mbps: float, mpdu_bytes: int) -> FrameFormat:
    """Return the format of a frame with an MPDU of that length, FCS included."""
    bits = 8 * mpdu_bytes
    if rate_mbps in DSSS_RATES_MBPS:
        return FrameFormat(rate_mbps, 1.0, 48, bits, 144, 48, ceil(bits / rate_mbps), 0)
    bits_per_symbol = int(4 * rate_mbps)
    symbols = ceil((16 + bits + 6) / bits_per_symbol)
    silence_us = 6 if op_mode.startswith("g") else 0
    return FrameFormat(rate_mbps, 6.0, 24, symbols * bits_per_symbol, 16, 4, 4 * symbols, silence_us)


def knows_format(op_mode: str, sender_op_mode: str, rate_mbps: float) -> bool:
    """Return whether a station of that operation mode has the sender's mode at that rate.

    OFDM of 5 GHz and of 2.4 GHz are different modes.
    """
    if rate_mbps in DSSS_RATES_MBPS:
        return op_mode in ("b", "g(mixed)")
    of_2_4_ghz = ("g(erp)", "g(mixed)")
    return op_mode in of_2_4_ghz if sender_op_mode in of_2_4_ghz else op_mode == sender_op_mode
