import json

import pytest

from gradysim.protocol.plugin.raft.raft_message import (
    AppendEntries,
    AppendEntriesResponse,
    DiscoveryHeartbeat,
    DiscoveryHeartbeatResponse,
    MessageFactory,
    RaftMessage,
    RequestVote,
    RequestVoteResponse,
    parse_message,
)
from gradysim.protocol.plugin.raft.raft_state import Entry

MESSAGES = [
    RequestVote(4, 2, 7, 3),
    RequestVoteResponse(4, True, 1),
    AppendEntries(
        4, 2, {"v": 1, "w": None}, 9, 2, [0, 2], 8, 3, [Entry(4, "v", [1, "x"]), Entry(4, None, None)]
    ),
    AppendEntriesResponse(4, False, 1, 9),
    DiscoveryHeartbeat(4, 2, 7, 3, answered=[1], known_nodes=[1, 2], cluster_id=5),
    DiscoveryHeartbeatResponse(4, 1, False),
]
PUBLISHED = {
    '{"type": "RequestVote", "term": 1, "candidate_id": 2, "sender_id": 2}': RequestVote(1, 2),
    '{"type": "RequestVoteResponse", "term": 1, "vote_granted": true, "voter_id": 0, "sender_id": 0}': (
        RequestVoteResponse(1, True, 0)
    ),
    '{"type": "AppendEntries", "term": 1, "leader_id": 1, "consensus_values": {"v": 5}, "term_number": 0, '
    '"sender_id": 1, "active_nodes_count": 2, "active_nodes_list": [0, 1]}': (
        AppendEntries(1, 1, {"v": 5}, 0, 2, [0, 1])
    ),
    '{"type": "AppendEntriesResponse", "term": 1, "success": true, "follower_id": 0, "term_number": 0, '
    '"sender_id": 0}': AppendEntriesResponse(1, True, 0, 0),
    '{"type": "DiscoveryHeartbeat", "term": 0, "discoverer_id": 1, "sender_id": 1}': DiscoveryHeartbeat(0, 1),
    '{"type": "DiscoveryHeartbeatResponse", "term": 0, "responder_id": 0, "sender_id": 0}': (
        DiscoveryHeartbeatResponse(0, 0)
    ),
}


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: type(message).__name__)
def test_a_message_survives_the_air(message):
    assert parse_message(message.to_json()) == message


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: type(message).__name__)
def test_every_message_names_its_type_and_sender(message):
    content = json.loads(message.to_json())
    assert (content["type"], content["sender_id"]) == (type(message).__name__, message.sender_id)


@pytest.mark.parametrize("text", PUBLISHED, ids=lambda text: json.loads(text)["type"])
def test_the_published_fields_are_enough(text):
    assert parse_message(text) == PUBLISHED[text]


def test_entries_of_the_log_cross_the_air():
    message = parse_message(MESSAGES[2].to_json())
    log = message.log()
    assert (log.base_index, log.base_term, log.values, log.last_index) == (8, 3, {"v": 1}, 10)


def test_reading_a_message_of_another_type_is_an_error():
    with pytest.raises(ValueError, match="AppendEntriesResponse"):
        RequestVote.from_json(MESSAGES[3].to_json())


NOT_MESSAGES = [
    "garbage",
    "[]",
    "{}",
    '{"type": ["RequestVote"]}',
    '{"type": "Foo"}',
]
WRONG_FIELDS = {
    '{"type": "RequestVote"}': "term",
    '{"type": "RequestVote", "term": 1}': "candidate_id",
    '{"type": "RequestVote", "term": "1", "candidate_id": 2}': "term",
    '{"type": "RequestVote", "term": -1, "candidate_id": 2}': "term",
    '{"type": "RequestVote", "term": true, "candidate_id": 2}': "term",
    '{"type": "RequestVoteResponse", "term": 1, "vote_granted": 1, "voter_id": 2}': "vote_granted",
    '{"type": "AppendEntries", "term": 1, "leader_id": 2, "consensus_values": [], "term_number": 0}': (
        "consensus_values"
    ),
    (
        '{"type": "AppendEntries", "term": 1, "leader_id": 2, "consensus_values": {}, "term_number": 0, '
        '"entries": [[1, 2, 3]]}'
    ): "entries",
    '{"type": "DiscoveryHeartbeat", "term": 1, "discoverer_id": 2, "answered": ["x"]}': "answered",
}


@pytest.mark.parametrize("text", NOT_MESSAGES)
def test_a_text_that_is_not_a_message_is_an_error(text):
    with pytest.raises(ValueError, match="message"):
        parse_message(text)


@pytest.mark.parametrize("text", WRONG_FIELDS)
def test_a_wrong_or_missing_field_is_an_error(text):
    with pytest.raises(ValueError, match=WRONG_FIELDS[text]):
        parse_message(text)


@pytest.fixture
def factory():
    """Return the factory without types registered by others."""
    return type("Factory", (MessageFactory,), {"_message_types": dict(MessageFactory._message_types)})


@pytest.mark.parametrize("message", MESSAGES)
def test_the_factory_reads_all_messages(factory, message):
    assert factory.create_from_json(message.to_json()) == message


def test_the_factory_refuses_what_is_not_json(factory):
    with pytest.raises(ValueError, match="JSON"):
        factory.create_from_json("{")


@pytest.mark.parametrize("text", [*NOT_MESSAGES, *WRONG_FIELDS])
def test_the_factory_refuses_what_is_not_a_message(factory, text):
    with pytest.raises(ValueError, match=r"message|must be"):
        factory.create_from_json(text)


def test_the_factory_takes_more_types(factory):
    class Rumour(RaftMessage):
        @classmethod
        def from_json(cls, json_str):
            return ("heard", json_str)

    factory.register_message_type("Rumour", Rumour)
    assert factory.create_from_json('{"type": "Rumour"}') == ("heard", '{"type": "Rumour"}')


def test_the_factory_takes_no_type_that_cannot_be_read(factory):
    with pytest.raises(ValueError, match="5"):
        factory.register_message_type("Rumour", 5)


@pytest.mark.parametrize(
    ("content", "defaults"),
    [
        ({"type": "RequestVote", "term": 1, "candidate_id": 2}, {"last_log_index": 0, "last_log_term": 0}),
        ({"type": "DiscoveryHeartbeatResponse", "term": 1, "responder_id": 2}, {"would_vote": True}),
        (
            {"type": "AppendEntries", "term": 1, "leader_id": 2, "consensus_values": {}, "term_number": 0},
            {"commit_index": 0, "commit_term": 0, "entries": []},
        ),
        (
            {"type": "DiscoveryHeartbeat", "term": 1, "discoverer_id": 2},
            {"last_log_index": 0, "last_log_term": 0, "answered": []},
        ),
    ],
)
def test_what_nodes_of_the_published_package_leave_out(content, defaults):
    message = parse_message(json.dumps(content))
    assert {name: getattr(message, name) for name in defaults} == defaults
