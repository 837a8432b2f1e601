"""Orders and protocols, against their defining properties."""

import itertools
from collections import Counter

import numpy as np
import pytest

import holdfast as hf
from holdfast.teleop.protocol import protocol
from holdfast.teleop.protocol.order import choose_next_row, shuffle_scenarios, williams_square
from holdfast.teleop.protocol.protocol import Training, read_protocol, training_limit


@pytest.mark.parametrize("n", [*range(1, 12), *range(12, 50, 2), 23, 47])
def test_williams_square_is_balanced(n):
    square = williams_square(n)
    rows = n if n % 2 == 0 or n == 1 else 2 * n
    assert square.shape == (rows, n)
    for row in square:
        assert sorted(row) == list(range(n))
    for column in square.T:
        assert set(Counter(column.tolist()).values()) == {rows // n}
    pairs = Counter((int(a), int(b)) for row in square for a, b in itertools.pairwise(row))
    assert len(pairs) == n * (n - 1)
    assert set(pairs.values()) <= {rows // n}


def test_first_row_of_24_is_the_printed_one():
    printed = "0 1 23 2 22 3 21 4 20 5 19 6 18 7 17 8 16 9 15 10 14 11 13 12"
    assert " ".join(map(str, williams_square(24)[0])) == printed


def test_rows_go_to_those_who_finish(rng):
    """However many drop out, rows of finished sessions never differ by more than one when everybody is done."""
    completed, open_ = [], []
    for _ in range(300):
        if open_ and rng.random() < 0.5:
            row = open_.pop(int(rng.integers(len(open_))))
            if rng.random() < 0.6:
                completed.append(row)
        else:
            open_.append(choose_next_row(completed, open_, 6))
    while len(completed) % 6:
        completed.append(choose_next_row(completed, [], 6))
    counts = np.bincount(completed, minlength=6)
    while counts.max() > counts.min():  # those who were ahead when others dropped out
        completed.append(choose_next_row(completed, [], 6))
        assert completed[-1] in np.flatnonzero(counts == counts.min())
        counts = np.bincount(completed, minlength=6)


def test_scenario_orders_are_permutations_and_reproducible():
    orders = shuffle_scenarios(500, 4, seed=1, subject=7)
    assert (np.sort(orders, axis=1) == np.arange(4)).all()
    np.testing.assert_array_equal(orders, shuffle_scenarios(500, 4, 1, subject=7))
    assert (orders != shuffle_scenarios(500, 4, 1, subject=8)).any()
    share = np.stack([(orders == k).mean(axis=0) for k in range(4)])
    assert np.abs(share - 0.25).max() < 0.1


def test_training_needs_both_conditions():
    t = Training(at_least=10, in_a_row=5, limit=50)
    assert not t.is_met_by([40] * 9)
    assert t.is_met_by([40] * 10)
    assert t.is_met_by([60] * 5 + [50] * 5)
    assert not t.is_met_by([40] * 9 + [51])
    assert not t.is_met_by([np.nan] + [40] * 9)
    assert not t.is_met_by([40] * 10 + [np.nan] + [40] * 4)


def test_training_limit_is_taken_from_the_best(rng):
    times = rng.uniform(40, 90, (3, 20))
    times[0, 3] = np.nan
    assert training_limit(times) == pytest.approx(1.2 * np.mean([np.nanmin(t) for t in times]))
    with pytest.raises(hf.InputError, match="never completed"):
        training_limit([[np.nan, np.nan], [40, 41]])


@pytest.mark.parametrize("name", protocol.BUILTIN_PROTOCOLS)
def test_shipped_protocols(name):
    p = read_protocol(name)
    assert len(p.tasks) == 24
    assert p.rate * p.stick.limit == pytest.approx(0.3)
    assert p.plants[0].substeps * (p.rate / 6) == pytest.approx(10)
    start = p.plants[0].position(p.tasks.q0)
    np.testing.assert_allclose(np.linalg.norm(p.tasks.target - start, axis=1), 2.0)
    sessions = [p.session_order(k, k) for k in range(24)]
    counts = Counter((int(t), int(s)) for session in sessions for t, s in session)
    assert len(counts) == 96
    assert set(counts.values()) == {24}


def test_protocol_reads_what_it_writes(tmp_path):
    p = read_protocol()
    again = read_protocol(p.write(tmp_path / "p.yaml"))
    assert again.to_yaml() == p.to_yaml()
    np.testing.assert_array_equal(again.tasks.q0, p.tasks.q0)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rate: 6.0", "rat: 6.0", "the key 'rat' is not known"),
        ("rate: 6.0", "rate: 0", "rate: 0 is wrong"),
        ("law: failure-tolerant", "law: magic", "control law 'magic' is not known"),
        ("pre_failure_error: 0.5", "e_pre: 0.5", "no option 'e_pre'"),
        ("arm: planar-3r", "arm: planar-9z", "planar-9z"),
        ("joint: joint3", "joint: elbow", "elbow"),
        ("target: [1.5, 1.5]", "target: [1.5, 1.5, 0]", "target: it has 3 numbers"),
        ("dead_zone: 0.005", "dead_zone: 0.5", "dead zone"),
        ("moderate, difficult,", "easy, difficult,", "two of its steps"),
        ("- {law: pseudoinverse, failed: true}", "- {law: pseudoinverse, failed: false}", "two of them are equal"),
    ],
)
def test_bad_protocols_get_one_sentence(tmp_path, old, new, message):
    text = read_protocol().to_yaml()
    assert old in text
    (tmp_path / "p.yaml").write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(hf.InputError, match=message) as error:
        read_protocol(tmp_path / "p.yaml")
    assert "\n" not in str(error.value)
