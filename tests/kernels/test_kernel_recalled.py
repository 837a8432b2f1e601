"""Kernels found by what they are made of: only where nothing else can have changed."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.caching import cached_property
from holdfast.kernels import Kernel, Loop, cached_json, cached_kernel, input_digest
from holdfast.kernels.input_digest import fingerprint
from holdfast.kinematics.indices import CustomIndex

BUILT: list[str] = []


def ours(function):
    """As if it stood in holdfast, whose sources are part of every digest."""
    function.__module__ = "holdfast.made_in_a_test"
    return function


@cached_kernel
@ours
def line(slope, offset=0.0):
    BUILT.append("line")
    x = ca.SX.sym("x", 2)
    return Kernel("line", [x], [slope * x + offset, x[0] * x[1]])


@cached_kernel
@ours
def root(times):
    BUILT.append("root")
    y, p = ca.SX.sym("y"), ca.SX.sym("p")
    return Loop("root", y, [p], next_state=(y + p / y) / 2, residual=ca.fabs(y * y - p), times=times)


@cached_json
@ours
def texts(arm, name="hand"):
    BUILT.append("texts")
    return {f"{name}.txt": f"\u00e4 {arm.name}\n", "numbers": repr(arm.tool.tolist())}


@pytest.fixture(autouse=True)
def fresh(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    BUILT.clear()


def test_the_second_call_builds_nothing_and_gives_the_same_bits(rng):
    x = rng.normal(size=(40, 2))
    first, again = line(3.0), line(3.0)
    assert BUILT == ["line"]
    for a, b in zip(first(x), again(x), strict=True):
        np.testing.assert_array_equal(a, b)
    assert repr(again) == repr(first)
    assert BUILT == ["line"]
    # Who asks for its operations has it built, and finds the same.
    assert again.program.instructions == first.program.instructions
    assert BUILT == ["line", "line"]


def test_threads_that_need_the_same_kernel_at_once_build_it_once():
    together = threading.Barrier(8)

    def need(_):
        together.wait()
        return line(3.0)

    with ThreadPoolExecutor(8) as threads:
        made = list(threads.map(need, range(8)))
    assert BUILT == ["line"]
    assert {repr(kernel) for kernel in made} == {repr(made[0])}


def test_a_kept_property_is_the_same_thing_for_threads_that_ask_at_once():
    together = threading.Barrier(8)

    class Holder:
        @cached_property
        def thing(self):
            together.wait()  # all of them compute it
            return object()

    holder = Holder()
    with ThreadPoolExecutor(8) as threads:
        found = list(threads.map(lambda _: holder.thing, range(8)))
    assert len({id(thing) for thing in found}) == 1
    assert holder.thing is found[0]


def test_another_argument_is_another_kernel(rng):
    x = rng.normal(size=2)
    line(3.0)
    np.testing.assert_allclose(line(np.nextafter(3.0, 4.0))(x)[0], 3 * x)
    np.testing.assert_allclose(line(3.0, offset=1.0)(x)[0], 3 * x + 1)
    assert BUILT == ["line"] * 3


def test_loops_keep_what_the_caller_put_there():
    root(7)
    again = root(7)
    assert BUILT == ["root"]
    assert again.times == 7
    found = again.run(np.ones((5, 1)), np.full((5, 1), 2.0), 1e-12, 50)
    np.testing.assert_allclose(found.state[:, 0], np.sqrt(2), rtol=1e-15)


def test_the_machine_of_casadi_always_builds(monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    line(3.0)
    line(3.0)
    assert BUILT == ["line", "line"]


def test_a_function_of_somebody_else_is_always_called():
    @cached_kernel
    def foreign():
        BUILT.append("foreign")
        x = ca.SX.sym("x")
        return Kernel("foreign", [x], [x])

    foreign()
    foreign()
    assert BUILT == ["foreign", "foreign"]


def test_changed_sources_are_another_recipe(monkeypatch):
    line(3.0)
    monkeypatch.setattr(input_digest, "_sources_digest", lambda: "other")
    line(3.0)
    assert BUILT == ["line", "line"]


def test_equal_things_have_equal_digests_and_others_others(rng):
    arm, other = (oracles.random_arm(np.random.default_rng(3), types="RRRR", limits=limits) for limits in (2.0, 2.1))
    same = oracles.random_arm(np.random.default_rng(3), types="RRRR", limits=2.0)
    assert fingerprint(arm) == fingerprint(same) != fingerprint(other)
    a, b = (hf.indices.relative_manipulability(x, "position") for x in (arm, same))
    a(rng.uniform(-1, 1, (3, 4)))  # what an object keeps at hand does not count
    assert fingerprint(a) == fingerprint(b) != fingerprint(hf.indices.manipulability(same, "position"))
    assert fingerprint(1.0) != fingerprint(1)
    assert fingerprint((1, (2,))) != fingerprint((1, 2))
    assert fingerprint("ab", "c") != fingerprint("a", "bc")
    assert fingerprint(np.zeros(4)) != fingerprint(np.zeros((2, 2)))
    assert fingerprint(0.0) != fingerprint(-0.0)
    some, turned = set(range(0, 24, 8)), set(range(16, -8, -8))
    assert list(some) != list(turned)
    assert fingerprint(some) == fingerprint(turned) != fingerprint(frozenset(some))
    assert fingerprint({("a", "b"), ("c", "d")}) != fingerprint({("a", "c"), ("b", "d")})


@dataclass(frozen=True)
class Mine:
    value: float


def test_another_thread_may_keep_something_in_the_middle_of_a_digest(monkeypatch):
    """The attributes of an arm grow when something that it caches is first asked for."""
    arm = hf.arms.load("planar-3r")
    index = hf.indices.manipulability(arm, "planar")
    expected, look = fingerprint(index), input_digest.getattr_static

    def looked(*args):
        vars(index)[f"_kept_{len(vars(index))}"] = 1  # as another thread would, between two steps of the loop
        return look(*args)

    monkeypatch.setattr(input_digest, "getattr_static", looked)
    assert fingerprint(index) == expected


def test_what_is_somebody_elses_has_no_digest(mixed5):
    """Its code may change where nobody looks."""
    holds_itself: list[object] = []
    holds_itself.append(holds_itself)
    for thing in (
        Mine(1.0),
        lambda x: x,
        CustomIndex(ca.sumsqr, mixed5, "position"),
        ca.SX.sym("x"),
        {Mine(1.0)},
        holds_itself,
    ):
        assert fingerprint(thing) is None


@pytest.mark.parametrize("backend", ["llvm", "casadi"])
def test_texts_are_made_once(backend, flat4, mixed5, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", backend)
    first = texts(flat4)
    assert texts(flat4) == first == texts.__wrapped__(flat4)
    assert BUILT == ["texts"] * 2
    assert list(texts(flat4)) == list(first)
    assert texts(mixed5) != first
    assert texts(flat4, "name") != first
    assert BUILT == ["texts"] * 4
    monkeypatch.setattr(input_digest, "_sources_digest", lambda: "other")
    assert texts(flat4) == first
    assert BUILT == ["texts"] * 5


def test_damaged_texts_are_made_again(flat4, tmp_path, rng):
    first = texts(flat4)
    (file,) = (tmp_path / "kernels").iterdir()
    whole = file.read_bytes()
    at = int(rng.integers(len(whole)))
    for damaged in (b"", whole[:at], whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :]):
        file.write_bytes(damaged)
        BUILT.clear()
        assert texts(flat4) == first
        assert BUILT == ["texts"]
        assert file.read_bytes() == whole


def test_without_a_cache_texts_are_always_made(flat4, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", "off")
    assert texts(flat4) == texts(flat4)
    assert BUILT == ["texts"] * 2
