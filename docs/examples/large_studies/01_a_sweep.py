"""
A sweep over arms and indices
=============================

A study evaluates every combination of its lists, and stores each chunk when it is computed. A
stopped study can be resumed. This one has three arms, two indices and 200 poses each.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.studies import study_files

ASKED = """
seed: 1
poses: 200
chunk: 100
arms: [panda, xarm7, ur5-rail]
assess: {indices: [relative-manipulability, minimum-singular-value]}
"""
figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True)
with tempfile.TemporaryDirectory() as folder:
    file, out = Path(folder, "arms.yaml"), Path(folder, "arms")
    file.write_text(ASKED)
    asked = study_files.read_study_file(file)
    study = Study.create(out, asked.name, asked.seed, cells=asked.cells, source=asked.text)
    study.run(asked.cells, ThreadRunner(2))
    for number in range(len(study.cells)):
        run = hf.load(study.cell_folder(number))
        h, axes = np.linspace(0, run.distribution.quantile(0.995), 200), panels[number % 2]
        axes.plot(h, 1 - run.cdf(h), lw=2, label=run.arm.name)
        axes.set_xlabel(f"{run.index.name}, worst lock")
panels[0].set_ylabel("probability of at least that")
panels[0].legend()
