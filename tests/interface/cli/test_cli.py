"""The command line inside this process: what every command prints, and one sentence for everything that is wrong."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms, load
from holdfast.interface.cli.program import COMMAND_MODULES

HOME9 = "0 30 0 90 0 18 0 36 0"
RHO9 = (0.61245, 0.12725, 0.67622, 0.47972, 0.66629, 0.76427, 0.79161, 0.41179, 0.31151)


@pytest.fixture
def box(tmp_path):
    file = tmp_path / "box.yaml"
    file.write_text("angles: deg\nbox: {center: [0.968, 0, 0.041], size: 0.2, rpy_center: [0, 174, 0], rpy_size: 20}\n")
    return file


# ---- what there is -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", COMMAND_MODULES)
def test_every_command_has_help(command, cli):
    for flag in ("--help", "-h"):
        code, out, err = cli(command, flag)
        assert (code, err) == (0, "")
        assert f"holdfast {command}" in " ".join(out.split())


def test_version(cli):
    assert cli("--version") == (0, f"holdfast {hf.__version__}\n", "")


def test_arms(cli, ask):
    code, out, err = cli("arms")
    assert (code, err) == (0, "")
    assert all(name in out for name in arms.names())
    entries = ask("arms")
    assert [e["name"] for e in entries] == arms.names()
    assert all(e["joints"] == arms.load(e["name"]).n for e in entries)


@pytest.mark.parametrize("name", arms.names())
def test_describe(name, cli, ask):
    code, out, err = cli("describe", name)
    assert (code, err) == (0, "")
    arm = arms.load(name)
    assert name in out
    data = ask("describe", name)
    assert data["fingerprint"] == arm.fingerprint
    assert [j["name"] for j in data["joints"]] == list(arm.joint_names)
    for given, joint in zip(data["joints"], arm.joints, strict=True):
        assert given["lower"] == (joint.lower if np.isfinite(joint.lower) else None)
        assert given["unit"] == ("m" if joint.prismatic else "rad")


def test_describe_names_the_single_point_of_failure_and_counts_joints_from_1(cli, ask):
    _, out, _ = cli("describe", "pa10-7dof")
    assert "once joint4 (joint 4) locks" in " ".join(out.split())
    structure = {s["task"]: s for s in ask("describe", "pa10-7dof")["structure"]}
    assert structure["pose"]["single_points_of_failure"] == ["joint4"]
    assert structure["position"]["single_points_of_failure"] == []


# ---- index ---------------------------------------------------------------------------------------------------------


def test_index_at_the_nominal_configuration_of_the_paper(ask, cli):
    """Specification, section 6."""
    data = ask("index", "pa10-9dof", "--q", HOME9, "--degrees")
    assert data["value"] == pytest.approx(0.127251, abs=1e-6)
    assert data["worst"] == "joint2"
    np.testing.assert_allclose(list(data["by_failure"].values()), RHO9, atol=6e-6)
    assert list(data["by_failure"]) == [f"joint{k}" for k in range(1, 10)]
    np.testing.assert_allclose(list(data["q"].values()), oracles.NOMINAL)
    assert data["bound"] == pytest.approx(0.57735, abs=1e-5)
    code, out, err = cli("index", "pa10-9dof", "--q", HOME9, "--degrees")
    assert (code, err) == (0, "")
    assert "0.127251" in out
    assert "joint2" in out


@pytest.mark.parametrize(
    ("index", "value"), [("manipulability", 0.099983), ("minimum-singular-value", 0.060262), ("condition-number", 35.5947)]
)
def test_other_indices_at_the_nominal_configuration(index, value, ask):
    data = ask("index", "pa10-9dof", "--index", index, "--q", HOME9, "--degrees")
    assert data["value"] == pytest.approx(value, rel=1e-5)
    assert data["worst"] == "joint2"


def test_index_gradient_against_differences(ask, pa10):
    q = oracles.NOMINAL + 0.1

    def worst(x):
        return oracles.index("relative-manipulability", oracles.jacobian(pa10, x), [[k] for k in range(9)]).min(1)

    data = ask("index", "pa10-9dof", "--q", " ".join(map(repr, q.tolist())))
    np.testing.assert_allclose(list(data["gradient"].values()), oracles.slope(worst, q), atol=1e-7)


def test_several_configurations_and_separators(ask):
    many = ask("index", "panda", "--q", "0,-0.8,0,-2.3,0,1.5,0.8", "--q", " 0.1, 0.2  0.3,-1 0.5 1 0.7 ")
    assert len(many) == 2
    assert list(many[1]["q"].values()) == [0.1, 0.2, 0.3, -1, 0.5, 1, 0.7]
    assert many[0] == ask("index", "panda", "--q", "0,-0.8,0,-2.3,0,1.5,0.8")


def test_degrees_leave_the_metres_of_a_sliding_joint_alone(ask):
    data = ask("index", "ur5-rail", "--q", "1.25 10 -80 90 -45 -90 30", "--degrees")
    assert data["q"].pop("rail") == 1.25
    np.testing.assert_allclose(list(data["q"].values()), np.radians([10, -80, 90, -45, -90, 30]))
    plain = ask("index", "ur5-rail", "--q", "1.25 0.1 -8 9 -4.5 -9 3")
    assert list(plain["q"].values()) == [1.25, 0.1, -8, 9, -4.5, -9, 3]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("1; 3", ["joint1", "joint3"]),
        ("2; 4+5", ["joint2", "joint4+joint5"]),
        ("joint9;1", ["joint9", "joint1"]),
        ("joint2+1", ["joint1+joint2"]),
        (" 9+1 ;", ["joint1+joint9"]),
        ("single", [f"joint{k}" for k in range(1, 10)]),
        ("1", [f"joint{k}" for k in range(1, 10)]),
    ],
)
def test_failures_are_numbered_from_1_or_named(text, names, ask, pa10):
    data = ask("index", "pa10-9dof", "--q", HOME9, "--degrees", "--failures", text)
    assert list(data["by_failure"]) == names
    j = oracles.jacobian(pa10, oracles.NOMINAL[None])
    sets = [[int(x.removeprefix("joint")) - 1 for x in name.split("+")] for name in names]
    np.testing.assert_allclose(
        list(data["by_failure"].values()), oracles.index("relative-manipulability", j, sets)[0], rtol=1e-9
    )


def test_a_lone_number_of_failures_is_how_many(ask):
    assert len(ask("index", "pa10-9dof", "--q", HOME9, "--degrees", "--failures", "2")["by_failure"]) == 36


@pytest.mark.parametrize("task", ["position", "pointing", "vx,wz", "vz", " vx , vy "])
def test_tasks_by_name_and_by_rows(task, ask, pa10):
    data = ask(
        "index", "pa10-9dof", "--q", HOME9, "--degrees", "--task", task, "--index", "minimum-singular-value", "--length", "0.5"
    )
    rows = task if task in ("position", "pointing") else [r.strip() for r in task.split(",")]
    j = oracles.task_jacobian(pa10, oracles.NOMINAL[None], rows, length=0.5)
    expected = oracles.index("minimum-singular-value", j, [[k] for k in range(9)])[0]
    np.testing.assert_allclose(list(data["by_failure"].values()), expected, rtol=1e-9, atol=1e-12)
    assert data["characteristic_length_m"] == 0.5


@pytest.mark.parametrize("index", ["relative-manipulability", "condition-number"])
def test_a_singular_configuration_is_said(index, ask, cli):
    data = ask("index", "pa10-9dof", "--q", "0 0 0 0 0 0 0 0 0", "--index", index)
    assert data["singular"] is True
    assert data["worst"] is None
    assert data["value"] == (0 if index.startswith("relative") else None)
    code, out, _ = cli("index", "pa10-9dof", "--q", "0 0 0 0 0 0 0 0 0", "--index", index)
    assert code == 0
    assert "singular" in out
    assert "Joints outside their limits: joint4." in " ".join(out.split())


# ---- assess and report ---------------------------------------------------------------------------------------------


def test_assess_is_the_library(ask):
    data = ask("assess", "pa10-9dof", "--poses", 300, "--seed", 5, "--at-least", 0.1, "--at-least", "0.2")
    arm = arms.load("pa10-9dof")
    run = hf.assess(arm, hf.Region.from_dict(data["region"]), poses=300, seed=5)
    assert data["reached"] == run.distribution.reached
    assert data["not_found"] == run.distribution.unreached
    assert data["evaluated"] == 300
    assert data["mean"] == run.distribution.mean
    assert [p["at_least"] for p in data["probability"]] == [0.1, 0.2]
    for p in data["probability"]:
        found = run.interval(at_least=p["at_least"])
        assert (p["value"], p["low"], p["high"]) == (found.value, found.low, found.high)
    assert list(data["worst_counts"].values()) == run.worst_counts.tolist()
    assert data["region"]["center"][:3] == [0.968, 0, 0.041]


def test_assess_prints_a_table(cli, box):
    code, out, err = cli("assess", "pa10-9dof", "--poses", 200, "--region", box, "--threads", 1)
    assert (code, err) == (0, "")
    text = " ".join(out.split())
    for part in ("pa10-9dof", "sampled poses 200, seed 0", "no configuration found", "median", "at least", "0.2 x 0.2 x 0.2 m"):
        assert part in text, part


def test_assess_warns_of_a_single_point_of_failure(cli):
    code, out, err = cli("assess", "pa10-7dof", "--poses", 30)
    assert code == 0
    assert "once joint4 (joint 4) locks" in err
    assert "Traceback" not in err
    assert out


def test_assess_condition_numbers_ask_for_at_most(ask):
    data = ask("assess", "pa10-9dof", "--poses", 100, "--index", "condition-number", "--at-least", 20)
    assert data["better"] == "smaller"
    assert data["probability"][0]["at_most"] == 20
    for p in ask("assess", "pa10-9dof", "--poses", 100, "--index", "condition-number")["probability"]:
        assert "at_most" in p


@pytest.mark.parametrize("name", [n for n in arms.names() if n != "planar-2r"])
def test_assess_has_a_region_for_every_built_in_arm(name, ask):
    six = name in ("ur5", "kinova-j2s6s200", "yam")
    data = ask("assess", name, "--poses", 64, "--restarts", 10, *(["--task", "position"] if six else []))
    assert data["reached"] > 0
    assert data["task"] == ("position" if six else arms.about(name).task)


def test_an_unreachable_region_runs_and_says_so(cli, ask, tmp_path):
    far = tmp_path / "far.yaml"
    far.write_text("box: {center: [9, 9, 9], size: 0.1}")
    for index in ("manipulability", "condition-number"):
        arguments = ("assess", "pa10-9dof", "--region", far, "--poses", 20, "--restarts", 2, "--index", index)
        data = ask(*arguments)
        assert (data["reached"], data["not_found"], data["mean"], data["quantiles"]) == (0, 20, None, None)
        assert all(p["value"] == 0 for p in data["probability"])
        code, out, _ = cli(*arguments)
        assert code == 0
        assert "found for any of the 20 poses of the region" in " ".join(out.split())
        assert "nan" not in out.lower()


def test_assess_sobol_and_joints(ask, tmp_path):
    file = tmp_path / "joints.yaml"
    file.write_text("joints: {lower: [-1, -1, -1], upper: [1, 1, 1]}")
    data = ask("assess", "planar-3r", "--region", file, "--poses", 256, "--sampling", "sobol")
    assert (data["reached"], data["sampling"], data["task"]) == (256, "sobol", "planar")


def test_assess_out_then_report(ask, tmp_path, box):
    folder = tmp_path / "results"
    arguments = ("assess", "pa10-9dof", "--region", box, "--poses", 100, "--seed", 3, "--out", folder)
    first = ask(*arguments)
    page = folder / "report.html"
    assert first["report"] == str(page)
    assert page.read_text().lstrip().lower().startswith("<!doctype html")
    run = load(folder)
    assert json.loads(json.dumps(run.to_dict(report=page))) == first | {"seconds": run.seconds}  # of the rows alone
    page.unlink()
    data = ask("report", folder)
    assert page.exists()
    same = ("reached", "mean", "worst_counts", "quantiles", "fingerprint", "region", "seed", "poses")
    assert {k: data[k] for k in same} == {k: first[k] for k in same}


def test_assess_locks_at_given_angles_and_failure_rates(cli, ask, tmp_path):
    folder = tmp_path / "run"
    common = ("assess", "planar-3r", "--poses", 100, "--seed", 2)
    rates = ("--failure-rate", "joint2=1", "--failure-rate", "3=3")
    data = ask(*common, "--lock", "2=0.5", "--lock", "joint3=-1", *rates, "--out", folder)
    arm = arms.load("planar-3r")
    run = hf.assess(arm, hf.Region.from_dict(data["region"]), task="planar", poses=100, seed=2, locked={1: 0.5, 2: -1.0})
    shares = run.survival()
    assert data["after_lock"]["joint2"] == {
        "value": shares["joint2"].value,
        "low": shares["joint2"].low,
        "high": shares["joint2"].high,
        "locked_at": 0.5,
    }
    assert data["expected_survival"] == run.expected_survival({"joint2": 1, "joint3": 3})
    assert ask("report", folder, *rates)["expected_survival"] == data["expected_survival"]
    assert ask("report", folder)["expected_survival"] is None
    code, out, _ = cli(*common, "--after-lock", "--lock", "2=0.5", *rates)
    assert code == 0
    for part in ("28.6 deg (0.5 rad)", "at its position for another pose", "poses still reached after a failure,"):
        assert part in " ".join(out.split()), part


def test_assess_a_weighted_list(cli, ask, tmp_path):
    (tmp_path / "job.csv").write_text("x,y,z,qx,qy,qz,qw,weight\n1,0.2,0,0,0,0,1,1\n9,9,0,0,0,0,1,3\n")
    (tmp_path / "job.yaml").write_text("poses: job.csv")
    data = ask("assess", "planar-3r", "--region", tmp_path / "job.yaml")
    assert (data["poses"], data["reached"], data["effective_sample_size"]) == (2, 1, pytest.approx(4 / 3))
    code, out, _ = cli("assess", "planar-3r", "--region", tmp_path / "job.yaml")
    assert code == 0
    text = " ".join(out.split())
    for part in ("25.0 % of the weight are reached", "largest weight) is 1.333", "a list of 2 poses, with weights"):
        assert part in text, part
    assert ask("assess", "planar-3r", "--region", tmp_path / "job.yaml", "--poses", 10)["effective_sample_size"] is None


# ---- several -------------------------------------------------------------------------------------------------------


@pytest.fixture
def flat(tmp_path):
    file = tmp_path / "flat.yaml"
    file.write_text("box: {center: [0.6, 0.2, 0], size: [0.3, 0.3, 0]}\n")
    return file


def test_one_arm_is_as_if_there_were_no_comparison(ask, flat):
    data = ask("assess", "planar-3r", "--region", flat, "--poses", 30, "--task", "planar")
    assert "candidates" not in data
    assert data["upgrades"]["threshold"] == 0.29  # half of sqrt(1/3)
    assert data["gap"] == pytest.approx(data["bound"] - data["quantiles"]["0.5"])
    run = hf.assess(arms.load("planar-3r"), hf.Region.load(flat), task="planar", poses=30)
    expected = {u.joint: u.gain for u in run.upgrades()}
    assert {u["joint"]: u["gain"] for u in data["upgrades"]["joints"]} == expected


def test_tools_and_arms_are_compared(cli, tmp_path, monkeypatch):
    out = tmp_path / "all"
    urdf = tmp_path / "my arm.urdf"
    data_folder = Path(hf.__file__).parent / "model" / "arms" / "data"
    urdf.write_bytes((data_folder / "xarm7.urdf").read_bytes())
    arguments = ("assess", "panda", urdf, "--task", "position", "--poses", 12, "--restarts", 5)
    tools = ("--tool", "short=0,0,0.1,0,0,0", "--tool", "bent=0 0.02 0.1 90 0 0")
    code, text, err = cli(*arguments, *tools, "--out", out)
    assert code == 0
    assert "every candidate is assessed in the default region of 'panda-short'" in err
    names = ["panda-short", "panda-bent", "my_arm-short", "my_arm-bent"]
    assert all(name in text for name in names)
    assert sorted(p.name for p in out.iterdir()) == sorted([*names, "comparison.json", "report.html"])
    stamps = {name: (out / name / "run.json").read_text() for name in names}
    monkeypatch.setattr(hf.Assessment, "report", lambda self, path, *_, **__: Path(path))  # drawn a moment ago
    code, text, again = cli(*arguments, *tools, "--out", out, "--json")  # goes on: nothing is computed again
    assert (code, again) == (0, err)
    data = json.loads(text)
    assert {name: (out / name / "run.json").read_text() for name in names} == stamps
    assert [c["name"] for c in data["candidates"]] == names
    assert [c["tool"] for c in data["candidates"]] == ["short", "bent"] * 2
    assert {c["task"] for c in data["candidates"]} == {"position"}
    assert data["comparison"]["report"] == str(out / "report.html")
    for row, c in zip(data["comparison"]["table"], data["candidates"], strict=True):
        assert row["name"] == c["name"]
        assert row["reached"] == c["reached"] / 12
        assert row["probability"] == c["probability"][0]["value"]
        assert (out / c["name"] / "report.html").exists()
        assert load(out / c["name"]).arm.fingerprint == c["fingerprint"]
    bent = load(out / "panda-bent").arm
    turned = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0.02], [0, 1, 0, 0.1], [0, 0, 0, 1]])
    np.testing.assert_allclose(np.linalg.inv(bent.flange) @ bent.tool, turned, atol=1e-15)


def test_two_tasks_of_one_arm(ask, cli, flat):
    code, out, err = cli("assess", "planar-3r", "--region", flat, "--task", "vx", "--task", "planar", "--poses", 20)
    assert (code, err) == (0, "")
    assert "The tasks differ" in " ".join(out.split())
    data = ask("assess", "planar-3r", "--region", flat, "--task", "vx", "--task", "planar", "--poses", 20)
    assert [c["name"] for c in data["candidates"]] == ["planar-3r-vx", "planar-3r-planar"]


def test_report_of_a_comparison(cli, ask, refused, flat, tmp_path):
    """It said that the folder was no run."""
    out = tmp_path / "two"
    call = ("assess", "planar-3r", "--region", flat, "--task", "vx", "--task", "planar", "--poses", 20, "--at-least", 0.3)
    data = ask(*call, "--out", out)
    page = (out / "report.html").read_text(encoding="utf-8")
    (out / "report.html").unlink()
    again = ask("report", out, "--at-least", 0.3)
    differ = {key for a, b in zip(again["candidates"], data["candidates"], strict=True) for key in a if a[key] != b[key]}
    assert differ <= {"seconds"}  # of the whole run, and of the rows alone
    assert again["comparison"] == data["comparison"]
    assert (out / "report.html").read_text(encoding="utf-8") == page
    code, text, err = cli("report", out, "--to", tmp_path / "other.html")
    assert (code, err) == (0, "")
    assert "planar-3r-vx" in text
    assert (tmp_path / "other.html").exists()
    assert "--failure-rate" in refused("report", out, "--failure-rate", "joint1=1")
    for listed in ("[", "{}", '{"candidates": [{"name": "../two", "tool": null}]}', '{"candidates": [1]}'):
        (out / "comparison.json").write_text(listed)
        assert "is damaged" in refused("report", out)


def test_a_folder_of_one_run_is_not_used_for_a_comparison(refused, tmp_path):
    run = tmp_path / "run"
    hf.assess(arms.load("planar-3r"), hf.Region.joints([-1] * 3, [1] * 3), task="planar", poses=10, store=run)
    assert "contains a single run" in refused("assess", "planar-3r", "planar-2r", "--task", "vx", "--poses", 5, "--out", run)


def test_report_of_a_run_that_was_stopped(cli, ask, tmp_path):
    def stop(done, _):
        if done:
            raise KeyboardInterrupt

    folder = tmp_path / "run"
    with pytest.raises(KeyboardInterrupt):
        hf.assess(
            arms.load("planar-3r"),
            hf.Region.joints([-1] * 3, [1] * 3),
            task="planar",
            poses=200_000,
            store=folder,
            progress=stop,
        )
    data = ask("report", folder)
    assert data["complete"] is False
    assert 0 < data["evaluated"] < data["poses"] == 200_000
    assert (folder / "report.html").exists()
    other = tmp_path / "other.html"
    code, out, err = cli("report", folder, "--to", other)
    assert (code, err) == (0, "")
    assert "This run is not complete" in out
    assert other.exists()
    assert "other.html" in "".join(out.split())


def test_report_of_a_run_without_a_single_chunk(cli, tmp_path):
    def stop(*_):
        raise KeyboardInterrupt

    folder = tmp_path / "run"
    with pytest.raises(KeyboardInterrupt):
        hf.assess(
            arms.load("planar-3r"), hf.Region.joints([-1] * 3, [1] * 3), task="planar", poses=10, store=folder, progress=stop
        )
    for extra in ((), ("--json",)):
        code, _, err = cli("report", folder, *extra)
        assert code in (0, 2)
        assert "no pose was reached" not in err  # nothing was tried yet
        assert "Traceback" not in err


# ---- bad input -----------------------------------------------------------------------------------------------------

BAD = {
    "unknown command": (["nope"], ["No such command 'nope'"]),
    "unknown option": (["arms", "--x"], ["No such option", "--x"]),
    "missing arm": (["describe"], ["ARM"]),
    "missing q": (["index", "panda"], ["--q"]),
    "unknown arm": (["describe", "pa10"], ["'pa10'", "pa10-9dof"]),
    "missing urdf": (["describe", "nowhere.urdf"], ["nowhere.urdf", "cannot be read"]),
    "missing table": (["describe", "nowhere.yaml"], ["nowhere.yaml", "cannot be read"]),
    "a folder as arm": (["describe", "/tmp"], ["/tmp"]),
    "tip of a built-in": (["describe", "panda", "--tip", "hand"], ["tip cannot be chosen for 'panda'"]),
    "empty q": (["index", "panda", "--q", ""], ["0 values", "7"]),
    "short q": (["index", "panda", "--q", "1 2"], ["2 values", "7"]),
    "long q": (["index", "panda", "--q", "1 2 3 4 5 6 7 8"], ["8 values", "7"]),
    "one q of two short": (["index", "panda", "--q", "1 2 3 4 5 6 7", "--q", "1"], ["1 values", "7"]),
    "text in q": (["index", "panda", "--q", "1 2 x 4 5 6 7"], ["'x' is not a number"]),
    "nan in q": (["index", "panda", "--q", "0 0 nan 0 0 0 0"], ["NaN"]),
    "infinity in q": (["index", "panda", "--q", "0 0 1e999 0 0 0 0"], ["infinity"]),
    "not redundant": (["index", "ur5", "--q", "0 0 0 0 0 0"], ["'ur5' is not redundant", "6 joints for 6 rows"]),
    "not redundant to assess": (["assess", "ur5"], ["'ur5' is not redundant"]),
    "planar 2r": (["assess", "planar-2r"], ["'planar-2r' is not redundant"]),
    "unknown index": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--index", "charm"], ["'charm'", "condition-number"]),
    "unknown task": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--task", "dance"], ["'dance'", "pointing"]),
    "planar task in space": (
        ["index", "panda", "--q", "0 0 0 0 0 0 0", "--task", "planar"],
        ["'panda' does not move in a plane"],
    ),
    "unknown row": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--task", "vx,vq"], ["'vq'", "vx, vy, vz, wx, wy, wz"]),
    "row twice": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--task", "vx,vx"], ["each row once"]),
    "no row": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--task", ","], ["task"]),
    "length 0": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--length", "0"], ["length", "above 0"]),
    "length nan": (["index", "panda", "--q", "0 0 0 0 0 0 0", "--length", "nan"], ["length"]),
    "joint 0": (["assess", "panda", "--failures", "0; 1"], ["joint 0 is out of range", "joints 1 to 7"]),
    "joint 8": (["assess", "panda", "--failures", "8; 1"], ["joint 8 is out of range", "joints 1 to 7"]),
    "joint 0 of a pair": (["assess", "pa10-9dof", "--failures", "0+1"], ["joint 0 is out of range", "joints 1 to 9"]),
    "joint -1": (["assess", "panda", "--failures", "-1; 2"], ["'-1'", "panda_joint1"]),
    "unknown joint": (["assess", "panda", "--failures", "elbow"], ["'elbow'", "panda_joint4"]),
    "raised digit": (["assess", "panda", "--failures", "²"], ["'²'"]),
    "raised digits in a list": (["assess", "panda", "--failures", "²; 1"], ["'²'"]),
    "no failure": (["assess", "panda", "--failures", ";"], ["at least one joint"]),
    "empty failures": (["assess", "panda", "--failures", ""], ["at least one joint"]),
    "half a pair": (["assess", "pa10-9dof", "--failures", "1+"], ["''"]),
    "the same joint twice": (["assess", "pa10-9dof", "--failures", "1+1"], ["once"]),
    "the same set twice": (["assess", "pa10-9dof", "--failures", "1; joint1"], ["twice"]),
    "too many together": (["assess", "panda", "--failures", "pairs"], ["locking 2 of the 7 joints"]),
    "0 together": (["assess", "panda", "--failures", "0"], ["cannot fail together", "1 to 6"]),
    "lock beyond the limits": (["assess", "planar-3r", "--lock", "joint2=9"], ["'joint2' cannot lock at 9 rad", "limits"]),
    "lock nowhere": (["assess", "planar-3r", "--lock", "joint2"], ["--lock 'joint2' is not joint=number"]),
    "lock of nobody": (["assess", "planar-3r", "--lock", "4=0"], ["joint 4 is out of range"]),
    "lock twice": (["assess", "planar-3r", "--lock", "2=0", "--lock", "joint2=1"], ["'joint2' twice"]),
    "rate without a lock": (["assess", "planar-3r", "--failure-rate", "2=1"], ["needs its lock", "--after-lock"]),
    "negative rate": (["assess", "planar-3r", "--after-lock", "--failure-rate", "2=-1"], ["failure rates must be"]),
    "negative poses": (["assess", "pa10-9dof", "--poses", "-3"], ["poses is -3; it must be 1 or more"]),
    "no poses": (["assess", "pa10-9dof", "--poses", "0"], ["poses is 0"]),
    "poses in words": (["assess", "pa10-9dof", "--poses", "many"], ["--poses"]),
    "negative seed": (["assess", "pa10-9dof", "--poses", "5", "--seed", "-1"], ["seed is -1", "0 or more"]),
    "unknown sampling": (["assess", "pa10-9dof", "--sampling", "grid"], ["'grid'", "'random' or 'sobol'"]),
    "no threads": (["assess", "pa10-9dof", "--threads", "0"], ["threads is 0"]),
    "negative threads": (["assess", "pa10-9dof", "--threads", "-2"], ["threads is -2"]),
    "no restarts": (["assess", "pa10-9dof", "--restarts", "0"], ["restarts is 0"]),
    "threshold nan": (["assess", "pa10-9dof", "--poses", "5", "--at-least", "nan"], ["nan"]),
    "an arm twice": (["assess", "panda", "panda"], ["two candidates have the name 'panda'"]),
    "a task twice": (["assess", "panda", "--task", "pose", "--task", "pose"], ["two candidates have the name 'panda-pose'"]),
    "a tool without a name": (["assess", "panda", "--tool", "0,0,0.1,0,0,0"], ["NAME=x,y,z,roll,pitch,yaw", "gripper=0"]),
    "a tool of five numbers": (["assess", "panda", "--tool", "a=0,0,0,0,0"], ["--tool a has 5 numbers", "give 6"]),
    "a tool in words": (["assess", "panda", "--tool", "a=0,0,up,0,0,0"], ["--tool a: 'up' is not a number"]),
    "a tool nowhere": (["assess", "panda", "--tool", "a=0,0,nan,0,0,0"], ["--tool a contains NaN"]),
    "a tool that climbs": (["assess", "panda", "--tool", "../a=0,0,0,0,0,0"], ["is not NAME="]),
    "one of two not redundant": (["assess", "panda", "ur5"], ["'ur5' is not redundant"]),
    "missing region": (
        ["assess", "pa10-9dof", "--region", "nowhere.yaml"],
        ["region file 'nowhere.yaml': the file cannot be read"],
    ),
    "report of nothing": (["report", "/nowhere"], ["'/nowhere' is not a holdfast run"]),
    "report of another folder": (["report", "/tmp"], ["'/tmp' is not a holdfast run"]),
    "unwritable": (["assess", "pa10-9dof", "--poses", "5", "--out", "/proc/x"], ["cannot write to '/proc/x'"]),
    "below a file": (["assess", "pa10-9dof", "--poses", "5", "--out", "/etc/passwd/x"], ["cannot write to '/etc/passwd/x'"]),
    "a file as folder": (["assess", "pa10-9dof", "--poses", "5", "--out", "/etc/passwd"], ["'/etc/passwd'"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_sentence(case, refused):
    arguments, parts = BAD[case]
    message = refused(*arguments)
    for part in parts:
        assert part.lower() in message.lower(), message


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("box: {center: [0, 0, 0], size: 1, edge: 2}", ["'box.edge' is not known", "rpy_size"]),
        ("box: {center: [0, 0, .nan], size: 1}", ["center", "finite"]),
        ("box: [", ["not valid YAML"]),
        ("joints: {lower: [0], upper: [1]}", ["1 joints", "9"]),
    ],
)
def test_a_bad_region_file_is_one_sentence(text, parts, refused, tmp_path):
    file = tmp_path / "region.yaml"
    file.write_text(text)
    message = refused("assess", "pa10-9dof", "--region", file, "--poses", 5, "--out", tmp_path / "out")
    assert all(p in message for p in parts), message
    assert not (tmp_path / "out").exists()


def test_foreign_damaged_and_other_folders(refused, cli, tmp_path):
    foreign = tmp_path / "foreign"
    foreign.mkdir()
    (foreign / "mine.txt").write_text("x")
    assert "is not a holdfast run" in refused("assess", "pa10-9dof", "--poses", 5, "--out", foreign)
    assert [p.name for p in foreign.iterdir()] == ["mine.txt"]
    run = tmp_path / "run"
    hf.assess(arms.load("planar-3r"), hf.Region.joints([-1] * 3, [1] * 3), task="planar", poses=10, store=run)
    assert "holds another run" in refused("assess", "pa10-9dof", "--poses", 5, "--out", run)
    (run / "run.json").write_text('{"format": "holdfast-run", "version": 1, "pl')
    assert "damaged" in refused("report", run)
    assert "damaged" in refused("assess", "pa10-9dof", "--poses", 5, "--out", run)


def test_the_report_cannot_be_written(refused, tmp_path):
    run = tmp_path / "run"
    hf.assess(arms.load("planar-3r"), hf.Region.joints([-1] * 3, [1] * 3), task="planar", poses=10, store=run)
    for place in ("/proc/x.html", "/etc/passwd/x.html"):
        assert place in refused("report", run, "--to", place)


# ---- URDF files that were not made for holdfast --------------------------------------------------------------------


def joint(
    name,
    kind,
    parent,
    child,
    xyz="0 0 0.3",
    rpy="0 0 0",
    axis="0 0 1",
    more='<limit lower="-2" upper="2" effort="1" velocity="1"/>',
):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{more}</joint>'
    )


def robot(*joints, links):
    return (
        '<?xml version="1.0"?>\n<robot name="r">' + "".join(f'<link name="{x}"/>' for x in links) + "".join(joints) + "</robot>"
    )


# The world carries a pedestal; fixed frames sit between moving joints; the hand branches into two fingers and a camera.
MOVING = ["Achse 1 (Fuß)", "j.2-links/rechts", "J3", "joint_elbow::pitch", "5", "wrist [a]", "µ7"]


def odd_urdf() -> str:
    x, lines = "pedestal", [joint("world fix", "fixed", "Welt", "pedestal", "1 2 0.5", "0.1 0.2 0.3", more="")]
    links = ["Welt", "pedestal"]
    axes = ["0 0 1", "0 1 0", "0 0 -1", "0 2 0", "0 0 1", "0.6 0.8 0", "0 0 1"]
    for k, (name, axis) in enumerate(zip(MOVING, axes, strict=True)):
        links += [f"Glied {k}", f"Glied {k} / mount", f"Glied {k} / plate"]
        lines += [
            joint(name, "continuous" if k == 6 else "revolute", x, links[-3], f"0.0{k} 0.02 0.25", f"0 0 0.{k}", axis),
            joint(f"fix {k}a", "fixed", links[-3], links[-2], "0 0.01 0", "0.1 0 0", more=""),
            joint(f"fix {k}b", "fixed", links[-2], links[-1], "0.01 0 0.05", "0 0.2 0", more=""),
        ]
        x = links[-1]
    for side, sign in (("left", 1), ("right", -1)):
        links.append(f"finger {side}")
        mimic = "" if sign > 0 else '<mimic joint="grip left" multiplier="-1"/>'
        limit = '<limit lower="0" upper="0.04" effort="1" velocity="1"/>'
        lines.append(
            joint(f"grip {side}", "prismatic", x, links[-1], f"0 {0.02 * sign} 0.1", axis=f"0 {sign} 0", more=limit + mimic)
        )
    links += ["camera", "TCP"]
    lines += [
        joint("eye", "fixed", x, "camera", "0.1 0 0", more=""),
        joint("tcp", "fixed", x, "TCP", "0 0 0.12", "0 0.1 0", more=""),
    ]
    return robot(*lines, links=links)


def test_a_urdf_not_made_for_holdfast_end_to_end(ask, cli, refused, tmp_path, rng):
    import pinocchio as pin

    file = tmp_path / "Zelle 3.urdf"
    file.write_text(odd_urdf())
    message = refused("describe", file)
    assert "TCP" in message
    assert "camera" in message
    chain = ("--base", "pedestal", "--tip", "TCP")
    data = ask("describe", file, *chain)
    assert [j["name"] for j in data["joints"]] == MOVING
    assert data["joints"][6]["lower"] is None
    code, out, err = cli("describe", file, *chain)
    assert (code, err) == (0, "")
    assert "wrist [a]" in out  # not taken for markup

    q = rng.uniform(-1.5, 1.5, 7)
    found = ask("index", file, *chain, "--q", " ".join(map(repr, q.tolist())))
    model = pin.buildModelFromXML(odd_urdf())
    position = pin.neutral(model)
    for name, value in zip(MOVING, q, strict=True):
        body = model.joints[model.getJointId(name)]
        position[body.idx_q : body.idx_q + body.nq] = value if body.nq == 1 else (np.cos(value), np.sin(value))
    full = pin.computeFrameJacobian(model, model.createData(), position, model.getFrameId("TCP"), pin.LOCAL)
    j = full[:, [model.joints[model.getJointId(name)].idx_v for name in MOVING]]
    expected = oracles.index("relative-manipulability", j[None], [[k] for k in range(7)])[0]
    assert list(found["by_failure"]) == MOVING
    np.testing.assert_allclose(list(found["by_failure"].values()), expected, rtol=1e-8, atol=1e-12)
    assert found["worst"] == MOVING[expected.argmin()]
    by_number = ask("index", file, *chain, "--q", " ".join(map(repr, q.tolist())), "--failures", "6; 2")
    assert list(by_number["by_failure"]) == [MOVING[5], MOVING[1]]

    run = ask("assess", file, *chain, "--poses", 64, "--out", tmp_path / "out")
    assert run["reached"] > 0
    assert list(run["worst_counts"]) == MOVING
    assert list(load(tmp_path / "out").arm.joint_names) == MOVING


LIMITS = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
CHAIN = [joint("a", "revolute", "base", "l1"), joint("b", "revolute", "l1", "l2")]
BAD_URDF = {
    "no such tip": (robot(*CHAIN, links=["base", "l1", "l2"]), ["--tip", "hand"], ["'hand'", "l2"]),
    "no such base": (robot(*CHAIN, links=["base", "l1", "l2"]), ["--base", "floor"], ["'floor'", "base"]),
    "tip below base": (robot(*CHAIN, links=["base", "l1", "l2"]), ["--base", "l2", "--tip", "l1"], ["'l1'", "'l2'"]),
    "ambiguous tip": (
        robot(*CHAIN, joint("c", "revolute", "l1", "l3"), links=["base", "l1", "l2", "l3"]),
        [],
        ["l2", "l3"],
    ),
    "mimic": (
        robot(CHAIN[0], joint("b", "revolute", "l1", "l2", more=LIMITS + '<mimic joint="a"/>'), links=["base", "l1", "l2"]),
        [],
        ["'b'", "mimic"],
    ),
    "floating": (
        robot(CHAIN[0], joint("b", "floating", "l1", "l2", more=""), links=["base", "l1", "l2"]),
        [],
        ["'b'", "floating"],
    ),
    "reversed limits": (
        robot(
            CHAIN[0],
            joint("b", "revolute", "l1", "l2", more='<limit lower="1" upper="-1" effort="1" velocity="1"/>'),
            links=["base", "l1", "l2"],
        ),
        [],
        ["'b'", "reversed", "lower 1", "upper -1"],
    ),
    "loop": (robot(*CHAIN, joint("c", "revolute", "l2", "l1"), links=["base", "l1", "l2"]), [], ["l1"]),
    "not XML": ("<robot", [], ["XML"]),
    "empty": ("", [], ["XML"]),
    "not a robot": ("<mujoco/>", [], ["<mujoco>"]),
    "nan": (robot(CHAIN[0], joint("b", "revolute", "l1", "l2", xyz="0 nan 0"), links=["base", "l1", "l2"]), [], ["'b'"]),
}


@pytest.mark.parametrize("command", ["describe", "index", "assess"])
@pytest.mark.parametrize("case", BAD_URDF)
def test_a_bad_urdf_is_one_sentence(case, command, refused, tmp_path):
    text, options, parts = BAD_URDF[case]
    file = tmp_path / "bad.urdf"
    file.write_text(text)
    message = refused(command, file, *options, *(["--q", "0 0"] if command == "index" else []))
    assert "bad.urdf" in message
    for part in parts:
        assert part in message, message


def test_only_heavy_commands_load_heavy_packages():
    code = "import sys, holdfast.interface.cli; print(sorted({'matplotlib', 'xarray', 'zarr', 'jinja2'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
