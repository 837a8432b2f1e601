"""``holdfast self-motion`` and ``holdfast tolerant-workspace``: what they print, write and draw."""

from __future__ import annotations

import matplotlib.image
import numpy as np
import pytest

import holdfast as hf


def test_the_curves_and_bounds_of_a_planar_arm(cli, ask, tmp_path):
    data = ask("self-motion", "planar-3r", "--target", "1.5,1.5", "--bounds")
    assert data["status"] == "ok"
    assert data["redundancy"] == 1
    (curve,) = data["components"]
    assert curve["closed"]
    assert curve["length_rad"] == pytest.approx(13.18, abs=0.02)
    np.testing.assert_allclose(np.degrees(data["bounds"]["joint1"]), [[-24.2952, 114.2952]], atol=1e-4)
    table, figure = tmp_path / "points.csv", tmp_path / "curve.png"
    code, out, err = cli(
        "self-motion", "planar-3r", "--target", "1.5 1.5", "--bounds", "--degrees", "--csv", table, "--plot", figure
    )
    assert (code, err) == (0, "")
    assert "-24.30 to 114.30 deg" in out
    assert "closed" in out
    assert table.read_text().startswith("curve,joint1_deg,joint2_deg,joint3_deg\n")
    q = np.radians(np.loadtxt(table, delimiter=",", skiprows=1)[:, 1:])
    hand = np.exp(1j * np.cumsum(q, axis=1)).sum(axis=1)
    np.testing.assert_allclose(hand, 1.5 + 1.5j, atol=1e-8)
    assert matplotlib.image.imread(figure).shape[1] > 600


def test_a_spatial_arm_ends_at_its_limits(cli, tmp_path):
    figure = tmp_path / "panda.png"
    code, out, err = cli("self-motion", "panda", "--pose", "0.4,0.1,0.5,180,0,0", "--plot", figure)
    assert (code, err) == (0, "")
    assert "limit of panda_joint" in out
    assert "allowed lock positions" in out
    assert figure.exists()


def test_explain_states_the_proof_or_a_configuration(cli, ask):
    code, out, err = cli("self-motion", "planar-3r", "--target", "3.2,0", "--explain")
    assert (code, err) == (3, "")
    assert "Unreachable: it is proved" in out
    assert "boxes of joints" in out
    data = ask("self-motion", "planar-3r", "--target", "1.5,1.5", "--explain")
    assert data["verdict"] == "reachable"
    q = [row["value"] for row in data["q"]]
    np.testing.assert_allclose(np.exp(1j * np.cumsum(q)).sum(), 1.5 + 1.5j, atol=2e-6)
    code, _, err = cli("self-motion", "planar-3r", "--target", "1.5,1.5", "--explain", "--plot", "none.png")
    assert code == 2
    assert "--explain draws no figure" in err


def test_more_redundancy_and_nothing_found(cli, tmp_path):
    figure = tmp_path / "none.png"
    code, out, _ = cli("self-motion", "planar-3r", "--target", "5,0", "--bounds", "--plot", figure)
    assert code == 0
    assert "which does not prove that none exists" in out
    assert "nowhere" in out
    assert figure.exists()
    code, out, _ = cli(
        "self-motion", "ur5", "--task", "position", "--target", "0.4,0.2,0.4", "--spacing", "0.5", "--plot", figure
    )
    assert code == 0
    assert "a manifold of dimension 3" in out
    assert "anywhere" in out


def test_the_region_of_a_planar_arm(cli, ask, tmp_path):
    limits = ["--limit", "1=-18,18", "--limit", "joint2=-110,110", "--limit", "3=-110,110"]
    data = ask("tolerant-workspace", "planar-3r", *limits)
    assert data["exact"]
    assert data["size_m2"] == pytest.approx(3.56, abs=0.01)
    assert data["confidence"] is None
    np.testing.assert_allclose(np.degrees(data["limits"]["joint1"]), [-18, 18])
    figure = tmp_path / "region.png"
    code, out, err = cli("tolerant-workspace", "planar-3r", *limits, "--plot", figure)
    assert (code, err) == (0, "")
    assert "3.56" in out
    assert "in closed form" in out
    assert matplotlib.image.imread(figure).shape[1] > 600


def test_the_region_of_a_spatial_arm_is_sampled(cli, tmp_path):
    figure = tmp_path / "region.png"
    code, out, err = cli(
        "tolerant-workspace", "panda", "--limit", "4=-115,-65", "--points", "80", "--angles", "3", "--plot", figure
    )
    assert (code, err) == (0, "")
    assert "80 points, 3 locked values per joint" in out
    assert "does not account for" in out
    assert figure.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["self-motion", "planar-3r"], "give the target by either --target or --pose"),
        (["self-motion", "planar-3r", "--target", "1,1", "--pose", "1,1,0"], "by either --target or --pose"),
        (["self-motion", "planar-3r", "--target", "1,1,1"], "--target has 3 numbers; task 'planar' needs 2, in m"),
        (["self-motion", "planar-2r", "--target", "1,1"], "without redundancy"),
        (["self-motion", "panda", "--pose", "0.4,0.1,0.5"], "--pose has 3 numbers; task 'pose' needs 6"),
        (["tolerant-workspace", "planar-3r", "--limit", "1=5"], "has 1 number after =; give both limits"),
        (["tolerant-workspace", "planar-3r", "--limit", "1=-5,5", "--optimise"], "not both"),
        (["tolerant-workspace", "panda", "--rotation", "1,2"], "--rotation has 2 numbers"),
        (["tolerant-workspace", "planar-2r"], "no region survives"),
    ],
)
def test_errors(cli, arguments, message):
    code, out, err = cli(*arguments)
    assert (code, out) == (2, "")
    assert message in err


def test_the_command_cuts_curves_where_they_meet_a_cell(cli, ask, tmp_path):
    cell = tmp_path / "bench.yaml"
    cell.write_text("name: bench\nobjects: {post: {sphere: 0.2, pose: {xyz: [0.4, 0.9, 0]}}}\n")
    call = ("self-motion", "planar-3r", "--target", "1.2,0.4", "--cell", cell, "--radius", 0.03, "--no-clearance")
    data = ask(*call, "--bounds")
    arm = hf.arms.load("planar-3r")
    slim = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.03), hf.Cell.load(cell), itself=False)
    found = hf.self_motion(arm, [1.2, 0.4], "planar", clearance=slim)
    assert [c["barred_by"] for c in data["components"]] == [list(c.barred_by) for c in found.components]
    assert data["bounds"] == {name: [list(x) for x in arcs] for name, arcs in zip(arm.joint_names, found.arcs(), strict=True)}
    assert data["clearance"]["cell"]["sha256"] == hf.Cell.load(cell).digest
    code, text, err = cli(*call, "--out", tmp_path / "out")
    assert (code, err) == (0, "")
    assert "& post" in text
    assert "bench" in (tmp_path / "out" / "report.html").read_text()
