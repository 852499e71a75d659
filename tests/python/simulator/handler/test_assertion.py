import pytest

from gradysim.simulator.handler.assertion import (
    AssertionHandler,
    FailedAssertionException,
    SimulationTestCase,
    assert_always_true_for_protocol,
    assert_always_true_for_simulation,
    assert_eventually_true_for_protocol,
    assert_eventually_true_for_simulation,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet


class Counter(Quiet):
    """Counts four timers, at 0, 1, 2 and 3 s."""

    count = 0

    def initialize(self):
        for time in range(4):
            self.provider.schedule_timer("count", time)

    def handle_timer(self, timer):
        self.count += 1


class Other(Counter):
    pass


def run(*cases, protocols=(Counter,)):
    builder = SimulationBuilder(SimulationConfiguration(execution_logging=False))
    builder.add_handler(TimerHandler()).add_handler(AssertionHandler(list(cases)))
    for protocol in protocols:
        builder.add_node(protocol, (0, 0, 0))
    builder.build().start_simulation()


def count(node):
    return node.protocol_encapsulator.protocol.count


def test_its_label():
    assert AssertionHandler([]).get_label() == "assertion"


# Conditions that always hold


def always(limit, protocol=Counter):
    @assert_always_true_for_protocol(protocol, "few", "less than so many")
    def few(node):
        return count(node) < limit

    return few


def test_always_true():
    run(always(5))


def test_not_always_true():
    expected = (
        r'^Assertion "few" \(less than so many\) failed for node 0 \(Counter 0\): '
        r"\[iteration=2 \| timestamp=2.0\]$"
    )
    with pytest.raises(FailedAssertionException, match=expected):
        run(always(3))


class Steps(Counter):
    """Counts at 0.1, 0.2 and 0.30000000000000004 s."""

    def initialize(self):
        self.provider.schedule_timer("count", 0.1)

    def handle_timer(self, timer):
        self.count += 1
        if self.count < 3:
            self.provider.schedule_timer("count", self.provider.current_time() + 0.1)


def test_the_time_is_told_without_the_rests_of_rounding():
    with pytest.raises(FailedAssertionException, match=r"timestamp=0\.3\]$"):
        run(always(3, Steps), protocols=[Steps])


def test_only_nodes_of_the_protocol_are_checked():
    run(always(3, Other), protocols=[Counter])


def test_subclasses_are_of_the_protocol():
    with pytest.raises(FailedAssertionException, match="node 1"):
        run(
            always(3, Counter), protocols=[type("Idle", (Counter,), {"initialize": lambda self: None}), Other]
        )


def test_always_true_of_the_simulation():
    @assert_always_true_for_simulation("sum")
    def few_in_all(nodes):
        return sum(map(count, nodes)) < 8

    run(few_in_all)
    with pytest.raises(FailedAssertionException, match=r'"sum" failed: \[iteration=7 \| timestamp=3.0\]'):
        run(few_in_all, protocols=[Counter, Counter])


def test_a_protocol_whose_file_was_loaded_twice_is_an_error():
    again = type("Counter", (Counter.__base__,), {**vars(Counter), "__module__": __name__})
    with pytest.raises(TypeError, match=r"node 0 .*Counter"):
        run(always(5), protocols=[again])


# Conditions that hold once


def eventually(value, protocol=Counter):
    @assert_eventually_true_for_protocol(protocol, "so many")
    def so_many(node):
        return count(node) == value

    return so_many


def test_eventually_true():
    run(eventually(2), protocols=[Counter, Counter])


def test_never_true():
    with pytest.raises(FailedAssertionException, match=r'"so many" .* node 0 .*, 1 '):
        run(eventually(9), protocols=[Counter, Counter])


def test_it_must_be_true_of_each_node():
    slow = type("Slow", (Counter,), {"handle_timer": lambda self, timer: None})
    with pytest.raises(FailedAssertionException, match=r"node 1 \(Slow 1\): "):
        run(eventually(2), protocols=[Counter, slow])


def test_without_nodes_of_the_protocol_nothing_fails():
    run(eventually(9, Other))


def test_eventually_true_of_the_simulation():
    @assert_eventually_true_for_simulation("sum", "of counts")
    def sum_is_six(nodes):
        return sum(map(count, nodes)) == 6

    run(sum_is_six, protocols=[Counter, Counter])
    with pytest.raises(FailedAssertionException, match=r'"sum" \(of counts\) '):
        run(sum_is_six)


# Test cases


def test_a_case_goes_by_the_name_of_its_predicate():
    case = always(1)
    assert issubclass(case, SimulationTestCase)
    assert (case.__name__, case.__qualname__, case.__module__) == ("few", "always.<locals>.few", __name__)


def test_a_case_of_ones_own():
    seen = []

    class Case(SimulationTestCase):
        def test_iteration(self, nodes, iteration, timestamp):
            seen.append((len(nodes), iteration, timestamp))

        def finalize(self):
            seen.append("finalize")

    run(Case)
    assert seen == [(1, 0, 0), (1, 1, 1), (1, 2, 2), (1, 3, 3), "finalize"]


def test_each_simulation_has_its_own_case():
    builder = SimulationBuilder(SimulationConfiguration(max_iterations=1, execution_logging=False))
    builder.add_handler(TimerHandler()).add_handler(AssertionHandler([eventually(1)]))
    builder.add_node(Counter, (0, 0, 0))
    builder.build().start_simulation()
    builder.build().start_simulation()


@pytest.mark.parametrize("wrong", ["few", len, SimulationTestCase()])
def test_what_is_no_case_is_refused(wrong):
    with pytest.raises(TypeError, match="assert_"):
        AssertionHandler([wrong])


def test_after_a_failure_nothing_more_is_judged(caplog):
    with pytest.raises(FailedAssertionException, match="few"):
        run(eventually(4), always(1))
    assert caplog.messages == []


def test_ctrl_c_is_what_an_interrupted_simulation_ends_with():
    class Interrupted(Counter):
        def handle_timer(self, timer):
            super().handle_timer(timer)
            if self.count == 2:
                raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(eventually(4), protocols=(Interrupted,))


def test_an_exception_of_a_predicate_passes_with_a_note():
    @assert_always_true_for_protocol(Counter, "wrong")
    def wrong(node):
        return count(node) < 2 or node.height > 0

    with pytest.raises(AttributeError, match="height") as error:
        run(always(9), wrong, eventually(1))
    assert error.value.__notes__ == ["in the assertion wrong: [iteration=1 | timestamp=1.0]"]


@pytest.mark.parametrize("raised", [FailedAssertionException, KeyboardInterrupt])
def test_what_says_all_itself_and_ctrl_c_gain_no_note(raised):
    @assert_always_true_for_protocol(Counter, "ends")
    def ends(node):
        raise raised

    with pytest.raises(raised) as error:
        run(ends)
    assert not hasattr(error.value, "__notes__")


def test_a_case_in_the_place_of_their_list_is_refused():
    with pytest.raises(TypeError, match=r"<class .*few'>$"):
        AssertionHandler(always(1))


@pytest.mark.parametrize("decorator", [assert_always_true_for_protocol, assert_eventually_true_for_protocol])
def test_nodes_are_chosen_by_a_class(decorator):
    with pytest.raises(TypeError, match="'Scout'"):
        decorator("Scout", "in reach")
