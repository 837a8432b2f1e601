"""What users call, on a GPU that is none: all of it is launched there, and the outcome is that of the processor."""

from __future__ import annotations

import json
import sys

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms, control, indices, kernels
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.interface.cli.program import main
from holdfast.kernels import compiled
from holdfast.studies import read_study_file as read_study

Q = np.random.default_rng(1).uniform(-2, 2, (6, 3))
COMMAND = "index planar-3r --index manipulability --task planar --q 0.3,0.4,0.5 --json"
STUDY = """
seed: 7
poses: 8
chunk: 4
arms: [planar-3r]
assess: {indices: [manipulability], tasks: [planar], clearance: false}
"""


def index(arm, _):
    rho, smallest = indices.relative_manipulability(arm, "planar"), indices.minimum_singular_value(arm, "planar")
    return [rho(Q), rho.gradient(Q), smallest(Q), smallest.gradient(Q)]


def susceptibility(*_):
    measure, q = indices.susceptibility.torque(arms.load("panda")), np.tile(Q, (1, 3))[:, :7]
    return [measure(q), measure.gradient(q)]


def law(arm, _):
    return [control.by_name("damped:0.1", arm, task="planar").velocity(Q, np.ones(2))]


def solve_ik(arm, _):
    found = hf.solve_ik(arm, arm.forward_kinematics(Q), task="planar", seed=3)
    return [found.q, found.status]


def optimise(arm, _):
    best = hf.optimise(arm, arm.forward_kinematics(Q[:2]), indices.relative_manipulability(arm, "planar"), seed=3)
    return [best.q, best.status]


def closed_loop(arm, _):
    runs = hf.simulate(control.by_name("damped:0.1", arm, task="planar"), Q, Q[::-1, :2], locked=[1], time_limit=5)
    return [runs.q_final, runs.code]


def cycles(arm, _):
    damped = control.by_name("damped:0.1", arm, task="planar", speed_limit=0.1)
    runs = hf.simulate(damped, Q, Q[::-1, :2], locked=[1], cycles=True, time_limit=20)
    return [runs.q_final, runs.code]


def assess(arm, _):
    region = hf.Region.joints([-2, -2, -2], [2, 2, 2])
    run = hf.assess(arm, region, indices.relative_manipulability(arm, "planar"), poses=8, seed=1)
    return list(run.columns.values())


def study(_, folder):
    (folder / "study.yaml").write_text(STUDY)
    asked = read_study(folder / "study.yaml")
    made = Study.create(folder / kernels.default_backend(), asked.name, asked.seed, cells=asked.cells, source=asked.text)
    assert made.run(asked.cells, ThreadRunner(1)) == {}
    return [made.cell_store(0).read_chunk(k, ("index",))["index"] for k in range(2)]


@pytest.mark.parametrize(
    ("entry", "launched"),
    [
        (index, {"relative manipulability", "relative manipulability gradient", "Jacobi sweep", "pull back"}),
        (susceptibility, {"torque susceptibility", "torque susceptibility gradient"}),
        (law, {"damped inverse"}),
        (solve_ik, {"inverse kinematics"}),
        (optimise, {"inverse kinematics", "ascent of relative manipulability"}),
        (closed_loop, {"closed loop, DOP853"}),
        (cycles, {"control cycles"}),
        (assess, {"task jacobian", "relative manipulability"}),
        (study, {"inverse kinematics", "manipulability"}),
    ],
)
def test_all_of_it_is_launched_and_gives_the_bits_of_the_processor(entry, launched, gpu, tmp_path, monkeypatch):
    arm = arms.load("planar-3r")  # with the kernels it has made already
    expected = entry(arm, tmp_path)
    kernels.set_backend("cuda")
    monkeypatch.setattr(compiled.CompiledProgram, "bind_arrays", None)  # nothing is left to the processor
    for a, b in zip(entry(arm, tmp_path), expected, strict=True):
        np.testing.assert_array_equal(a, b)
    assert launched <= gpu.launched, gpu.launched


def test_the_command_line_by_its_environment(gpu, monkeypatch, capsys):
    def said():
        monkeypatch.setattr(sys, "argv", ["holdfast", *COMMAND.split()])
        with pytest.raises(SystemExit) as end:
            main()
        assert end.value.code == 0
        return json.loads(capsys.readouterr().out)

    expected = said()
    monkeypatch.setenv("HOLDFAST_BACKEND", "cuda")
    assert said() == expected
    assert "manipulability" in gpu.launched
