"""``holdfast stow``: the numbers of the library, the exit code, the files, and one sentence for everything that is wrong."""

from __future__ import annotations

import json

import numpy as np
import pytest

import holdfast as hf

HOME = "0 -45 0 -135 0 90 45"
START = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
COMMON = ["--degrees", "--coulomb", "2,8,2,4,0.5,0.5,0.2", "--samples", "3000"]
FRICTION = hf.Friction(coulomb=[2, 8, 2, 4, 0.5, 0.5, 0.2])


def test_it_is_the_library(ask):
    expected = hf.stow(hf.arms.load("panda"), START, friction=FRICTION, samples=3000)
    data = ask("stow", "panda", "--start", HOME, *COMMON)
    assert data == expected.to_dict()
    assert data["holds"] is True


def test_a_path_is_reported_and_written(cli, tmp_path):
    code, out, _ = cli(
        "stow", "panda", "--start", HOME, *COMMON, "--path", "--tolerance", "0.5", "--nodes", "100", "--out", tmp_path / "out"
    )
    assert code == 0
    assert "The path takes" in out
    assert {"drop.png", "report.html"} <= {file.name for file in (tmp_path / "out").iterdir()}


def test_exit_code_3_if_nothing_holds(cli):
    code, out, _ = cli("stow", "panda", "--coulomb", "0.01", "--factor", "5", "--samples", "200")
    assert "smallest drop" in out or code == 0
    assert code in (0, 3)


def test_an_arm_that_only_lies_on_the_floor_has_exit_code_3(cli, tmp_path):
    cell = tmp_path / "cell.yaml"
    cell.write_text("objects:\n  floor: {half_space: [0, 1, 0], pose: {xyz: [0, -0.5, 0]}}\n")
    call = ["stow", "planar-3r", "--coulomb", "1e-9", "--viscous", "1", "--samples", "300", "--cell", cell, "--radius", "0.05"]
    code, out, _ = cli(*call)
    assert code == 3
    assert "found by simulating 20 falls in MuJoCo, which is no proof" in " ".join(out.split())
    assert "Friction and stops do not hold the arm in this configuration." in out
    code, out, _ = cli(*call, "--json")
    assert code == 3
    assert json.loads(out)["resting"]["outcome"] == "rest"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--path"], "give it to stow as at (--start)"),
        (["--start", "1 2"], "has 2 values"),
        (["--factor", "0.1"], "factor is 0.1"),
        (["--speeds", "1,x"], "--speeds: 'x' is not a number"),
        (["--monotone", "--start", HOME, "--tolerance", "-1"], "tolerance is -1"),
    ],
)
def test_a_wrong_option_is_one_sentence(cli, options, message):
    code, _, err = cli("stow", "panda", *COMMON, *options)
    assert code == 2
    assert message in err
