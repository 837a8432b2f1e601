"""``holdfast susceptibility``: the library's numbers, with units, flags and one sentence for everything that is wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast import susceptibility as sus
from holdfast.core.registry import SUSCEPTIBILITY_REGISTRY

HOME = "0 -45 0 -135 0 90 45"
IN_RADIANS = "0 -0.8 0 -2.4 0 1.6 0.8"


@pytest.mark.parametrize("name", SUSCEPTIBILITY_REGISTRY)
def test_it_is_the_library(name, ask):
    arm = arms.load("panda")
    q = np.radians([float(x) for x in HOME.split()])
    data = ask("susceptibility", "panda", "--measure", name, "--q", HOME, "--degrees")
    measure = sus.by_name(name, arm)
    assert data["measure"] == name
    assert data["value"] == measure(q)
    assert data["better"] == "smaller"
    assert list(data["by_joint"]) == list(arm.joint_names)
    np.testing.assert_array_equal(list(data["by_joint"].values()), measure.by_joint(q))
    np.testing.assert_array_equal(list(data["gradient"].values()), measure.gradient(q))
    assert tuple(data["joint_unit"].values()) == measure.joint_unit


def test_a_person_reads_units_degrees_and_flags(cli):
    code, out, err = cli("susceptibility", "ur5-rail", "--measure", "swing-angle", "--q", "3 0 0 0 0 0 0.2")
    text = " ".join(out.split())
    assert (code, err) == (0, "")
    for part in (
        "smaller is better",
        "(rad)^2",
        " rad (",
        " deg)",
        "not defined: a prismatic joint",
        "degenerate: ",
        "outside",
    ):
        assert part in text, part
    _, out, _ = cli("susceptibility", "ur5-rail", "--q", "1 0 0 0 0 0 0.2", "--weights", "worst-case")
    assert "rail 0 N " in " ".join(out.split())
    assert "worst-case weights" in out


def test_mount_gravity_and_payload(ask):
    arm = arms.load("panda")
    q = np.array([0.1, -0.5, 0.2, -1.5, 0.3, 1.2, 0.4])
    text = " ".join(map(str, q))
    wall, ceiling = np.eye(4), np.diag([1.0, -1, -1, 1])
    wall[:3, :3] = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    for mount, base in (("floor", np.eye(4)), ("wall", wall), ("ceiling", ceiling)):
        data = ask("susceptibility", "panda", "--q", text, "--mount", mount)
        expected = arm.with_base(base @ arm.base).gravity_torque(q)
        np.testing.assert_allclose(list(data["by_joint"].values()), expected, rtol=1e-12)
    data = ask("susceptibility", "panda", "--q", text, "--gravity", "1.62,0,0.5")
    np.testing.assert_allclose(
        list(data["by_joint"].values()), replace(arm, gravity=np.array([1.62, 0, 0.5])).gravity_torque(q), rtol=1e-12
    )
    data = ask("susceptibility", "panda", "--q", text, "--payload", "2, 0.01, 0, 0.1")
    held = arm.with_payload(hf.Link(2.0, np.array([0.01, 0, 0.1]), np.zeros((3, 3))))
    np.testing.assert_allclose(list(data["by_joint"].values()), held.gravity_torque(q), rtol=1e-12)
    assert ask("susceptibility", "panda", "--q", text, "--payload", "2") == ask(
        "susceptibility", "panda", "--q", text, "--payload", "2 0 0 0"
    )


def test_weights_in_words_numbers_and_files(ask, tmp_path, rng):
    arm = arms.load("panda")
    q = oracles.inside(arm, rng, 2)
    texts = [a for row in q for a in ("--q", " ".join(map(repr, row.tolist())))]
    root = rng.normal(size=(7, 7))
    square, row = tmp_path / "w.csv", tmp_path / "row.CSV"
    np.savetxt(square, root @ root.T, delimiter=",")
    row.write_text("1,2,3,4,5,6,7\n")
    column = tmp_path / "column.csv"
    column.write_text("1\n2\n3\n4\n5\n6\n7\n")
    for given, weights in (
        ("effort", "effort"),
        ("worst-case", "worst-case"),
        ("1,2,3,4,5,6,7", np.arange(1.0, 8)),
        (str(row), np.arange(1.0, 8)),
        (str(column), np.arange(1.0, 8)),
        (str(square), root @ root.T),
    ):
        data = ask("susceptibility", "panda", *texts, "--weights", given)
        np.testing.assert_allclose([d["value"] for d in data], sus.torque(arm, weights)(q), rtol=1e-9)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["panda", "--q", IN_RADIANS, "--measure", "speed"], "susceptibility 'speed' is not known"),
        (["panda", "--q", "1 2 3"], "has 3 values per configuration"),
        (["panda", "--q", "1 2 x 4 5 6 7"], "--q: 'x' is not a number"),
        (["pa10-9dof", "--q", "0 0 0 0 0 0 0 0 0"], "it has no inertial data"),
        (["panda", "--q", IN_RADIANS, "--mount", "roof"], "--mount 'roof' is not known; use one of floor, wall, ceiling"),
        (["panda", "--q", IN_RADIANS, "--gravity", "0,0"], "gravity must be 3 finite numbers"),
        (["panda", "--q", IN_RADIANS, "--gravity", "0,0,g"], "--gravity: 'g' is not a number"),
        (["panda", "--q", IN_RADIANS, "--payload", "1,2"], "--payload has 2 numbers"),
        (["panda", "--q", IN_RADIANS, "--payload", "-1"], "mass is -1 kg"),
        (["panda", "--q", IN_RADIANS, "--weights", "heavy"], "--weights: 'heavy' is not a number"),
        (["panda", "--q", IN_RADIANS, "--weights", "1,2"], "weights have shape (2,)"),
        (["panda", "--q", IN_RADIANS, "--weights", "1,1,1,1,1,1,-1"], "not positive semidefinite"),
        (["panda", "--q", IN_RADIANS, "--weights", "nowhere.csv"], "'nowhere.csv' cannot be read"),
        (["planar-3r", "--q", "0 0 0", "--weights", "effort"], "no largest effort above 0"),
        (["panda", "--q", IN_RADIANS, "--measure", "swing-angle", "--weights", "effort"], "weights 'effort' are of torques"),
    ],
)
def test_bad_input_is_one_sentence(arguments, words, refused):
    assert words in refused("susceptibility", *arguments)


def test_a_weights_file_that_is_no_table(refused, tmp_path):
    file = tmp_path / "w.csv"
    for content, words in (
        (b"a,b\n1\n", "'a' is not a number"),
        (b"", "lines with equally many numbers"),
        (b"1,2\n3\n", "lines with equally many numbers"),
        (b"\xff\xfe1", "is not text"),
    ):
        file.write_bytes(content)
        assert words in refused("susceptibility", "panda", "--q", IN_RADIANS, "--weights", file)
