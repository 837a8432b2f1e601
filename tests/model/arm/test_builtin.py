"""The arms that come with holdfast: where they are from, what they are, and the names that people type."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import yaml
from scipy.spatial.transform import Rotation

from holdfast import arms
from holdfast.core.errors import ArmError
from holdfast.model.arm.task import as_task
from holdfast.model.arms.builtin import DATA_FOLDER

PROVENANCE = yaml.safe_load(DATA_FOLDER.joinpath("provenance.yaml").read_text())


@pytest.mark.parametrize("name", arms.names())
def test_what_is_said_about_an_arm_is_true(name: str) -> None:
    arm, said = arms.load(name), arms.about(name)
    assert (arm.name, arm.n, arm.source) == (said.name, said.n, said.source)
    assert arms.load(name) is arm
    home = np.array(said.home)
    assert home.shape == (arm.n,)
    assert np.all(arm.lower < home)
    assert np.all(home < arm.upper)
    task = as_task(arm, said.task)
    assert np.linalg.svd(task.rows @ arm.jacobian(home), compute_uv=False).min() > 0.1
    assert said.summary
    assert said.licence in {"MIT", *(x["licence"] for x in PROVENANCE.values())}


@pytest.mark.parametrize("name", list(PROVENANCE))
def test_files_are_those_whose_provenance_is_told(name: str) -> None:
    entry = PROVENANCE[name]
    content = DATA_FOLDER.joinpath(entry["file"]).read_bytes()
    assert hashlib.sha256(content).hexdigest() == entry["sha256"]
    assert len(entry["sha256_original"]) == 64
    assert arms.about(name).licence == entry["licence"]
    assert entry["package"] in arms.about(name).source
    for text in entry["texts"]:
        assert len(DATA_FOLDER.joinpath("licenses", text).read_text()) > 500
    from_mjcf = "mjcf_to_urdf" in entry.get("note", "")  # with capsules
    kept = () if "meshes" in entry else (b"<mesh",) if from_mjcf else (b"<collision", b"<mesh")
    for left_over in (b"<visual", b"<transmission", b"<gazebo", b"ns0:", *kept):
        assert left_over not in content


def test_every_file_has_its_provenance() -> None:
    files = {x.name for x in DATA_FOLDER.iterdir() if x.name.endswith(".urdf")}
    assert files == {x["file"] for x in PROVENANCE.values()}
    assert {x.name for x in DATA_FOLDER.iterdir() if x.name.endswith(".srdf")} == {
        x["pairs"]["file"] for x in PROVENANCE.values() if "pairs" in x
    }
    texts = {x.name for x in DATA_FOLDER.joinpath("licenses").iterdir()}
    assert texts == {text for x in PROVENANCE.values() for text in x["texts"]}


def test_meshes_are_those_whose_provenance_is_told() -> None:
    listed = {f"{x['meshes_in']}/{name}": h for x in PROVENANCE.values() for name, h in x.get("meshes", {}).items()}
    root = Path(str(DATA_FOLDER))
    found = {p.relative_to(root).as_posix(): p for p in root.rglob("*") if p.is_file() and p.suffix not in (".yaml", ".txt")}
    meshes = {name: p for name, p in found.items() if "/" in name}
    assert {name: hashlib.sha256(p.read_bytes()).hexdigest() for name, p in meshes.items()} == listed
    pairs = PROVENANCE["panda"]["pairs"]
    assert hashlib.sha256(found[pairs["file"]].read_bytes()).hexdigest() == pairs["sha256"]
    assert sum(p.stat().st_size for p in meshes.values()) < 130_000


def test_stripping_keeps_every_number_and_every_notice(tmp_path: Path) -> None:
    source = tmp_path / "in.urdf"
    source.write_text(
        "<?xml version='1.0'?>\n<!-- Copyright someone -->\n"
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><material name='m'/>"
        "<link name='a'><visual><origin xyz='9 9 9'/></visual><inertial><mass value='0.10'/></inertial></link><link name='b'/>"
        "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><origin xyz='1.50 0 0'/><calibration/></joint>"
        "<transmission name='t'><joint name='j'/></transmission></robot>"
    )
    tool = Path(__file__).parents[3] / "tools" / "strip_urdf.py"
    done = subprocess.run([sys.executable, tool, source, tmp_path / "out.urdf"], capture_output=True, text=True, check=True)
    out = (tmp_path / "out.urdf").read_text()
    assert hashlib.sha256(out.encode()).hexdigest() in done.stdout
    assert "Copyright someone" in out
    assert "Altered for holdfast" in out
    assert 'value="0.10"' in out
    assert 'xyz="1.50 0 0"' in out
    for gone in ("visual", "material", "transmission", "calibration", "9 9 9", "xacro"):
        assert gone not in out
    assert subprocess.run([sys.executable, tool], capture_output=True, check=False).returncode == 2


def test_stripping_keeps_collisions_where_asked_and_the_pairs_of_an_srdf_file(tmp_path: Path) -> None:
    tool = Path(__file__).parents[3] / "tools" / "strip_urdf.py"
    source, out = tmp_path / "in.urdf", tmp_path / "out.urdf"
    source.write_text(
        "<robot name='r'><link name='a'><visual/>"
        "<collision><geometry><sphere radius='0.10'/></geometry></collision></link></robot>"
    )
    subprocess.run([sys.executable, tool, source, out, "--collisions"], capture_output=True, check=True)
    assert 'radius="0.10"' in out.read_text()
    assert "visual" not in out.read_text()
    source.write_text("<robot name='r'><group name='g'/><disable_collisions link1='a' link2='b' reason='Never'/></robot>")
    subprocess.run([sys.executable, tool, source, out], capture_output=True, check=True)
    assert '<disable_collisions link1="a" link2="b" reason="Never" />' in out.read_text()
    assert "group" not in out.read_text()


def test_pa10_9dof_stands_where_the_paper_says() -> None:
    pose = arms.load("pa10-9dof").forward_kinematics(np.array(arms.about("pa10-9dof").home))
    np.testing.assert_allclose(pose[:3, 3] * 1000, [967.484, 0, 40.735], atol=1e-3)
    np.testing.assert_allclose(pose[:3, :3], Rotation.from_euler("y", 174, degrees=True).as_matrix(), atol=1e-12)
    arm = arms.load("pa10-9dof")
    np.testing.assert_allclose(np.rad2deg((arm.upper + arm.lower) / 2), [0, 30, 0, 90, 0, 18, 0, 36, 0], atol=1e-12)
    np.testing.assert_allclose(np.rad2deg(arm.upper - arm.lower), 90, atol=1e-12)


def test_pa10_7dof_is_a_shoulder_an_elbow_and_a_wrist() -> None:
    arm = arms.load("pa10-7dof")
    np.testing.assert_allclose(arm.forward_kinematics(np.zeros(7))[:3, 3], [0, 0, 0.315 + 0.45 + 0.5 + 0.08], atol=1e-12)
    np.testing.assert_allclose(np.rad2deg(arm.upper), [177, 94, 174, 137, 255, 165, 360])
    np.testing.assert_allclose(arm.lower, -arm.upper)
    q = np.array([0, np.pi / 2, 0, np.pi / 2, 0, 0, 0])
    # Upper arm level along x, forearm straight down.
    np.testing.assert_allclose(arm.forward_kinematics(q)[:3, 3], [0.45, 0, 0.315 - 0.58], atol=1e-12)


@pytest.mark.parametrize("n", [2, 3])
def test_planar_arms_are_rods_in_the_plane(n: int) -> None:
    arm = arms.load(f"planar-{n}r")
    q = np.random.default_rng(n).uniform(-3, 3, n)
    turned = np.cumsum(q)
    joints = np.vstack([[0, 0], np.cumsum(np.column_stack([np.cos(turned), np.sin(turned)]), axis=0)])
    np.testing.assert_allclose(arm.forward_kinematics(q)[:3, 3], [*joints[-1], 0], atol=1e-12)
    assert arm.gravity.tolist() == [0, -9.81, 0]
    for k, link in enumerate(arm.links):
        moving = np.eye(4)
        moving[:2, :2] = [[np.cos(turned[k]), -np.sin(turned[k])], [np.sin(turned[k]), np.cos(turned[k])]]
        moving[:2, 3] = joints[k]
        np.testing.assert_allclose((moving @ [*link.com, 1])[:2], (joints[k] + joints[k + 1]) / 2, atol=1e-12)
        np.testing.assert_allclose(link.inertia, np.diag([0, 1 / 12, 1 / 12]), atol=1e-15)
        assert link.mass == 1


def test_ur5_rail_is_the_ur5_on_a_slide() -> None:
    rail, ur5 = arms.load("ur5-rail"), arms.load("ur5")
    q = np.random.default_rng(0).uniform(-2, 2, 6)
    pose = rail.forward_kinematics([1.25, *q])
    expected = ur5.forward_kinematics(q).copy()
    expected[1, 3] += 1.25
    np.testing.assert_allclose(pose, expected, atol=1e-12)
    assert (rail.lower[0], rail.upper[0], rail.prismatic[0]) == (0, 2, True)
    assert "assumed" in rail.source
    assert rail.links[1:] == ur5.links


def test_iiwa_is_the_14() -> None:
    """Lengths by Pinocchio: base to shoulder, upper arm, forearm; the iiwa 7 has 0.34, 0.40, 0.40 m."""
    model = pin.buildModelFromUrdf(str(DATA_FOLDER.joinpath("iiwa14.urdf")))
    data = model.createData()
    pin.forwardKinematics(model, data, pin.neutral(model))
    heights = [data.oMi[k].translation[2] for k in (2, 4, 6)]
    np.testing.assert_allclose(np.diff([0, *heights]), [0.36, 0.42, 0.40], atol=1e-9)


def test_small_open_arms_reach_where_they_are_known_to() -> None:
    """YAM: its park pose, 393 mm above the base. SO-101 straight out. OpenArm: hangs down from its pedestal at 0.698 m."""
    yam = arms.load("yam")
    np.testing.assert_allclose(yam.forward_kinematics(arms.about("yam").home)[2, 3], 0.393, atol=5e-4)
    assert [joint.armature for joint in yam.joints] == [0.032] * 3 + [0.0018] * 3
    straight = arms.load("so101").forward_kinematics(np.zeros(5))[:3, 3]
    np.testing.assert_allclose(straight, [0.391, 0.0, 0.226], atol=1e-3)
    hanging = arms.load("openarm").forward_kinematics(np.zeros(7))[:3, 3]
    np.testing.assert_allclose(hanging, [0.0, 0.158, 0.082], atol=1e-3)
    for name, mass in (("yam", 3.761), ("so101", 0.485), ("openarm", 4.907)):
        assert sum(link.mass for link in arms.load(name).links) == pytest.approx(mass, abs=1e-3)


# ---- names and paths ---------------------------------------------------------------------------------------------


def test_unknown_names() -> None:
    with pytest.raises(
        ArmError, match="there is no built-in arm or file 'pand'; did you mean 'panda'\\? the built-in arms are planar-2r, "
    ):
        arms.load("pand")
    with pytest.raises(ArmError, match="there is no built-in arm 'Panda'; did you mean 'panda'"):
        arms.about("Panda")
    with pytest.raises(ArmError, match="there is no built-in arm '1234567'; the built-in arms are"):
        arms.about("1234567")


def test_names_and_files(tmp_path: Path) -> None:
    assert arms.load("panda") is arms.load("panda")
    urdf = str(DATA_FOLDER.joinpath("panda.urdf"))
    assert arms.load(urdf, tip="panda_link8").n == 7
    assert arms.load(urdf, base="panda_link2", tip="panda_link8").n == 5
    copy = tmp_path / "copy.XML"
    copy.write_bytes(DATA_FOLDER.joinpath("iiwa14.urdf").read_bytes())
    assert arms.load(str(copy)).n == 7
    for ending in ("yaml", "yml"):
        path = tmp_path / f"two.{ending}"
        path.write_text("rows: [{a: 1, alpha: 0}, {a: 1, alpha: 0}]")
        assert arms.load(str(path)).n == 2
    with pytest.raises(
        ArmError,
        match="tip cannot be chosen for 'panda', which is a built-in arm; leave it out",
    ):
        arms.load("panda", tip="panda_link8")
    with pytest.raises(ArmError, match=r"base cannot be chosen for .*, which is a DH table"):
        arms.load(str(path), base="x")
    with pytest.raises(ArmError, match=r"did you mean 'xarm7'.*give a built-in name, a file \(.urdf, .*a \.yaml DH table"):
        arms.load("xarm")
    with pytest.raises(ArmError, match="the file cannot be read"):
        arms.load(str(tmp_path / "none.urdf"))
    other = tmp_path / "arm.sdf"
    other.write_text("")
    with pytest.raises(ArmError, match=r"arm.sdf' is not a file of a known kind; give a built-in name, a file \(.urdf, "):
        arms.load(str(other))
