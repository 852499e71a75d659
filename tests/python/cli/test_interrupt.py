import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from gradysim.cli.interrupt import FORWARDED, KILLING, StopOnInterrupt
from python.cli.command import environment


def test_nothing_was_pressed():
    with StopOnInterrupt() as interrupt:
        assert not interrupt.should_stop()


def test_the_first_press_is_a_wish():
    with StopOnInterrupt() as interrupt:
        signal.raise_signal(signal.SIGINT)
        assert interrupt.should_stop()


def test_the_first_press_is_answered_with_what_a_second_one_does(capfd):
    with StopOnInterrupt():
        signal.raise_signal(signal.SIGINT)
    assert "Ctrl-C" in capfd.readouterr().err


def test_the_second_press_is_an_order():
    with StopOnInterrupt():
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


def test_where_nothing_is_lost_the_first_press_is_an_order():
    with StopOnInterrupt() as interrupt:
        with pytest.raises(KeyboardInterrupt), interrupt.at_once():
            signal.raise_signal(signal.SIGINT)
        assert interrupt.should_stop()


def test_behind_it_the_first_press_is_a_wish_again():
    with StopOnInterrupt() as interrupt:
        with interrupt.at_once():
            pass
        signal.raise_signal(signal.SIGINT)
        assert interrupt.should_stop()
        with pytest.raises(KeyboardInterrupt), interrupt.at_once():
            pytest.fail("it was pressed before")


def test_with_a_time_limit_one_press_is_enough():
    with StopOnInterrupt(grace_s=0.1) as interrupt:
        signal.raise_signal(signal.SIGINT)
        assert interrupt.should_stop()
        with pytest.raises(KeyboardInterrupt):
            time.sleep(30)


def test_a_process_that_is_not_done_after_a_press_ends():
    program = """
        import signal, time
        from gradysim.cli.interrupt import StopOnInterrupt
        with StopOnInterrupt(grace_s=0.01):
            signal.raise_signal(signal.SIGTERM)
            while True:
                try:
                    time.sleep(30)
                except KeyboardInterrupt:
                    pass
    """
    command = [sys.executable, "-c", textwrap.dedent(program)]
    assert subprocess.run(command, env=environment(), timeout=20).returncode == 143


def test_afterwards_all_is_as_before():
    before = signal.getsignal(signal.SIGINT)
    with StopOnInterrupt():
        pass
    assert signal.getsignal(signal.SIGINT) is before


def test_in_another_thread_it_does_no_harm():
    answers = []

    def work():
        with StopOnInterrupt() as interrupt:
            answers.append(interrupt.should_stop())

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert answers == [False]


def test_presses_are_passed_on_to_workers_and_the_third_one_raises(monkeypatch):
    sent = []
    monkeypatch.setattr(os, "kill", lambda *signal: sent.append(signal))
    with StopOnInterrupt(raises_at=KILLING) as interrupt:
        interrupt.workers = [11, 12]
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    assert sent == [(11, FORWARDED), (12, FORWARDED)] * 3


def test_a_worker_counts_one_press_that_terminal_and_command_tell_of_once():
    before = signal.getsignal(FORWARDED)
    try:
        with StopOnInterrupt() as interrupt:
            interrupt.become_worker()
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(FORWARDED)
            assert interrupt.should_stop()
            with pytest.raises(KeyboardInterrupt), interrupt.executing():
                signal.raise_signal(FORWARDED)
            signal.raise_signal(signal.SIGINT)  # same sender, second press
    finally:
        signal.signal(FORWARDED, before)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_the_press_after_a_signal_comes_by_itself(number):
    with StopOnInterrupt() as interrupt:
        signal.raise_signal(number)
        signal.raise_signal(number)  # from another sender
        assert (interrupt.should_stop(), interrupt.exit_code) == (True, 128 + number)
        assert signal.getitimer(signal.ITIMER_REAL)[0] > 0
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGALRM)
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)


def test_a_worker_that_writes_results_is_not_interrupted():
    before = signal.getsignal(FORWARDED)
    try:
        with StopOnInterrupt() as interrupt:
            interrupt.become_worker()
            for _ in range(5):
                signal.raise_signal(FORWARDED)
            assert interrupt.should_stop()
    finally:
        signal.signal(FORWARDED, before)
