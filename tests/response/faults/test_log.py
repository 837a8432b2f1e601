"""Records from files: their columns and units, gaps, and what cannot be of the arm."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.faults import Log

PANDA = hf.arms.load("panda")
COLUMNS = """
t: {column: "Time [ms]", unit: ms}
q: {column: "A* actual", unit: deg}
q_ref: [set base, set arm]
tau: {column: "A* torque"}
"""


@pytest.fixture
def log(rng):
    q = rng.uniform(-1, 1, (50, 2))
    return Log(t=np.arange(50) / 200, q_ref=q + 0.01, q=q, tau=10 * q)


def written(path, log, *, mark=",", comma=False):
    """As a controller might export it: the clock's ms, degrees, other names, an order of its own, a column of text."""
    head = ["mode", "A2 actual", "A1 actual", "Time [ms]", "set arm", "set base", "A1 torque", "A2 torque"]
    lines = [mark.join(head)]
    for t, q, ref, tau in zip(log.t, np.degrees(log.q), log.q_ref, log.tau, strict=True):
        cells = [1.7643e12 + 1e3 * t, *ref[::-1], *tau]
        cells = [f"{x:.9f}" if np.isfinite(x) else "" for x in (q[1], q[0], *cells)]
        lines.append(mark.join(["auto", *([cell.replace(".", ",") for cell in cells] if comma else cells)]))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8-sig")
    return path


@pytest.mark.parametrize(("mark", "comma"), [(",", False), (";", True), ("\t", False)])
def test_columns_of_other_names_and_units(log, tmp_path, mark, comma):
    (tmp_path / "columns.yaml").write_text(COLUMNS, encoding="utf-8")
    log.q[7, 1] = np.nan  # an empty cell
    read = Log.load(written(tmp_path / "run.csv", log, mark=mark, comma=comma), columns=tmp_path / "columns.yaml")
    for field in ("t", "q_ref", "q", "tau"):
        assert getattr(read, field) == pytest.approx(getattr(log, field), abs=1e-6, nan_ok=True)


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ('t: {column: "Time [ms]", unit: min}', "t: unit 'min' is not known; use s, ms, us, ns"),
        ("q: {columns: a}", "q.columns: the key 'columns' is not known"),
        ("q: 5", "q: 5 is wrong; give the keys column, unit"),
        ("tau: force_*", r"it has no column 'force_\*' for tau, but 'mode', 'A2 actual', "),
        ("t: mode", "line 2 has 'auto' in column 'mode'; give numbers"),
    ],
)
def test_columns_that_are_wrong(columns, words, log, tmp_path):
    names = {line.split(":")[0]: line for line in COLUMNS.strip().splitlines()}
    names[columns.split(":")[0]] = columns
    (tmp_path / "columns.yaml").write_text("\n".join(names.values()), encoding="utf-8")
    with pytest.raises(InputError, match=words):
        Log.load(written(tmp_path / "run.csv", log), columns=tmp_path / "columns.yaml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("t,q_1\n0,1\n1,1\n", r"it has no column 'q_ref_\*' for q_ref, but 't', 'q_1'; name them"),
        ("t,q_ref_1,q_1\n0,1\n", "line 2 has 2 cells, and the first line 3"),
        ("t,q_ref_1,q_2\n0,1,1\n1,1,1\n", r"its columns q_\* have a gap: their numbers are 2"),
        ("t,q_ref_1,q_1\n0,1,1\n0,1,1\n", "t does not increase at row 1"),
        ("t,q_ref_1,q_1\n0,1,1\n1,1,1\n2,1,1\n99,1,1\n", "nearly all samples are missing: 4 in 99 s"),
    ],
)
def test_a_record_that_is_wrong(text, words, tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        Log.load(path)


def test_samples_that_are_missing_are_rows_of_nan(log):
    """Times in whole ms at 300 Hz: steps of 3 and 4 ms are no gaps, and a step of 17 ms leaves out four samples."""
    t = np.round(np.arange(50) / 300, 3)
    keep = np.delete(np.arange(50), [20, 21, 22, 23])
    part = Log(t=t[keep], q_ref=log.q_ref[keep], q=log.q[keep])
    assert part.rate == pytest.approx(300, rel=0.01)
    assert len(part.t) == 50
    assert part.t == pytest.approx(t, abs=1e-3)
    assert np.isnan(part.q[20:24]).all()
    assert np.array_equal(part.q[keep], log.q[keep])


def test_a_gap_is_no_jerk():
    """Where rows are missing the residual torque is no larger than where nothing is."""
    t = np.arange(600) / 200
    q = 0.3 * np.sin(t[:, None] * np.linspace(1, 2, 7)) + [0, -0.5, 0, -2, 0, 2, 0]
    whole = Log(t=t, q_ref=q + 1e-3, q=q, tau=PANDA.gravity_torque(q))
    keep = np.delete(np.arange(600), [300, 301, 302, 303])
    part = Log(**{f.name: x[keep] for f in dataclasses.fields(Log) if (x := getattr(whole, f.name)) is not None})
    of_whole, of_part = (hf.diagnosis.calibrate(PANDA, [log]) for log in (whole, part))
    assert of_part.torque == pytest.approx(of_whole.torque, rel=0.05)
    assert of_part.speed == pytest.approx(of_whole.speed, rel=0.01)


def test_units_that_cannot_be_those_of_the_arm():
    q = 0.3 * np.sin(np.arange(600)[:, None] / 200 * np.linspace(1, 2, 7)) + [0, -0.5, 0, -2, 0, 2, 0]
    t = np.arange(600) / 200
    Log(t=t, q_ref=q, q=q).require(PANDA)
    leaps = np.repeat(q[::100], 100, axis=0)
    Log(t=t, q_ref=leaps, q=q).require(PANDA)
    with pytest.raises(InputError, match=r"q_ref of 'panda_joint1' is from 0 to 17.19 rad .* give a log in rad and s"):
        Log(t=t, q_ref=np.degrees(q), q=np.degrees(q)).require(PANDA)
    with pytest.raises(InputError, match=r"the log has 0\.2 samples a second; it must have 40 or more, with t in s"):
        Log(t=1e3 * t, q_ref=q, q=q).require(PANDA)
    with pytest.raises(InputError, match=r"is from .* rad at .* rad/s, and the joint's limits are"):
        Log(t=t / 30, q_ref=q, q=q).require(PANDA)
