"""A policy as it is stored: a small network whose forward pass needs NumPy alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

LOWEST, HIGHEST = -5.0, 2.0  # of the logarithm of a deviation


@dataclass(frozen=True)
class Policy:
    """A normal distribution of actions before they are squashed by tanh to their range (Haarnoja et al., 2018).

    Attributes:
        centre: (m,) what is taken from an observation before it is divided by ``spread`` (m,).
        spread: See ``centre``.
        layers: Matrices (inputs, outputs) and offsets (outputs,) one after the other; the last gives n means and n logarithms
            of deviations, with a ramp between layers.
        limit: The largest action, N m.
        about: How it was made: seed, steps, minutes, versions.
    """

    centre: Array
    spread: Array
    layers: tuple[tuple[Array, Array], ...]
    limit: float
    about: Mapping[str, str]

    def __call__(self, observation: NDArray[Any], generator: np.random.Generator | None = None) -> Array:
        """(n,) action, N m: the mean's, or drawn."""
        x = ((observation - self.centre) / self.spread).astype(np.float32)
        for weights, offset in self.layers[:-1]:
            x = np.maximum(x @ weights + offset, 0.0)
        mean, deviation = np.split(x @ self.layers[-1][0] + self.layers[-1][1], 2)
        if generator is not None:
            noise = generator.standard_normal(mean.shape, dtype=np.float32)
            mean = mean + np.exp(np.clip(deviation, LOWEST, HIGHEST)) * noise
        return np.asarray(self.limit * np.tanh(mean), dtype=np.float32)

    def save(self, file: Path) -> None:
        """As an npz."""
        parts = {f"{name}{k}": part for k, layer in enumerate(self.layers) for name, part in zip("wb", layer, strict=True)}
        about = np.array([f"{key}: {value}" for key, value in self.about.items()])
        np.savez_compressed(file, centre=self.centre, spread=self.spread, limit=self.limit, about=about, **parts)


def load(file: Path) -> Policy:
    """The policy of a file."""
    with np.load(file) as data:
        count = sum(name.startswith("w") for name in data.files)
        layers = tuple((data[f"w{k}"], data[f"b{k}"]) for k in range(count))
        about = dict(line.split(": ", 1) for line in data["about"].tolist())
        return Policy(data["centre"], data["spread"], layers, float(data["limit"]), about)
