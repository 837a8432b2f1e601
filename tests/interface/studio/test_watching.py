"""A fault that is injected in the studio, and what the monitor makes of it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.studio import State, monitor_demo
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.monitor_demo import simulate_monitor_demo
from holdfast.model.arm.poses import pose_numbers
from holdfast.model.arm.task import as_task
from holdfast.response.diagnosis.decision import CLASSIFICATION_TIME_S, ISOLATION_TIME_S

pytest.importorskip("mujoco")
NAMES = ("a", "b")


def sentences(onset=1.0, end=4.0, inconclusive=(), **more):
    """Sentences about a lock of b at 1 s that is detected at 1.2 s."""
    verdict = {"alarm": True, "time": 1.2, "joint": "b", "kind": "locked", "candidates": ("b",), "evidence": ("it stands.",)}
    diagnosis = SimpleNamespace(
        verdict=SimpleNamespace(**(verdict | more)),
        inconclusive=inconclusive,
        arm=SimpleNamespace(joint_names=NAMES),
        describe=lambda: ["alarm at 1.2 s: b is <locked>."],
    )
    isolation_time = 1.2 + ISOLATION_TIME_S
    return monitor_demo._write_sentences(diagnosis, onset, isolation_time, end)


def test_what_is_known_comes_with_time():
    known_from = 1.2 + ISOLATION_TIME_S + CLASSIFICATION_TIME_S
    assert sentences() == [
        (1.2, "Alarm 200 ms after the fault."),
        (1.2 + ISOLATION_TIME_S, "The monitor isolates b."),
        (pytest.approx(known_from), "b is <locked>."),
        (pytest.approx(known_from), "It stands."),
    ]


@pytest.mark.parametrize(
    ("changes", "number", "sentence"),
    [
        ({"onset": 2.0}, 0, (1.2, "Alarm at 1.200 s, before any fault.")),
        ({"onset": np.inf}, 0, (1.2, "Alarm at 1.200 s, before any fault.")),
        ({"alarm": False}, 0, (4.0, "No fault was detected, which does not prove that there is none.")),
        ({"candidates": ("a", "b")}, -1, (4.0, "Not distinguished: a, b.")),
        ({"inconclusive": ("a",)}, -1, (4.0, "Did not move enough for a diagnosis: a.")),
    ],
)
def test_the_sentences_follow_the_verdict(changes, number, sentence):
    assert sentences(**changes)[number] == sentence


def test_no_joint_is_isolated_where_the_monitor_names_none():
    assert not any("isolates" in text for _, text in sentences(joint=None))


def test_there_must_be_a_target():
    with pytest.raises(InputError, match="there is no target"):
        simulate_monitor_demo(None, State("x", NAMES, (0.0, 0.0)), lambda *_: None)


@pytest.fixture(scope="module")
def machine():
    arm = hf.arms.load("panda")
    return CompiledArm(arm, as_task(arm, "position"))


@pytest.mark.parametrize(("kind", "joint", "onset"), [("locked", 3, 1.0), ("limp", 1, 0.5), ("none", 0, 1.0)])
def test_a_fault_is_detected_and_isolated(machine, kind, joint, onset):
    names = machine.arm.joint_names
    q = np.array(hf.arms.about("panda").home)
    target = pose_numbers(machine.tool_pose(machine.nearby_configuration(q)))
    state = State("panda", names, tuple(q), task="position", target=target, fault=(kind, names[joint], onset))
    steps = []
    watch = simulate_monitor_demo(machine, state, lambda *step: steps.append(step))
    assert steps[-1] == (monitor_demo.HEALTHY_MOTIONS, monitor_demo.HEALTHY_MOTIONS + 1)
    time, torque = np.array(watch["time"]), np.array(watch["signals"][0]["values"], dtype=float)
    assert torque.shape == (len(time), 7)
    texts = [sentence["text"] for sentence in watch["sentences"]]
    if kind == "none":
        assert (watch["onset"], watch["alarm"], watch["isolated"]) == (None, None, None)
        assert texts[0].startswith("No fault was detected")
        assert np.nanmax(torque) < 1
        return
    assert watch["onset"] == onset <= watch["alarm"]
    assert watch["isolated"]["joint"] == joint
    assert texts[:2] == [
        f"Alarm {1000 * (watch['alarm'] - onset):.0f} ms after the fault.",
        f"The monitor isolates {names[joint]}.",
    ]
    assert any(names[joint] in text for text in texts[2:])
    ratios = np.concatenate([np.array(signal["values"], dtype=float) for signal in watch["signals"]], axis=1)
    assert np.nanmax(ratios[time < onset - 0.05]) < 1 < np.nanmax(ratios[time > watch["alarm"] - 0.05])
    moved, path = np.array(watch["motion"]["time"]), np.array(watch["motion"]["q"])
    after = path[moved > onset + 0.1, joint]
    if kind == "locked":
        np.testing.assert_allclose(after, after[0], atol=2e-3)
    np.testing.assert_allclose(path[0], q, atol=1e-6)
