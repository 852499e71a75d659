import pytest
from hypothesis import given
from hypothesis import strategies as st

from message import (
    GroundHeartbeat,
    Message,
    PairConfirmation,
    PairRequest,
    SensorData,
    UavHeartbeat,
    decode,
    encode,
)

NUMBER = st.integers(min_value=0, max_value=10**9)
MESSAGES = st.one_of(
    st.builds(UavHeartbeat, NUMBER, st.booleans(), st.booleans()),
    st.builds(GroundHeartbeat, NUMBER),
    st.builds(SensorData, NUMBER),
    st.builds(PairRequest, NUMBER, NUMBER, NUMBER),
    st.builds(PairConfirmation, NUMBER, NUMBER, NUMBER),
)


@given(MESSAGES)
def test_a_message_arrives_as_it_was_sent(message: Message) -> None:
    assert decode(encode(message)) == message


def test_the_text_is_compact_json() -> None:
    assert encode(SensorData(sender=4)) == '{"type":"SensorData","sender":4}'


@pytest.mark.parametrize(
    "text",
    [
        "",
        "hello",
        "[]",
        "7",
        "{}",
        '{"type":"Greeting"}',
        '{"type":"SensorData"}',
        '{"type":"SensorData","to":1}',
    ],
)
def test_other_texts_are_refused_with_their_wording(text: str) -> None:
    with pytest.raises(ValueError, match="ZigZag") as caught:
        decode(text)
    assert repr(text) in str(caught.value)
