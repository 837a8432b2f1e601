"""`holdfast cell check`: what touches the base, always, or sometimes; against counts from the clearance itself."""

import math

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.probability.sobol_sequence import sobol_points
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.cell import Box, Mesh, Points, Sphere, field


def at(*xyz: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = xyz
    return pose


BOX = [
    [0, 1, 3],
    [0, 3, 2],
    [0, 4, 5],
    [0, 5, 1],
    [0, 2, 6],
    [0, 6, 4],
    [7, 5, 4],
    [7, 4, 6],
    [7, 6, 2],
    [7, 2, 3],
    [7, 3, 1],
    [7, 1, 5],
]


@pytest.fixture
def cell(monkeypatch):
    monkeypatch.setattr(field, "_MAX_NODES", 5_000)
    corners = np.array([[x, y, z] for x in (0, 0.2) for y in (0, 0.2) for z in (0, 0.2)])
    block = Mesh(
        "block", (corners, [[0, 1, 3], [0, 3, 2], [0, 4, 5], [0, 5, 1], [0, 2, 6]]), solid="hull", pose=at(0.5, 0, 0.4)
    )
    scan = Points("scan", [[0.0, 0.5, 0.5]], radius=0.02, margin=0.2)
    objects = [Box("table", [1, 1, 0.1], pose=at(0, 0, -0.05)), Sphere("hood", 0.6, pose=at(0, 0, 0.6)), block, scan]
    return hf.Cell(objects, margin=0.01, name="bench")


def test_what_touches_is_told_by_name_and_counted(cell):
    arm = hf.arms.load("panda")
    found = hf.check_cell(cell, arm)
    assert found.base == ("table", "hood")
    assert "panda_joint4 & hood" in found.always
    assert not found.ok
    low, high = sampling_limits(arm)
    q = low + (high - low) * sobol_points(512, arm.n)
    open_ = hf.Cell(cell.objects, may_touch=[("table", "base"), ("hood", "base")])
    clearance = hf.Clearance(arm, cell=open_, itself=False)
    hits = clearance.by_pair(q) < 0
    assert found.colliding == hits.any(axis=1).mean() == 1.0
    names = np.array([name.partition(" & ")[2] for name in clearance.pair_names])
    for each in found.objects:
        assert each.touching == hits[:, names == each.name].any(axis=1).mean()
    assert [each.kind for each in found.objects] == ["box", "sphere", "hull", "point cloud"]
    assert [each.margin for each in found.objects] == [0.01, 0.01, 0.01, 0.2]
    assert [each.width > 0 for each in found.objects] == [False, False, True, True]
    assert "The base of 'panda' touches table, hood" in " ".join(found.describe())


def test_a_sound_cell_without_and_with_an_arm(cell):
    alone = hf.check_cell(hf.Cell(cell.objects[2:]))
    assert alone.ok
    assert math.isnan(alone.colliding)
    assert alone.describe()[1] == "Use --arm to check an arm for contacts with these objects."
    found = hf.check_cell(hf.Cell(cell.objects[2:]), hf.arms.load("panda"))
    assert found.ok
    assert 0 < found.colliding < 0.5


def test_nothing_is_said_of_a_cell_whose_files_changed(tmp_path):
    np.save(tmp_path / "scan.npy", np.zeros((2, 3)))
    cell = hf.Cell([Points("scan", tmp_path / "scan.npy", radius=0.1)])
    np.save(tmp_path / "scan.npy", np.ones((2, 3)))
    with pytest.raises(hf.InputError, match="changed since"):
        hf.check_cell(cell)


def test_batches_of_close_objects_agree_with_single_ones(rng, monkeypatch):
    """Of a batch only the spheres and objects that may be nearest are read; of a single configuration all of them are."""
    monkeypatch.setattr(field, "_MAX_NODES", 5_000)
    corners = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.03, 0.03) for z in (-0.1, 0.1)])
    plates = [Mesh(f"plate{k}", (corners, BOX), solid="hull", pose=at(0.45, 0.08 * k, 0.5)) for k in range(-3, 4)]
    objects = hf.Clearance(hf.arms.load("panda"), cell=hf.Cell(plates)).obstacles
    q = rng.uniform(*sampling_limits(objects.arm), (400, objects.arm.n))
    for measure in (objects.pair_distances, objects.smallest_distance):
        singly = np.concatenate([measure(row[None]) for row in q])
        np.testing.assert_allclose(measure(q), singly, rtol=0, atol=1e-9)
