"""A policy as a small network whose forward pass and training need NumPy alone."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

RATE, FADE = 1e-3, (0.9, 0.999)  # of Adam (Kingma and Ba, 2015)


@dataclass(frozen=True)
class Policy:
    """Two layers of ramps, and tanh at the end.

    Attributes:
        centre: (m,) what is taken from an observation before it is divided by ``spread``, (m,).
        spread: See ``centre``.
        layers: Weights (inputs, outputs) and offsets (outputs,) in turn.
        limit: The largest action, N m.
        about: How it was made.
    """

    centre: Array
    spread: Array
    layers: list[Array]
    limit: float
    about: Mapping[str, str]

    def __call__(self, observation: NDArray[Any]) -> Array:
        """(..., m) observations, (..., n) actions, N m."""
        return np.asarray(self.limit * self._passed(observation)[-1], dtype=np.float32)

    def learn(self, observations: Array, actions: Array, *, steps: int, batch: int, generator: np.random.Generator) -> float:
        """Fit (N, m), (N, n) by least squares; the mean square that is left, in units of ``limit``.

        Steps are those of Adam, whose means start anew with each call and whose rate falls to nothing.
        """
        means = [np.zeros_like(part) for part in self.layers]
        squares = [np.zeros_like(part) for part in self.layers]
        left = 0.0
        for step in range(1, steps + 1):
            rows = generator.integers(len(observations), size=batch)
            passed = self._passed(observations[rows])
            error = passed[-1] - actions[rows] / self.limit
            left += float(np.square(error).mean()) / steps
            rate = RATE * (1 - (step - 1) / steps) * (1 - FADE[1] ** step) ** 0.5 / (1 - FADE[0] ** step)
            for k, slope in self._slopes(passed, np.asarray(error * (2 / batch), dtype=np.float32)):
                means[k] += (1 - FADE[0]) * (slope - means[k])
                squares[k] += (1 - FADE[1]) * (slope * slope - squares[k])
                self.layers[k] -= np.float32(rate) * means[k] / (np.sqrt(squares[k]) + np.float32(1e-8))
        return left

    def save(self, file: Path) -> None:
        """As an npz."""
        about = np.array([f"{key}: {value}" for key, value in self.about.items()])
        parts: dict[str, Any] = {f"layer{k}": part for k, part in enumerate(self.layers)}
        np.savez_compressed(file, centre=self.centre, spread=self.spread, limit=self.limit, about=about, **parts)

    def _passed(self, observation: NDArray[Any]) -> list[Array]:
        """What goes into each layer, and what comes out at the end, in -1 to 1."""
        x = ((observation - self.centre) / self.spread).astype(np.float32)
        passed = [x]
        for k in range(0, len(self.layers), 2):
            x = x @ self.layers[k] + self.layers[k + 1]
            x = np.tanh(x) if k + 2 == len(self.layers) else np.maximum(x, 0)
            passed.append(x)
        return passed

    def _slopes(self, passed: list[Array], error: Array) -> Iterator[tuple[int, Array]]:
        """The gradient by each part of ``layers``, from the last to the first, for an error of what comes out."""
        back = error * (1 - passed[-1] ** 2)
        for k in reversed(range(0, len(self.layers), 2)):
            into = passed[k // 2]
            weights = self.layers[k].copy()  # before it is changed
            yield k, into.T @ back
            yield k + 1, back.sum(0)
            back = (back @ weights.T) * (into > 0)


def made(centre: Array, spread: Array, *, width: int, outputs: int, limit: float, generator: np.random.Generator) -> Policy:
    """One that knows nothing yet (He et al., 2015)."""
    sizes, layers = (len(centre), width, width, outputs), []
    for below, above in itertools.pairwise(sizes):
        scale = np.float32((2 / below) ** 0.5 if above == width else 0.01)
        layers += [scale * generator.standard_normal((below, above), dtype=np.float32), np.zeros(above, dtype=np.float32)]
    return Policy(centre, spread, layers, limit, {})


def load(file: Path) -> Policy:
    """The policy of a file."""
    with np.load(file) as data:
        layers = [data[f"layer{k}"] for k in range(sum(name.startswith("layer") for name in data.files))]
        about = dict(line.split(": ", 1) for line in data["about"].tolist())
        return Policy(data["centre"], data["spread"], layers, float(data["limit"]), about)
