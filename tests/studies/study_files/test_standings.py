"""Which arm for what: who leads, and whether the samples say so."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from holdfast import arms
from holdfast.core.probability.distribution import Distribution
from holdfast.core.probability.intervals import Interval
from holdfast.interface.presentation.studies.answer import compose_answer
from holdfast.interface.presentation.studies.sections import build_ranking_blocks, build_structure_blocks
from holdfast.interface.presentation.studies.study import find_fatal_structures
from holdfast.interface.report.page import Page, Section, render
from holdfast.kinematics.indices import by_name
from holdfast.studies.study_files.ranking import rank_arms
from holdfast.studies.study_files.results import AssessedCell, DrivenCell


def assessed(arm: str, values, better: str = "larger", unit: str = "1", best=None) -> AssessedCell:
    labels = {"arm": arm, "index": "manipulability", "task": "pose"}
    plan = SimpleNamespace(index=SimpleNamespace(name="manipulability", better=better, unit=unit))
    return AssessedCell(
        labels,
        plan,
        Distribution.from_values(values, better),
        None if best is None else Distribution.from_values(best, better),
        None,
        None,
    )


def driven(arm: str, share: float, law: str = "pseudoinverse") -> DrivenCell:
    p = Interval.from_counts(round(400 * share), 400)
    labels = {"arm": arm, "law": law, "task": "pose"}
    return DrivenCell(labels, ("a", "b"), 200, np.zeros((3, 4)), (p, p, p), np.zeros(200), p, 1.0)


FAR = [assessed("near", np.r_[np.zeros(100), np.ones(900)]), assessed("far", np.r_[np.zeros(500), np.ones(500)])]


def test_the_arm_with_the_largest_share_is_first_and_clearly_ahead_if_intervals_say_so():
    (s,) = rank_arms(FAR[::-1], [], {("manipulability", "pose"): 0.5})
    assert [(name, p.value) for name, p in s.ranked_entries] == [("near", 0.9), ("far", 0.5)]
    assert s.tied_with_first == ["near"]
    assert (s.question, s.about, s.law, s.unit) == ("manipulability ≥ 0.5", "1,000 poses", "", "")


def test_arms_whose_intervals_overlap_are_level_and_the_page_says_so():
    some = [driven("a", 0.5), driven("b", 0.52), driven("c", 0.1), driven("a", 0.8, "damped:0.1")]
    first, second = rank_arms([], some, {})
    assert first.tied_with_first == ["b", "a"]
    assert first.about == "200 motions × 2 joints"
    assert (second.law, second.tied_with_first) == ("damped:0.1", ["a"])
    text = render(Page("t", compose_answer([first, second]), [Section("s", build_ranking_blocks([first, second]))])).replace(
        "\u00a0", " "
    )
    assert "overlaps with a" in text
    assert "a reaches its target most often, under damped:0.1" in text
    none = compose_answer(rank_arms([], [driven("a", 0.0), driven("b", 0.0)], {}))
    assert "hardly any motion reaches its target under any law: the largest fraction of 200 motions × 2 joints is 0.00" in none


def test_smaller_is_better_where_the_index_says_so_and_units_are_said():
    found = [
        assessed("even", np.full(300, 5.0), "smaller", "m/rad", best=np.full(300, 2.0)),
        assessed("uneven", np.full(300, 50.0), "smaller", "m/rad", best=np.full(300, 2.0)),
    ]
    plain, best = rank_arms(found, [], {("manipulability", "pose"): 10.0})
    assert (plain.question, plain.unit, plain.ranked_entries[0][0]) == ("manipulability ≤ 10", "m/rad", "even")
    assert plain.tied_with_first == ["even"]
    assert best.question == "manipulability ≤ 10, best configuration"
    assert best.tied_with_first == ["even", "uneven"]
    text = render(Page("t", compose_answer([plain, best]), [Section("s", build_ranking_blocks([plain, best]))])).replace(
        "\u00a0", " "
    )
    assert "After any failure considered, even most often keeps a manipulability ≤ 10 m/rad: at 1.000" in text
    assert "significant" in text


def test_nobody_is_ahead_of_an_arm_that_is_0_by_structure_unless_it_is_surely_above_0():
    for kept, sentence in ((0, "may be 0, too; never: 0 by structure"), (30, "significant; never: 0 by structure")):
        found = [assessed("some", np.r_[np.zeros(100 - kept), np.ones(kept)]), assessed("never", np.zeros(100))]
        (s,) = rank_arms(found, [], {("manipulability", "pose"): 0.5})
        assert sentence in render(
            Page("t", "h", [Section("s", build_ranking_blocks([replace(s, ended={"never": "joint 4"})]))])
        )


def test_one_arm_alone_has_nobody_to_be_compared_with():
    assert build_ranking_blocks(rank_arms(FAR[:1], [], {("manipulability", "pose"): 0.5})) == []


@pytest.mark.interpreted
def test_a_joint_whose_lock_ends_the_task_everywhere_is_named():
    def of(arm: str, index: str, failures: str = "single") -> AssessedCell:
        plan = SimpleNamespace(arm=arms.load(arm), index=by_name(index, arms.load(arm), "pose"))
        return AssessedCell({"arm": arm, "task": "pose", "failures": failures}, plan, None, None, None, None)

    indices = ("relative-manipulability", "manipulability")
    found = [of(arm, index) for arm in ("panda", "iiwa14") for index in indices]
    (callout,) = build_structure_blocks(
        find_fatal_structures(found)
    )  # an iiwa's hand is as far from its shoulder as its elbow says
    assert "once lbr_iiwa_joint_4 (joint 4) locks, 'iiwa14' is singular for task 'pose'" in callout.text
    assert find_fatal_structures([of("iiwa14", "manipulability", "pairs")]) == {}


def test_an_arm_that_is_0_by_structure_is_level_with_none_and_an_empty_headline_says_why():
    sparse = assessed("sparse", np.r_[np.full(60, 0.1), np.full(40, 0.2)], best=np.full(100, 0.3))
    sparse = replace(sparse, worst=("elbow", 0.72))
    nothing = assessed("nothing", np.zeros(100), best=np.zeros(100))
    asked, ended = {("manipulability", "pose"): 0.5}, {("nothing", "pose", "single"): "its elbow"}
    blind = rank_arms([nothing, sparse], [], asked)[0]
    assert blind.tied_with_first == ["nothing", "sparse"]  # what shares alone say of two arms that keep nothing
    plain, best = rank_arms([nothing, sparse], [], asked, ended)
    assert plain.tied_with_first == best.tied_with_first == ["sparse"]
    line = compose_answer([plain, best])
    assert "hardly any pose keeps a manipulability ≥ 0.5: at most 0.00" in line
    assert "not distinguishable" not in line
    assert "sparse has the best median, 0.100; in the best configurations 0.300. Its worst failure" in line
    assert "is most often a lock of elbow." in line
    assert "nothing is singular in every configuration once its elbow locks." in line
    assert "nothing: 0 by structure" in render(Page("t", line, [Section("s", build_ranking_blocks([plain, best]))]))


def test_an_index_that_is_not_0_at_a_singularity_is_not_0_by_structure():
    few = [assessed("ended", np.zeros(6)), assessed("some", np.r_[np.zeros(5), 1.0])]
    ended = {("ended", "pose", "single"): "its elbow"}
    assert rank_arms(few, [], {("manipulability", "pose"): 0.5}, ended)[0].ended == {"ended": "its elbow"}
    assert rank_arms(few, [], {("manipulability", "pose"): 0.0}, ended)[0].ended == {}  # at least 0 is kept everywhere
    mean = [replace(a, labels=a.labels | {"index": "mean-singular-value"}) for a in few]
    assert rank_arms(mean, [], {("mean-singular-value", "pose"): 0.5}, ended)[0].ended == {}
