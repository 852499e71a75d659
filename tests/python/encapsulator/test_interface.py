import pytest

from gradysim.encapsulator.interface import IEncapsulator


def test_an_encapsulator_must_have_every_method():
    with pytest.raises(
        TypeError, match=r"encapsulate.*finish.*handle_packet.*handle_telemetry.*handle_timer.*init"
    ):
        IEncapsulator()
