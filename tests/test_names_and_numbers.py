"""Whole numbers that no file should hold, and names of joints that tables, C, and options must survive."""

from __future__ import annotations

import json
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.control.laws.c_functions import write_c_comment
from holdfast.core.errors import ArmError, InputError
from holdfast.core.files.reading import parse_json
from holdfast.model.arm.machine import Joint
from holdfast.model.failure_modes import read_failures, read_joint
from holdfast.response.recovery.waypoints import read_waypoints, write_waypoints

NAMES = ("a,b", "=1+1", 'q"r')


def renamed(names: tuple[str, ...]) -> hf.Arm:
    """Return the planar arm with other names of its joints."""
    arm = arms.load("planar-3r")
    return replace(arm, joints=tuple(replace(j, name=name) for j, name in zip(arm.joints, names, strict=True)))


@pytest.mark.parametrize("text", [f"[{2**63 + 1}]", f'{{"a": {"9" * 5000}}}', '"\\ud800"', "[" * 100_000])
def test_json_that_no_reader_can_use_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"beyond 2\^63|surrogate|nested"):
        parse_json(text)


@pytest.mark.parametrize("data", [2**63, -(2**63), {"a": [1.5, "é", "\U0001f600", None]}])
def test_sound_json_is_read_as_the_json_module_reads_it(data: object) -> None:
    assert parse_json(json.dumps(data)) == data


@pytest.mark.parametrize("value", [10**400, -(10**5000), {"uniform": [0, 10**400]}], ids=["high", "low", "end"])
def test_a_number_of_a_fault_beyond_floats_is_refused(value: object) -> None:
    with pytest.raises(InputError, match="gain of 'weak' is a whole number beyond 1e308; it must be finite"):
        hf.faults.weak(gain=value)


@pytest.mark.parametrize("read", [read_joint, read_failures])
def test_more_digits_than_python_converts_are_no_number(read) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match="has no joint"):
        read(arms.load("planar-3r"), "9" * 5000)


def test_waypoints_are_read_as_written_whatever_the_joints_are_called(tmp_path, rng) -> None:  # type: ignore[no-untyped-def]
    arm, q = renamed(NAMES), rng.uniform(-1, 1, (4, 3))
    np.testing.assert_array_equal(read_waypoints(arm, write_waypoints(arm, q, tmp_path / "w.csv")), q)


def test_a_name_that_is_the_number_of_another_joint_is_announced(capsys, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    monkeypatch.delenv("HOLDFAST_NOTICES", raising=False)
    arm = renamed(("2", "1", "3"))
    assert [read_joint(arm, text) for text in ("2", "1", "3")] == [0, 1, 2]
    said = capsys.readouterr().err
    assert "'2' is taken as the name of joint 1, not as number 2, which is joint '1'" in said
    assert "'3'" not in said
    assert [read_joint(renamed(("1", "2", "3")), text) for text in "123"] == [0, 1, 2]
    assert capsys.readouterr().err == ""


def test_half_of_a_surrogate_pair_is_no_name() -> None:
    with pytest.raises(ArmError, match="surrogate"):
        Joint("\ud800", "revolute", np.eye(4), axis=np.array([0.0, 0, 1]))
    with pytest.raises(ArmError, match="surrogate"):
        replace(arms.load("planar-3r"), name="\udfff")


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
@pytest.mark.parametrize("name", ["a/*b", "a*/b", "*/*", "/*/"])
def test_comments_of_c_hold_any_name(tmp_path, name: str) -> None:  # type: ignore[no-untyped-def]
    file = tmp_path / "c.c"
    file.write_text(f"{write_c_comment([name])}\nint x;\n", encoding="utf-8")
    done = subprocess.run(
        ["cc", "-c", "-Wall", "-Wextra", "-Werror", str(file), "-o", str(tmp_path / "c.o")], capture_output=True
    )
    assert done.returncode == 0, done.stderr
