import math
from array import array

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gradysim.results import read_scalars, read_vectors
from gradysim.results.omnetpp import RunIdentity, write_scalar_file, write_vector_file
from gradysim.results.omnetpp_reader import recorded_modules, run_attributes
from gradysim.results.quantity import Scalar
from gradysim.results.recorder import NodeRecorder, Vector
from python.damage import damaged

IDENTITY = RunIdentity(
    "A-0-20261123-05:00:00-7", {"mode": "prototype", "x": "an attribute"}, {"x": "2", "y": "3"}, ()
)


@pytest.fixture
def scalar_file(tmp_path):
    path = tmp_path / "A.sca"
    found = [
        Scalar("N.uavs[0].protocol", "heard:last", 5.0, {"unit": "s", "mode": "hidden"}),
        Scalar("N.uavs[0].protocol", "rate:last", math.nan),
        Scalar("N.uavs[0].protocol", "far:last", -math.inf),
    ]
    write_scalar_file(found, IDENTITY, path)
    return path


def test_a_row_for_each_scalar(scalar_file):
    row, nan, infinite = read_scalars(scalar_file)
    assert row == {
        "runID": "A-0-20261123-05:00:00-7",
        "module": "N.uavs[0].protocol",
        "name": "heard:last",
        "value": 5.0,
        "$x": "2",
        "y": "3",
        "mode": "prototype",
        "x": "an attribute",
        "unit": "s",
    }
    assert list(row)[:4] == ["runID", "module", "name", "value"]
    assert math.isnan(nan["value"])
    assert infinite["value"] == -math.inf


@pytest.mark.parametrize("variable", ["runID", "module", "name", "value", "unit", "title", "source"])
def test_a_variable_that_is_called_as_a_column_has_another_name(tmp_path, variable):
    identity = RunIdentity("A", {}, {variable: "2"}, ())
    write_scalar_file([Scalar("N", "heard:last", 5.0)], identity, tmp_path / "A.sca")
    (row,) = read_scalars(tmp_path / "A.sca")
    assert row == {"runID": "A", "module": "N", "name": "heard:last", "value": 5.0, f"${variable}": "2"}


def test_several_files(scalar_file):
    assert len(read_scalars([scalar_file, str(scalar_file)])) == 6
    assert read_scalars([]) == []


def test_a_row_for_each_vector(tmp_path):
    vector = Vector("protocol", "v", array("q", [1, 2_500_000_000_000]), array("d", [3.0, math.nan]), "m")
    write_vector_file([("N.a.protocol", vector)], IDENTITY, tmp_path / "A.vec")
    (row,) = read_vectors(tmp_path / "A.vec")
    assert (row["module"], row["name"], row["unit"], row["$x"]) == ("N.a.protocol", "v:vector", "m", "2")
    assert row["vectime"] == array("d", [1e-12, 2.5])
    assert row["vecvalue"][0] == 3.0
    assert math.isnan(row["vecvalue"][1])
    assert "value" not in row


@given(
    st.lists(
        st.tuples(
            st.integers(0, 9_200_000 * 10**12),
            st.sampled_from(["heard", "sent", "a[0] b"]),
            st.one_of(
                st.integers(-(2**53), 2**53), st.floats(), st.booleans(), st.text(max_size=3), st.none()
            ),
        ),
        max_size=30,
    )
)
def test_what_was_tracked_comes_back(tmp_path_factory, changes):
    changes.sort(key=lambda change: change[0])
    recorder = NodeRecorder()
    expected = {}
    for time_ps, name, value in changes:
        recorder.variable_set(time_ps, name, value)
        is_number = isinstance(value, int | float)
        if is_number or name in expected:
            number = float(value) if is_number else math.nan
            number += 0.0  # SQLite does not store -0.0
            rows = expected.setdefault(name, [])
            if not rows or rows[-1][1] != str(number):  # a change
                rows.append((time_ps / 10**12, str(number)))
    path = tmp_path_factory.mktemp("vectors") / "A.vec"
    vectors = [(f"N.a.{vector.part}", vector) for vector in recorder.vectors()]
    write_vector_file(vectors, IDENTITY, path)
    found = {
        row["name"].removesuffix(":vector"): list(zip(row["vectime"], map(str, row["vecvalue"]), strict=True))
        for row in read_vectors(path)
        if row["module"] == "N.a.protocol"
    }
    assert found == expected


def test_only_those_that_are_wanted(tmp_path, scalar_file):
    vectors = [
        ("N.a.protocol", Vector("protocol", name, array("q", [1, 2]), array("d", [number, number])))
        for number, name in enumerate(["heard", "sent", "lost"])
    ]
    write_vector_file(vectors, IDENTITY, tmp_path / "A.vec")
    found = read_vectors(tmp_path / "A.vec", ["lost:vector", "heard:vector", "other:vector"])
    assert [(row["name"], list(row["vecvalue"])) for row in found] == [
        ("heard:vector", [0, 0]),
        ("lost:vector", [2, 2]),
    ]
    assert [row["name"] for row in read_scalars(scalar_file, ["far:last"])] == ["far:last"]
    assert read_scalars(scalar_file, []) == []


@pytest.mark.parametrize(
    ("names", "found"),
    [
        ("far:last", ["far:last"]),
        ("*a*:last", ["heard:last", "rate:last", "far:last"]),
        (["rate:*", "f?r:last"], ["rate:last", "far:last"]),
        ("rate", []),
        ("", []),
    ],
)
def test_a_single_name_and_patterns(scalar_file, names, found):
    assert [row["name"] for row in read_scalars(scalar_file, names)] == found


def test_brackets_in_names_are_no_pattern(tmp_path):
    names = ("a[0]:last", "a0:last", "A[0]:last")
    write_scalar_file([Scalar("N", name, 1.0) for name in names], IDENTITY, tmp_path / "A.sca")
    assert [row["name"] for row in read_scalars(tmp_path / "A.sca", "a[0]:*")] == ["a[0]:last"]


def test_a_file_that_is_not_there_is_an_error(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"missing\.sca"):
        read_scalars(tmp_path / "missing.sca")


@pytest.mark.parametrize("content", [b"version 3\nrun A-0\n", b""])
def test_a_file_of_another_kind_is_an_error(tmp_path, content):
    path = tmp_path / "A.vec"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"A\.vec: .*SQLite"):
        read_vectors(path)


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    """Return the content of a file of scalars and of a file of vectors."""
    files = [tmp_path_factory.mktemp("contents") / name for name in ("A.sca", "A.vec")]
    vector = Vector("protocol", "heard", array("q", range(500)), array("d", range(500)))
    write_scalar_file([Scalar("N", f"{i}:last", i) for i in range(100)], IDENTITY, files[0])
    write_vector_file([("N.a.protocol", vector)], IDENTITY, files[1])
    return [file.read_bytes() for file in files]


@given(random=st.randoms(use_true_random=False))
@settings(deadline=None, max_examples=40)
def test_a_damaged_file_is_read_or_an_error_that_names_it(tmp_path_factory, contents, random):
    path = tmp_path_factory.getbasetemp() / "damaged"
    for content, read in zip(contents, (read_scalars, read_vectors), strict=True):
        path.write_bytes(damaged(content, random))
        try:
            read(path)
        except ValueError as error:
            assert str(error).startswith(f"{path}: ")  # noqa: PT017 (not every file is an error)
        assert isinstance(run_attributes(path), dict)
        assert isinstance(recorded_modules(path), set)


def test_it_knows_which_modules_have_vectors(tmp_path):
    vector = Vector("mobility", "positionX", array("q"), array("d"))
    write_vector_file([("N.a.mobility", vector)], IDENTITY, tmp_path / "A.vec")
    (tmp_path / "other.vec").write_text("version 3")
    assert recorded_modules(tmp_path / "A.vec") == {"N.a.mobility"}
    assert recorded_modules(tmp_path / "other.vec") == set()
    assert recorded_modules(tmp_path / "missing.vec") == set()


def test_it_knows_of_which_run_a_file_is(tmp_path, scalar_file):
    assert run_attributes(scalar_file) == {"runID": IDENTITY.name, **IDENTITY.attributes}
    for name, content in (("other.sca", b"version 3"), ("empty.sca", b"")):
        (tmp_path / name).write_bytes(content)
        assert run_attributes(tmp_path / name) == {}
    assert run_attributes(tmp_path / "missing.sca") == {}
    assert run_attributes(tmp_path) == {}
