"""Commands and Python lines that a visitor copies: they run, and give the numbers that the page shows."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from holdfast import arms
from holdfast.interface.presentation.arm_page.build import build_page

BRAKE_DELAY_MS = 150
ARM_FILES = Path(__file__).parents[1] / "studio" / "arms"  # the commands of the crane name its file alone


def numbers_in(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


def contains(text, value, scales=(1.0,), rel=2e-3):
    """Whether a text has a number that is the value in one of the units."""
    return any(number * scale == pytest.approx(value, rel=rel, abs=1e-7) for number in numbers_in(text) for scale in scales)


@pytest.fixture(scope="module", params=["panda", "planar-3r", "crane"])
def shown(request, page_arm):
    """The page of an arm: a call of its numerics, its data, and the worst joint."""
    page = page_arm(request.param)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ARM_FILES)
        arm = arms.load("inspection-crane.urdf" if request.param == "crane" else request.param)
        html = build_page(arm).text
    block = re.search(r'class="arm-data"[^{]*(\{.*?)</script>', html, re.S)
    data = json.loads(block.group(1))
    data["scene"] = {"joints": [None] * arm.n}
    q = data["story"]["start"]
    (fractions,) = page.call("(page, arm, q) => page.relativeManipulability(arm, q)", [q])
    return page, data, np.array(fractions)


@pytest.fixture
def copied(shown, cli, capsys, monkeypatch):
    """``copied(step, **conditions)``: output of the shell lines and of the Python lines."""
    page, data, fractions = shown
    monkeypatch.chdir(ARM_FILES)

    def run(step, conditions=()):
        joints = [dict(conditions).get(k, "healthy") for k in range(page.arm.n)]
        state = {
            "arm": data["name"],
            "step": step,
            "q": data["story"]["start"],
            "conditions": joints,
            "brakeDelay": BRAKE_DELAY_MS,
        }
        row = [data, state, int(fractions.argmin()), data["story"]["target"]]
        (codes,) = page.call("(page, arm, row) => page.reproduce(...row)", [row])
        lines = {code["kind"]: code["text"] for code in codes}
        outputs = []
        for line in lines["shell"].splitlines():
            code, out, err = cli(*shlex.split(line)[1:])
            assert code == 0, err
            outputs.append(out)
        exec(lines["python"], {})
        return outputs, capsys.readouterr().out

    return run


def test_bars_are_those_of_the_index(shown, copied):
    _, _, fractions = shown
    (shell,), python = copied("healthy")
    assert all(contains(shell, value) and contains(python, value) for value in fractions)


def test_a_lock_leaves_what_the_command_prints(shown, copied):
    page, data, fractions = shown
    worst = int(fractions.argmin())
    (shell,), _ = copied("lock", {worst: "locked"})
    row = [data["story"]["start"], [worst]]
    (motions,) = page.call("(page, arm, [q, joints]) => page.lostMotions(arm, q, joints)", [row])
    assert contains(shell, motions[0]["remaining"])
    other = (worst + 1) % page.arm.n
    _, python = copied("lock", {worst: "locked", other: "locked"})
    row = [data["story"]["start"], sorted([worst, other])]
    (motions,) = page.call("(page, arm, [q, joints]) => page.lostMotions(arm, q, joints)", [row])
    assert contains(python, max(motion["remaining"] for motion in motions))


def test_the_best_is_at_least_that_of_the_self_motion(shown, copied):
    page, data, _ = shown
    (shell,), python = copied("prepare")
    (motion,) = page.call("(page, arm, q) => page.traceSelfMotion(arm, q)", [data["story"]["start"]])
    best = motion["worst"][motion["best"]]
    (found,) = numbers_in(python)
    assert best * 0.999 <= found <= 1.05 * best
    assert contains(shell, found)


def test_deviations_are_those_of_simulate(shown, copied):
    page, data, fractions = shown
    worst, story = int(fractions.argmin()), data["story"]
    shells, python = copied("undetected", {worst: "locked"})
    for k, (law, shell) in enumerate(zip(story["laws"], shells, strict=True)):
        settings = {"law": law["slug"], "gain": story["gain"], "speed": story["speed"]}
        row = [story["start"], story["target"], [worst], settings]
        (motion,) = page.call("(page, arm, row) => page.simulateControl(arm, ...row)", [row])
        assert numbers_in(python)[k] == pytest.approx(motion["deviation"], abs=1e-4)
        if motion["time"][-1] < 12 - 0.03:
            assert contains(shell, motion["deviation"], (1.0, 1e-2, 1e-3), rel=5e-3)


@pytest.mark.parametrize("free", [[], [1]])
def test_drops_are_those_of_a_power_loss(shown, copied, free):
    page, data, _ = shown
    shells, python = copied("power", dict.fromkeys(free, "free"))
    falling = [int(not free or k in free) for k in range(page.arm.n)]
    row = [data["story"]["start"], falling, BRAKE_DELAY_MS / 1000, data["gravity"]]
    (fall,) = page.call("(page, arm, row) => page.simulateFall(arm, ...row)", [row])
    assert numbers_in(python) == pytest.approx([fall["drop"][-1]], abs=2e-5)
    assert contains(shells[0], fall["drop"][-1], (1.0, 1e-2, 1e-3), rel=5e-3)
    if free:
        (swing,) = page.call("(page, arm, [q, k]) => page.swingJoint(arm, q, k)", [[data["story"]["start"], free[0]]])
        joint, end = page.arm.joints[free[0]], data["story"]["start"][free[0]] + swing["toRest"]
        if joint.lower + 1e-6 < end < joint.upper - 1e-6:  # the command does not stop at limits
            assert contains(shells[1], swing["toRest"])
