"""A view as a command line and back, and what the command refuses."""

from __future__ import annotations

import json
import re
import shlex
import socket
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import holdfast as hf
from holdfast.interface.cli.program import build_app
from holdfast.interface.studio import State, serve
from holdfast.interface.studio.answers import Request, ServedArm
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.motions import read_motion
from holdfast.model.arm.task import as_task

BENCH = Path(__file__).parents[3] / "examples" / "cells" / "bench.yaml"


@pytest.fixture
def opened(monkeypatch):
    """What the command would have served, in place of serving it."""
    calls = []

    class Page:
        def __enter__(self):
            return self

        def __exit__(self, *_):
            return None

        def wait(self):
            return None

    def fake(arm, state, host, port, task, cell, ready):
        calls.append((arm, state, host, port, task, cell))
        ready("http://127.0.0.1:1")
        return Page()

    monkeypatch.setattr("holdfast.interface.studio.server.serve", fake)
    return calls


def run(command):
    result = CliRunner().invoke(build_app(), shlex.split(command)[1:], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def test_a_state_comes_back_from_its_command_line(opened, tmp_path, rng):
    folder = tmp_path / "it's a folder"
    folder.mkdir()
    names = hf.arms.load("panda").joint_names
    quaternion = rng.normal(size=4)
    state = State(
        "panda",
        names,
        tuple(rng.uniform(-0.3, 0.3, 7).tolist()),
        task="pose",
        conditions=("healthy", "locked", "healthy", "healthy", "free", "healthy", "healthy"),
        index="condition-number",
        susceptibility="swing-angle",
        objective="acceleration",
        laws=("damped:0.1", "failure-tolerant:0.3"),
        target=(0.3, -0.2, 0.5, *(quaternion / np.linalg.norm(quaternion) * np.sign(quaternion[3])).tolist()),
        show="laws",
        region=str(folder),
        time=1.25,
        cell=str(BENCH),
        meshes=str(folder),
        moved=(("lamp", (0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0)),),
    )
    run(state.to_command())
    found = opened[0][1]
    np.testing.assert_allclose(found.target, state.target, atol=1e-12)
    assert found == State(**(vars(state) | {"target": found.target}))


def test_defaults_are_the_home_of_the_arm_and_this_machine(opened):
    output = run("holdfast studio pa10-9dof")
    _, state, host, port, task, cell = opened[0]
    assert host == "127.0.0.1"
    assert port == 8123
    assert state.q == hf.arms.about("pa10-9dof").home
    assert task.m == 6
    assert state.show == "arm"
    assert re.search(r"Open http://\S+ in a browser", output)
    run(state.to_command())
    assert opened[1][1] == state
    assert cell is None


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("--q 1,2", "it must have 7"),
        ("--lock 9", "joints 1 to 7"),
        ("--lock 2 --free 2", "given twice"),
        ("--index best", "--index: index 'best' is not known"),
        ("--show all", "--show 'all' is not known"),
        ("--law pseudoinverse", "given 1 times"),
        ("--law pseudoinverse --law magic", "not known"),
        ("--file nowhere.csv", "no file or folder 'nowhere.csv'"),
        ("--target 1,2", "--target has 2 numbers"),
        ("--port 70000", "not a port"),
        ("--host 203.0.113.7 --port 0", "cannot be used"),
    ],
)
def test_bad_input_is_one_sentence(options, sentence):
    with pytest.raises(hf.HoldfastError, match=re.escape(sentence)):
        CliRunner().invoke(build_app(), ["studio", "panda", *shlex.split(options)], catch_exceptions=False)


def test_a_port_in_use_is_named():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(hf.InputError, match=f"port {port} of 127.0.0.1 cannot be used"):
            serve(
                hf.arms.load("planar-3r"),
                State("planar-3r", hf.arms.load("planar-3r").joint_names, (0.1, 0.2, 0.3), task="planar"),
                port=port,
            )


def test_a_state_that_a_page_returns_is_the_same(rng):
    panda = hf.arms.load("panda")
    state = State(
        "panda",
        panda.joint_names,
        tuple(rng.uniform(-0.3, 0.3, 7).tolist()),
        hold=(("finger", 0.1),),
        conditions=("healthy", "locked", "free", "healthy", "free", "healthy", "healthy"),
        target=tuple(rng.normal(size=7).tolist()),
        moved=(("lamp", (0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0)),),
        fault=("limp", "panda_joint2", 0.5),
        friction=0.25,
    )
    served = ServedArm(CompiledArm(panda, as_task(panda, "pose")), state)
    page_state = json.loads(json.dumps(served.page_data("token")["state"]))
    body = json.dumps({"state": page_state, "file": None, "ghosts": [list(state.q)]}).encode()
    assert served.read_request(body) == Request(state, ghosts=(state.q,))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"q": (0.1,)}, "q has 1 values"),
        ({"conditions": ("broken",) * 3}, "healthy, locked, free"),
        ({"show": "nothing"}, "use one of arm"),
        ({"target": (1.0, 2.0)}, "target has the numbers"),
        ({"target": (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0)}, "other than 0"),
        ({"moved": (("ball", (1.0,)),)}, "ball has the numbers"),
        ({"time": float("nan")}, "finite"),
    ],
)
def test_impossible_states_are_refused(change, sentence):
    with pytest.raises(hf.InputError, match=sentence):
        State(**({"arm": "planar-3r", "names": ("a", "b", "c"), "q": (0.0, 0.0, 0.0)} | change))


# ---- motions of files ----------------------------------------------------------------------------------------------


def test_motions_that_the_library_writes_are_read(tmp_path):
    from holdfast.response.recovery.waypoints import write_waypoints

    arm = hf.arms.load("planar-3r")
    q = np.array([[0.1, 0.2, 0.3], [0.2, 0.1, 0.5], [0.2, 0.0, 0.6]])
    motion = read_motion(arm, write_waypoints(arm, q, tmp_path / "waypoints.csv"))
    np.testing.assert_array_equal(motion.q, q)
    assert motion.unit in ("s", "rad")
    assert read_motion(arm, tmp_path).label == "waypoints.csv"
    line = hf.paths.line([1.5, 1.0, 0], [1.2, 1.2, 0])
    trajectory = hf.follow(
        arm, hf.paths.TimedPath(line, hf.paths.Constant(1.0)), hf.indices.relative_manipulability(arm, "planar")
    )
    found = read_motion(arm, trajectory.to_csv(tmp_path / "trajectory.csv"))
    np.testing.assert_array_equal(found.q, trajectory.q)
    np.testing.assert_array_equal(found.time, trajectory.time)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "column"),
        ("time_s,joint1_rad\n0,1\n", "is missing"),
        ("HEAD\n", "finite numbers"),
        ("HEAD\n0,1,2\n", "must hold 4 numbers"),
        ("HEAD\n0,1,2,nan\n", "finite numbers"),
        ("HEAD\n1,1,2,3\n0,1,2,3\n", "run backwards"),
    ],
)
def test_damaged_motions_are_refused(tmp_path, text, sentence):
    arm = hf.arms.load("planar-3r")
    head = ",".join(["time_s", *(f"{j.name}_rad" for j in arm.joints)])
    (tmp_path / "x.csv").write_text(text.replace("HEAD", head))
    with pytest.raises(hf.InputError, match=sentence):
        read_motion(arm, tmp_path / "x.csv")
    with pytest.raises(hf.InputError, match="contains no motion"):
        read_motion(arm, tmp_path)
