"""The program as a process of its own: exit codes, signals, pipes, and runs that are stopped and go on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from functools import cache

import pytest

import holdfast as hf
from holdfast import arms, load
from holdfast.core.sweeps import Store

PROGRAM = [sys.executable, "-m", "holdfast"]
POSES = 1_500_000  # 12 chunks, about a second


def run(*arguments, **options):
    return subprocess.run([*PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=60, **options)


@pytest.fixture
def joints(tmp_path):
    file = tmp_path / "joints.yaml"
    file.write_text("name: joint range\njoints: {lower: [-2, -2, -2], upper: [2, 2, 2]}\n")
    return file


def start(folder, joints, poses):
    """A run whose first chunk is committed."""
    command = [*PROGRAM, "assess", "planar-3r", "--region", joints, "--poses", poses, "--seed", 3, "--out", folder]
    process = subprocess.Popen(
        [str(x) for x in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # What runs in the background of a shell ignores Ctrl-C, and so would the program that it starts.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    end = time.monotonic() + 60
    while time.monotonic() < end:
        assert process.poll() is None, process.communicate()
        if (folder / "done.journal").exists() and Store.open(folder).committed_chunks:
            return process
        time.sleep(0.005)
    process.kill()
    raise AssertionError("no chunk was committed in a minute")


def goes_on(folder, poses):
    """The library goes on where the program stopped, and the rows are those of a run without a stop."""
    left = Store.open(folder)
    assert 0 < len(left.committed_chunks) < len(left.chunks)
    part = load(folder)
    assert not part.complete
    assert part.distribution.samples == sum(b - a for k, (a, b) in enumerate(left.chunks) if k in left.committed_chunks)
    whole = hf.assess(arms.load("planar-3r"), load(folder).region, task="planar", poses=poses, seed=3, store=folder)
    assert whole.complete
    rows = whole.dataset
    for name, values in without_a_stop(whole.region, poses).data_vars.items():
        assert rows[name].values.tobytes() == values.values.tobytes(), name


@cache
def without_a_stop(region, poses):
    return hf.assess(arms.load("planar-3r"), region, task="planar", poses=poses, seed=3).dataset


def test_ctrl_c_ends_with_130_and_a_folder_that_goes_on(tmp_path, joints):
    process = start(tmp_path / "run", joints, POSES)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert err.strip().splitlines() == ["holdfast: stopped"]
    assert "Traceback" not in out + err
    assert not list((tmp_path / "run").glob(".run-*"))
    goes_on(tmp_path / "run", POSES)


def test_kill_9_leaves_a_folder_that_goes_on(tmp_path, joints):
    process = start(tmp_path / "run", joints, POSES)
    process.kill()
    process.communicate(timeout=60)
    assert process.returncode == -signal.SIGKILL
    goes_on(tmp_path / "run", POSES)


def test_two_programs_at_once(tmp_path, joints):
    process = start(tmp_path / "run", joints, POSES)
    try:
        os.kill(process.pid, signal.SIGSTOP)
        second = run("assess", "planar-3r", "--region", joints, "--poses", POSES, "--seed", 3, "--out", tmp_path / "run")
        assert second.returncode == 2
        assert second.stderr == f"holdfast: another program is writing to '{tmp_path / 'run'}'; wait for it or stop it\n"
    finally:
        process.kill()
        process.communicate(timeout=60)


def test_the_program_and_its_module_say_the_same():
    a = run("arms", "--json")
    b = subprocess.run(
        [sys.executable, "-m", "holdfast.interface.cli", "arms", "--json"], capture_output=True, text=True, check=True
    )
    assert a.returncode == 0
    assert a.stdout == b.stdout
    assert a.stderr == b.stderr == ""
    assert [e["name"] for e in json.loads(a.stdout)] == arms.names()


def test_bad_input_of_a_real_process():
    done = run("index", "panda", "--q", "1 2")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "holdfast: q for 'panda' has 2 values per configuration; it must have 7, one per joint\n"


def test_no_arguments_show_the_help():
    done = run()
    assert "Usage" in done.stdout
    assert all(c in done.stdout for c in ("arms", "describe", "index", "assess", "report"))
    assert done.returncode in (0, 2)
    # help is no error: no empty sentence on stderr
    assert "holdfast:  " not in done.stderr


@pytest.mark.parametrize("arguments", [["describe", "panda", "--json"], ["describe", "panda"]])
def test_a_reader_that_has_seen_enough(arguments):
    process = subprocess.Popen([*PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()  # as 'holdfast ... | true'
    err = process.stderr.read().decode()
    process.stderr.close()
    assert process.wait(60) == 0
    assert err == ""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")  # noqa: PTH110
@pytest.mark.parametrize("arguments", [["describe", "panda", "--json"], ["arms"]])
def test_a_full_disk_behind_stdout(arguments):
    with open("/dev/full", "w") as full:  # noqa: PTH123
        done = subprocess.run([*PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "No space left" in done.stderr


def test_output_in_a_plain_terminal(tmp_path):
    """Names and units outside ASCII must not break a program in the C locale, nor one that writes to a file on Windows."""
    rows = "".join(f"  - {{name: {name}, a: 0.3, alpha: 0, lower: -2, upper: 2}}\n" for name in ("Schürze", "jοint", "手"))
    (tmp_path / "arm.yaml").write_text(f"rows:\n{rows}", encoding="utf-8")
    for encoding in ("ascii", "cp1252"):
        plain = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": encoding}
        done = run("describe", tmp_path / "arm.yaml", env=plain, encoding=encoding)
        assert done.returncode == 0, done.stderr
        assert "j\\u03bfint" in done.stdout  # a Greek omicron


def test_more_than_there_is_memory_for():
    done = run("optimise", "planar-3r", "--at", "0 1 1", "--maximise", "relative-manipulability", "--starts", 10**13)
    assert (done.returncode, done.stdout) == (2, "")
    assert "there is not enough memory" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(("halvings", "code"), [("1", 3), ("8", 0)])
def test_the_exit_code_survives_a_reader_that_has_ended(tmp_path, halvings, code):
    """As of 'holdfast ... | true': nobody reads the text, but the code still tells the outcome."""
    size = "0.02" if code == 0 else "1.5"
    words = ["certify", "reach", "planar-3r", "--box", "1.6 0.4", "--size", size, "--halvings", halvings, "--no-check"]
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as output:
        done = subprocess.run(
            [*PROGRAM, *words, "--out", str(tmp_path / "a.certificate")], stdout=output, stderr=subprocess.PIPE, text=True
        )
    assert (done.returncode, done.stderr) == (code, "")
