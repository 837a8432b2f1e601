"""A job that knows no robots, for the runners: importable by worker processes."""

from __future__ import annotations

import os
import time
from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.sweeps import Column, SweepCell


class Toy:
    def __init__(self, scale=1.0, slow=0.0, refuses=-1, kills=None):
        self.scale, self.slow, self.refuses, self.kills = scale, slow, refuses, kills

    def prepare(self, alone):
        pass

    def columns(self):
        return [Column("x", "float64", (("k", 2),), units="m", about="random"), Column("status", "uint8")]

    def run(self, chunk):
        if chunk.number == self.refuses:
            raise InputError("this chunk is one too many")
        if self.kills is not None and chunk.number == 2:
            try:
                Path(self.kills).touch(exist_ok=False)
                os.kill(os.getpid(), 9)  # once: the second time the file is there
            except FileExistsError:
                pass
        time.sleep(self.slow)
        x = np.random.default_rng(chunk.sequence).random((len(chunk), 2))
        return {"x": self.scale * x, "status": np.zeros(len(chunk), np.uint8)}


def cells(count=2, rows=23, chunk=5, **more):
    return [
        SweepCell(f"c{k}", Toy(k + 1.0, **more), {"scale": k + 1.0}, rows=rows, chunk=chunk, labels={"k": k})
        for k in range(count)
    ]
