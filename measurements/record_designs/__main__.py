"""Search for designs by measures without gradients, with an evolution strategy.

``python -m measurements.record_designs tolerant-workspace planar-3r --vary a1=0.05..2.9 --vary a2=0.05..2.9`` searches planar
arms with a large failure-tolerant workspace. ``self-motion-size`` searches arms whose joints turn as far as
possible on one self-motion; its ARM may be a record, such as self-motion-position-4R-001.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import holdfast as hf
from measurements.record_designs.found import EvolvedDesign
from measurements.record_designs.self_motions import design_for_self_motion
from measurements.record_designs.workspaces import design_for_workspace


def resolve_arm(name: str) -> hf.Arm:
    """Return a built-in arm, the arm of a file, or the arm of a record."""
    entry = hf.designs.record_designs().get(name)
    return hf.arms.load(name) if entry is None or entry.arm is None else entry.arm


def main(words: Sequence[str] | None = None) -> int:
    """Search, print the design, and write its arm."""
    parser = argparse.ArgumentParser(prog="python -m measurements.record_designs", description=__doc__)
    parser.add_argument("objective", choices=("self-motion-size", "tolerant-workspace"))
    parser.add_argument("arm", help="built-in name, file of an arm, or record")
    parser.add_argument("--vary", action="append", required=True, help="a3=0.2..0.6 (m), alpha4=-90..90deg; may be repeated")
    parser.add_argument("--task", default="pose", help="rows of the pose that a self-motion keeps")
    parser.add_argument("--free-reach", action="store_true", help="link lengths need not keep their sum")
    parser.add_argument("--generations", type=int, help="generations of each search")
    parser.add_argument("--restarts", type=int, default=3, help="searches")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, help="file for the arm (YAML)")
    options = parser.parse_args(words)
    effort = {"restarts": options.restarts, "seed": options.seed}
    if options.generations is not None:
        effort["generations"] = options.generations
    try:
        space = hf.designs.design_space(resolve_arm(options.arm), options.vary)
        design: EvolvedDesign
        if options.objective == "self-motion-size":
            design = design_for_self_motion(space.arm, space, task=options.task, **effort)
        else:
            design = design_for_workspace(space.arm, space, keep_reach=not options.free_reach, **effort)
        values = ", ".join(p.name + " = " + p.text(float(x)) for p, x in zip(space.parameters, design.values, strict=True))
        print("\n".join([*design.describe(), values]))
        if options.out is not None:
            options.out.write_text(design.arm_file(), encoding="utf-8")
    except hf.HoldfastError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
