from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    CommunicationCommandType,
    SendMessageCommand,
)


def test_send_names_its_destination():
    command = SendMessageCommand("hello", 3)
    assert (command.command_type, command.message, command.destination) == (
        CommunicationCommandType.SEND,
        "hello",
        3,
    )


def test_broadcast_has_no_destination():
    command = BroadcastMessageCommand("hello")
    assert (command.command_type, command.message, command.destination) == (
        CommunicationCommandType.BROADCAST,
        "hello",
        None,
    )


def test_the_types_have_the_published_numbers():
    assert (CommunicationCommandType.SEND, CommunicationCommandType.BROADCAST) == (0, 1)


def test_commands_of_one_class_are_equal_if_their_values_are():
    assert SendMessageCommand("a", 1) == SendMessageCommand("a", 1)
    assert SendMessageCommand("a", 1) != CommunicationCommand(CommunicationCommandType.SEND, "a", 1)
