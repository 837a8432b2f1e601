"""The controller in C++: by a real clock, and cycle by cycle beside the reaction in Python."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.diagnosis.monitor import Monitor
from holdfast.response.supervisor.controller import Controller
from holdfast.response.supervisor.masked_law import MaskedLaw

sys.path.append(str(Path(__file__).parents[2] / "response" / "diagnosis"))
import c_monitor

HERE = Path(__file__).parent
CPP = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++")
WARNINGS = ("-pedantic", "-Wall", "-Wextra", "-Werror")
START, RATE = np.array([0.3, 0.2, 0.4, -1.6, 0.5, 1.6, 0.3]), 1000.0
MODES = ("inactive", "running", "slowed", "degraded", "stopped")
needs_compilers = pytest.mark.skipif(CPP is None or c_monitor.COMPILER is None, reason="no C++ compiler on this machine")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The files for a Panda, and the mock hardware, compiled with sanitisers."""
    arm, folder = hf.arms.load("panda"), tmp_path_factory.mktemp("controller")
    law, bounds = hf.control.damped(arm, 0.02), replace(c_monitor.bounds_of(arm), speed=np.full(7, 0.2))
    files = hf.supervisor.export_controller(law, bounds, folder)
    sanitised = ("-O0", "-ffp-contract=off", *c_monitor.SANITISED)
    for source in ("controller_law.c", "controller_monitor.c"):
        command = [c_monitor.COMPILER, "-std=c99", *WARNINGS, *sanitised, "-c", source]
        subprocess.run(command, cwd=folder, check=True, timeout=100)
    objects = ("controller_law.o", "controller_monitor.o")
    command = [CPP, "-std=c++17", *WARNINGS, *sanitised, "-I.", "controller.cpp", str(HERE / "mock_loop.cpp"), *objects]
    subprocess.run([*command, "-o", "mock_loop"], cwd=folder, check=True, timeout=100)
    return law, bounds, files, [str(folder / "mock_loop"), *map(repr, START.tolist())]


@needs_compilers
def test_every_lock_is_isolated_by_a_real_clock(made):
    *_, program = made
    done = subprocess.run([*program, "10"], capture_output=True, text=True, check=True, timeout=60)
    *arms, allocated = done.stdout.splitlines()
    rows = [line.split() for line in arms]
    assert [(row[0], int(row[1]), row[2]) for row in rows[:7]] == [("1", k, "degraded") for k in range(7)]
    assert rows[7][:3] == ["0", "-1", "running"]
    assert allocated == "0"


class Driven:
    """The compiled controller, cycle by cycle, and beside it the monitor and the reaction in Python."""

    def __init__(self, made, *, brakes=True):
        self.law, self.bounds, _, program = made
        self.process = subprocess.Popen([*program, "step", str(int(brakes))], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.monitor = Monitor(self.law.arm, self.bounds)
        self.masked = MaskedLaw(self.law, np.eye(4), centring=0.0)
        self.ours = Controller(
            self.masked,
            bounds=self.bounds,
            brakes=self,
            monitor=self.monitor,
            react="chain",
            plan=False,
        )
        self.rates = np.zeros(7)

    def brake(self, joint):
        """Nothing to do: what is asked for is compared."""

    def __call__(self, told, effort, twist, pose=None, period=1 / RATE):
        row = np.r_[period, told, effort, twist, 0 if pose is None else 1, np.zeros(16) if pose is None else pose.ravel()]
        self.process.stdin.write(row.tobytes())
        self.process.stdin.flush()
        out = np.frombuffer(self.process.stdout.read(8 * 26))
        self.mode, self.joint, self.watching, self.time = MODES[int(out[0])], int(out[1]), bool(out[2]), out[3]
        before, self.place, self.rates, self.reference, self.braked = self.rates, out[4], out[5:12], out[12:19], out[19:]
        q = self.ours.trusted_positions(told)
        if pose is not None:
            self.ours.on_tool_pose(self.time, told, pose)
        verdict = self.monitor.step(q, self.reference, effort, pose=pose)
        signals = {"v": self.monitor._filtered_rates, "commanded_rates": before, "gravity": self.monitor._gravity_torque}
        self.ours.on_verdict(self.time, verdict, tracking_error=self.reference - q, **signals)
        return self.rates

    @property
    def expected(self):
        """Mode and joint by Python."""
        out = -1 if self.ours.condition.last_braked is None else self.ours.condition.last_braked
        mode = "stopped" if self.ours.is_stopped else "degraded" if out >= 0 else "slowed" if self.ours.pace < 1 else "running"
        return mode, out

    def close(self):
        """The end; a leak or an allocation shows here."""
        self.process.stdin.close()
        assert self.process.wait(20) == 0
        self.process.stdout.close()


def moved(drive, fault, joint, rng, *, brakes=True, second=None):
    """An arm whose torques are those of the model, with a fault: modes that it went through, and its true places."""
    arm, body = drive.law.arm, drive.bounds.body(drive.law.arm)
    q, v, modes, sensor = START.copy(), np.zeros(7), [], np.zeros(7)
    for k in range(900 if second is None else 1900):
        after = k > 250
        target = drive.rates + (v - drive.rates) * np.exp(-1 / 16)
        if after and fault == "locked":
            target[joint] = 0
        if k > 1200 and second is not None:
            target[second] = 0
        if after and fault == "limp" and not drive.braked[joint]:  # nothing acts on it but the others
            one = np.eye(7)[joint]
            still = body.inverse_dynamics(q, v, np.where(one, 0, (target - v) * RATE))
            own = body.inverse_dynamics(q, 0 * v, one)[joint] - body.gravity_torque(q)[joint]
            target[joint] = v[joint] - still[joint] / own / RATE
        elif after and fault == "limp":
            target[joint] = 0
        acceleration, v = (target - v) * RATE, target
        q = q + v / RATE
        effort = body.inverse_dynamics(q, v, acceleration) + 0.3 * v + drive.bounds.coulomb * np.tanh(v / 0.02)
        if after and fault in ("locked", "limp"):
            effort[joint] += 900 * (drive.reference[joint] - q[joint])
        if k > 1200 and second is not None:
            effort[second] += 900 * (drive.reference[second] - q[second])
        if after and fault == "weak":
            effort[joint] /= 0.45
        elif after and fault == "push":
            effort -= arm.jacobian(q)[:3].T @ [20.0, -30.0, 25.0]
        elif after and fault == "sensor":
            sensor[joint] += 1e-4
        pose = arm.forward_kinematics(q) if fault == "sensor" and k % 10 == 0 else None
        if pose is not None:
            pose[:3, 3] += rng.normal(0, 3e-4, 3)
        twist = 0.04 * np.sin(np.arange(6) + k / 300) * min(1, k / 100)
        drive(q + sensor + rng.normal(0, 2e-5, 7), effort, twist, pose)
        assert not brakes or (drive.mode, drive.joint) == drive.expected, (fault, k)
        assert (drive.braked > 0).tolist() == (drive.masked.mask == 0).tolist() or not brakes
        if not modes or modes[-1] != drive.mode:
            modes.append(drive.mode)
    return " ".join(modes), q


@needs_compilers
@pytest.mark.parametrize(
    ("fault", "joint", "ends", "out"),
    [
        ("none", 0, "running", -1),
        ("locked", 1, "running degraded", 1),
        ("limp", 3, "running degraded", 3),
        ("weak", 3, "running slowed", -1),
        ("push", 0, "running slowed", -1),
        ("sensor", 2, "running degraded", 2),
    ],
)
def test_it_reacts_as_in_python(made, rng, fault, joint, ends, out):
    drive = Driven(made)
    modes, q = moved(drive, fault, joint, rng)
    assert (modes, drive.joint) == (ends, out)
    if fault == "sensor":
        assert drive.place == pytest.approx(drive.ours.trusted_positions(q)[joint], abs=1e-5)
        assert drive.place == pytest.approx(q[joint], abs=2e-3)
    drive.close()


@needs_compilers
@pytest.mark.parametrize("first", ["locked", "sensor"])
def test_a_second_lock_is_reacted_to_as_in_python(made, rng, first):
    drive = Driven(made)
    modes, _ = moved(drive, first, 2, rng, second=3)
    assert (modes.split()[-1], drive.joint) == ("degraded", 3)
    assert np.flatnonzero(drive.braked).tolist() == [2, 3]
    assert [v.joint for v in drive.ours.verdicts] == [drive.law.arm.joint_names[k] for k in (2, 3)]
    drive.close()


@needs_compilers
def test_without_brakes_an_arm_that_swings_free_stops(made, rng):
    drive = Driven(made, brakes=False)
    assert moved(drive, "limp", 3, rng, brakes=False)[0] == "running slowed stopped"
    drive.close()


@needs_compilers
def test_what_no_joint_is_to_blame_for(made, rng):
    """Positions that are not numbers, cycles that come late, twists that are not numbers; and the task itself."""
    drive, still = Driven(made), np.zeros(6)
    arm, q, gravity = drive.law.arm, START.copy(), drive.bounds.body(drive.law.arm).gravity_torque(START)
    twist = np.array([0.05, 0, 0, 0, 0.1, 0])
    for _ in range(600):
        q = q + drive(q, gravity, twist) / RATE
    assert drive.mode == "running"
    assert arm.jacobian(q) @ drive.rates == pytest.approx(twist, abs=2e-3)  # damped
    assert (drive(np.full(7, np.nan), gravity, twist) == 0).all()
    assert drive.mode == "stopped"
    assert not drive.watching
    assert 0 < np.abs(drive(q, gravity, twist)).max() <= 0.011  # from standstill
    assert drive.mode == "running"
    for period, seen in ((1.6e-3, False), (1e-3, True), (0.4e-3, False), (0.0, False), (np.nan, False), (1.2e-3, True)):
        drive(q, gravity, twist, period=period)
        assert drive.watching == seen, period
    for _ in range(600):
        q = q + drive(q, gravity, [np.nan] * 6) / RATE
    assert np.abs(drive.rates).max() == 0
    assert (drive(q, gravity, still, period=np.inf) == 0).all()
    assert drive.mode == "inactive"
    drive.close()


@pytest.mark.skipif(CPP is None, reason="no C++ compiler on this machine")
def test_the_other_files_have_no_mistake_that_a_compiler_sees(tmp_path):
    """The console's example has a main."""
    arm = hf.arms.load("planar-3r")
    files = hf.supervisor.export_controller(
        hf.control.pseudoinverse(arm, "planar"), c_monitor.bounds_of(arm), tmp_path, name="mine"
    )
    command = [CPP, "-std=c++17", *WARNINGS, "-fsyntax-only", str(files.example)]
    subprocess.run(command, check=True, timeout=100)
    for file in (files.header, files.source, *files.monitor):
        assert "NO CERTIFIED SAFETY FUNCTION" in file.read_text(encoding="utf-8") or file == files.monitor.example
    assert files.to_dict()["digest"] in files.monitor.header.read_text(encoding="utf-8")
    assert "mine_law.c" in files.describe()[0]


def test_what_is_no_controller(tmp_path):
    arm = hf.arms.load("planar-3r")
    law, bounds = hf.control.pseudoinverse(arm, "planar"), c_monitor.bounds_of(arm)
    with pytest.raises(InputError, match="cannot name a C function"):
        hf.supervisor.export_controller(law, bounds, tmp_path, name="new-one")
    with pytest.raises(InputError, match="the thresholds are not of"):
        hf.supervisor.export_controller(hf.control.pseudoinverse(hf.arms.load("panda")), bounds, tmp_path)
