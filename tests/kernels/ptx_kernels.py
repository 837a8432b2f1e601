"""Kernels as PTX through NVIDIA's assembler: registers and spills of each, of a session and of the whole test suite.

As a plugin of pytest, ``-p ptx_kernels`` with this folder in ``PYTHONPATH``, it notes the largest kernel of each name that
the tests make in the folder ``HOLDFAST_PTX_NOTED``. ``python tests/kernels/ptx_kernels.py [FOLDER]`` then writes the table
anew, in a quarter of an hour of processor time; it needs the wheel nvidia-cuda-nvcc-cu12.
"""

from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY
from holdfast.kernels import Kernel, Loop, Program
from holdfast.kernels.gpu.ptx import DeviceLoop, DeviceRows, _translate_to_ptx
from holdfast.kinematics.indices.index import by_name
from holdfast.kinematics.indices.susceptibility import by_name as measure_by_name
from holdfast.model.arm.task import as_task
from holdfast.model.collision.object_kernels import outward_gradient_kernel
from holdfast.response.recovery.task_rows import make_row_solver
from holdfast.teleop.trials.plant import JoystickPlant

TABLE = Path(__file__).with_name("ptx_table.csv")
TARGETS = (70, 80, 90)
_NOTING, _MADE = pytest.StashKey(), pytest.StashKey()
LARGE = 8000  # operations: the assembler takes seconds for one of them, 44 for one of 50,000


def assembler() -> Path | None:
    """``ptxas`` of the wheel; one of the system's own has another version."""
    try:
        found = find_spec("nvidia.cuda_nvcc")
    except ModuleNotFoundError:
        return None
    places = [] if found is None else [Path(p) / "bin" / "ptxas" for p in found.submodule_search_locations or []]
    return next((p for p in places if p.exists()), None)


@contextmanager
def noting(backend: str | None = None) -> Iterator[dict[int, tuple]]:
    """Programs of kernels and loops that are made inside, with the numbers in a loop's state (None for what is no loop)."""
    made: dict[int, tuple] = {}
    take, loop = Kernel._set_program, Loop._set_step

    def noted(self, program, its):
        made.setdefault(id(program), (program, None))
        take(self, program, backend or its)

    def noted_loop(self, step, *rest):
        loop(self, step, *rest)
        made[id(step.program)] = step.program, self.size

    Kernel._set_program, Loop._set_step = noted, noted_loop
    try:
        yield made
    finally:
        Kernel._set_program, Loop._set_step = take, loop


def kernels(large: bool) -> dict[str, tuple]:
    """Name and operations -> program and numbers in a state, of what a session makes."""
    with noting("casadi") as made:  # nothing is compiled
        session(large)
    return {_name(p): (p, state) for p, state in made.values() if large or p.size <= LARGE}


def _name(program: Program) -> str:
    return f"{program.name}, {program.size} operations"


# ---- of the test suite ---------------------------------------------------------------------------------------------


def pytest_configure(config):
    config.stash[_NOTING] = context = noting()
    config.stash[_MADE] = context.__enter__()


def pytest_sessionfinish(session):
    session.config.stash[_NOTING].__exit__(None, None, None)
    largest: dict[str, tuple] = {}
    for program, state in session.config.stash[_MADE].values():
        if program.name not in largest or largest[program.name][0].size < program.size:
            largest[program.name] = program, state
    for program, state in largest.values():
        said = [program.facts(), state, program.function.serialize()]
        (Path(os.environ["HOLDFAST_PTX_NOTED"]) / f"{program.digest}.json").write_text(json.dumps(said))


def suite(folder: Path) -> dict[str, tuple]:
    """The largest of each name that were noted in a folder."""
    largest: dict[str, tuple] = {}
    for file in sorted(folder.glob("*.json")):
        facts, state, text = json.loads(file.read_text())
        if facts[0] not in largest or largest[facts[0]][0].size < facts[3]:
            program = Program.from_facts(facts, lambda: None)
            program.function = ca.Function.deserialize(text)
            largest[facts[0]] = program, state
    return {_name(program): (program, state) for program, state in largest.values()}


# ---- of a session --------------------------------------------------------------------------------------------------


def session(large: bool) -> None:
    """Values, slopes and steps of everything, of a few rows."""
    panda, plane = arms.load("panda"), arms.load("planar-3r")
    q = (panda.lower + panda.upper) / 2 + 0.1 * np.arange(7)[None]
    for arm, place in ((panda, q), (arms.load("pa10-9dof"), np.full((1, 9), 0.4))):
        for name in INDEX_REGISTRY:
            index = by_name(oracles.example(INDEX_REGISTRY, name, arm), arm)
            index(place)
            index.gradient(place)
    for name in SUSCEPTIBILITY_REGISTRY:
        measure = measure_by_name(name, panda)
        measure(q)
        measure.gradient(q)
    for name in LAW_REGISTRY:
        if name == "failure-tolerant" and not large:
            continue
        law = hf.control.by_name(oracles.example(LAW_REGISTRY, name, panda, "position"), panda, task="position")
        law.velocity(q, np.ones(3))
        law._rate_derivatives_kernel(q, np.ones(3))
    poses = panda.forward_kinematics(q)
    hf.solve_ik(panda, poses, seed=1, restarts=1)
    law = hf.control.by_name("damped:0.1", plane, task="planar")
    hf.simulate(law, np.ones(3), np.array([1.0, 1.0]), locked=[1], time_limit=0.1)
    rho = hf.indices.relative_manipulability(plane, "planar")
    hf.optimise(plane, plane.forward_kinematics(np.ones(3)), rho, seed=1, starts=2)
    if large:
        law = hf.control.by_name("failure-tolerant", plane, task="planar")
        hf.simulate(law, np.ones(3), np.array([1.0, 1.0]), locked=[1], time_limit=0.1)
        hf.control.by_name("failure-tolerant", arms.load("iiwa14")).velocity(np.full(7, 0.5), np.ones(6))
        hf.optimise(panda, poses[0], hf.indices.minimum_singular_value(panda), seed=1, starts=1)
        measures = hf.indices.susceptibility
        measures.SusceptibilityBatch([measures.torque(panda), measures.acceleration(panda)])(q)
        _ = make_row_solver(panda, as_task(panda, "pose"))._kernels.solver_loop
        outward_gradient_kernel()
        JoystickPlant(hf.control.by_name("damped:0.1", plane, task="planar"))


def assembled(program, state, target: int, ptxas: Path) -> list[int]:
    """Registers of a thread, bytes it stores and loads because they do not suffice."""
    text = (DeviceRows(program) if state is None else DeviceLoop(program, state)).module_text()
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "kernel.ptx"
        source.write_bytes(_translate_to_ptx(text, target))
        command = [ptxas, "-v", f"-arch=sm_{target}", source, "-o", Path(folder) / "kernel.cubin"]
        said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    spills = re.search(r"(\d+) bytes spill stores, (\d+) bytes spill loads", said)
    return [int(re.search(r"Used (\d+) registers", said)[1]), *map(int, spills.groups())]


def versions(ptxas: Path) -> str:
    said = subprocess.run([ptxas, "--version"], capture_output=True, text=True, check=True).stdout
    return f"ptxas {re.search(r'V([0-9.]+)', said)[1]}, llvmlite {version('llvmlite')}, casadi {version('casadi')}"


def stored() -> tuple[str, dict[tuple[str, int], list[int]]]:
    """The versions and rows of the table."""
    head, *rows = csv.reader(TABLE.read_text(encoding="utf-8").splitlines())
    return head[0], {(name, int(target)): [*map(int, numbers)] for name, target, *numbers in rows[1:]}


if __name__ == "__main__":
    ptxas = assembler() or sys.exit("pip install nvidia-cuda-nvcc-cu12")
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([versions(ptxas)])
        writer.writerow(["kernel", "target sm", "registers", "bytes of spill stores", "bytes of spill loads"])
        every = kernels(large=True) | (suite(Path(sys.argv[1])) if sys.argv[1:] else {})
        for name, (program, state) in sorted(every.items(), key=lambda found: (found[1][0].size, found[0])):
            for target in TARGETS:
                row = [name, target, *assembled(program, state, target, ptxas)]
                print(*row, flush=True)
                writer.writerow(row)
                file.flush()
