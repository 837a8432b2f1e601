"""Arms judged as wholes, in one table of numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.ceilings.ceiling import when
from holdfast.designs.judging.judgement import Judgement
from holdfast.present.printing import Rows, number, print_rows
from holdfast.present.story import Story
from holdfast.words import capitalised

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(j: Judgement) -> dict[str, Any]:
    """Each column with its unit, its samples, and of every arm the value with its interval."""
    return {
        "arms": [arm.entry() for arm in j.arms],
        "task": j.task.name,
        "failures": j.failures,
        "region": j.region.name,
        "level": j.level,
        "columns": [
            {
                "measure": column.measure,
                "name": column.name,
                "unit": column.unit,
                "samples": column.samples,
                "values": j.values[:, c].tolist(),
                "low": j.low[:, c].tolist(),
                "high": j.high[:, c].tolist(),
            }
            for c, column in enumerate(j.columns)
        ],
        "left_out": list(j.left_out),
        "front": j.front().tolist(),
        "seed": j.seed,
        "seconds": j.seconds,
    }


def show(j: Judgement, out: Console) -> None:
    """What was judged on, and the table."""
    for line in (j.describe()[0], *j.left_out):
        out.print(line, markup=False, soft_wrap=True)
    print_rows(out, key_table(j))


def story(j: Judgement) -> Story:
    """Which arms no other beats, and how it was measured."""
    names = [arm.name for arm in j.arms]
    if len(names) > 1:
        answer = f"Of {len(names)} arms beaten by no other in everything: {', '.join(names[k] for k in j.front())}."
    else:
        first = int(np.argmax(j.values[0] > 0))
        unit = "" if j.columns[first].unit == "1" else f" {j.columns[first].unit}"
        answer = f"{capitalised(j.columns[first].name)}: {number(j.values[0, first])}{unit}."
    return Story(
        f"{', '.join(names)}: judged as {'wholes' if len(names) > 1 else 'a whole'}",
        answer,
        lines=[f"{capitalised(said)}." for said in j.left_out],
        tables=tables(j),
        method=[
            ("Task", j.task.describe()),
            ("Region", j.region.describe()),
            ("Failures", f"{when(j.failures)}; of a workspace one"),
            ("Draws", f"seed {j.seed}, the same poses for all arms"),
            ("Intervals", "95 %: exact for fractions, by order statistics for quantiles"),
        ],
    )


def tables(j: Judgement) -> list[Rows]:
    """A row for each column, arms side by side."""
    head = ["measure", "unit", "samples", *(arm.name for arm in j.arms)]
    rows = []
    for c, column in enumerate(j.columns):
        ends = zip(j.values[:, c], j.low[:, c], j.high[:, c], strict=True)
        cells = [f"{number(x)} ({number(low, 3)} to {number(high, 3)})" for x, low, high in ends]
        rows.append([column.name, column.unit, f"{column.samples:,}" if column.samples else "exact", *cells])
    return [Rows(head, rows, "Values with their intervals: larger is better in all")]


def key_table(j: Judgement) -> Rows:
    """The same for notebooks."""
    return tables(j)[0]


def next_steps(j: Judgement, name: str) -> list[str]:
    """Which arms no other beats."""
    return [f'{name}.front("{j.columns[0].name}")  # what intervals do not tell apart counts as equal']
