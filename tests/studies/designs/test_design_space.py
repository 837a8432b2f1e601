"""The space of a search: what text means, which arm a design is, and every sentence of refusal."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.studies.designs import DesignParameter, DesignSpace, design_space, parse_vary

EVERYTHING = {
    "a2": (-0.3, 0.5), "alpha3": (-3.2, 3.2), "d1": (-1.0, 1.0), "theta4": (-3.2, 3.2), "lower2": (-3.0, -0.5),
    "upper2": (0.5, 3.0), "tool.x": (-1.0, 1.0), "tool.y": (-1.0, 1.0), "tool.z": (-1.0, 1.0), "tool.roll": (-3.2, 3.2),
    "tool.pitch": (-1.6, 1.6), "tool.yaw": (-3.2, 3.2),
}  # fmt: skip


def five(rng: np.random.Generator) -> hf.Arm:
    rows = [hf.DH(a=0.2, alpha=rng.uniform(0.2, 2), d=0.1, theta=rng.uniform(-1, 1), lower=-1.0, upper=1.0) for _ in range(4)]
    rows.append(hf.DH(a=0.1, alpha=0.3, type="prismatic", lower=0.0, upper=0.4))
    return hf.Arm.from_dh(rows, base=oracles.random_pose(rng), tool=oracles.random_pose(rng), name="five")


def test_the_given_arm_is_the_design_at_the_start(rng: np.random.Generator) -> None:
    arm = five(rng)
    space = design_space(arm, EVERYTHING)
    same = space.arm_of(space.start)
    q = rng.uniform(-1, 1, (9, 5))
    np.testing.assert_allclose(oracles.forward(same, q), oracles.forward(arm, q), atol=1e-12)
    assert np.array_equal(same.lower, arm.lower)
    assert np.array_equal(same.upper, arm.upper)
    assert np.array_equal(same.gravity, arm.gravity)
    assert same.name == "five-design"
    assert "tool.roll" in same.source


def test_a_design_is_the_table_with_other_numbers(rng: np.random.Generator) -> None:
    """Against the textbook product with SciPy's rotations."""
    arm = five(rng)
    space = design_space(arm, EVERYTHING)
    (design,) = space.draw(1, seed=int(rng.integers(1000)))
    value = dict(zip(space.names, design, strict=True))
    made = space.arm_of(design, name="mine")
    assert made.name == "mine"
    assert (made.joints[1].lower, made.joints[1].upper) == (value["lower2"], value["upper2"])
    q = rng.uniform(-1, 1, 5)
    out = arm.base.copy()
    for k, row in enumerate(space.table.rows):
        get = {f: value.get(f"{f}{k + 1}", getattr(row, f)) for f in ("a", "alpha", "d", "theta")}
        turn, slide = (q[k], 0.0) if row.type == "revolute" else (0.0, q[k])
        z = oracles.pose(Rotation.from_euler("z", get["theta"] + turn).as_matrix(), (0, 0, get["d"] + slide))
        out = out @ z @ oracles.pose(Rotation.from_euler("x", get["alpha"]).as_matrix(), (get["a"], 0, 0))
    tool = oracles.pose(
        Rotation.from_euler("xyz", [value["tool.roll"], value["tool.pitch"], value["tool.yaw"]]).as_matrix(),
        [value["tool.x"], value["tool.y"], value["tool.z"]],
    )
    np.testing.assert_allclose(oracles.forward(made, q[None])[0], out @ tool, atol=1e-12)


def test_moving_the_tool_alone_does_not_turn_it(rng: np.random.Generator) -> None:
    arm = five(rng)
    space = design_space(arm, {"tool.x": (-1, 1)})
    table = space.table_of([0.25])
    assert np.array_equal(table.tool[:3, :3], space.table.tool[:3, :3])
    assert table.tool[0, 3] == 0.25


def test_a_tool_pitched_by_a_right_angle_starts_where_it_is(rng: np.random.Generator) -> None:
    tool = np.eye(4)
    tool[:3, :3] = Rotation.from_euler("y", 90, degrees=True).as_matrix()
    space = design_space(five(rng).with_tool(tool), ["tool.pitch=0..100deg", "tool.yaw=-10..10deg"])
    np.testing.assert_allclose(space.start, [np.pi / 2, 0], atol=1e-12)
    np.testing.assert_allclose(space.table_of(space.start).tool, tool, atol=1e-12)


def test_an_angle_may_lie_a_turn_away(pa10: hf.Arm) -> None:
    assert design_space(pa10, ["alpha1=180..300deg"]).start == pytest.approx([np.deg2rad(270)])


@pytest.mark.parametrize(
    ("text", "lower", "upper", "unit"),
    [
        ("a3=-0.2..0.6", -0.2, 0.6, "m"),
        (" d1 = 200 .. 400mm ", 0.2, 0.4, "m"),
        ("d1=200mm..400mm", 0.2, 0.4, "m"),
        ("tool.z=-1e-1..1E-1m", -0.1, 0.1, "m"),
        ("alpha4=-90..90deg", -np.pi / 2, np.pi / 2, "rad"),
        ("theta4=-.5..+.5rad", -0.5, 0.5, "rad"),
        ("lower5=-0.1..0.1", -0.1, 0.1, "m"),
        ("upper2=0.6..1.5rad", 0.6, 1.5, "rad"),
    ],
)
def test_what_text_means(text: str, lower: float, upper: float, unit: str, rng: np.random.Generator) -> None:
    arm = five(rng)
    p = parse_vary(text, arm)
    assert (p.lower, p.upper, p.unit) == (pytest.approx(lower), pytest.approx(upper), unit)
    again = parse_vary(p.option_text, arm)
    assert (again.lower, again.upper) == pytest.approx((p.lower, p.upper), abs=1e-9)


def test_limits_of_sliding_joints_are_lengths_however_they_are_given(rng: np.random.Generator) -> None:
    for vary in ({"upper5": (0.3, 0.6)}, ["upper5=300..600mm"], [DesignParameter("upper5", 0.3, 0.6)]):
        space = design_space(five(rng), vary)
        assert space.parameters == (DesignParameter("upper5", 0.3, 0.6, unit="m"),)
        assert design_space(five(rng), space) is space


def test_draws_fill_the_bounds_and_more_begin_with_the_same(pa10: hf.Arm) -> None:
    space = design_space(pa10, ["a3=-0.1..0.6", "alpha4=0..90deg"])
    drawn = space.draw(300, seed=4)
    assert drawn.shape == (300, 2)
    assert np.array_equal(drawn[:7], space.draw(7, seed=4))
    assert ((drawn >= space.lower) & (drawn <= space.upper)).all()
    unit = (drawn - space.lower) / (space.upper - space.lower)
    counts = np.histogramdd(unit[:256], bins=(16, 16), range=[(0, 1), (0, 1)])[0]
    assert counts.min() == counts.max() == 1  # a net: one point in each cell
    assert not np.array_equal(drawn, space.draw(300, seed=5))


@pytest.mark.parametrize(
    ("vary", "sentence"),
    [
        ([], "no parameter of 'five' is varied; give at least one of a3"),
        (["link3=0..1"], "--vary 'link3' is not a parameter of an arm; write a3"),
        (["a0=0..1"], "'a0' is not a parameter"),
        (["tool.w=0..1"], "'tool.w' is not a parameter"),
        (["a3"], "--vary 'a3' cannot be read; write NAME=LOWER..UPPER, as a3=0.2..0.6"),
        (["a3=1"], "cannot be read"),
        (["a3=one..2"], "'one' is not a number"),
        (["a3=nan..2"], "'nan' is not a number"),
        (["a3=0..2ft"], "the unit 'ft' is not known; use m, mm, deg or rad"),
        (["a3=0..2deg"], "a3 is a length; give m or mm, not deg"),
        (["alpha3=0..2m"], "alpha3 is an angle; give deg or rad, not m"),
        (["lower5=0..2deg"], "lower5 is a length"),
        (["alpha3=-90..90"], "bounds of an angle need their unit; write alpha3=-90..90deg"),
        (["lower2=-1..0"], "bounds of an angle need their unit"),
        (["d3=200mm..0.4m"], "has two units, mm and m"),
        (["a3=0.6..0.2"], "bounds of a3 are reversed: 0.6 m is above 0.2 m; swap them"),
        (["alpha3=90..-90deg"], "reversed: 90 deg is above -90 deg"),
        (["a3=0.2..0.2"], "both bounds of a3 are 0.2 m"),
        (["a6=0..1"], "a6: 'five' has no row 6; its Denavit-Hartenberg table has rows 1 to 5"),
        (["a3=0..0.1"], "a3 of 'five' is 0.2 m, outside the bounds 0 m to 0.1 m; widen them"),
        (["a3=0..1", "a3=0..2"], "a3 is varied twice"),
        (["lower2=-2..1rad"], "the limits of joint 'joint2' can cross"),
        (["lower2=-2..0.5rad", "upper2=0.4..2rad"], "lower2 may be as high as 28.6479 deg and upper2 as low as 22.9183 deg"),
        ({"a3": (0.1,)}, "bounds of a3 are (0.1,); they must be two numbers"),
        ({"a3": "wide"}, "they must be two numbers"),
        ({"a3": (0.1, np.inf)}, "they must be finite numbers"),
    ],
)  # fmt: skip
def test_refusals(vary: object, sentence: str, rng: np.random.Generator) -> None:
    with pytest.raises(hf.InputError) as error:
        design_space(five(rng), vary)
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


def test_a_joint_without_limits_has_none_to_vary() -> None:
    with pytest.raises(hf.InputError, match="has no lower limit; give it one in the arm's file"):
        design_space(hf.Arm.from_dh([hf.DH(1.0, 0.0), hf.DH(1.0, 0.0)]), ["lower2=-2..1rad"])


def test_refused_designs(pa10: hf.Arm) -> None:
    space = design_space(pa10, ["a3=-0.1..0.6", "alpha4=0..90deg"])
    for values, sentence in [
        ([0.7, 1.0], "a3 is 0.7 m; it must lie within its bounds, -0.1 m to 0.6 m"),
        ([0.0, -0.5], "alpha4 is -28.6479 deg; it must lie within its bounds, 0 deg to 90 deg"),
        ([np.nan, 1.0], "a3 is nan m"),
        ([0.0], "a design has 1 values; it must have 2, a3, alpha4"),
        (["a", "b"], "a design must be 2 numbers, a3, alpha4"),
        ([[0.0, 0.0]], "one design has the shape (2,)"),
    ]:
        with pytest.raises(hf.InputError) as error:
            space.arm_of(values)
        assert sentence in str(error.value)
    with pytest.raises(hf.InputError, match="it must be 1 or more"):
        space.draw(0)


def test_masses_of_other_shapes_are_left_out() -> None:
    panda = arms.load("panda")
    made = design_space(panda, ["d3=200..400mm"]).arm_of([0.35])
    assert made.links[2] is None
    assert made.joints[0].velocity == panda.joints[0].velocity
    assert DesignSpace(panda, (DesignParameter("d3", 0.2, 0.4),)).names == ("d3",)
    assert replace(DesignParameter("d3", 0.2, 0.4), upper=0.5).upper == 0.5


def test_masses_stay_where_the_links_keep_their_shape(rng: np.random.Generator) -> None:
    """The torques of the given arm, read from its URDF file with other frames, are those of a design with other limits."""
    panda = hf.arms.load("panda").with_payload(hf.Link(1.5, np.array([0.02, 0, 0.1]), 0.01 * np.eye(3), name="part"))
    limits = design_space(panda, {"upper4": (-1.0, 0.0)}).arm_of([-0.5])
    q, qd, qdd = rng.uniform(-1, 1, (3, 7))
    np.testing.assert_allclose(limits.inverse_dynamics(q, qd, qdd), panda.inverse_dynamics(q, qd, qdd), rtol=1e-9, atol=1e-9)
    longer = design_space(panda, {"d3": (0.2, 0.4)}).arm_of([0.35])
    assert [link is None for link in longer.links] == [k == 2 for k in range(7)]
    assert longer.payload is not None
    # What hangs behind the longer link weighs as much about the joints behind it.
    whole = hf.Arm(**{**vars_of(longer), "links": tuple(link or panda.links[2] for link in longer.links)})
    np.testing.assert_allclose(whole.inertia_diagonal(q)[3:], panda.inertia_diagonal(q)[3:], rtol=1e-9)


def vars_of(arm: hf.Arm) -> dict[str, Any]:
    return {f.name: getattr(arm, f.name) for f in fields(arm)}
