"""Writes ``VERSION.zip`` beside this file: folders as that version of holdfast stores them, and what their results were.

``python tests/stored/make.py VERSION`` with the version to come, once before it changes what is stored. A zip that is there
stays for good: ``tests/test_stored.py`` shows that all of them are still read.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import holdfast as hf
from holdfast import arms, control
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.response.recovery import write_waypoints
from holdfast.studies import read_study_file
from holdfast.studies.study_files.results import read_assessment, read_convergence
from holdfast.teleop import simulate_experiment
from holdfast.teleop.protocol import Training, read_protocol
from holdfast.teleop.trials import End

ASSESSED = {"poses": 12, "seed": 3, "restarts": 10, "task": "planar", "optimise": True, "after_lock": True}
WORKSPACE = {"target": [1.5, 1.5], "starts": "grid:5", "configurations": 3, "points": 1, "method": "brute"}
DESIGNED = {
    "vary": {"a1": (0.6, 1.4)},
    "objective": "minimum-singular-value",
    "task": "planar",
    "poses": 6,
    "designs": 4,
    "local_searches": 1,
    "check_poses": 8,
}
LOCKED, START = {"joint2": 0.7}, [0.35, 0.7, 1.0]
STUDY = """
name: small
seed: 3
poses: 12
chunk: 8
arms: [planar-3r]
assess: {indices: [relative-manipulability], regions: [bench.yaml], restarts: 10}
convergence: {laws: ["damped:0.2"], motions: 2, time_limit: 200}
"""


def region() -> hf.Region:
    return hf.Region.box([1.5, 0.6, 0], [0.8, 0.8, 0])


def write() -> dict[str, Any]:
    """Store everything in this folder; what the results were while they were in memory."""
    arm = arms.load("planar-3r")
    law = control.pseudoinverse(arm, "planar")
    told: dict[str, Any] = {}

    run = hf.assess(arm, region(), **ASSESSED)
    run.save("assessment")
    told["assessment"] = {
        "reached": run.distribution.reached, "mean": run.distribution.mean, "best": run.optimised.mean,
        "worst": run.worst_counts.tolist(), "left": run.survivors.tolist(), "q": run.dataset["q"].values.tolist(),
    }  # fmt: skip

    Path("bench.yaml").write_text("name: bench\nbox: {center: [1.5, 0.6, 0], size: [0.8, 0.8, 0]}\n")
    Path("small.yaml").write_text(STUDY)
    asked = read_study_file("small.yaml")
    study = Study.create("study", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    problems = study.run(asked.cells, ThreadRunner(1))
    assert not problems
    told["study"] = {
        "mean": read_assessment(study, 0).plain.mean,
        "ends": read_convergence(study, 1).ends.tolist(),
        "digest": study.digest,
    }

    found = hf.workspace(law, **WORKSPACE, store="workspace")
    told["workspace"] = {name: values.tolist() for name, values in found.measures.items()} | {"ends": found.ends.tolist()}
    told["design"] = hf.design(arm, region=region(), **DESIGNED, store="design").to_dict()

    whole = read_protocol()
    quick = Training(at_least=1, in_a_row=1, limit=90, most=2)
    one = whole.with_tasks(whole.tasks.take(np.array([0])), ["a"])
    few = replace(one, scenarios=whole.scenarios[:2], training=quick, subjects=1, substeps=1)
    with simulate_experiment("experiment", few, 1, seed=2) as records:
        entries = records.entries()
        trials = records.read_trials(entries)
        told["experiment"] = {
            "subjects": [s.code for s in records.subjects()], "ends": [End(e).name for e in trials.end],
            "ratings": [e.rating for e in entries], "last": trials.q_end.tolist(),
        }  # fmt: skip

    route = hf.recover(arm, LOCKED, START, goal="home", task="planar", samples=0)
    write_waypoints(arm, route.q, "waypoints.csv")
    told["waypoints"] = route.q.tolist()
    return told


def main(version: str) -> None:
    """Write the zip of a version."""
    target = Path(__file__).resolve().with_name(f"{version}.zip")
    if target.exists():
        sys.exit(f"{target.name} is there, and stays: it says what that version wrote")
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        Path("numbers.json").write_text(json.dumps(write(), indent=1))
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as pack:
            for file in sorted(Path().rglob("*")):
                if file.is_file():
                    pack.write(file)
        os.chdir(target.parent)
    print(f"{target.name}: {target.stat().st_size} bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])
