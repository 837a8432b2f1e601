"""Measures over targets against one workspace analysis for each target."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import holdfast as hf
import oracles
from cards import check_card
from holdfast.control.convergence.analysis import StartConfigurations
from holdfast.control.convergence.places import read_places
from holdfast.interface.cli.program import main
from holdfast.interface.presentation.convergence.workspace import present


def test_each_target_is_a_workspace_of_its_own(three, tmp_path):
    goals = np.array([[1.5, 1.5], [-0.7, 2.0], [4.0, 0.0]])
    starts = np.array([[2.0, -1.4], [0.7, 2.1], [-2.0, 0.5]])
    found = hf.workspace(three, goals, starts, over="targets", configurations=6, points=2, cells=40)
    for k in (0, 1):
        one = hf.workspace(three, goals[k], starts, configurations=6, points=2, cells=40)
        for name, values in one.measures.items():
            known = np.ma.masked_invalid(values)
            np.testing.assert_allclose(found.measures[name][k], known.mean(axis=0).filled(np.nan))
        np.testing.assert_array_equal(found.ends[k], one.ends.sum(axis=0))
    assert all(np.isnan(v[2]).all() for v in found.measures.values())
    assert present(found).about.count("2 of 3 targets") == 1
    found.save(tmp_path)
    rows = list(csv.DictReader((tmp_path / "targets.csv").read_text(encoding="utf-8").splitlines()))
    assert float(rows[1]["Ravg_any_percent"]) == pytest.approx(found.measures["Ravg"][1, -1])
    assert rows[2]["Ravg_any_percent"] == ""
    data = found.to_xarray()
    assert float(data.Ravg.sel(joint="any")[1].mean()) == pytest.approx(found.measures["Ravg"][1, -1])
    assert data.x.values.tolist() == goals[:, 0].tolist()


def test_reach_is_the_share_of_a_way_inside_the_ring_of_a_two_link_arm(three):
    """R100, Ravg and Rsens of each joint: the healthy motion by scipy, and the ring that two links reach in closed form."""
    goals, starts, cells = np.array([[1.5, 1.5], [-0.7, 1.9]]), np.array([[2.0, -1.4], [0.7, 2.1]]), 50
    found = hf.workspace(three, goals, starts, over="targets", configurations=5, points=0, cells=cells)
    check_card(found)
    owner, q0 = StartConfigurations(
        three, read_places(three.arm, three.task, starts, np.random.default_rng(0)), 5, "brute", 0
    ).find_configurations(0, 2)
    np.testing.assert_allclose(oracles.planar_hand([1, 1, 1], q0), starts[owner], atol=1e-8)
    for g, goal in enumerate(goals):
        inside = np.zeros((len(q0), cells, 4), dtype=bool)
        for i, q in enumerate(q0):
            # The hand goes straight, and a cell's middle is reached when that share of the error is left.
            motion = oracles.planar_run([1, 1, 1], 0.0, q, goal, -1, 40.0)
            way = motion.sol(-np.log(1 - (np.arange(cells) + 0.5) / cells)).T
            for j in range(3):
                for k, x in enumerate(way):
                    middle, least, most = oracles.two_link_ring([1, 1, 1], j, x[j])
                    inside[i, k, j] = least <= np.linalg.norm(goal - middle) <= most
        inside[..., 3] = inside[..., :3].all(axis=-1)
        share = 100 * inside.mean(axis=1)
        for s in range(2):
            mine = share[owner == s]
            values = {"R100": 100 * (mine == 100).mean(axis=0), "Ravg": mine.mean(axis=0), "Rsens": np.ptp(mine, axis=0)}
            for name, expected in values.items():
                np.testing.assert_allclose(found.values[name][g, s], expected, atol=1e-9, err_msg=f"{name} {goal} {starts[s]}")


def test_on_the_command_line(tmp_path, monkeypatch, capsys):
    command = [
        "holdfast",
        "workspace",
        "planar-3r",
        "--over",
        "targets",
        "--target",
        "grid:3",
        "--starts",
        "4",
        "--configurations",
        "3",
    ]
    monkeypatch.setattr("sys.argv", [*command, "--points", "1", "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit) as done:
        main()
    assert done.value.code == 0
    assert "targets within reach of motions from 4 starts" in capsys.readouterr().out
    assert {f.name for f in (tmp_path / "out").iterdir()} == {
        "targets.csv",
        "targets.json",
        "targets-reach.png",
        "targets-finish.png",
        "report.html",
    }
