"""`gradysim verify`."""

from gradysim.cli.errors import FAILED, MISTAKE, OK

RUN = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out", "--scalars")


def test_complete_files_are_counted(gradysim):
    gradysim(*RUN)
    done = gradysim("verify", "out")
    assert (done.returncode, done.stdout, done.stderr) == (
        OK,
        "out: 6 files are complete and undamaged\n",
        "",
    )


def test_files_that_no_result_names_are_counted(gradysim, folder):
    gradysim(*RUN)
    (folder / "out" / "General-#1.prototype.json").unlink()
    printed = gradysim("verify", "out").stdout.split()
    assert [word for word in printed if word.isdigit()] == ["5", "1"]


def test_each_bad_file_has_a_line(gradysim, folder):
    gradysim(*RUN)
    (folder / "out" / "General-#0.prototype.json").write_text("{}")
    (folder / "out" / "General-#2.prototype.sca").unlink()
    done = gradysim("verify", "out")
    assert (done.returncode, done.stderr) == (FAILED, "")
    assert done.stdout.splitlines() == [
        "out/General-#0.prototype.json: it has no checksum",
        "out/General-#2.prototype.sca: it is missing; out/General-#2.prototype.json names it",
        "out: 2 of 6 files are damaged or missing",
    ]


def test_a_damaged_pack_has_a_line(gradysim, folder):
    gradysim(*RUN)
    gradysim("pack", "out", "--remove")
    pack = folder / "out" / "packs" / "runs.sca"
    pack.write_bytes(pack.read_bytes()[:-1])
    for place in ("out", "out/packs/runs.sca"):
        done = gradysim("verify", place)
        assert done.returncode == FAILED
        assert done.stdout.startswith("out/packs/runs.sca: ")


def test_a_directory_without_results_is_a_mistake(gradysim):
    for directory in (".", "missing"):
        done = gradysim("verify", directory)
        assert (done.returncode, done.stdout) == (MISTAKE, "")
        assert done.stderr.startswith(f"{directory}: ")
