"""Sets of joints that fail together."""

from __future__ import annotations

from itertools import combinations
from math import comb

import numpy as np
import pytest

import oracles
from holdfast.core.errors import InputError, TaskError
from holdfast.model.failure_modes import failure_names, failure_sets, locks_at, read_locks
from holdfast.model.failure_modes.sets import require_redundant


def test_single_is_every_joint_once(mixed8):
    assert failure_sets(mixed8) == failure_sets(mixed8, "single") == failure_sets(mixed8, 1) == tuple((k,) for k in range(8))


@pytest.mark.parametrize("k", [1, 2, 3, 7])
def test_every_k_joints(k, mixed8):
    sets = failure_sets(mixed8, k)
    assert len(sets) == comb(8, k)
    assert set(sets) == set(combinations(range(8), k))
    if k == 2:
        assert failure_sets(mixed8, "pairs") == sets


def test_given_sets_keep_their_order_and_are_sorted_inside(mixed8):
    sets = failure_sets(mixed8, ["j3", 0, ("j5", 2), [7], (4, "j1", 6)])
    assert sets == ((3,), (0,), (2, 5), (7,), (1, 4, 6))
    assert failure_names(mixed8, sets) == ["j3", "j0", "j2+j5", "j7", "j1+j4+j6"]


@pytest.mark.parametrize(
    ("failures", "error", "message"),
    [
        ("triples", TaskError, "failures 'triples' is not known; use 'single', 'pairs', a number of joints, or a list of sets"),
        (0, TaskError, "0 of the 8 joints of 'random-RPRRRPRR' cannot fail together; use 1 to 7"),
        (8, TaskError, "8 of the 8 joints"),
        (-1, TaskError, "use 1 to 7"),
        ([], TaskError, "each failure must name at least one joint"),
        ([()], TaskError, "each failure must name at least one joint"),
        ([(1, 1)], TaskError, "each of its joints once"),
        ([("j1", 1)], TaskError, "each of its joints once"),
        ([1, 2, "j1"], TaskError, "listed twice"),
        ([(1, 2), (2, 1)], TaskError, "listed twice"),
        ([8], InputError, "joint index 8 is out of range; 'random-RPRRRPRR' has joints 0 to 7"),
        ([-1], InputError, "joint index -1 is out of range"),
        (["elbow"], InputError, "has no joint 'elbow'; its joints are j0, j1, j2"),
    ],
)
def test_errors_say_what_would_be_right(failures, error, message, mixed8):
    with pytest.raises(error, match=message):
        failure_sets(mixed8, failures)


def test_too_many_sets(rng):
    arm = oracles.random_arm(rng, n=18)
    assert len(failure_sets(arm, 3)) == comb(18, 3)
    with pytest.raises(TaskError, match=f"{comb(18, 6)} failure sets are too many for one kernel; give 5000 or fewer"):
        failure_sets(arm, 6)


def test_redundancy(mixed8):
    single, pairs = failure_sets(mixed8), failure_sets(mixed8, "pairs")
    require_redundant(mixed8, 6, "pose", pairs)
    require_redundant(mixed8, 7, "seven", single)
    with pytest.raises(TaskError, match="'random-RPRRRPRR' is not redundant for task 'eight': 8 joints for 8 rows"):
        require_redundant(mixed8, 8, "eight", single)
    with pytest.raises(TaskError, match="locking 2 of the 8 joints of 'random-RPRRRPRR' leaves 6 for the 7 rows"):
        require_redundant(mixed8, 7, "seven", pairs)
    with pytest.raises(TaskError, match="lock at most 2 joints together"):
        require_redundant(mixed8, 6, "pose", (*single, (0, 1, 2)))


def test_a_lock_is_read_alike_however_it_is_given(mixed8):
    at = np.arange(8.0)
    for given in (["j2", 0], ("j2", "j0"), {"j2": None, 0: None}, [np.int64(2), 0]):
        assert read_locks(mixed8, given) == {2: None, 0: None}
        assert list(locks_at(mixed8, given, at).items()) == [(0, 0.0), (2, 2.0)]
    assert read_locks(mixed8, "j2") == read_locks(mixed8, 2) == read_locks(mixed8, np.int64(2)) == {2: None}
    assert read_locks(mixed8, {"j2": 1, 0: np.float64(0.5), "j1": None}) == {2: 1.0, 0: 0.5, 1: None}
    assert locks_at(mixed8, {"j2": 1, "j1": None}, at) == {1: 1.0, 2: 1.0}
    assert read_locks(mixed8, ()) == {}


@pytest.mark.parametrize(
    ("locked", "message"),
    [
        ("elbow", "no joint 'elbow'"),
        ([8], "joint index 8 is out of range"),
        (["j1", 1], "joint 'j1' is locked twice; give each joint once"),
        ({"j0": np.nan}, "joint 'j0' is locked at nan; give a finite number, rad"),
        ({"j1": "far"}, "the lock of 'j1' is not numbers; it must be a number, m"),
    ],
)
def test_a_lock_that_cannot_be_is_one_sentence(locked, message, mixed8):
    with pytest.raises(InputError, match=message):
        read_locks(mixed8, locked)
