"""The messages between nodes: JSON objects with a `type`.

Every message also has the sender's cluster and the members that the sender knows. Fields with a default may
be missing, as in messages of gradysim 0.8.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Self

from gradysim.protocol.plugin.raft.raft_state import Entry, RaftLog


@dataclass(kw_only=True)
class RaftMessage:
    """Fields of all messages.

    Attributes:
        cluster_id: Cluster of the sender, None if none was set.
        known_nodes: Members that the sender knows. Missing if its members were set.
    """

    SENDER: ClassVar[str]

    cluster_id: int | None = None
    known_nodes: list[int] | None = None

    @property
    def sender_id(self) -> int:
        """Id of the node that sent the message."""
        sender: int = getattr(self, self.SENDER)
        return sender

    def to_json(self) -> str:
        """Return the message as JSON."""
        content: dict[str, Any] = {"type": type(self).__name__}
        for each in fields(self):
            value = getattr(self, each.name)
            if value is not None:
                content[each.name] = value
        content["sender_id"] = self.sender_id
        return json.dumps(content)

    @classmethod
    def from_json(cls, json_str: str) -> Self:
        """Read a message of this type. Raise ValueError if the string is not one."""
        message = parse_message(json_str)
        if not isinstance(message, cls):
            raise ValueError(f"expected a {cls.__name__}, got a {type(message).__name__}")
        return message


@dataclass
class RequestVote(RaftMessage):
    """Request of a candidate for votes. Its log ends at `last_log_index`, with term `last_log_term`."""

    SENDER: ClassVar[str] = "candidate_id"

    term: int
    candidate_id: int
    last_log_index: int = 0
    last_log_term: int = 0


@dataclass
class RequestVoteResponse(RaftMessage):
    """Answer to `RequestVote`. `term` is the voter's term: the election's if the vote was granted."""

    SENDER: ClassVar[str] = "voter_id"

    term: int
    vote_granted: bool
    voter_id: int


@dataclass
class AppendEntries(RaftMessage):
    """Heartbeat of the leader, with its whole log.

    Attributes:
        term: Term of the leader.
        leader_id: Id of the leader.
        consensus_values: Committed value of each variable, or None if there is none.
        term_number: Index of the last entry of the log.
        active_nodes_count: Number of nodes that the leader considers active.
        active_nodes_list: Their ids.
        commit_index: Index of the last committed entry.
        commit_term: Term of that entry.
        entries: The entries after it, as (term, name, value).
    """

    SENDER: ClassVar[str] = "leader_id"

    term: int
    leader_id: int
    consensus_values: dict[str, Any]
    term_number: int
    active_nodes_count: int | None = None
    active_nodes_list: list[int] | None = None
    commit_index: int = 0
    commit_term: int = 0
    entries: list[Entry] = field(default_factory=list)

    def log(self) -> RaftLog:
        """Return the leader's log."""
        values = {name: value for name, value in self.consensus_values.items() if value is not None}
        return RaftLog(self.commit_index, self.commit_term, values, self.entries)


@dataclass
class AppendEntriesResponse(RaftMessage):
    """Answer to `AppendEntries`. On success the follower has the leader's log up to entry `term_number`."""

    SENDER: ClassVar[str] = "follower_id"

    term: int
    success: bool
    follower_id: int
    term_number: int


@dataclass
class DiscoveryHeartbeat(RaftMessage):
    """Request before an election: asks which nodes are there and would vote for the sender.

    Attributes:
        term: Term of the sender.
        discoverer_id: Id of the sender.
        last_log_index: Index of the last entry of its log.
        last_log_term: Term of that entry.
        answered: Ids of the nodes that have answered already.
    """

    SENDER: ClassVar[str] = "discoverer_id"

    term: int
    discoverer_id: int
    last_log_index: int = 0
    last_log_term: int = 0
    answered: list[int] = field(default_factory=list)


@dataclass
class DiscoveryHeartbeatResponse(RaftMessage):
    """Answer to `DiscoveryHeartbeat`: whether the node would vote for the sender."""

    SENDER: ClassVar[str] = "responder_id"

    term: int
    responder_id: int
    would_vote: bool = True


def parse_message(text: str) -> RaftMessage:
    """Read a message of any type.

    Raise ValueError if the string is not JSON or not a message, or a field is missing or has a wrong type.
    """
    content = _content_of(text)
    message_type = _TYPES.get(str(content.get("type")))
    if message_type is None:
        raise ValueError(
            f"unknown type of message {content.get('type')!r}, expected one of {', '.join(_TYPES)}"
        )
    arguments = {
        name: _read(content, name, check, expected)
        for name, (check, expected) in _CHECKS_OF_FIELDS[message_type].items()
        if name in content
    }
    try:
        return message_type(**arguments)
    except TypeError as error:  # an argument without a default is missing
        raise ValueError(f"incomplete message: {error}") from None


def _content_of(text: str) -> Mapping[str, Any]:
    try:
        content = json.loads(text)
    except ValueError as error:
        raise ValueError(f"a message must be JSON: {error}") from None
    if not isinstance(content, dict):
        raise ValueError(f"a message must be a JSON object, got {text[:80]!r}")
    return content


def _read(content: Mapping[str, Any], name: str, check: Callable[[Any], bool], expected: str) -> Any:
    value = content[name]
    if not check(value):
        raise ValueError(f"{name} of a {content['type']} must be {expected}, got {value!r}")
    return [Entry(*entry) for entry in value] if name == "entries" else value


def _is_natural(value: object) -> bool:
    return type(value) is int and value >= 0


def _is_ids(value: object) -> bool:
    return isinstance(value, list) and {*map(type, value)} <= {int} and min(value, default=0) >= 0


def _is_entry(value: object) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 3
        and _is_natural(value[0])
        and (value[1] is None or isinstance(value[1], str))
    )


_CHECKS: Mapping[Any, tuple[Callable[[Any], bool], str]] = {
    int: (_is_natural, "an integer >= 0"),
    int | None: (lambda value: value is None or _is_natural(value), "an integer >= 0 or null"),
    bool: (lambda value: isinstance(value, bool), "true or false"),
    list[int]: (_is_ids, "a list of ids"),
    list[int] | None: (lambda value: value is None or _is_ids(value), "a list of ids or null"),
    dict[str, Any]: (lambda value: isinstance(value, dict), "an object"),
    list[Entry]: (
        lambda value: isinstance(value, list) and all(map(_is_entry, value)),
        "a list of [term, name, value]",
    ),
}
"""Check and description of the valid values, for each type of field."""

_TYPES: dict[str, type[RaftMessage]] = {kind.__name__: kind for kind in RaftMessage.__subclasses__()}
_CHECKS_OF_FIELDS = {
    message_type: {each.name: _CHECKS[each.type] for each in fields(message_type)}
    for message_type in _TYPES.values()
}


class MessageFactory:
    """Reader of messages, as in gradysim 0.8. The consensus itself does not use types registered here."""

    _message_types: ClassVar[dict[str, type[RaftMessage]]] = dict(_TYPES)

    @classmethod
    def create_from_json(cls, json_str: str) -> RaftMessage:
        """Read a message of any registered type with the `from_json` of its class.

        Raise ValueError if the string is not JSON or not a message.
        """
        message_type = cls._message_types.get(str(_content_of(json_str).get("type")))
        return parse_message(json_str) if message_type is None else message_type.from_json(json_str)

    @classmethod
    def register_message_type(cls, message_type: str, message_class: type[RaftMessage]) -> None:
        """Read messages of that `type` with that class, in this process and from now on.

        Raise ValueError if the class has no `from_json`.
        """
        if not isinstance(message_class, type) or not callable(getattr(message_class, "from_json", None)):
            raise ValueError(f"expected a message class with from_json, got {message_class!r}")
        cls._message_types[message_type] = message_class
