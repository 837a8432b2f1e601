"""--capsules, --radius, --margin and --no-clearance of ``holdfast assess`` and ``holdfast optimise``."""

from __future__ import annotations

import inspect
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import Capsules, Clearance, arms
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_percent
from holdfast.interface.cli.declaration import as_typer
from holdfast.interface.cli.groups import ClearanceOptions
from holdfast.interface.cli.program import COMMAND_MODULES

CLOSE = "box: {center: [0.2, 0.1, 0], size: [0.5, 0.5, 0]}\n"
POSE = "0.3,0.2,0,0,0,0"
BEST = ("optimise", "planar-3r", "--pose", POSE, "--maximise", "relative-manipulability", "--task", "planar")


@pytest.fixture
def close(tmp_path):
    file = tmp_path / "close.yaml"
    file.write_text(CLOSE)
    return file


def test_assess_prints_how_often_the_arm_runs_through_itself(cli, ask, close, tmp_path):
    arm = arms.load("planar-3r")
    common = ("assess", "planar-3r", "--region", close, "--poses", 200, "--optimise")
    data = ask(*common, "--radius", 0.13, "--margin", 0.01)["clearance"]
    thick = Clearance(arm, Capsules.along_links(arm, 0.13))
    region = hf.Region.load(close)
    run = hf.assess(arm, region, task="planar", poses=200, optimise=True, clearance=thick, margin=0.01)
    found = run.collisions
    assert [data[k] for k in ("found", "best_without_regard", "none_clear", "reached")] == [
        found.found,
        found.blocked,
        found.hopeless,
        found.reached,
    ]
    assert data["found_fraction"] == found.found / found.reached
    assert (data["capsules"], data["radius_m"], data["margin_m"]) == ("given radius", 0.13, 0.01)
    assert data["pairs_checked"] == thick.pair_names
    assert ask(*common)["clearance"] is None
    file = tmp_path / "shape.yaml"
    file.write_text("radius: 0.13\n")
    assert ask(*common, "--capsules", file, "--margin", 0.01)["clearance"] == data
    code, out, _ = cli(*common, "--radius", 0.13, "--margin", 0.01)
    text = " ".join(out.split())
    assert code == 0
    for part in (
        f"collisions with itself {format_percent(found.found / found.reached)} of the configurations found collide",
        "the best configurations have a clearance of at least 0.01 m",
        "given radius 0.13 m along each link",
    ):
        assert part in text, part
    assert "collisions with itself" not in cli(*common, "--no-clearance")[1]


def test_a_run_that_is_not_optimised_looks_if_told_to(ask, close):
    common = ("assess", "planar-3r", "--region", close, "--poses", 50)
    data = ask(*common, "--clearance")["clearance"]
    assert (data["capsules"], data["best_without_regard"]) == ("assumed radius", None)
    assert ask(*common)["clearance"] is None


def test_optimise_keeps_the_arm_clear_of_itself(cli, ask):
    arm = arms.load("planar-3r")
    thick = Clearance(arm, Capsules.along_links(arm, 0.13))
    data = ask(*BEST, "--radius", 0.13, "--margin", 0.02)
    row = data["poses"][0]
    pose = np.eye(4)
    pose[:3, 3] = [0.3, 0.2, 0]
    index = hf.indices.relative_manipulability(arm, "planar")
    best = hf.optimise(arm, pose, index, clearance=thick, margin=0.02)
    assert row["value"] == best.value
    assert row["blocked"] == best.blocked
    assert row["clearance_m"] == thick(best.q)
    assert row["clearance_m"] >= 0.02
    assert data["clearance"]["description"] == "given radius 0.13 m along each link"
    free = ask(*BEST, "--no-clearance")
    assert free["clearance"] is None
    assert free["poses"][0]["clearance_m"] is free["poses"][0]["blocked"] is None
    assert free["poses"][0]["value"] >= row["value"]
    code, out, _ = cli(*BEST, "--radius", 0.13)
    assert code == 0
    assert "clearance of the best" in out


def test_optimise_says_why_nothing_is_clear(cli):
    code, out, err = cli(*BEST, "--radius", 0.13, "--margin", 9)
    assert (code, out) == (2, "")
    assert (
        "the arm comes closer than 9 m to itself in each that was found (capsules: given radius 0.13 m along each link)" in err
    )
    assert "--no-clearance" in err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (
            ("--no-clearance", "--radius", 0.1),
            "--radius needs the check for self-collisions that --no-clearance excludes",
        ),
        (("--no-clearance", "--margin", 0.1), "--margin needs the check for self-collisions"),
        (("--no-clearance", "--capsules", "x.yaml"), "--capsules needs the check for self-collisions"),
        (("--radius", 0.1, "--capsules", "x.yaml"), "--capsules and --radius are both given"),
        (("--radius", 0), "--radius is 0; it must be a finite number of metres above 0"),
        (("--radius", "nan"), "--radius is nan"),
        (("--margin", "inf"), "--margin is inf"),
        (("--capsules", "missing.yaml"), "missing.yaml"),
        (("--margin", 0.1), "--margin has no effect"),
    ],
)
def test_options_that_make_no_sense(options, sentence, refused, close):
    assert sentence in refused(*BEST, *options)
    assert sentence in refused("assess", "planar-3r", "--region", close, "--poses", 5, "--optimise", *options)


def test_capsules_of_one_arm_are_not_those_of_another(refused, tmp_path):
    file = tmp_path / "shape.yaml"
    file.write_text("radius: 0.13\n")
    sentence = refused("assess", "planar-3r", "planar-2r", "--task", "vx", "--poses", 5, "--capsules", file)
    assert "--capsules describes one arm and there are 2" in sentence
    file.write_text("links: {elbow: []}\n")
    assert "has no link 'elbow'" in refused("assess", "planar-3r", "--poses", 5, "--capsules", file)
    assert "add --optimise" in refused("assess", "planar-3r", "--poses", 5, "--margin", 0.1)


def test_failure_rates_are_of_one_arm(refused):
    sentence = refused("assess", "planar-3r", "planar-2r", "--task", "vx", "--after-lock", "--failure-rate", "1=2")
    assert "--failure-rate applies to one arm" in sentence


BENCH = """
name: bench
margin: 0.01
objects:
  post: {sphere: 0.15, pose: {xyz: [0.4, 0.35, 0]}}
  far: {box: [0.2, 0.2, 0.2], pose: {xyz: [-2, -2, 0]}}
"""


@pytest.fixture
def bench(tmp_path):
    file = tmp_path / "bench.yaml"
    file.write_text(BENCH)
    return file


def test_assess_and_optimise_keep_clear_of_a_cell(cli, ask, close, bench):
    common = ("assess", "planar-3r", "--region", close, "--poses", 40, "--after-lock", "--cell", bench, "--no-clearance")
    data = ask(*common, "--radius", 0.02)["clearance"]
    arm, cell = arms.load("planar-3r"), hf.Cell.load(bench)
    slim = Clearance(arm, Capsules.along_links(arm, 0.02), cell, itself=False)
    run = hf.assess(arm, hf.Region.load(close), task="planar", poses=40, after_lock=True, clearance=slim)
    assert data["found_with"] == run.collisions.with_each == {"post": run.collisions.found, "far": 0}
    assert data["reached_clear"]["value"] == run.reached_clear().value
    assert data["best_barred_by"] is None
    assert data["cell"]["sha256"] == cell.digest
    text = " ".join(cli(*common, "--radius", 0.02)[1].split())
    assert f"at most {format_percent(run.collisions.found / run.collisions.reached)} of the configurations found" in text
    assert "cell 'bench' with 2 objects" in text
    slender = (*BEST, "--radius", 0.02)
    free = ask(*slender)["poses"][0]
    q = free["q"]["joint1"]
    bench.write_text(BENCH.replace("[0.4, 0.35, 0]", f"[{np.cos(q)}, {np.sin(q)}, 0]"))  # where the elbow is then
    row = ask(*slender, "--cell", bench, "--no-clearance")["poses"][0]
    assert row["blocked_by"].endswith("& post")
    assert row["clearance_m"] >= 0.01
    assert free["blocked_by"] is None
    assert row["value"] < free["value"]


def test_a_cell_that_cannot_be_used_is_one_sentence(refused, bench, tmp_path):
    assert "no link 'elbow'" in refused(*BEST, "--cell", _with(bench, "may_touch: [[post, elbow]]"))
    assert "missing.yaml" in refused(*BEST, "--cell", tmp_path / "missing.yaml")


def _with(file, line):
    file.write_text(f"{BENCH}{line}\n")
    return file


def test_meshes_are_looked_for_in_the_folder_that_is_named(tmp_path):
    text = "<link name='{}'><collision><geometry><mesh filename='package://gone/{}.stl'/></geometry></collision></link>"
    joint = "<joint name='j{}' type='revolute'><parent link='{}'/><child link='{}'/><origin xyz='0 0 0.4'/><axis xyz='{}'/>"
    joint += "<limit lower='-2' upper='2' velocity='1' effort='1'/></joint>"
    names = ["link0", "link1", "link2", "link3"]
    links = "".join(text.format(name, name) for name in names)
    joints = "".join(joint.format(k, names[k], names[k + 1], axis) for k, axis in enumerate(("0 0 1", "0 1 0", "1 0 0")))
    file, meshes = tmp_path / "own.urdf", tmp_path / "meshes"
    file.write_text(f"<robot name='own'>{links}{joints}</robot>")
    meshes.mkdir()
    given = arms.builtin.DATA_FOLDER.joinpath("example-robot-data/robots/panda_description/meshes/collision")
    for name in names:
        (meshes / f"{name}.stl").write_bytes(given.joinpath(f"{name}.stl").read_bytes())
    arm = arms.load(str(file))
    assert (
        ClearanceOptions(clearance=True)
        .build_clearance(arm)
        .capsules.describe(arm)
        .endswith(" along each link (package://gone/link0.stl was not read)")
    )
    there = ClearanceOptions(clearance=True, meshes=meshes)
    found = there.build_clearance(arm)
    assert found.capsules.describe(arm).startswith("cover of the collision shapes of own.urdf: ")
    with pytest.raises(InputError, match="cannot be found or is not a folder"):
        ClearanceOptions(clearance=True, meshes=tmp_path / "none").build_clearance(arm)
    with pytest.raises(InputError, match="'planar-3r' was not read from a URDF file"):
        there.build_clearance(arms.load("planar-3r"))


CALLS = {
    "assess": ("planar-3r", "--poses", 5),
    "compare-laws": ("planar-3r", "--motions", 2),
    "convergence-map": ("planar-3r", "--target", "1.5,1.5", "--starts", 2),
    "plan-motion": ("panda", "line.yaml"),
    "follow": ("panda", "line.yaml", "--minimise", "torque"),
    "power-loss": ("panda", "--q", "0 -0.2 0 -1.6 0 1.6 0.8", "--physics"),
    "optimise": BEST[1:],
    "page": ("panda", "--out", "panda.html"),
    "stow": ("panda", "--coulomb", "9", "--samples", "100"),
    "recover": ("panda", "--lock", "panda_joint4=-1.2", "--goal", "0.5,0.2,0.4"),
    "self-motion": ("planar-3r", "--target", "1.5,1.5"),
    "simulate": ("planar-3r", "--start", "0 0.2 0.3", "--target", "1.2,1.2"),
    "studio": ("panda",),
}


def test_every_command_with_a_cell_takes_the_folder_of_meshes():
    for command, module in COMMAND_MODULES.items():
        name, _, function = module.partition(":")
        made = getattr(import_module(f"holdfast.interface.cli.{name}"), function or "command")
        assert (command in CALLS) == (callable(made) and "cell" in inspect.signature(as_typer(made)).parameters), command


@pytest.mark.parametrize("command", CALLS)
def test_a_folder_of_meshes_that_is_not_there_is_said(command, refused, bench, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("line.yaml").write_text("line: {from: {xyz: [0.5, 0, 0.4]}, to: {xyz: [0.5, 0.1, 0.4]}}\ntiming: {duration: 2}\n")
    assert "the folder of meshes is" in refused(command, *CALLS[command], "--cell", bench, "--meshes", tmp_path / "none")
