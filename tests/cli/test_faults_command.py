"""``holdfast faults``."""

from __future__ import annotations

import json

import holdfast as hf


def test_the_command_prints_what_the_library_draws(cli, tmp_path):
    path = hf.faults.Faults([hf.faults.weak(gain=(0.2, 0.7), probability=0.5)], seed=1).save(tmp_path / "faults.yaml")
    arguments = ["faults", "draw", str(path), "--arm", "planar-3r", "--episodes", "4", "--seed", "9"]
    shown = json.loads(cli(*arguments, "--json")[1])
    batch = hf.faults.load(path).seeded(9).batch(hf.arms.load("planar-3r"), episodes=4)
    assert [one["id"] for one in shown["episodes"]] == [events.id for events in batch.episodes]
    assert batch.describe()[0] in cli(*arguments)[1]
