"""The tables are those of OMNeT++ 6.1."""

import re

import pytest

from gradysim.results.omnetpp import RunIdentity, new_database
from python.sqlite_rows import rows_of

IDENTITY = RunIdentity(
    "A-0-20261123-05:00:00-7",
    {"configname": "A", "network": "Field"},
    {"x": "2"},
    (("repeat", "2"), ("**.x", "1"), ("**.x", "2")),
)

ID = "INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL"
OF = "INTEGER NOT NULL REFERENCES {0}({1}) ON DELETE CASCADE"
OF_RUN = OF.format("run", "runId")

SCHEMA = {
    "run": {"runId": ID, "runName": "TEXT NOT NULL", "simtimeExp": "INTEGER NOT NULL"},
    "runAttr": {"runId": OF_RUN, "attrName": "TEXT NOT NULL", "attrValue": "TEXT NOT NULL"},
    "runItervar": {"runId": OF_RUN, "itervarName": "TEXT NOT NULL", "itervarValue": "TEXT NOT NULL"},
    "runConfig": {
        "runId": OF_RUN,
        "configKey": "TEXT NOT NULL",
        "configValue": "TEXT NOT NULL",
        "configOrder": "INTEGER NOT NULL",
    },
    "scalar": {
        "scalarId": ID,
        "runId": OF_RUN,
        "moduleName": "TEXT NOT NULL",
        "scalarName": "TEXT NOT NULL",
        "scalarValue": "REAL",
    },
    "scalarAttr": {
        "scalarId": OF.format("scalar", "scalarId"),
        "attrName": "TEXT NOT NULL",
        "attrValue": "TEXT NOT NULL",
    },
    "parameter": {
        "paramId": ID,
        "runId": OF_RUN,
        "moduleName": "TEXT NOT NULL",
        "paramName": "TEXT NOT NULL",
        "paramValue": "TEXT NOT NULL",
    },
    "paramAttr": {
        "paramId": OF.format("parameter", "paramId"),
        "attrName": "TEXT NOT NULL",
        "attrValue": "TEXT NOT NULL",
    },
    "statistic": {
        "statId": ID,
        "runId": OF_RUN,
        "moduleName": "TEXT NOT NULL",
        "statName": "TEXT NOT NULL",
        "isHistogram": "INTEGER NOT NULL",
        "isWeighted": "INTEGER NOT NULL",
        "statCount": "INTEGER NOT NULL",
        "statMean": "REAL",
        "statStddev": "REAL",
        "statSum": "REAL",
        "statSqrsum": "REAL",
        "statMin": "REAL",
        "statMax": "REAL",
        "statWeights": "REAL",
        "statWeightedSum": "REAL",
        "statSqrSumWeights": "REAL",
        "statWeightedSqrSum": "REAL",
    },
    "statisticAttr": {
        "statId": OF.format("statistic", "statId"),
        "attrName": "TEXT NOT NULL",
        "attrValue": "TEXT NOT NULL",
    },
    "histogramBin": {
        "statId": OF.format("statistic", "statId"),
        "lowerEdge": "REAL NOT NULL",
        "binValue": "REAL NOT NULL",
    },
    "vector": {
        "vectorId": ID,
        "runId": OF_RUN,
        "moduleName": "TEXT NOT NULL",
        "vectorName": "TEXT NOT NULL",
        "vectorCount": "INTEGER",
        "vectorMin": "REAL",
        "vectorMax": "REAL",
        "vectorSum": "REAL",
        "vectorSumSqr": "REAL",
        "startEventNum": "INTEGER",
        "endEventNum": "INTEGER",
        "startSimtimeRaw": "INTEGER",
        "endSimtimeRaw": "INTEGER",
    },
    "vectorAttr": {
        "vectorId": OF.format("vector", "vectorId"),
        "attrName": "TEXT NOT NULL",
        "attrValue": "TEXT NOT NULL",
    },
    "vectorData": {
        "vectorId": OF.format("vector", "vectorId"),
        "eventNumber": "INTEGER NOT NULL",
        "simtimeRaw": "INTEGER NOT NULL",
        "value": "REAL",
    },
}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "a" / "A-#0.prototype.sca"


@pytest.fixture
def rows(path):
    """`rows(query)`: rows of a file with only the attributes of the run."""
    with new_database(path, IDENTITY):
        pass

    def of(query):
        return rows_of(path, query)

    return of


def test_tables_columns_and_types(rows):
    found = {}
    for name, sql in rows("SELECT name, sql FROM sqlite_master WHERE name NOT LIKE 'sqlite_%'"):
        columns = re.fullmatch(r"CREATE TABLE \w+ \((.*)\)", sql)[1].split(", ")
        found[name] = dict(column.split(" ", 1) for column in columns)
    assert found == SCHEMA


def test_the_run(rows):
    assert rows("SELECT * FROM run") == [(1, "A-0-20261123-05:00:00-7", -12)]
    assert rows("SELECT * FROM runAttr") == [(1, "configname", "A"), (1, "network", "Field")]
    assert rows("SELECT * FROM runItervar") == [(1, "x", "2")]
    assert rows("SELECT * FROM runConfig") == [
        (1, "repeat", "2", 0),
        (1, "**.x", "1", 1),
        (1, "**.x", "2", 2),
    ]


def test_an_earlier_file_is_replaced(path):
    path.parent.mkdir()
    path.write_text("an earlier file")
    with new_database(path, IDENTITY):
        pass
    assert path.read_bytes().startswith(b"SQLite format 3\0")


def test_what_fails_half_way_leaves_the_earlier_file(path):
    path.parent.mkdir()
    path.write_text("an earlier file")
    with pytest.raises(KeyboardInterrupt), new_database(path, IDENTITY):
        raise KeyboardInterrupt
    assert [file.name for file in path.parent.iterdir()] == [path.name]
    assert path.read_text() == "an earlier file"


def test_what_sqlite_cannot_do_is_an_error_about_the_file(path):
    with (
        pytest.raises(OSError, match="missing") as raised,
        new_database(path, IDENTITY) as database,
    ):
        database.execute("INSERT INTO missing VALUES (1)")
    assert raised.value.filename == str(path)


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path):
    (tmp_path / "taken").write_text("")
    with (
        pytest.raises(OSError, match="taken"),
        new_database(tmp_path / "taken" / "A.sca", IDENTITY),
    ):
        pass


def test_a_folder_in_its_place_is_an_error_about_the_file(path):
    path.mkdir(parents=True)
    with pytest.raises(IsADirectoryError) as raised, new_database(path, IDENTITY):
        pass
    assert raised.value.filename == str(path)
    assert list(path.parent.iterdir()) == [path]


def test_what_no_file_can_hold_is_written_in_another_way(path):
    identity = RunIdentity("A", {"configname": "\ud800"}, {}, ())
    with new_database(path, identity) as database:
        assert database.execute("SELECT attrValue FROM runAttr").fetchall() == [("\\ud800",)]
