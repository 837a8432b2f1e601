"""Theorem R4: all classes of arrangements, and certificates that ball arithmetic accepts or refuses."""

from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
import pytest
from measurements.upper_bounds import minor_programmes, pseudolines
from measurements.upper_bounds.minor_programmes import bounds_by_arrangement
from measurements.upper_bounds.proofs import certificates_of, main, replay

import holdfast as hf


def chirotope(lines):
    """Signs of the minors of real lines (n, 3)."""
    return np.sign([np.linalg.det(lines[list(t)]) for t in combinations(range(len(lines)), 3)]).astype(np.int8)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7])
def test_there_are_as_many_classes_as_the_literature_counts(n):
    found = pseudolines.arrangement_classes(n)
    assert len(found) == pseudolines.CLASS_COUNTS[n]
    assert pseudolines.is_oriented_matroid(n, found).all()


def test_a_class_has_one_number_whatever_the_labels_and_the_turns(rng):
    lines = rng.normal(size=(6, 3))
    alike = [chirotope(lines[list(p)] * rng.choice([-1, 1], size=(6, 1))) for p in list(permutations(range(6)))[::60]]
    assert len(np.unique(pseudolines._class_codes(6, np.array(alike)))) == 1
    many = np.array([chirotope(rng.normal(size=(6, 3))) for _ in range(300)])
    assert pseudolines.is_oriented_matroid(6, many).all()
    known = pseudolines._class_codes(6, pseudolines.arrangement_classes(6))
    assert set(pseudolines._class_codes(6, many)) == set(known)  # random lines are of all four classes, and of no other


@pytest.mark.parametrize(("n", "best"), [(6, 0.16625077511098137), (7, 0.0867754190429908)])
def test_certificates_prove_the_ceiling(n, best):
    bounds = bounds_by_arrangement(n)
    assert len(bounds) == pseudolines.CLASS_COUNTS[n]
    assert best <= max(bounds) <= best * (1 + 1e-9)
    assert hf.index_bounds.upper_bound(n=n, m=n - 3, k=3).bound >= best
    for certificate in certificates_of(n, n - 3, 3):
        proved, stored = replay(certificate)
        assert best * (1 - 1e-9) <= proved <= stored
    assert hf.index_bounds.upper_bound(n=n, m=n - 3, k=3).verify().is_attained


def test_each_class_bounds_the_lines_of_its_own(rng):
    """Random lines of a class never have a least minor above what its certificate proves."""
    bound = dict(
        zip(
            pseudolines._class_codes(6, pseudolines.arrangement_classes(6)).tolist(),
            bounds_by_arrangement(6),
            strict=True,
        )
    )
    for _ in range(300):
        lines = np.linalg.qr(rng.normal(size=(6, 3)))[0]
        (name,) = pseudolines._class_codes(6, chirotope(lines)[None]).tolist()
        assert min(abs(np.linalg.det(lines[list(t)])) for t in combinations(range(6), 3)) < bound[name]


def test_a_worse_dual_point_still_proves_a_bound_and_a_wrong_one_none(rng):
    one = minor_programmes.find_certificate(6, pseudolines.arrangement_classes(6)[0])
    assert one.proved_bound() == pytest.approx(one.approximate_bound(), rel=1e-9)
    assert one.proved_bound() >= one.approximate_bound() * (1 - 1e-12)
    less = replace(one, relation=0.9 * one.relation)
    assert one.proved_bound() < less.proved_bound() < 1
    with pytest.raises(ValueError, match="do not hold"):
        replace(one, relation=2 * one.relation).proved_bound()
    with pytest.raises(ValueError, match="negative"):
        replace(one, relation=-one.relation).proved_bound()
    wrong = one.signs.copy()
    wrong[[0, 5, 7]] *= -1
    assert not pseudolines.is_oriented_matroid(6, wrong[None])[0]
    with pytest.raises(ValueError, match="no oriented matroid"):
        replace(one, signs=wrong, relation=np.full_like(one.relation, 1e-3)).proved_bound()
    with pytest.raises(ValueError, match="no oriented matroid"):
        minor_programmes.find_certificate(6, wrong)


def test_the_certificates_of_a_size_are_replayed_by_the_command(capsys):
    main(["7,4,3", "8,2,2"])
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("R4, 7 joints, 4 rows: proves 0.0867754190")
    assert second.startswith("R3, 8 joints, 2 rows: proves 0.718914")
    main(["9,6,2"])
    assert capsys.readouterr().out == "these bounds rest on theorems alone\n"
