"""The one table of statuses."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast import Status
from holdfast.control.simulation import Reason, RunOutcome
from holdfast.core.errors import HoldfastError
from holdfast.core.status import require_ok
from holdfast.response.recovery import RecoveryOutcome
from holdfast.teleop.trials import End

CODES = {
    "OK": 0,
    "NOT_FOUND": 1,
    "BAD_INPUT": 2,
    "SINGULAR": 3,
    "INFEASIBLE": 4,
    "NO_INERTIA": 5,
    "UNDEFINED": 6,
    "SLOWED": 7,
    "DEGENERATE": 8,
    "NOT_DEFINED": 9,
    "INACCURATE": 10,
    "NOT_COMPUTED": 255,
}


def test_codes_do_not_change():
    """They are in results folders; every one fits a byte."""
    assert {s.name: int(s) for s in Status} == CODES
    assert all(np.array(s, dtype=np.uint8) == s for s in Status)


@pytest.mark.parametrize("status", Status)
def test_every_status_has_a_sentence_of_advice(status):
    assert Status(int(status)).sentence
    assert "\n" not in status.sentence
    if status is not Status.OK:
        assert ":" in status.sentence  # what it is: what to try


@pytest.mark.parametrize("kind", [RunOutcome, Reason, RecoveryOutcome, End])
def test_the_numbers_of_motions_do_not_change(kind):
    """Those of outcomes, reasons and ends are in studies and records; each says in a sentence of its own what it means."""
    names = {
        RunOutcome: "CONVERGED STUCK MOVING UNDECIDED",
        Reason: "NONE SINGULAR TIME_LIMIT STEPS BAD_INPUT HALF_TURN CONTACT",
        RecoveryOutcome: "GOAL_REACHED GOAL_REACHED_WITH_RELAXED_ROWS PATH_UNFINISHED NO_ROUTE_FOUND NOTHING_FOUND "
        "PROVED_UNREACHABLE START_OUTSIDE_LIMITS START_TOO_CLOSE LOCK_MISMATCH START_VIOLATES_CONSTRAINTS PROVED_DISCONNECTED",
        End: "ARRIVED STILL TIME ABORTED BROKEN_OFF",
    }
    assert [k.name for k in sorted(kind)] == names[kind].split()
    assert [int(k) for k in sorted(kind)] == list(range(len(kind)))
    assert len({k.sentence for k in kind}) == len(kind)


def test_no_two_statuses_give_the_same_advice():
    assert len({s.sentence for s in Status}) == len(Status)


def test_require_ok_names_the_first_row_and_counts():
    require_ok(np.zeros(5, np.uint8), "solve")
    require_ok(np.zeros(0, np.uint8), "solve")
    require_ok(np.uint8(0), "solve")
    with pytest.raises(HoldfastError, match=r"^solve: 2 of 4 rows failed; first: row 1, singular: .*move off") as caught:
        require_ok(np.array([0, 3, 0, 1], np.uint8), "solve")
    assert "\n" not in str(caught.value)
    with pytest.raises(HoldfastError, match="1 of 1 rows failed; first: row 0, not_found"):
        require_ok(np.uint8(1), "solve")
