from gradysim.simulator.real_time import FullSpeed, is_full_speed


def test_it_ends_with_the_outermost_context() -> None:
    seen = [is_full_speed()]
    with FullSpeed():
        with FullSpeed():
            seen.append(is_full_speed())
        seen.append(is_full_speed())
    seen.append(is_full_speed())
    assert seen == [False, True, True, False]
