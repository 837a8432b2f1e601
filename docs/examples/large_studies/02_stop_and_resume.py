"""
Stop and resume an assessment
=============================

With ``store``, an assessment writes its results as it computes them. After Ctrl-C, a crash or a
power cut, the same call resumes it. Here 20,000 poses are stopped after a quarter of them.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
region = hf.Region.around_tool(arm, hf.arms.about("panda").home)


def stop(done, total):
    if done >= total / 4:
        raise KeyboardInterrupt


with tempfile.TemporaryDirectory() as folder:
    store = Path(folder, "cell")
    try:
        hf.assess(arm, region, poses=20_000, seed=1, store=store, progress=stop)
    except KeyboardInterrupt:
        print("stopped")
    run = hf.assess(arm, region, poses=20_000, seed=1, store=store)
    values = run.dataset["index"].values
whole = hf.assess(arm, region, poses=20_000, seed=1).dataset["index"].values
print("the same bits as without a stop:", np.array_equal(values, whole, equal_nan=True))

figure, axes = plt.subplots(figsize=(7, 3.6))
axes.hist(values, bins=60)
axes.set(xlabel="worst-case relative manipulability", ylabel="poses", title="Panda, 20,000 poses")
