"""The kernels of a session, as PTX through NVIDIA's assembler: registers and spills of each.

``python tests/kernels/ptx_kernels.py`` writes the table anew, in some minutes; it needs the wheel nvidia-cuda-nvcc-cu12.
"""

from __future__ import annotations

import csv
import re
import subprocess
import sys
import tempfile
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.indices.index import by_name
from holdfast.indices.susceptibility import by_name as measure_by_name
from holdfast.kernels import Kernel, Loop
from holdfast.kernels.gpu.ptx import DeviceLoop, DeviceRows, _translated
from holdfast.registry import INDICES, LAWS, SUSCEPTIBILITIES

TABLE = Path(__file__).with_name("ptx_table.csv")
TARGETS = (70, 80, 90)
LARGE = 8000  # operations: the assembler takes seconds for one of them
LARGEST = 25_000  # and minutes from here on


def assembler() -> Path | None:
    """``ptxas`` of the wheel; one of the system's own has another version."""
    try:
        found = find_spec("nvidia.cuda_nvcc")
    except ModuleNotFoundError:
        return None
    places = [] if found is None else [Path(p) / "bin" / "ptxas" for p in found.submodule_search_locations or []]
    return next((p for p in places if p.exists()), None)


def kernels(large: bool) -> dict[str, tuple]:
    """Name and operations -> program, numbers in a state (None for what is no loop), of what a session makes."""
    made: dict[str, tuple] = {}
    take, loop = Kernel._take, Loop._take

    def noted(self, program, backend):
        made[f"{program.name}, {program.size} operations"] = program, None
        take(self, program, "casadi")  # nothing is compiled

    def noted_loop(self, step, *rest):
        loop(self, step, *rest)
        made[f"{step.name}, {step.program.size} operations"] = step.program, self.size

    Kernel._take, Loop._take = noted, noted_loop
    try:
        session(large)
    finally:
        Kernel._take, Loop._take = take, loop
    return {name: found for name, found in made.items() if found[0].size <= (LARGEST if large else LARGE)}


def session(large: bool) -> None:
    """Values, slopes and steps of everything, of a few rows."""
    panda, plane = arms.load("panda"), arms.load("planar-3r")
    q = (panda.lower + panda.upper) / 2 + 0.1 * np.arange(7)[None]
    for arm, place in ((panda, q), (arms.load("pa10-9dof"), np.full((1, 9), 0.4))):
        for name in INDICES:
            index = by_name(oracles.example(INDICES, name, arm), arm)
            index(place)
            index.gradient(place)
    for name in SUSCEPTIBILITIES:
        measure = measure_by_name(name, panda)
        measure(q)
        measure.gradient(q)
    for name in LAWS:
        if name == "failure-tolerant" and not large:
            continue
        law = hf.control.by_name(oracles.example(LAWS, name, panda, "position"), panda, task="position")
        law.velocity(q, np.ones(3))
        law._slopes_kernel(q, np.ones(3))
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


def assembled(program, state, target: int, ptxas: Path) -> list[int]:
    """Registers of a thread, bytes it stores and loads because they do not suffice."""
    text = (DeviceRows(program) if state is None else DeviceLoop(program, state)).text()
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "kernel.ptx"
        source.write_bytes(_translated(text, target))
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
        for name, (program, state) in sorted(kernels(large=True).items(), key=lambda found: found[1][0].size):
            for target in TARGETS:
                row = [name, target, *assembled(program, state, target, ptxas)]
                print(*row, flush=True)
                writer.writerow(row)
                file.flush()
