"""Closed form of reception: the NIST error model and free space.

Written from the papers, independent of the engine, to verify it.

Sources: G. Pei and T. R. Henderson, "Validation of OFDM error rate model in ns-3", 2010 (bit errors; the
union bounds are those of the 802.11 convolutional code with generators 133, 171 and its punctured versions).
IEEE 802.11-2020, 17.3.2 (bits of a frame). H. T. Friis, "A note on a simple transmission formula", 1946.
"""

from math import ceil, erfc, exp, log1p, pi, sqrt

SPEED_OF_LIGHT_MPS = 299_792_458.0

# Mbps: (ratio of symbol errors, spread s of the constellation: p = ratio * erfc(sqrt(snir / s)) / 2, code)
_OFDM = {
    6: (1.0, 1, "1/2"),
    9: (1.0, 1, "3/4"),
    12: (1.0, 2, "1/2"),
    18: (1.0, 2, "3/4"),
    24: (3 / 4, 10, "1/2"),
    36: (3 / 4, 10, "3/4"),
    48: (7 / 12, 42, "2/3"),
    54: (7 / 12, 42, "3/4"),
}
# code: (factor, {power of D: coefficient})
_UNION_BOUNDS = {
    "1/2": (
        1 / 2,
        dict(
            zip(
                range(10, 28, 2),
                (36, 211, 1404, 11633, 77433, 502690, 3322763, 21292910, 134365911),
                strict=True,
            )
        ),
    ),
    "2/3": (
        1 / 4,
        dict(
            zip(
                range(6, 16),
                (3, 70, 285, 1276, 6160, 27128, 117019, 498860, 2103891, 8784123),
                strict=True,
            )
        ),
    ),
    "3/4": (
        1 / 6,
        dict(
            zip(
                range(5, 15),
                (42, 201, 1492, 10469, 62935, 379644, 2253373, 13073811, 75152755, 428005675),
                strict=True,
            )
        ),
    ),
}

OFDM_RATES_MBPS = tuple(float(rate) for rate in _OFDM)
DSSS_RATES_MBPS = (1.0, 2.0, 5.5, 11.0)


def bit_error(rate_mbps: float, snir: float) -> float:
    """Return the probability that a data bit is wrong after decoding; `snir` is linear."""
    if rate_mbps in DSSS_RATES_MBPS:
        return _dsss_bit_error(rate_mbps, snir)
    share, spread, code = _OFDM[int(rate_mbps)]
    p = share * erfc(sqrt(snir / spread)) / 2
    d = sqrt(4 * p * (1 - p))
    factor, coefficients = _UNION_BOUNDS[code]
    return min(1.0, factor * sum(coefficient * d**power for power, coefficient in coefficients.items()))


def _dsss_bit_error(rate_mbps: float, snir: float) -> float:
    if rate_mbps == 1:
        return exp(-2 * snir) / 2
    if rate_mbps == 2:
        factor = (sqrt(2) + 1) / sqrt(8 * pi * sqrt(2))
        return min(1.0, factor / sqrt(snir) * exp(-(2 - sqrt(2)) * snir))
    if snir > 10 or snir < 0.1:
        return 0.0 if snir > 10 else 0.5
    if rate_mbps == 5.5:
        return 0.53681634344 * exp(-(((snir - 0.0033092430026) / 0.416543723610) ** 1.02889815344))
    dividend = 0.0079056742265 * snir**2 - 0.18397449399 * snir + 1.07406894673
    return dividend / (snir**3 + 1.05233169046 * snir**2 + 0.30552298746 * snir + 2.20327151287)


def success_probability(rate_mbps: float, snir: float, mpdu_bytes: int) -> float:
    """Return the probability of receiving a frame, header and data; `snir` is linear and constant."""
    if rate_mbps in DSSS_RATES_MBPS:
        header_bits, header_rate, data_bits = 48, 1.0, 8 * mpdu_bytes
    else:
        bits_per_symbol = int(4 * rate_mbps)
        header_bits, header_rate = 24, 6.0
        data_bits = ceil((16 + 8 * mpdu_bytes + 6) / bits_per_symbol) * bits_per_symbol
    header_error, data_error = bit_error(header_rate, snir), bit_error(rate_mbps, snir)
    if header_error >= 1 or data_error >= 1:
        return 0.0
    return exp(header_bits * log1p(-header_error) + data_bits * log1p(-data_error))


def received_power_w(tx_power_w: float, distance_m: float, carrier_hz: float = 2.412e9) -> float:
    """Return the received power over free space with isotropic antennas."""
    wavelength_m = SPEED_OF_LIGHT_MPS / carrier_hz
    return tx_power_w * (wavelength_m / (4 * pi * distance_m)) ** 2
