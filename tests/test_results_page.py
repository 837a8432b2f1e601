"""The page *Results and their words* lists every member of every outcome."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from holdfast.control.equilibria.stability import Kind
from holdfast.control.simulation.runs import Reason, RunOutcome
from holdfast.core.status import Status
from holdfast.kinematics.interval_search.search import SearchOutcome
from holdfast.response.faults.feasibility import Answer as FeasibilityAnswer
from holdfast.response.lock_survival.problem import Kind as SurvivalKind
from holdfast.response.recovery.recovery import Answer, ProofKind, RecoveryOutcome
from holdfast.response.supervisor.run import FaultRunOutcome

PAGE = (Path(__file__).parents[1] / "docs/reference/results.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("outcomes", [RunOutcome, Reason, Kind, RecoveryOutcome, SearchOutcome, Status])
def test_every_member_has_a_row(outcomes):
    assert [member.name for member in outcomes if f"\n| `{member.name.lower()}` |" not in PAGE] == []


@pytest.mark.parametrize("words", [FeasibilityAnswer, Answer, ProofKind, FaultRunOutcome])
def test_every_word_has_a_row(words):
    assert [word for word in get_args(words) if f"\n| `{word}` |" not in PAGE] == []


def test_every_kind_of_a_survival_value_is_explained():
    assert all(f"*{kind}*" in PAGE for kind in get_args(SurvivalKind))
