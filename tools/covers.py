"""Fits the covers of the built-in arms that have collision shapes, so that nobody waits for it: ``python -m tools.covers``."""

from __future__ import annotations

import json
from pathlib import Path

import holdfast as hf
from holdfast.model.collision.cover import MAX_MEAN_EXCESS_M, fit_capsules
from holdfast.model.collision.shape import CollisionModel

FILE = Path(__file__).parents[1] / "src/holdfast/model/arms/data/covers.json"


def main() -> None:
    """By the digests of the shapes: a shape that is read otherwise one day is fitted again by whoever meets it."""
    shapes = [CollisionModel.from_arm(hf.arms.load(name)) for name in hf.arms.names()]
    FILE.write_text(json.dumps({shape.digest: fit_capsules(shape, MAX_MEAN_EXCESS_M) for shape in shapes if len(shape)}) + "\n")


if __name__ == "__main__":
    main()
