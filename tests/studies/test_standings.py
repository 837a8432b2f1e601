"""Which arm for what: who leads, and whether the samples say so."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from holdfast import arms
from holdfast.assess.distribution import Distribution
from holdfast.indices import by_name
from holdfast.interval import Interval
from holdfast.report.page import Page, Section, render
from holdfast.studies.report import _headline, _standings, _structure
from holdfast.studies.results import Assessed, Driven
from holdfast.studies.standings import ended_of, standings, structures_of


def assessed(arm: str, values, better: str = "larger", unit: str = "1", best=None) -> Assessed:
    labels = {"arm": arm, "index": "manipulability", "task": "pose"}
    plan = SimpleNamespace(index=SimpleNamespace(name="manipulability", better=better, unit=unit))
    return Assessed(
        labels, plan, Distribution.of(values, better), None if best is None else Distribution.of(best, better), None, None
    )


def driven(arm: str, share: float, law: str = "pseudoinverse") -> Driven:
    p = Interval.of(round(400 * share), 400)
    labels = {"arm": arm, "law": law, "task": "pose"}
    return Driven(labels, ("a", "b"), 200, np.zeros((3, 4)), (p, p, p), np.zeros(200), p, 1.0)


FAR = [assessed("near", np.r_[np.zeros(100), np.ones(900)]), assessed("far", np.r_[np.zeros(500), np.ones(500)])]


def test_the_arm_with_the_largest_share_is_first_and_clearly_ahead_if_intervals_say_so():
    (s,) = standings(FAR[::-1], [], {("manipulability", "pose"): 0.5})
    assert [(name, p.value) for name, p in s.ranked] == [("near", 0.9), ("far", 0.5)]
    assert s.level == ["near"]
    assert (s.question, s.about, s.law, s.unit) == ("manipulability ≥ 0.5", "1,000 poses", "", "")


def test_arms_whose_intervals_overlap_are_level_and_the_page_says_so():
    some = [driven("a", 0.5), driven("b", 0.52), driven("c", 0.1), driven("a", 0.8, "damped:0.1")]
    first, second = standings([], some, {})
    assert first.level == ["b", "a"]
    assert first.about == "200 motions × 2 joints"
    assert (second.law, second.level) == ("damped:0.1", ["a"])
    text = render(Page("t", _headline([first, second]), [Section("s", _standings([first, second]))]))
    assert "level with a" in text
    assert "a arrives most often, under damped:0.1" in text


def test_smaller_is_better_where_the_index_says_so_and_units_are_said():
    found = [
        assessed("even", np.full(300, 5.0), "smaller", "m/rad", best=np.full(300, 2.0)),
        assessed("uneven", np.full(300, 50.0), "smaller", "m/rad", best=np.full(300, 2.0)),
    ]
    plain, best = standings(found, [], {("manipulability", "pose"): 10.0})
    assert (plain.question, plain.unit, plain.ranked[0][0]) == ("manipulability ≤ 10", "m/rad", "even")
    assert plain.level == ["even"]
    assert best.question == "manipulability ≤ 10, best configuration"
    assert best.level == ["even", "uneven"]
    text = render(Page("t", _headline([plain, best]), [Section("s", _standings([plain, best]))]))
    assert "After any failure considered, even most often keeps a manipulability ≤ 10 m/rad: at 1.000" in text
    assert "clearly ahead" in text


def test_one_arm_alone_has_nobody_to_be_compared_with():
    assert _standings(standings(FAR[:1], [], {("manipulability", "pose"): 0.5})) == []


@pytest.mark.interpreted
def test_a_joint_whose_lock_ends_the_task_everywhere_is_named():
    def of(arm: str, index: str, failures: str = "single") -> Assessed:
        plan = SimpleNamespace(arm=arms.load(arm), index=by_name(index, arms.load(arm), "pose"))
        return Assessed({"arm": arm, "failures": failures}, plan, None, None, None, None)

    indices = ("relative-manipulability", "manipulability")
    found = [of(arm, index) for arm in ("panda", "iiwa14") for index in indices]
    (callout,) = _structure(found, structures_of(found))  # an iiwa's hand is as far from its shoulder as its elbow says
    assert "once lbr_iiwa_joint_4 (joint 4) locks, 'iiwa14' is singular for task 'pose'" in callout.text
    pairs = [of("iiwa14", "manipulability", "pairs")]
    assert _structure(pairs, structures_of(pairs)) == []
    ended = ended_of([*found, *pairs], structures_of([*found, *pairs]))
    assert [(a.labels["arm"], a.plan.index.slug) for a in ended] == [
        ("iiwa14", "relative-manipulability"),
        ("iiwa14", "manipulability"),
        ("iiwa14", "manipulability"),
    ]
    mean = [of("iiwa14", "mean-singular-value")]  # of a Jacobian that has lost rank it is not 0
    assert ended_of(mean, structures_of(mean)) == []


def test_an_arm_that_is_0_by_structure_is_level_with_none():
    """Of six poses: the intervals overlap, and yet no number of samples would bring the two together."""
    few = [assessed("ended", np.zeros(6)), assessed("some", np.r_[np.zeros(5), 1.0]), assessed("none", np.zeros(6))]
    asked = {("manipulability", "pose"): 0.5}
    assert standings(few, [], asked)[0].level == ["some", "ended", "none"]
    (s,) = standings(few, [], asked, few[:1])
    assert s.level == ["some", "none"]
    assert [name for name, _ in s.ranked] == ["some", "none", "ended"]  # of two zeros the one by structure is last
    text = render(Page("t", _headline([s]), [Section("s", _standings([s]))]))
    assert "level with none; 0 by structure: ended" in text
    (s,) = standings(few[:1] * 2, [], asked, few[:1])  # all of them: nobody is ahead
    assert len(s.level) == 2
    (s,) = standings(few, [], {("manipulability", "pose"): 0.0}, few[:1])  # at least 0 is kept by all
    assert s.level == ["ended", "some", "none"]
