"""The models of the air that have radios; with another one, nothing reads keys of radio, MAC and antenna."""

from gradysim.config.keys.key import ReadBy

RADIO_MEDIA = ReadBy(
    "medium.typename", ("Ieee80211ScalarRadioMedium", "Ieee802154NarrowbandScalarRadioMedium"), shown=""
)
