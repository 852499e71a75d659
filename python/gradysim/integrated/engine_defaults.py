"""The defaults of the engine's configurations, for lists of keys."""

from gradysim.integrated.compiled_part import load_netsim
from gradysim.scenario.key_list import Structs
from gradysim.scenario.keys.interface import IEEE802154
from gradysim.scenario.keys.radio_media import IEEE802154_MEDIUM


def engine_defaults() -> Structs:
    """Return the engine's structs as they are made. Raises CompiledPartMissingError."""
    netsim = load_netsim()
    return {
        "medium": {
            "": netsim.MediumConfig(),
            "802.15.4": netsim.MediumConfig(IEEE802154_MEDIUM),
        },
        "interface": {"": netsim.NodeConfig("node").wlan[0]},
        "radio": {
            "": netsim.RadioConfig(),
            "802.15.4": netsim.RadioConfig(IEEE802154.names[0]),
        },
        "antenna": {"": netsim.AntennaConfig()},
        "mac": {"": netsim.MacConfig()},
        "csma": {"": netsim.CsmaConfig()},
        "mobility": {"": netsim.MobilityConfig()},
    }
