"""``holdfast holds``: the numbers of the library, the exit code, and one sentence for everything that is wrong."""

from __future__ import annotations

import json

import numpy as np
import pytest

import holdfast as hf

HOME = "0 -45 0 -135 0 90 45"
Q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])


def test_it_is_the_library(ask):
    arm = hf.arms.load("panda").with_payload(hf.Link(0.5, np.zeros(3), np.zeros((3, 3)), name="payload"))
    options = ["--q", HOME, "--degrees", "--effort", "40%", "--coulomb", "1,2,3,1,2,3,1", "--payload", "0.5", "--free", "2,4"]
    expected = hf.holds(arm, Q, effort=0.4, friction=hf.Friction(coulomb=[1, 2, 3, 1, 2, 3, 1]), free=[1, 3])
    data = ask("holds", "panda", *options)
    assert data == expected.to_dict()
    assert (data["holds"], data["margin"], data["free"]) == (True, float(expected.margin), ["panda_joint2", "panda_joint4"])


def test_exit_code_3_if_it_falls(cli):
    code, out, err = cli("holds", "panda", "--q", HOME, "--degrees", "--stiction", "15")
    assert (code, err) == (3, "")
    text = " ".join(out.split())
    for part in ("The arm falls: panda_joint4 needs 22.02 N m to stay, and has 15 N m.", "gives way", "least effort"):
        assert part in text, part
    code, out, _ = cli("holds", "panda", "--q", HOME, "--q", "0 -45 0 -150 0 90 45", "--degrees", "--coulomb", "22.1", "--json")
    assert code == 3
    data = json.loads(out)
    assert data["holds"] == [True, False]
    assert cli("holds", "panda", "--q", HOME, "--degrees", "--stiction", "25")[0] == 0


def test_a_stop_carries_only_if_it_is_one(cli):
    for options, code in (((), 0), (("--no-stops",), 3)):
        assert cli("holds", "panda", "--q", "0 0 0 -3.0718 0 1.8 0", "--free", "4", *options)[0] == code


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--q", "0 0 0 -3.2 0 1.8 0"], "joint 'panda_joint4' is 0.1282 rad outside its limits, -3.0718 to -0.0698; give a"),
        (["--q", HOME], "--q: joint 'panda_joint2' is at -45 rad, far beyond its limits"),
        (["--q", HOME, "--degrees", "--effort", "35"], "effort is 35; it must be a fraction from 0 to 1"),
        (["--q", HOME, "--degrees", "--effort", "much"], "--effort: 'much' is not a fraction; write for example 35% or 0.35"),
        (["--q", HOME, "--degrees", "--coulomb", "1,x"], "--coulomb: 'x' is not a number"),
        (["--q", HOME, "--degrees", "--stiction", "1,2"], "stiction has shape (2,)"),
        (["--q", HOME, "--degrees", "--free", "8"], "joint 8 is out of range"),
        (["--q", HOME, "--degrees", "--free", ""], "no joint of 'panda' is named"),
    ],
)
def test_bad_input_is_one_sentence(arguments, words, refused):
    assert words in refused("holds", "panda", *arguments)
