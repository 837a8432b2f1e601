"""The record book: its check finds every changed digit, and the index of the library and MuJoCo measure its arms."""

import numpy as np
import pytest
import yaml

import holdfast as hf
from holdfast.studies.designs.record_book.entries import digest_record_text, parse_record
from holdfast.studies.designs.record_book.workspaces import compute_exact_area, estimate_area_by_grid


@pytest.fixture(scope="module")
def book():
    return hf.designs.record_designs()


def test_a_changed_digit_is_found(book, tmp_path):
    """The last but two of the value, of a length, of an entry of a null space."""
    for name in ("pose-9R-k2-001", "position-6R-k3-001", "jacobian-9-6-2-001"):
        data = yaml.safe_load(book[name].text)
        for change in ("value", "bound", "inside"):
            new = yaml.safe_load(book[name].text)
            new.pop("digest", None)  # which finds all of them
            if change == "value":
                new["value"] = data["value"] * (1 + 1e-7)
            elif change == "bound":
                new["proven_bound"]["value"] *= 1 - 1e-6
            elif "arm" in new:
                new["arm"]["rows"][3]["a"] += 1e-5
            else:
                new["null_space"][4][1] += 1e-7
            file = tmp_path / "changed.yaml"
            file.write_text(yaml.safe_dump(new), encoding="utf-8")
            assert not hf.designs.record_design(str(file)).check().ok, (name, change)


def test_every_changed_digit_of_a_file_is_found(book, rng):
    """By the digest: that of joint 1's offset, say, changes nothing that is measured."""
    files = [r for r in book.values() if r.arm is not None]
    assert len(files) == 36
    for record in files:
        assert record.data.digest == digest_record_text(record.text)
        assert digest_record_text(record.text.replace(", ", ",  ")) == record.data.digest
        digits = [k for k, c in enumerate(record.text[: record.text.index("digest:")]) if c.isdigit()]
        for k in rng.choice(digits, 20):
            changed = record.text[:k] + str((int(record.text[k]) + 1) % 10) + record.text[k + 1 :]
            assert digest_record_text(changed) != record.data.digest
    text = book["panda-pose-k1-001"].text.replace("at: [0.0,", "at: [0.1,")
    failed = [said for said, holds in parse_record(yaml.safe_load(text), text, "changed").check().claims if not holds]
    assert len(failed) == 1
    assert "digest" in failed[0]


def test_a_workspace_is_measured_again_in_closed_form_by_a_grid_and_by_the_library(book, tmp_path):
    """Widths of the last joint's range, and what they cost: section 9 of the specification; the library samples the plane."""
    b = 2 * np.arccos(0.6)
    for width, area in ((0.001, 9.4185), (0.02, 9.2983), (0.05, 9.1059), (0.1, 8.7783), (0.2, 8.1013)):
        assert compute_exact_area([0.5, 1.25, 1.25], (b - width, b)) == pytest.approx(area, abs=6e-5)
    limits = np.array([[-np.pi, np.pi], [b - 0.2, b]])
    assert estimate_area_by_grid([0.5, 1.25, 1.25], limits) == pytest.approx(8.1013, rel=2e-3)
    record = book["workspace-planar-3R-001"]
    for last in ((b - 0.2, b), (-0.3, 0.4), (2.9, 3.4)):
        pairs = np.array([[-np.pi, np.pi], [-np.pi, np.pi], last])
        found = hf.tolerant_workspace(record.arm, "planar", pairs).size
        assert compute_exact_area([0.5, 1.25, 1.25], last) == pytest.approx(found, rel=1e-4)
    changed = yaml.safe_load(record.text)
    del changed["digest"]
    for key, value, said in (
        ("limits", [None, [-1, 1], None], "no joint but the last"),
        ("limits", [None, None], "limits of each joint"),
        ("value", 9.4, "value"),
    ):
        file = tmp_path / "changed.yaml"
        file.write_text(yaml.safe_dump(changed | {key: value}), encoding="utf-8")
        check = hf.designs.record_design(str(file)).check()
        assert any(said in claim for claim, holds in check.claims if not holds)
    for value in (0.0, -1.0):  # every quantity of the book is positive
        file.write_text(yaml.safe_dump(changed | {"value": value}), encoding="utf-8")
        with pytest.raises(hf.InputError, match="value"):
            hf.designs.record_design(str(file))
    assert [book[f"workspace-planar-4R-least-{x}-001"].gap for x in ("00", "05", 10, 15)] == pytest.approx([0] * 4, abs=1e-12)


def test_the_best_configurations_of_arms_that_are_sold_hold(book):
    """The index of the library at the configuration, within the limits: the check measures by differences."""
    sold = [r for r in book.values() if r.data.kind.of is not None]
    assert len(sold) == 10
    for record in sold:
        c = record.data.kind
        index = hf.indices.relative_manipulability(record.arm, c.task, c.failures)
        assert index(record.q) == pytest.approx(record.data.value, rel=1e-7)
        assert record.data.value <= index.bound
    changed = yaml.safe_load(book["panda-pose-k1-001"].text)
    del changed["digest"]
    for at, value, said in ((3, 1e-6, "value"), (5, 1.0, "within its limits")):
        q = list(changed["at"])
        q[at] += value
        record = parse_record(changed | {"at": q}, "", "changed")
        assert any(said in claim for claim, holds in record.check().claims if not holds)
    with pytest.raises(hf.InputError, match="there is no built-in arm 'pandas'"):
        parse_record(changed | {"class": changed["class"] | {"of": "pandas"}}, "", "changed")


def test_a_record_in_mujoco(book):
    """The arm, exported as URDF and read by MuJoCo, has at home the index that the record claims: Jacobian by MuJoCo."""
    mujoco = pytest.importorskip("mujoco")
    record = book["pose-9R-k2-001"]
    arm = record.arm
    model = mujoco.MjModel.from_xml_string(arm.to_urdf())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    j, last = np.zeros((6, arm.n)), model.nbody - 1
    tool = data.xpos[last] + data.xmat[last].reshape(3, 3) @ arm.tool[:3, 3]
    mujoco.mj_jac(model, data, j[:3], j[3:], tool, last)
    null = np.linalg.svd(j)[2][6:].T
    pairs = [np.sqrt(np.linalg.det(null[[a, b]] @ null[[a, b]].T)) for a in range(9) for b in range(a)]
    assert min(pairs) == pytest.approx(record.data.value, rel=1e-8)
    assert hf.indices.relative_manipulability(arm, "pose", 2)(record.q) == pytest.approx(record.data.value, rel=1e-9)


@pytest.mark.parametrize("name", ["panda", "ur5-rail", "planar-3r"])
def test_an_arm_written_as_urdf_is_the_same_arm(name, tmp_path, rng):
    arm, file = hf.arms.load(name), tmp_path / "arm.urdf"
    file.write_text(arm.to_urdf(), encoding="utf-8")
    again = hf.Arm.from_urdf(file)
    q = rng.uniform(-1, 1, arm.n)
    assert again.forward_kinematics(q) == pytest.approx(arm.forward_kinematics(q), abs=1e-14)
    for mine, its in zip(arm.joints, again.joints, strict=True):
        assert (mine.name, mine.lower, mine.velocity, mine.effort) == (its.name, its.lower, its.velocity, its.effort)
    for mine, its in zip(arm.links, again.links, strict=True):
        assert (mine is None) == (its is None)
        assert mine is None or (mine.mass == its.mass and its.inertia == pytest.approx(mine.inertia, abs=1e-12))
