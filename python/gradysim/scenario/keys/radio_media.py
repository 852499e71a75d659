"""The models of the air that have radios; with another one, nothing reads keys of radio, MAC and antenna."""

from gradysim.scenario.keys.key import ReadBy

IEEE802154_MEDIUM = "Ieee802154NarrowbandScalarRadioMedium"

RADIO_MEDIA = ReadBy("medium.typename", ("Ieee80211ScalarRadioMedium", IEEE802154_MEDIUM), shown="")


def has_radios(medium_typename: object) -> bool:
    """Whether it is one of them, where powers make ranges; in others the range itself counts."""
    return medium_typename in RADIO_MEDIA.names
