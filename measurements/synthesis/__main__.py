"""Construct revolute arms with a given Jacobian or null space at q = 0.

``python -m measurements.synthesis jacobian.csv --task position --out arms`` reads the rows of a matrix, and
``python -m measurements.synthesis --size 9,6,2 --out arms`` takes the best null space known for 9 joints, 6 rows, 2 failures.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import holdfast as hf
from holdfast.core.files.output import make_folder
from measurements.synthesis.arms import Synthesis, synthesise, write_dh_table
from measurements.synthesis.matrices import read_matrix
from measurements.synthesis.orders import compare_joint_orders


def table(synthesis: Synthesis) -> list[str]:
    """Return a row for each arm, in Markdown."""
    lines = ["| arm | value | lost by rounding | condition | sum of |a| and |d|, m |", "|---|---|---|---|---|"]
    for number, (arm, loss) in enumerate(zip(synthesis.arms, synthesis.losses, strict=True), 1):
        lengths = sum(abs(row.a) + abs(row.d) for row in hf.arms.dh_table(arm).rows[:-1])
        condition = np.linalg.cond(arm.jacobian(np.zeros(arm.n)))
        lines.append(f"| {number} | {synthesis.value - loss:.6g} | {loss:.1e} | {condition:.3g} | {lengths:.3f} |")
    return lines


def main(words: Sequence[str] | None = None) -> int:
    """Construct the arms, write them, and print a row for each."""
    parser = argparse.ArgumentParser(prog="python -m measurements.synthesis", description=__doc__)
    parser.add_argument("file", type=Path, nargs="?", help="numbers (CSV), a row of the matrix on each line; m and rad")
    parser.add_argument("--size", metavar="N,M,K", help="joints, rows, failures: the best known null space instead of a file")
    parser.add_argument("--task", default="pose", help="planar, position, or pose")
    parser.add_argument("--null-space", action="store_true", help="the file is a null space, a row for each joint")
    parser.add_argument("--failures", type=int, default=1, help="joints that lock at once")
    parser.add_argument("--starts", type=int, default=12, help="starts of the search for axes")
    parser.add_argument("--orders", action="store_true", help="compare all orders of the axes of the best arm; poses only")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, help="folder for the arms, as YAML")
    options = parser.parse_args(words)
    try:
        if options.orders and options.task != "pose":
            raise hf.InputError("orders are compared for poses; leave out --orders")
        ceiling = matrix = None
        if options.size is not None:
            n, m, k = map(int, options.size.split(","))
            ceiling = hf.index_bounds.upper_bound(n=n, m=m, k=k)
        if options.file is not None:
            matrix = read_matrix(options.file)
        synthesis = synthesise(
            ceiling,
            jacobian=None if options.null_space else matrix,
            null_space=matrix if options.null_space else None,
            task=options.task,
            failures=options.failures,
            starts=options.starts,
            seed=options.seed,
        )
        print("\n".join([*synthesis.describe(), "", *table(synthesis)]))
        if options.out is not None:
            folder = make_folder(options.out)
            for number, arm in enumerate(synthesis.arms, 1):
                print(f"written: {write_dh_table(arm, folder / f'arm-{number}.yaml')}")
        if options.orders:
            orders = compare_joint_orders(synthesis.jacobians[0], failures=synthesis.failures, seed=options.seed)
            print("\n".join(orders.describe()))
    except hf.HoldfastError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
