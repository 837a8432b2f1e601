"""Make the arms of the record book from the best null spaces known: ``python -m measurements.record_designs.arms``.

The files go to the data of ``holdfast.studies.designs.record_book``, or to ``--out``.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import holdfast as hf
from holdfast.core.labels import TASK_SIZES
from measurements.synthesis.arms import synthesise

FOLDER = Path(__file__).parents[2] / "src/holdfast/studies/designs/record_book/data"
CLASSES = {
    "planar": [(3, 1), (4, 2), (5, 2), (5, 3), (6, 2)],
    "position": [(4, 1), (5, 2), (6, 2), (6, 3), (7, 3), (8, 3)],
    "pose": [(7, 1), (8, 1), (8, 2), (9, 2), (9, 3), (10, 2), (10, 3)],
}
STARTS, SEED = 12, 1
SOLD = {
    "planar": [("planar-3r", 1)],
    "position": [("panda", 1), ("panda", 2), ("iiwa14", 2), ("ur5", 1)],
    "pose": [("panda", 1), ("xarm7", 1), ("ur5-rail", 1), ("pa10-9dof", 1), ("pa10-9dof", 2)],
}
DIGITS = 7  # of a configuration


def main() -> None:
    """Of the arms of each class the one that rounding costs least."""
    parser = argparse.ArgumentParser(prog="python -m measurements.record_designs.arms", description=__doc__)
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder for the records")
    parser.add_argument("--task", choices=list(CLASSES), action="append", help="may be repeated; default: all")
    options = parser.parse_args()
    options.out.mkdir(exist_ok=True)
    for task in options.task or CLASSES:
        for n, k in CLASSES[task]:
            c = hf.index_bounds.upper_bound(n=n, m=TASK_SIZES[task], k=k)
            made = synthesise(c, task=task, starts=STARTS, seed=SEED)
            arm = made.arms[int(np.argmin(made.losses))]
            name = f"{task}-{n}R-k{k}-001"
            how = f"synthesise, {STARTS} starts, seed {SEED}; {c.best_known:.12g} before rounding"
            record = hf.designs.new_record(arm, task, k, name=name, by="holdfast", how=how)
            (options.out / f"{name}.yaml").write_text(record.text, encoding="utf-8")
            print(name, record.data.value, c.best_known)
        for sold, k in SOLD[task]:
            write_sold(sold, task, k, options.out)


def write_sold(sold: str, task: str, k: int, folder: Path) -> None:
    """The best configuration of an arm that is sold; joints that change nothing are at zero."""
    arm = hf.arms.load(sold)
    index = hf.indices.relative_manipulability(arm, task, k)
    q = max((hf.optimise(arm, None, index, seed=seed).q for seed in (1, 2)), key=index)
    for joint in range(arm.n):
        rest = np.where(np.arange(arm.n) == joint, np.clip(0.0, arm.lower, arm.upper), q)
        q = rest if abs(index(rest) - index(q)) < 1e-12 else q
    name = f"{sold}-{task}-k{k}-001"
    how = "holdfast optimise --any-pose, the better of seeds 1 and 2"
    low, high = np.ceil(arm.lower * 10**DIGITS) / 10**DIGITS, np.floor(arm.upper * 10**DIGITS) / 10**DIGITS
    record = hf.designs.new_record(arm, task, k, q=np.clip(np.round(q, DIGITS), low, high), name=name, by="holdfast", how=how)
    (folder / f"{name}.yaml").write_text(record.text, encoding="utf-8")
    print(name, record.data.value)


if __name__ == "__main__":
    main()
