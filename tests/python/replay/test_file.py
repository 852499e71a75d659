import pytest

from gradysim.replay.file import FORMAT, ReplayFile, read_parts


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.html"


def test_what_is_written_is_read(path):
    file = ReplayFile(path)
    file.begin({"config": "</script><b>"})
    file.add(b"one")
    file.add(b"two")
    file.end({"complete": True})
    file.close()
    run, chunks, end = read_parts(path)
    assert run == {"format": FORMAT, "config": "</script><b>"}
    assert list(chunks) == [b"one", b"two"]
    assert end == {"complete": True}


def test_a_file_that_was_cut_off_has_its_first_chunks(path):
    file = ReplayFile(path)
    file.begin({})
    file.add(b"one")
    size = path.stat().st_size
    file.add(b"two")
    file.end({})
    file.close()
    path.write_bytes(path.read_bytes()[: size + 40])
    _, chunks, end = read_parts(path)
    assert list(chunks) == [b"one"]
    assert end is None


@pytest.mark.parametrize(
    "text",
    [
        b"<html></html>",
        b"\xff",
        b'<script type="application/json" id="gradysim-run">{"format": 99}</script>',
        b'<script type="application/json" id="gradysim-run">[1]</script>',
        b'<script type="application/json" id="gradysim-run">{"for</script>',
        b'<script type="application/json" id="gradysim-run">' + b"[" * 100_000 + b"</script>",
    ],
)
def test_another_file_is_refused(path, text):
    path.write_bytes(text)
    with pytest.raises(ValueError, match="replay") as refused:
        read_parts(path)
    assert str(refused.value).startswith(f"{path}: ")
    assert len(str(refused.value)) < 200
