"""
A sweep over arms and indices
=============================

A study is every combination of its lists, cut into chunks that are computed and committed one by one. Stopped or killed, it
resumes; the result does not depend on who computed which chunk. Here three arms and two indices, 200 poses each.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast import studies
from holdfast.engine import Study, Threads

ASKED = """
seed: 1
poses: 200
chunk: 100
arms: [panda, xarm7, ur5-rail]
assess: {indices: [relative-manipulability, minimum-singular-value]}
"""
figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, layout="constrained")
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder, "arms.yaml")
    file.write_text(ASKED)
    asked = studies.read(file)
    study = Study.create(Path(folder, "arms"), asked.name, asked.seed, cells=asked.cells, source=asked.text)
    study.run(asked.cells, Threads(2))
    for number, style in zip(range(len(study.cells)), ("-", "-", "--", "--", ":", ":"), strict=True):
        run = hf.load(study.folder(number))
        h = np.linspace(0, float(run.distribution.quantile(0.995)), 200)
        panels[number % 2].plot(h, 1 - run.cdf(h), style, linewidth=2, label=run.arm.name)
        panels[number % 2].set_xlabel(f"{run.index.name}, worst lock")
panels[0].set(ylabel="probability of at least that", ylim=(0, 1.02))
panels[0].legend(frameon=False)
