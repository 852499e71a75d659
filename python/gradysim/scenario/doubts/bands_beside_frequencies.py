"""`radio.bandName` beside `radio.centerFrequency`: no channel is counted in that band, whichever comes first.

The two read as one statement, "2.412 GHz in the band at 5 GHz", of which the first half does nothing. Where
the frequency stands in a section or a file that overrides the band, nothing is said.
"""

from collections.abc import Iterable, Iterator

from gradysim.scenario.errors import Source
from gradysim.scenario.keys.radio import BAND_BESIDE_FREQUENCY, BAND_OF_CHANNEL, CENTER_FREQUENCY
from gradysim.scenario.node.node_spec import NodeSpec


def bands_beside_frequencies(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each, "FILE:LINE: warning: ...", that no interface reads."""
    idle: dict[Source, Source] = {}
    read: set[Source] = set()
    for wlan in {id(wlan): wlan for spec in nodes for wlan in spec.wlan}.values():
        carrier = wlan.radio.get(CENTER_FREQUENCY.field)
        beside = wlan.band.get(BAND_BESIDE_FREQUENCY.field)
        if carrier is not None and beside is not None:
            idle.setdefault(beside.source, carrier.source)
        in_use = (carrier, wlan.band.get(BAND_OF_CHANNEL.field))
        read.update(setting.source for setting in in_use if setting is not None)
    for band, centre in idle.items():
        if band not in read:
            is_near = centre.file == band.file and not (centre.is_override or band.is_override)
            place = f"line {centre.line}" if is_near else f"{centre}"
            yield (
                f"{band}: warning: `{band.key}` has no effect: {place}, `{centre.key}`, says which channel it"
                " is; expected one of them, or a channelNumber in that band"
            )
