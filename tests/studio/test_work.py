"""What is newest is done; what is older gives way."""

from __future__ import annotations

import threading

import pytest

from holdfast.studio.work import Latest, Worker


@pytest.fixture
def complaints():
    return []


def test_of_requests_with_one_key_only_the_newest_is_done(complaints):
    live = Latest(complaints.append)
    gate, started, seen = threading.Event(), threading.Event(), []

    def first():
        started.set()
        gate.wait(10)

    live.put("gate", first)
    assert started.wait(10)
    for k in range(50):
        live.put("hand", lambda k=k: seen.append(k))
        live.put("joint", lambda k=k: seen.append(-k))
    gate.set()
    assert live.settle(10)
    assert seen == [49, -49]
    live.stop()


def test_an_error_is_told_and_the_thread_goes_on(complaints):
    live = Latest(complaints.append)
    seen = []
    live.put("wrong", lambda: 1 / 0)
    live.put("right", lambda: seen.append(1))
    assert live.settle(10)
    assert seen == [1]
    assert [type(c) for c in complaints] == [ZeroDivisionError]
    live.stop()


def test_a_newer_computation_cancels_the_older(complaints):
    work = Worker(complaints.append)
    started, ends = threading.Event(), []

    def endless(check):
        started.set()
        try:
            while True:
                check()
                threading.Event().wait(0.001)
        finally:
            ends.append("older")

    work.ask(endless)
    assert started.wait(10)
    assert work.busy
    never = threading.Event()
    work.ask(lambda check: never.set())  # this one waits, and is overtaken while it does
    work.ask(lambda check: ends.append("newest"))
    assert work.settle(10)
    assert ends == ["older", "newest"]
    assert not never.is_set() or ends[-1] == "newest"
    assert complaints == []
    assert not work.busy
    work.stop()


def test_errors_of_what_was_cancelled_are_of_no_interest(complaints):
    work = Worker(complaints.append)
    started, gate = threading.Event(), threading.Event()

    def fails(check):
        started.set()
        gate.wait(10)
        raise ValueError("late")

    work.ask(fails)
    assert started.wait(10)
    work.cancel()
    gate.set()
    assert work.settle(10)
    assert complaints == []
    work.ask(lambda check: 1 / 0)
    assert work.settle(10)
    assert [type(c) for c in complaints] == [ZeroDivisionError]
    work.stop()
