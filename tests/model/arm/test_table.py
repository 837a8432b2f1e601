"""DH files: the same arm from YAML, from Python and from the textbook product, and every sentence of refusal."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from holdfast.core.errors import ArmError
from holdfast.model.arm.dh import DH
from holdfast.model.arm.machine import Link
from holdfast.model.arm.model import Arm
from holdfast.model.arms import dh_file as table


def write(tmp_path: Path, content: object) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(content if isinstance(content, str) else yaml.safe_dump(content))
    return path


def pose(xyz: tuple[float, ...] = (0, 0, 0), axis: str = "x", angle: float = 0.0) -> np.ndarray:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = Rotation.from_euler(axis, angle).as_matrix(), xyz
    return out


def product(rows: list[dict], convention: str, q: np.ndarray) -> np.ndarray:
    """The textbook product, with SciPy's rotations; angles in rad."""
    out = np.eye(4)
    for row, value in zip(rows, q, strict=True):
        sliding = row.get("type") == "prismatic"
        theta = row.get("theta", 0) + (0 if sliding else value)
        d = row.get("d", 0) + (value if sliding else 0)
        along_z = pose((0, 0, d), "z", theta)
        along_x = pose((row["a"], 0, 0), "x", row["alpha"])
        out = out @ (along_z @ along_x if convention == "standard" else along_x @ along_z)
    return out


def random_rows(rng: np.random.Generator, n: int) -> list[dict]:
    return [
        {
            **{key: float(rng.uniform(-2, 2)) for key in ("a", "alpha", "d", "theta")},
            "type": str(rng.choice(["revolute", "prismatic"])),
        }
        for _ in range(n)
    ]


@pytest.mark.interpreted
@settings(max_examples=20)
@given(
    seed=st.integers(0, 2**32 - 1), convention=st.sampled_from(["standard", "modified"]), angles=st.sampled_from(["rad", "deg"])
)
def test_forward_kinematics_is_the_textbook_product(
    tmp_path_factory: pytest.TempPathFactory, seed: int, convention: str, angles: str
) -> None:
    rng = np.random.default_rng(seed)
    rows = random_rows(rng, int(rng.integers(2, 7)))
    unit = 180 / np.pi if angles == "deg" else 1.0
    rpy, xyz, tool = rng.uniform(-2, 2, 3), rng.uniform(-2, 2, 3), pose(tuple(rng.uniform(-1, 1, 3)), "y", rng.uniform(-3, 3))
    content = {
        "rows": [{**row, "alpha": row["alpha"] * unit, "theta": row["theta"] * unit} for row in rows],
        "convention": convention,
        "angles": angles,
        "base": {"xyz": xyz.tolist(), "urdf_rpy": (rpy * unit).tolist()},
        "tool": tool.tolist(),
    }
    arm = table.load_dh_file(write(tmp_path_factory.mktemp("table"), content))
    q = rng.uniform(-3, 3, arm.n)
    base = np.eye(4)
    base[:3, :3], base[:3, 3] = Rotation.from_euler("xyz", rpy).as_matrix(), xyz
    np.testing.assert_allclose(arm.forward_kinematics(q), base @ product(rows, convention, q) @ tool, atol=1e-12)
    assert arm.name == "arm"


@pytest.mark.interpreted
def test_a_modified_table_of_the_same_arm_gives_the_same_arm() -> None:
    """Shifting a and alpha one row down turns a standard table into a modified one; the last pair becomes the tool."""
    rng = np.random.default_rng(7)
    rows = random_rows(rng, 6)
    shifted = [
        {**row, "a": before["a"], "alpha": before["alpha"]}
        for row, before in zip(rows, [{"a": 0, "alpha": 0}, *rows], strict=False)
    ]
    last = pose((rows[-1]["a"], 0, 0), "x", rows[-1]["alpha"])
    one = Arm.from_dh([DH(**r) for r in rows])
    other = Arm.from_dh([DH(**r) for r in shifted], convention="modified", tool=last)
    q = rng.uniform(-3, 3, (10, 6))
    np.testing.assert_allclose(one.forward_kinematics(q), other.forward_kinematics(q), atol=1e-12)
    np.testing.assert_allclose(one.jacobian(q), other.jacobian(q), atol=1e-12)


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_links_and_payload_are_given_in_their_row_s_frame(tmp_path: Path, convention: str) -> None:
    """World centre of mass and inertia by the textbook product up to the row, against the moving frames of the arm."""
    rng = np.random.default_rng(8)
    rows = random_rows(rng, 5)
    coms = rng.normal(size=(5, 3))
    inertias = np.array([np.diag(x) + 0.1 * (1 - np.eye(3)) for x in rng.uniform(1, 1.5, (5, 3))])
    six = [[i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]] for i in inertias]
    links = [{"mass": 2.0, "com": c.tolist(), "inertia": i} for c, i in zip(coms, [x.tolist() for x in inertias], strict=True)]
    links[2]["inertia"] = [float(x) for x in six[2]]
    arm = table.load_dh_file(write(tmp_path, {"rows": rows, "convention": convention, "links": links, "payload": links[-1]}))
    q = rng.uniform(-3, 3, 5)
    moving = np.eye(4)
    for k, link in enumerate(arm.links):
        here = product(rows[: k + 1], convention, q[: k + 1])
        joint = arm.joints[k]
        motion = pose((0, 0, q[k])) if joint.prismatic else pose((0, 0, 0), "z", q[k])
        moving = moving @ joint.origin @ motion  # the frame in which the arm holds its links
        np.testing.assert_allclose((moving @ [*link.com, 1])[:3], (here @ [*coms[k], 1])[:3], atol=1e-12)
        turned = here[:3, :3] @ inertias[k] @ here[:3, :3].T
        np.testing.assert_allclose(moving[:3, :3] @ link.inertia @ moving[:3, :3].T, turned, atol=1e-12)
    np.testing.assert_allclose(arm.payload.com, arm.links[-1].com, atol=1e-15)
    assert [x.name for x in arm.links] == [f"link{k + 1}" for k in range(5)]


def test_every_key_arrives(tmp_path: Path) -> None:
    example = table.__doc__.split("::\n", 1)[1]
    arm = table.load_dh_file(write(tmp_path, "\n".join(line[4:] for line in example.splitlines())))
    first, second, third = arm.joints
    assert arm.name == "my arm"
    assert (first.name, first.effort) == ("shoulder", 120)
    np.testing.assert_allclose([first.lower, first.upper, first.velocity], np.deg2rad([-170, 170, 90]))
    assert (second.name, second.type, second.lower, second.friction, second.armature) == (
        "joint2",
        "continuous",
        -np.inf,
        0.1,
        0.02,
    )
    assert (third.type, third.upper) == ("prismatic", 0.4)
    np.testing.assert_allclose(arm.base, [[-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 1, 0.8], [0, 0, 0, 1]], atol=1e-15)
    np.testing.assert_allclose(arm.tool[:3, 3], [0, 0, 0.1])
    assert [None if x is None else x.mass for x in arm.links] == [4, 2, None]
    assert arm.links[0].name == "upper arm"
    assert isinstance(arm.payload, Link)
    assert arm.payload.mass == 1
    assert arm.source == "Where the numbers come from."


def test_numbers_without_a_point_in_scientific_notation_are_numbers(tmp_path: Path) -> None:
    arm = table.load_dh_file(write(tmp_path, "rows: [{a: 1e-3, alpha: 0}]"))
    assert arm.tool[0, 3] == 1e-3
    assert arm.source == "arm.yaml"


ROW = "{a: 1, alpha: 0}"
BODY = "mass: 1, com: [0, 0, 0], inertia: [1, 1, 1, 0, 0, 0]"
REFUSED = [
    ("rows: [", "this is not valid YAML"),
    ("- 1", "the file must hold keys and values, at least rows"),
    ("", "the file must hold keys and values, at least rows"),
    ("name: x", "rows: it is missing; it must be given"),
    ("rows: []", "rows: it has 0 entries; it must have at least 1"),
    ("rows: 3", "rows: 3 is wrong; input should be a valid list"),
    (
        "rows: [{a: 1, alhpa: 0}]",
        "rows[0].alhpa: the key 'alhpa' is not known; the keys here are a, alpha, d, theta, type, lower, upper, name, "
        "velocity, effort, friction, armature",
    ),
    (
        f"rows: [{ROW}]\nlimits: 1",
        "limits: the key 'limits' is not known; the keys here are rows, name, convention, angles, base, tool, gravity, links, "
        "payload, source",
    ),
    (f"rows: [{ROW}, {{a: 1}}]", "rows[1].alpha: it is missing; it must be given"),
    ("rows: [{a: 1, alpha: up}]", "rows[0].alpha: 'up' is wrong; input should be a valid number"),
    ("rows: [{a: 1, alpha: true}]", "rows[0].alpha: True is wrong; it must be a number"),
    ("rows: [{a: .inf, alpha: 0}]", "rows[0].a: inf is wrong; input should be a finite number"),
    ("rows: [{a: 1, alpha: 0, type: ball}]", "rows[0].type: 'ball' is not known; use 'revolute' or 'prismatic'"),
    (f"rows: [{ROW}]\nangles: grad", "angles: 'grad' is not known; use 'rad' or 'deg'"),
    (f"rows: [{ROW}]\nconvention: Craig", "convention: 'Craig' is not known; use 'standard' or 'modified'"),
    (f"rows: [{ROW}]\nrows: [{ROW}]", "line 2: the key 'rows' is given twice; give it once"),
    ("rows: [{a: 1, alpha: 0, a: 2}]", "line 1: the key 'a' is given twice; give it once"),
    (
        f"rows: [{ROW}]\nbase: {{pos: [0, 0, 0]}}",
        "base.pos: the key 'pos' is not known; the keys here are xyz, urdf_rpy",
    ),
    (f"rows: [{ROW}]\nbase: {{xyz: [0, 0]}}", "base.xyz: it has 2 entries; it must have 3"),
    (f"rows: [{ROW}]\ntool: [[1, 0, 0, 0]]", "tool: it has 1 entries; it must have 4"),
    (f"rows: [{ROW}]\ntool: {[[2.0 * (i == j) for j in range(4)] for i in range(4)]}", "is not a rotation"),
    (f"rows: [{ROW}]\ngravity: [0, 0, 0, 9]", "gravity: it has 4 entries; it must have 3"),
    (f"rows: [{ROW}]\nlinks: []", "has 1 DH rows and 0 links; it needs one link per row"),
    (
        f"rows: [{ROW}]\nlinks: [{{{BODY}, cog: 1}}]",
        "links[0].cog: the key 'cog' is not known; the keys here are mass, com, inertia, name",
    ),
    (f"rows: [{ROW}]\nlinks: [{{mass: 1}}]", "links[0].com: it is missing; it must be given"),
    (
        f"rows: [{ROW}]\npayload: {{{BODY.replace('mass: 1', 'mass: -1')}}}",
        "link 'payload': mass is -1 kg; it must be 0 or more",
    ),
    (
        f"rows: [{ROW}]\npayload: {{mass: 1, com: [0, 0, 0], inertia: [1, 1, 1]}}",
        "payload.inertia: [1, 1, 1] is wrong; it must be 6 numbers (xx, yy, zz, xy, xz, yz) or 3 rows of 3",
    ),
    (
        f"rows: [{ROW}]\npayload: {{mass: 1, com: [0, 0, 0], inertia: [[1, 0, 0], [0, 1], [0, 0, 1]]}}",
        "payload.inertia[1]: it has 2 entries; it must have 3",
    ),
    (
        f"rows: [{ROW}]\npayload: {{mass: 1, com: [0, 0, 0], inertia: [[1, 1, 0], [0, 1, 0], [0, 0, 1]]}}",
        "link 'payload': the inertia matrix is not symmetric",
    ),
    ("rows: [{a: 1, alpha: 0, lower: 2, upper: 1}]", "limits of joint 'joint1' are reversed"),
    ("rows: [{a: 1, alpha: 0, name: x}, {a: 1, alpha: 0, name: x}]", "the joint name 'x' is used more than once"),
]


@pytest.mark.parametrize(("content", "sentence"), REFUSED, ids=[case[1][:50] for case in REFUSED])
def test_refusals(tmp_path: Path, content: str, sentence: str) -> None:
    with pytest.raises(ArmError) as caught:
        table.load_dh_file(write(tmp_path, content))
    assert str(caught.value).startswith("arm.yaml: ")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(ArmError, match=r"none.yaml: the file cannot be read \(No such file or directory\)"):
        table.load_dh_file(tmp_path / "none.yaml")
    (tmp_path / "arm.yaml").write_bytes(b"\xff\xfe\xfa")
    with pytest.raises(ArmError, match="this is not valid YAML"):
        table.load_dh_file(tmp_path / "arm.yaml")


def test_angles_of_many_turns_are_pointed_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    printed: list[str] = []
    monkeypatch.setattr(table, "print_warning", printed.append)
    file = tmp_path / "hoist.yaml"
    rows = "rows:\n  - {a: 0, alpha: -90, d: 0.36}\n  - {a: 0.4, alpha: 0, theta: 3.2}\n"
    file.write_text(rows, encoding="utf-8")
    table.load_dh_file(file)
    assert printed == ["hoist.yaml: alpha of row 1 is -90 rad, 14.3 turns; if it is in degrees, add 'angles: deg'"]
    file.write_text(f"angles: deg\n{rows}", encoding="utf-8")
    table.load_dh_file(file)
    assert len(printed) == 1
