"""Every key and option that an .ini file may hold: where its value goes, and what it has to be.

The names are INET's and OMNeT++'s. The engine checks the ranges of radio and MAC values; what is refused here
makes no sense in any model. To add a key, add a line to the table of its subject; lists of keys show them in
this order.
"""

from gradysim.scenario.keys.communication_medium import COMMUNICATION_MEDIUM_KEYS
from gradysim.scenario.keys.coordinate_system import COORDINATE_SYSTEM_KEYS
from gradysim.scenario.keys.csma import CSMA_KEYS
from gradysim.scenario.keys.environment import ENVIRONMENT_KEYS
from gradysim.scenario.keys.interface import INTERFACE_KEYS, NUM_WLAN_INTERFACES
from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.mac import MAC_KEYS
from gradysim.scenario.keys.medium import MEDIUM_KEYS
from gradysim.scenario.keys.mobility import MOBILITY_KEYS
from gradysim.scenario.keys.node import PROTOCOL_KEYS
from gradysim.scenario.keys.radio import RADIO_KEYS

WLAN_KEYS: tuple[Key, ...] = (*INTERFACE_KEYS, *MAC_KEYS, *CSMA_KEYS, *RADIO_KEYS)
"""Those below a network interface, here wlan[0]."""

NODE_KEYS: tuple[Key, ...] = (*PROTOCOL_KEYS, *MOBILITY_KEYS, NUM_WLAN_INTERFACES, *WLAN_KEYS)
"""Those below a node, as if each had one interface."""

NETWORK_KEYS: tuple[Key, ...] = (
    *MEDIUM_KEYS,
    *ENVIRONMENT_KEYS,
    *COMMUNICATION_MEDIUM_KEYS,
    *COORDINATE_SYSTEM_KEYS,
)
"""Those below the network."""

NETWORK_MODULES = frozenset(key.path.partition(".")[0] for key in NETWORK_KEYS)
"""Names below the network that are no groups of nodes."""
