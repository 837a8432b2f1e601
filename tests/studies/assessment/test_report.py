"""The report of every kind of assessment: well-formed, self-contained, and its numbers are the distribution's."""

from __future__ import annotations

import inspect
import re
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.core.formatting import format_percent
from holdfast.interface.cli.values import read_failures, read_task
from holdfast.interface.presentation import commands as rerun
from holdfast.interface.presentation.assessment import facts
from holdfast.interface.presentation.assessment import page as report
from holdfast.interface.presentation.assessment.sections import places
from holdfast.interface.report import save_png
from holdfast.kinematics.regions.region import rotation_from_rpy
from holdfast.kinematics.regions.weights import Density
from holdfast.model.arm.task import as_task, task_from_rows
from holdfast.model.failure_modes import failure_sets

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

NINE, SEVEN, PANDA = hf.arms.load("pa10-9dof"), hf.arms.load("pa10-7dof"), hf.arms.load("panda")
PAPER = hf.Region.box([0.968, 0, 0.041], 0.5, np.deg2rad([0, 174, 0]), np.deg2rad([90, 90, 90]), name="the paper's")
JOINTS = hf.Region.joints(NINE.lower, NINE.upper)
LIST = hf.Region.from_poses(PAPER.poses(next(PAPER.blocks(0, 0))[:60]), np.arange(60.0))
HEAVY = Density.from_points({"x": [(0.7, 1), (1.2, 4)], "roll": [(0, 1), (1, 2)]})
NASTY = replace(NINE, name='<script>alert("1")</script> $\\x$ 臂', source='"><img src=http://example.org/x.png>')


def around(name: str) -> hf.Region:
    return hf.Region.around_tool(hf.arms.load(name), np.array(hf.arms.about(name).home))


CASES: dict[str, Callable[[], hf.Assessment]] = {
    "paper": lambda: hf.assess(NINE, PAPER, poses=500, seed=1),
    "optimised": lambda: hf.assess(NINE, PAPER, poses=240, seed=2, optimise=True),
    "panda": lambda: hf.assess(PANDA, around("panda"), poses=250),
    "flat": lambda: hf.assess(hf.arms.load("planar-3r"), around("planar-3r"), task="planar", poses=250),
    "structural": lambda: hf.assess(SEVEN, around("pa10-7dof"), poses=100),
    "structural, unbounded": lambda: hf.assess(SEVEN, around("pa10-7dof"), "manipulability", poses=50),
    "condition number": lambda: hf.assess(PANDA, around("panda"), "condition-number", poses=250, sampling="sobol"),
    "infinite": lambda: hf.assess(SEVEN, around("pa10-7dof"), "condition-number", poses=50),
    "joints": lambda: hf.assess(NINE, JOINTS, poses=21_000),
    "none reached": lambda: hf.assess(PANDA, hf.Region.box([3, 0, 0], 0.5), poses=20, restarts=2),
    "none reached, infinite": lambda: hf.assess(PANDA, hf.Region.box([3, 0, 0], 0.5), "condition-number", poses=20, restarts=2),
    "few": lambda: hf.assess(NINE, PAPER, poses=5),
    "one": lambda: hf.assess(NINE, JOINTS, poses=1),
    "no rows": lambda: hf.assess(NINE, PAPER, poses=100, keep=False),
    "no rows, joints": lambda: hf.assess(NINE, JOINTS, poses=100, keep=False),
    "sliding": lambda: hf.assess(hf.arms.load("ur5-rail"), around("ur5-rail"), "manipulability", poses=50),
    "pairs": lambda: hf.assess(NINE, PAPER, hf.indices.relative_manipulability(NINE, failures="pairs"), poses=50),
    "one failure": lambda: hf.assess(
        NINE, PAPER, hf.indices.manipulability(NINE, "position", ["joint2"], length=0.5), poses=50
    ),
    "weighted": lambda: hf.assess(
        NINE, replace(PAPER, weight=HEAVY), poses=210, optimise=True, after_lock=True, locked={1: 0.5}
    ),
    "weighted, condition number": lambda: hf.assess(SEVEN, LIST, "condition-number"),
    "list, no rows": lambda: hf.assess(NINE, LIST, poses=100, keep=False),
    "nasty": lambda: hf.assess(NASTY, replace(PAPER, name="<i>&$x$"), poses=50),
}


@cache
def case(name: str) -> hf.Assessment:
    return CASES[name]()


@cache
def text(name: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        return case(name).report(Path(folder) / "r.html").read_text(encoding="utf-8").replace("\u00a0", " ")


LAID_OUT = ("paper", "weighted", "nasty")


@pytest.mark.parametrize("name", [name if name in LAID_OUT else pytest.param(name, marks=pytest.mark.rough) for name in CASES])
def test_every_case_renders(name: str) -> None:
    a, html = case(name), text(name)
    check(html)
    assert "nan" not in re.sub(r"<svg.*?</svg>|<iframe.*?</iframe>", "", html, flags=re.DOTALL).lower()
    assert f"{a.distribution.samples:,}" in html
    assert headline(html) == facts.AssessmentFacts(a, None).headline
    if name != "nasty":
        assert f"holdfast assess {a.arm.name} " in html


@pytest.mark.parametrize("name", ["paper", "infinite", "none reached", "no rows, joints"])
def test_overview_picture(name: str, tmp_path: Path) -> None:
    data = save_png(case(name).figures()["overview"], tmp_path / "o.png").read_bytes()
    assert (int.from_bytes(data[16:20]), int.from_bytes(data[20:24])) == (1200, 520)


def headline(html: str) -> str:
    found = re.search(r'class="headline">(.*?)</p>', html, re.DOTALL)
    assert found
    return found[1]


def test_an_empty_headline_names_the_worst_joint_and_the_next_figures():
    """Counted here from the rows, not by the distribution."""
    a = case("panda")
    data = a.dataset
    value, failed = data["index"].values, data["by_failure"].values
    reached = np.isfinite(value)
    line = facts.AssessmentFacts(a, 0.37).headline
    assert "probability 0.00" in line
    worst, counts = np.unique(failed[reached].argmin(axis=1), return_counts=True)
    name = PANDA.joint_names[worst[counts.argmax()]]
    assert f"A lock of {name} is the worst failure at {100 * counts.max() / counts.sum():.1f} %" in line
    assert f"The median of the reached poses is {np.quantile(value[reached], 0.5, method='inverted_cdf'):.3f}" in line
    assert "a run with --optimise (optimise=True in Python) also evaluates" in line
    assert "A lock of" not in facts.AssessmentFacts(a, 0.01).headline  # which says enough
    best = facts.AssessmentFacts(case("optimised"), 0.47).headline
    median = np.nanquantile(case("optimised").dataset["optimised_index"].values, 0.5, method="inverted_cdf")
    assert f"at the best configuration of each pose it is {median:.3f}, and the probability" in best
    data = case("weighted").dataset
    left = np.average(data["survives"].values == 1, axis=0, weights=data["weight"].values)
    name = NINE.joint_names[left.argmin()]
    first = f"Once {name} has locked, {100 * left.min():.1f} % of the poses of the region are still reached. "
    for threshold in (0.01, 0.57):
        assert facts.AssessmentFacts(case("weighted"), threshold).headline.startswith(first)
    assert headline(text("panda")).startswith(
        "Hardly any pose" if case("panda").probability(0.19) else "None of the 250 sampled poses keeps"
    )


def test_a_headline_that_is_zero_by_structure_names_the_joint():
    a = case("structural")
    line = facts.AssessmentFacts(a, None).headline
    assert "Once joint4 locks, the task is singular in every configuration." in line
    failed = a.dataset["by_failure"].values
    spared = np.delete(failed[np.isfinite(failed).all(axis=1)], 3, axis=1).min(axis=1)
    assert f"would be {np.quantile(spared, 0.5, method='inverted_cdf'):.3f}." in line


def test_one_configuration_in_a_hundred_is_a_probability_and_less_is_hardly_any():
    three = hf.arms.load("planar-3r")
    a = hf.assess(three, hf.Region.joints([-2] * 3, [2] * 3), poses=100, task="planar")
    top = a.distribution.highest
    assert facts.AssessmentFacts(a, top).headline.startswith("With probability 0.01 ")
    assert facts.AssessmentFacts(a, np.nextafter(top, 1)).headline.startswith("None of the 100 sampled configurations")


@pytest.mark.parametrize(("turned", "nothing"), [(1e-9, True), (1e-8, False)])
def test_a_manipulability_of_less_than_1e_9_after_a_lock_is_none(turned, nothing):
    """The axes about the elbow of an iiwa miss their points by an angle, and a lock leaves 0.35 times it, as minors say."""
    joints = list(hf.arms.load("iiwa14").joints)

    def turn(angle: float) -> hf.Arm:
        off = np.eye(4)
        off[:3, :3] = Rotation.from_euler("x", angle).as_matrix()
        changed = replace(joints[2], origin=joints[2].origin @ off)
        return hf.Arm(name="turned", joints=(*joints[:2], changed, *joints[3:]), base=np.eye(4), tool=np.eye(4))

    a = hf.assess(turn(turned), hf.Region.joints([-2] * 7, [2] * 7), poses=64)
    j = oracles.task_jacobian(turn(1e-4), a.dataset["q"].values, "pose")
    left, healthy = (np.linalg.svd(x, compute_uv=False).prod(axis=1) for x in (np.delete(j, 3, axis=2), j))
    assert a.distribution.highest == pytest.approx(turned / 1e-4 * (left / healthy).max(), rel=1e-3)
    assert (
        facts.AssessmentFacts(a, None).headline.startswith("No configuration found in the region tolerates every failure")
        == nothing
    )


@pytest.mark.parametrize(
    ("name", "threshold", "shown"),
    [("paper", None, 0.29), ("paper", 0.1, 0.1), ("condition number", 80.0, 80.0), ("joints", None, 0.29)],
)
def test_headline_has_the_numbers_of_the_distribution(name: str, threshold: float | None, shown: float) -> None:
    a = case(name)
    line = facts.AssessmentFacts(a, threshold).headline
    # Counted here, from the rows.
    values = a.dataset["index"].values
    with np.errstate(invalid="ignore"):
        hits = int((values >= shown).sum() if a.index.better == "larger" else (values <= shown).sum())
    found = re.search(r"probability ([\d.]+) \(([\d.]+) to ([\d.]+), 95 %\)", line)
    assert found
    p, low, high = map(float, found.groups())
    size = len(values)
    assert abs(p - hits / size) <= 0.5 * 10.0 ** -len(found[1].split(".")[1]) + 1e-12
    z, n, share = 1.959964, size, hits / size
    middle, half = (
        (share + z * z / (2 * n)) / (1 + z * z / n),
        z * np.sqrt(share * (1 - share) / n + (z / (2 * n)) ** 2) / (1 + z * z / n),
    )
    np.testing.assert_allclose([low, high], [middle - half, middle + half], atol=0.006)
    relation = f" ({format_percent(shown / a.index.bound)} of the largest possible value)" if a.index.bound else ""
    assert f" {shown:g}{relation} whichever joint locks" in line
    lost = int(np.isnan(values).sum())
    assert (f"for {100 * lost / size:.1f} % of poses" in line) == (lost > 0)


def test_bound_and_threshold_are_those_of_the_arm(tmp_path: Path) -> None:
    html = text("panda")
    assert "at least 0.19 " in headline(html)  # half of sqrt(1/7) = 0.378
    assert "no configuration can exceed 0.378" in html
    with pytest.raises(hf.InputError, match="threshold is nan"):
        case("panda").report(tmp_path / "x.html", float("nan"))
    assert not (tmp_path / "x.html").exists()


def test_structural_failure_is_said_first() -> None:
    html = text("structural")
    assert "No pose found in the region tolerates every failure" in headline(html)
    assert html.index('class="callout bad"') < html.index("<h2>Numbers")
    assert "once joint4 (joint 4) locks" in html
    rows = re.findall(r"<tr><th[^>]*>([\w() ]+)</th>(.*?)</tr>", html)
    fatal = {n: [k for k, c in enumerate(re.findall(r"<td.*?</td>", cells)) if "fatal" in c] for n, cells in rows}
    assert fatal["pose (this run)"] == [4]  # after the column of the redundancy: joint 4
    assert fatal["position"] == []


def test_before_and_after_optimisation() -> None:
    """Worst poses, failures, gaps and joints to protect at both kinds of configurations."""
    a, html = case("optimised"), text("optimised")
    for optimised in (False, True):
        values = a.dataset["optimised_index" if optimised else "index"].values
        worst = int(np.nanargmin(values))
        name = "after optimisation" if optimised else "found by inverse kinematics"
        table = html[html.index(f"reached poses, {name}; R = Rz") :]
        first = re.findall(r"<tbody>\s*<tr><th[^>]*>([\d,]+)</th>(.*?)</tr>", table)[0]
        assert int(first[0].replace(",", "")) == worst + 1
        assert f">{values[worst]:.3f}<" in first[1]
        gap = a.index.bound - float(np.nanquantile(values, 0.5, method="inverted_cdf"))
        assert f"(gap {gap:.3f})" in html
        assert f"Seen from the side, {name}" in html
        u = a.upgrades(0.29, optimised)[0]
        assert f"{u.gain:+.3f} ({u.low:.3f} to {u.high:.3f})" in html
    assert "best: is the worst" in html
    assert "Gain from a redundant motor or brake" in html


def test_names_are_escaped() -> None:
    html = text("nasty")
    assert "&lt;script&gt;alert" in html
    assert "<i>" not in html
    assert "<img" not in html
    assert "臂" in html


def test_what_is_missing_is_said() -> None:
    html = text("no rows")
    assert "were not stored" in html
    assert "The 10 worst" not in html
    html = text("none reached")
    assert headline(html).startswith("No configuration within the joint limits was found for any of the 20 poses")
    html = text("joints")
    assert "A random 20,000 of " in html
    assert "No configuration found" not in html


def test_an_interrupted_run_says_so(tmp_path: Path) -> None:
    def stop(done: int, _: int) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hf.assess(NINE, JOINTS, poses=140_000, store=tmp_path / "run", progress=stop)
    html = hf.load(tmp_path / "run").report(tmp_path / "r.html").read_text(encoding="utf-8")
    check(html)
    assert html.index('class="headline"') < html.index("This run is not complete") < html.index("<h2>")
    assert "131,072 of 140,000 configurations have been evaluated" in html


@pytest.mark.parametrize("region", [JOINTS, PAPER])
def test_a_run_of_which_nothing_is_done_yet(region: hf.Region, tmp_path: Path) -> None:
    def stop(*_: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hf.assess(NINE, region, poses=10, store=tmp_path / "run", progress=stop)
    a = hf.load(tmp_path / "run")
    html = a.report(tmp_path / "r.html").read_text(encoding="utf-8")
    check(html)
    assert headline(html) == "Nothing has been computed yet."
    assert "not kept" not in html
    save_png(a.figures()["overview"], tmp_path / "o.png")


def test_every_section_is_in_the_list_and_has_what_the_page_asks_for() -> None:
    folder = Path(report.__file__).parent / "sections"
    assert sorted(file.stem for file in folder.glob("[a-z]*.py")) == sorted(report.SECTION_TITLES)
    for name in report.SECTION_TITLES:
        section = import_module(f"holdfast.interface.presentation.assessment.sections.{name}")
        assert next(iter(inspect.signature(section.blocks).parameters.values())).annotation == "AssessmentFacts"


def test_unwritable_path(tmp_path: Path) -> None:
    with pytest.raises(hf.StoreError, match=r"^cannot write report '.*'; choose another path$|No such file"):
        case("few").report(tmp_path / "no" / "r.html")


@pytest.mark.parametrize("name", ["paper", "joints"])
def test_the_region_file_is_the_region(name: str, tmp_path: Path) -> None:
    a = case(name)
    file = tmp_path / "region.yaml"
    file.write_text(rerun.format_region_file(a.region))
    again = hf.Region.load(file)
    assert again.name == a.region.name
    np.testing.assert_allclose(again.center, a.region.center, rtol=0, atol=1e-15)
    np.testing.assert_allclose(again.size, a.region.size, rtol=0, atol=1e-15)


def test_command_line() -> None:
    command, note = rerun.build_command_line(case("one failure"))
    assert command is not None
    assert note == ""
    words = command.replace("\\\n", "").split()
    assert words[:3] == ["holdfast", "assess", "pa10-9dof"]
    options = dict(zip(words[3::2], words[4::2], strict=True))
    assert options["--length"] == "0.5"
    assert options["--failures"] == "joint2"
    assert (options["--poses"], options["--seed"], options["--task"]) == ("50", "0", "position")
    own = hf.indices.CustomIndex(lambda j: j[0, 0], NINE)
    assert rerun.build_command_line(hf.assess(NINE, JOINTS, own, poses=10))[0] is None
    odd = hf.Task("odd", np.array([[0.6, 0.8, 0, 0, 0, 0]]))
    assert rerun.build_command_line(hf.assess(NINE, JOINTS, hf.indices.relative_manipulability(NINE, odd), poses=10))[0] is None
    assert "ARM is the file" in rerun.build_command_line(case("nasty"))[1]


def test_the_command_line_reads_tasks_and_failures_as_they_were() -> None:
    for task in (*("pose", "pointing", "position"), task_from_rows(["vz", "vx", "wy"], "tool"), task_from_rows(["vx"])):
        t = as_task(NINE, task)
        option = rerun.format_task_option(NINE, t)
        again = as_task(NINE, read_task(option, "pa10-9dof", NINE))
        assert (again.name, again.frame, again.rows.tolist()) == (t.name, t.frame, t.rows.tolist())
    # Names that the option's own signs are in, and a name that is a number.
    for names in (NINE.joint_names, ["a+b", "b;", *"cdefghi"], ["1", *"bcdefghi"]):
        joints = tuple(replace(j, name=n) for j, n in zip(NINE.joints, names, strict=True))
        arm = replace(NINE, joints=joints, links=())
        for failures in ("single", "pairs", 3, [[0]], [[1], [0, 2]]):
            sets = failure_sets(arm, failures)
            assert failure_sets(arm, read_failures(arm, rerun.format_failures_option(arm, sets))) == sets


@pytest.mark.parametrize("name", hf.arms.names())
def test_the_drawn_arm_ends_at_the_tool(name: str) -> None:
    arm = hf.arms.load(name).with_base(hf.arms.load("ur5").joints[0].origin)
    q = np.random.default_rng(3).uniform(-1, 1, arm.n)
    _, *origins, tool = arm.frames(q)[:, :3, 3]
    np.testing.assert_allclose(tool, arm.forward_kinematics(q)[:3, 3], atol=1e-12)
    # The column of a revolute joint is z x (tool - origin): the origin lies on the axis that the Jacobian says.
    jacobian = arm.jacobian(q)
    for k in np.flatnonzero(~arm.prismatic):
        np.testing.assert_allclose(np.cross(jacobian[3:, k], tool - origins[k]), jacobian[:3, k], atol=1e-12)


def test_listed_angles_are_those_of_the_pose_and_inside_the_region() -> None:
    rng = np.random.default_rng(5)
    low, size = np.array(PAPER.center[3:]) - np.array(PAPER.size[3:]) / 2, np.array(PAPER.size[3:])
    drawn = low + size * rng.random((200, 3))
    shown = places._choose_rpy_angles(rotation_from_rpy(drawn), PAPER)
    np.testing.assert_allclose(shown, drawn, atol=1e-9)
    anything = Rotation.random(50, rng=rng).as_matrix()
    np.testing.assert_allclose(rotation_from_rpy(places._choose_rpy_angles(anything, JOINTS)), anything, atol=1e-9)
