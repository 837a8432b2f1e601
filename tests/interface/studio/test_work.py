"""What is newest is done; what is older gives way."""

from __future__ import annotations

import threading

import pytest

from holdfast.interface.studio.work import LatestRequests, LongJobWorker


@pytest.fixture
def complaints():
    return []


def test_of_requests_with_one_key_only_the_newest_is_done(complaints):
    live = LatestRequests(complaints.append)
    gate, started, seen = threading.Event(), threading.Event(), []

    def first():
        started.set()
        gate.wait(10)

    live.submit("gate", first)
    assert started.wait(10)
    for k in range(50):
        live.submit("hand", lambda k=k: seen.append(k))
        live.submit("joint", lambda k=k: seen.append(-k))
    gate.set()
    assert live.wait_until_done(10)
    assert seen == [49, -49]
    live.stop()


def test_an_error_is_told_and_the_thread_goes_on(complaints):
    live = LatestRequests(complaints.append)
    seen = []
    live.submit("wrong", lambda: 1 / 0)
    live.submit("right", lambda: seen.append(1))
    assert live.wait_until_done(10)
    assert seen == [1]
    assert [type(c) for c in complaints] == [ZeroDivisionError]
    live.stop()


def test_a_newer_computation_cancels_the_older(complaints):
    work = LongJobWorker(complaints.append)
    started, ends = threading.Event(), []

    def endless(check):
        started.set()
        try:
            while True:
                check()
                threading.Event().wait(0.001)
        finally:
            ends.append("older")

    work.submit(endless)
    assert started.wait(10)
    assert work.is_busy
    never = threading.Event()
    work.submit(lambda check: never.set())  # this one waits, and is overtaken while it does
    work.submit(lambda check: ends.append("newest"))
    assert work.wait_until_done(10)
    assert ends == ["older", "newest"]
    assert not never.is_set() or ends[-1] == "newest"
    assert complaints == []
    assert not work.is_busy
    work.stop()


def test_errors_of_what_was_cancelled_are_of_no_interest(complaints):
    work = LongJobWorker(complaints.append)
    started, gate = threading.Event(), threading.Event()

    def fails(check):
        started.set()
        gate.wait(10)
        raise ValueError("late")

    work.submit(fails)
    assert started.wait(10)
    work.cancel()
    gate.set()
    assert work.wait_until_done(10)
    assert complaints == []
    work.submit(lambda check: 1 / 0)
    assert work.wait_until_done(10)
    assert [type(c) for c in complaints] == [ZeroDivisionError]
    work.stop()
