"""The report of a search, built from numbers at hand: its sentences, its table, its command, and lists of poses."""

from __future__ import annotations

import shlex
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from cards import check_card
from holdfast import arms
from holdfast.core.probability import Distribution
from holdfast.core.probability.intervals import Interval
from holdfast.interface.presentation.designs.designs import present
from holdfast.interface.presentation.designs.sections import format_command
from holdfast.interface.presentation.renderers import build_page
from holdfast.interface.report.page import render
from holdfast.kinematics.indices import by_name
from holdfast.kinematics.regions.pose_list import PoseList
from holdfast.studies.designs import HeldOutCheck, HeldOutResult, design_space, parse_vary

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check


def checked(rng: np.random.Generator, shift: float, lost: int = 0) -> HeldOutResult:
    values = np.sort(shift + 0.1 * rng.random(200 - lost))
    low = float(values[10 - lost]) if lost < 10 else 0.0
    return HeldOutResult(
        Distribution.from_values(values, "larger", lost), Interval(value=low, low=0.9 * low, high=1.1 * low, confidence=0.95)
    )


@pytest.fixture
def found(rng) -> hf.Designs:
    """Four designs of the planar arm; the last one is the best, at two of its bounds."""
    arm = arms.load("planar-3r")
    space = design_space(arm, ["a1=0.5..1.5", "upper2=90..180deg", "tool.x=-0.2..0.2"])
    values = np.concatenate([space.start[None], space.draw(2), [[1.5, np.pi / 2, 0.1]]])
    return hf.Designs(
        space=space,
        values=values,
        guaranteed=np.array([0.2, 0.25, 0.1, 0.4]),
        reach=np.array([3.0, 3.6, 2.9, 3.5]),
        reached=np.array([1.0, 1.0, 0.9, 1.0]),
        front=np.array([3, 1]),
        best=3,
        checked=HeldOutCheck(checked(rng, 0.2), checked(rng, 0.38), 0.01),
        index=by_name("relative-manipulability", arm, "planar"),
        region=hf.Region.box([1.5, 0.6, 0], [0.8, 0.8, 0], name="a bench"),
        level=0.95,
        poses=64,
        screened=2,
        climbs=1,
        seed=3,
        seconds=1.0,
        method=[("Designs", "at hand")],
    )


def build(designs):
    return build_page(present(designs))


def test_its_figures_are_given(found):
    assert list(found.figures()) == ["front", "arms"]
    assert list(replace(found, best=0).figures()) == ["front"]
    check_card(found)
    assert "relative manipulability of 95\u00a0% of the poses" in found._repr_html_()


def test_the_page_says_what_to_build(found):
    page = render(build(found)).replace("\u00a0", " ")
    check(page)
    for words in (
        "For 95 % of the poses of the region the best design keeps a relative manipulability of at least 0.38",
        "whichever joint locks; the baseline arm keeps 0.20",
        "The reach changes from 3.000 m to 3.500 m",
        "a1 (1.5 m), upper2 (90 deg) of the best design are at their bounds",
        "upper limit of joint 2",
        "at the lower bound",
        "Index quantile against reach",
        "Command that assesses this arm over the same region",
        "name: planar-3r-design",
    ):
        assert words in page, words


def test_the_command_is_the_search(found):
    line, remark = format_command(found)
    words = shlex.split(line.replace("\\\n", " "))
    assert words[:3] == ["holdfast", "design", "planar-3r"]
    assert remark == ""
    options = list(zip(words[3::2], words[4::2], strict=True))
    again = [parse_vary(text, found.space.arm) for option, text in options if option == "--vary"]
    for a, b in zip(again, found.space.parameters, strict=True):
        assert (a.name, a.unit) == (b.name, b.unit)
        assert (a.lower, a.upper) == pytest.approx((b.lower, b.upper), abs=1e-9)
    assert dict(options) | {"--vary": ""} == {
        "--vary": "", "--maximise": "relative-manipulability", "--region": "region.yaml", "--task": "planar", "--level": "0.95",
        "--poses": "64", "--designs": "2", "--local-searches": "1", "--check-poses": "200", "--seed": "3",
    }  # fmt: skip


def test_nothing_better_and_nothing_at_all(found, rng):
    same = replace(found, best=0)
    assert present(same).answer.startswith("No design better than the baseline arm was found: at 95 % of the poses")
    assert "Before and after" not in [s.title for _, s in build(same).parts]
    none = HeldOutResult(Distribution.from_values([], "larger", 200), Interval(value=0.0, low=0.0, high=0.0, confidence=0.95))
    lost = replace(found, checked=HeldOutCheck(none, none, 0.0))
    assert "the relative manipulability that 95 % of the poses of the region keep is 0" in present(lost).answer
    page = render(build(lost)).replace("\u00a0", " ")
    check(page)
    assert "Neither arm reaches any pose of the region" in page


def test_a_design_that_guarantees_as_much_and_reaches_farther_is_not_nothing(found, rng):
    alike = replace(
        found, guaranteed=np.array([0.4, 0.25, 0.1, 0.4]), checked=HeldOutCheck(checked(rng, 0.38), checked(rng, 0.38), 0.0)
    )
    line = present(alike).answer
    assert line.startswith("No design with a larger relative manipulability than the baseline arm was found, but the best")
    assert line.endswith("reaches 3.500 m instead of 3.000 m.")


def test_the_headline_says_what_the_front_has_for_a_little_less(found):
    near = replace(found, guaranteed=np.array([0.2, 0.39, 0.1, 0.4]))
    assert present(near).answer.endswith(
        "For 2.5 % less, 0.390 on the poses of the search, another design reaches 3.600 m, 2.9 % farther."
    )


def test_a_gain_that_does_not_last_is_no_gain(found, rng):
    flattered = replace(found, checked=HeldOutCheck(checked(rng, 0.3), checked(rng, 0.25), 0.15))
    assert present(flattered).answer.startswith(
        "No gain was found that holds on held-out poses: the best design has a relative"
    )


def test_poses_that_only_the_best_design_loses_are_said(found, rng):
    page = render(build(replace(found, checked=HeldOutCheck(checked(rng, 0.2), checked(rng, 0.38, lost=8), 0.0)))).replace(
        "\u00a0", " "
    )
    assert "does not reach 4.0 % of the poses of the region, and the baseline arm does not reach 0 %" in page


def test_files_of_a_list_of_poses(found, rng, tmp_path):
    poses = np.tile(np.eye(4), (5, 1, 1))
    poses[:, :2, 3] = rng.uniform(0.5, 1.5, (5, 2))
    listed = replace(found, region=hf.Region("poses", (), (), name="a job", listed=PoseList.from_matrices(poses)))
    names = {f.name for f in listed.save(tmp_path / "out")}
    assert names == {"report.html", "best-arm.yaml", "designs.csv", "region.yaml", "poses.csv"}
    again = hf.Region.load(tmp_path / "out" / "region.yaml")
    np.testing.assert_allclose(again.listed.rows, listed.region.listed.rows, atol=1e-12)
    with pytest.raises(hf.StoreError, match="cannot write to"):
        listed.save(tmp_path / "out" / "designs.csv")
    assert found.to_dict()["best"]["values"]["upper2"] == pytest.approx(np.pi / 2)
