import gc
import logging
import weakref

from simulated import build, protocol, timers


def test_simulations_stepped_in_turn_log_their_own_lines(tmp_path):
    def logs(name):
        def handle_timer(self, timer):
            logging.getLogger(name).info("%s at %s", name, timer)

        tested = timers(1, 2)
        tested.handle_timer = handle_timer
        return tested

    simulators = [build(logs(name), log_file=tmp_path / name) for name in ("first", "second")]
    while sum(simulator.step_simulation() for simulator in simulators) > 0:
        pass
    for name in ("first", "second"):
        lines = (tmp_path / name).read_text().splitlines()
        assert [line.split("] ")[-1] for line in lines[1:3]] == [f"{name} at 1", f"{name} at 2"]
        assert sum("finished" in line for line in lines) == sum("started" in line for line in lines) == 1


def test_lines_say_when_and_to_whom(capsys):
    def handle_timer(self, timer):
        logging.getLogger().info("hello")

    tested = timers(7.5)
    tested.handle_timer = handle_timer
    build(tested).start_simulation()
    assert "INFO     [it=0 time=0:00:07.500000 | Tested 0 handle_timer] hello\n" in capsys.readouterr().err


def test_lines_of_initialize_and_finish_say_to_whom(capsys):
    def log(self):
        logging.getLogger().info("hello")

    build(protocol(initialize=log, finish=log)).start_simulation()
    lines = [line for line in capsys.readouterr().err.splitlines() if line.endswith("hello")]
    assert lines == [
        f"INFO     [it=0 time=0:00:00 | Tested 0 {context}] hello"
        for context in ("Initialization", "Finalization")
    ]


def test_lines_between_two_steps_belong_to_no_event(capsys):
    simulator = build(timers(1, 2))
    simulator.step_simulation()
    logging.getLogger().info("between")
    simulator.finalize()
    assert "     between\n" in capsys.readouterr().err


def test_the_course_of_the_simulation_is_logged(capsys):
    build(timers(1)).start_simulation()
    lines = capsys.readouterr().err
    assert all(part in lines for part in ("started", "finished", ": 1\t", ": 0:00:01"))


def test_the_wall_time_of_the_run_is_logged(capsys, monkeypatch):
    clock = iter([1000.0, 1090.0])
    monkeypatch.setattr("time.monotonic", lambda: next(clock))
    build(timers(1)).start_simulation()
    assert ": 0:01:30\t" in capsys.readouterr().err


def test_the_log_can_be_turned_off(capsys):
    build(timers(1), execution_logging=False).start_simulation()
    assert capsys.readouterr().err == ""


def test_a_quiet_simulation_stays_quiet_beside_another(capsys):
    def handle_timer(self, timer):
        logging.getLogger().info("hello")

    tested = timers(1, 2)
    tested.handle_timer = handle_timer
    simulators = [build(timers(1, 2)), build(tested, execution_logging=False)]
    for simulator in simulators:
        simulator.step_simulation()
    for simulator in simulators:
        simulator.finalize()
    assert "hello" not in capsys.readouterr().err


def test_the_log_goes_to_a_file_too(tmp_path):
    build(timers(1), log_file=tmp_path / "run.log").start_simulation()
    assert "finished" in (tmp_path / "run.log").read_text()


def test_the_profile_is_logged_at_the_end(capsys):
    build(timers(1, 2), profile=True, execution_logging=False).start_simulation()
    assert ["Tested", "0", "handle_timer", "2"] in [
        line.split()[:4] for line in capsys.readouterr().err.splitlines()
    ]


def test_the_profile_knows_the_events_of_single_steps(capsys):
    simulator = build(timers(1, 2), profile=True, execution_logging=False)
    while simulator.step_simulation():
        pass
    assert ["Tested", "0", "handle_timer", "2"] in [
        line.split()[:4] for line in capsys.readouterr().err.splitlines()
    ]


def test_a_dropped_simulation_leaves_no_log_handler():
    simulator = build(timers(1, 2))
    simulator.step_simulation()
    del simulator
    gc.collect()


def test_a_simulation_that_ended_is_not_kept():
    simulator = build(timers(1))
    simulator.start_simulation()
    gone = weakref.ref(simulator)
    del simulator
    gc.collect()
    assert gone() is None


def test_the_scope_of_a_line_can_be_set(capsys):
    simulator = build(timers(1, 2))
    simulator.step_simulation()
    simulator.scope_event(41, 60, "elsewhere")
    logging.getLogger().info("hello")
    simulator.finalize()
    assert "[it=41 time=0:01:00 | elsewhere] hello" in capsys.readouterr().err
