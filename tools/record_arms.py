"""Makes the arms of the record book from the best null spaces known: ``python -m tools.record_arms``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import holdfast as hf
from holdfast.grammar import TASKS

FOLDER = Path(__file__).parents[1] / "src/holdfast/designs/book/data"
CLASSES = {
    "planar": [(3, 1), (4, 2), (5, 2), (5, 3), (6, 2)],
    "position": [(4, 1), (5, 2), (6, 2), (6, 3), (7, 3), (8, 3)],
    "pose": [(7, 1), (8, 1), (8, 2), (9, 2), (9, 3), (10, 2), (10, 3)],
}
STARTS, SEED = 12, 1


def main() -> None:
    """Of the arms of each class the one that rounding costs least."""
    FOLDER.mkdir(exist_ok=True)
    for task, sizes in CLASSES.items():
        for n, k in sizes:
            c = hf.ceilings.look_up(n=n, m=TASKS[task], k=k)
            made = hf.designs.synthesise(c, task=task, starts=STARTS, seed=SEED)
            arm = made.arms[int(np.argmin(made.losses))]
            name = f"{task}-{n}R-k{k}-001"
            how = f"synthesise, {STARTS} starts, seed {SEED}; {c.best_known:.12g} before rounding"
            record = hf.designs.new_record(arm, task, k, name=name, by="holdfast", how=how)
            (FOLDER / f"{name}.yaml").write_text(record.text, encoding="utf-8")
            print(name, record.data.value, c.best_known)


if __name__ == "__main__":
    main()
