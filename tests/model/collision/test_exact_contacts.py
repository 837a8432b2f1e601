"""When the bodies themselves first touch, where the bound says that they may: against MuJoCo at many instants."""

from __future__ import annotations

import numpy as np
import pytest
from tests.model.collision import geometry

import holdfast as hf
import oracles
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.model.collision.contacts import Contact, find_first_contacts
from holdfast.model.collision.exact import engines


@pytest.fixture(scope="module")
def panda():
    cell = geometry.of_primitives()
    return hf.Clearance(hf.arms.load("panda"), cell=cell, itself=False), geometry.InMujoco(cell)


def test_the_first_exact_contact_is_the_one_that_mujoco_sees(panda, rng):
    clearance, mujoco = panda
    q = oracles.inside(clearance.arm, rng, 4000)
    room, clear, count, kinds = clearance.margin_left(q), clearance.sign(q), 1000, [0, 0]
    for end in np.concatenate([q[(room < 0) & clear][:5], q[~clear][:5]]):
        beside = end + rng.uniform(-0.2, 0.2, (100, 7))
        beside = beside[clearance.margin_left(beside) > 0.005]
        if not len(beside):
            continue
        ends = np.stack([beside[0], end])
        time = np.array([0.0, 1.0])
        contacts = find_first_contacts(clearance, time, ends)
        instants = np.linspace(0, 1, count + 1)
        seen = mujoco.touches(ends[0] + instants[:, None] * (ends[1] - ends[0]))
        exact = min((c.exact_time for c in contacts), default=np.inf)
        assert all(c.exact_time >= c.time for c in contacts)
        if not seen.any():
            # A brush of less than a quarter of a millimetre between two instants may be seen by either.
            kinds[0] += bool(contacts)
            assert np.isinf(exact)
            continue
        kinds[1] += 1
        assert exact == pytest.approx(instants[seen.argmax()] - 0.5 / count, abs=0.6 / count)
    assert min(kinds) > 0


def test_of_two_links_the_bodies_are_asked(rng):
    """The fingers come to the forearm: coal, asked of all bodies at once, agrees."""
    arm = hf.arms.load("panda")
    clearance = hf.Clearance(arm)
    q = oracles.inside(arm, rng, 1000)
    folded = q[~clearance.sign(q)][:4]
    assert len(folded)
    for end in folded:
        ends = np.stack([arm.states["home"], end])
        contacts = find_first_contacts(clearance, np.array([0.0, 1.0]), ends)
        exact = min(c.exact_time for c in contacts)
        assert 0 < exact <= 1
        sides = ends[0] + (exact + np.array([-1e-4, 1e-6]))[:, None] * (ends[1] - ends[0])
        assert clearance.sign(sides[:1])[0]
        assert not clearance.sign(sides[1:])[0]


def test_without_a_library_nothing_is_said_of_it(panda, monkeypatch):
    clearance, _ = panda
    monkeypatch.setattr(engines, "find_spec", lambda name: None)
    ends = np.stack([clearance.arm.states["home"], clearance.arm.states["home"] + [0, 1.5, 0, 0, 0, 0, 0]])
    contacts = find_first_contacts(clearance, np.array([0.0, 1.0]), ends)
    assert contacts
    assert all(c.exact_time is None for c in contacts)
    assert contacts[0].confirmation() == ""
    assert "exact time, s" not in tabulate_contacts(contacts).texts().head


def test_words():
    told = [Contact(time=1.0, link="a", object="b", depth=0.01, exact_time=exact) for exact in (None, 1.0, 1.25, float("inf"))]
    assert [c.sentence() for c in told] == [
        "at 1 s a touches b",
        "at 1 s a touches b, by exact distances",
        "at 1 s a touches b, by the lower bound; by exact distances at 1.25 s",
        "at 1 s a touches b, by the lower bound; by exact distances there is no contact",
    ]
    assert told[2].sentence("cycles") == "in cycle 2 a touches b, by exact distances"
    entries = list_contacts(told)
    assert [e.get("exact") for e in entries] == [None, True, True, False]
    assert [e.get("exact_time_s") for e in entries] == [None, 1.0, 1.25, None]
    assert [row[3] for row in tabulate_contacts(told).texts().rows] == ["", "1", "1.25", "does not touch"]
