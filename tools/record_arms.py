"""Makes the arms of the record book from the best null spaces known: ``python -m tools.record_arms``."""

from __future__ import annotations

from pathlib import Path
from textwrap import indent

import numpy as np

import holdfast as hf
from holdfast.arms.dh_file import text
from holdfast.designs.book.measuring import jacobian_of, least_left, null_space_of
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
            table = hf.arms.dh_table(arm)
            rows = [(r.a, r.alpha, r.d, r.theta) for r in table.rows]
            value = least_left(null_space_of(jacobian_of(rows, table.tool[:3, 3], np.zeros(n))[: c.m]), k)
            (FOLDER / f"{name}.yaml").write_text(
                f"id: {name}\n"
                f"class: {{task: {task}, rows: {c.m}, joints: {n}, failures: {k}, quantity: relative-manipulability, "
                "conditions: [revolute, one configuration]}\n"
                f"value: {value!r}\n"
                f"proven_bound: {{value: {c.bound!r}, by: {c.bound_by}}}\n"
                f'found: {{by: holdfast, date: "2026-11-25", how: "synthesise, {STARTS} starts, seed {SEED}; '
                f'{c.best_known:.12g} before rounding"}}\n'
                f"arm:\n{indent(text(table, name), '  ')}"
                f"at: home\ncheck: {{command: holdfast records check {name}, tolerance: 1.0e-9}}\nlicence: CC0-1.0\n",
                encoding="utf-8",
            )
            print(name, value, c.best_known)


if __name__ == "__main__":
    main()
