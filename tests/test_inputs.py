"""A seeded part of the mutated inputs of :mod:`fuzz_inputs`, whose whole is in ``make soak``."""

from __future__ import annotations

import numpy as np
import pytest

import fuzz_inputs

CASES = 460  # 10 of each kind


def test_mutated_inputs_are_read_or_refused_with_a_sentence(request):
    found = fuzz_inputs.fuzz(CASES, request.config.getoption("--draw"))
    assert found.failed == []
    assert found.counts.total() == CASES
    assert len(set(found.counts.values())) == 1


def test_a_reader_that_fails_is_seen(tmp_path, monkeypatch):
    """The harness itself: a traceback, a hang, a write elsewhere and a message that is no sentence all count."""
    watch = fuzz_inputs.Watch(tmp_path / "in")
    (tmp_path / "in").mkdir()
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    monkeypatch.setattr(fuzz_inputs, "MOST_SECONDS", 0.2)

    def trips(_):
        return {}["a"]

    def hangs(_):
        while True:
            pass

    def writes(_):
        (tmp_path / "elsewhere").write_text("x")

    def leaves(_):
        (tmp_path / "work" / "log").write_text("x")

    def mumbles(_):
        raise fuzz_inputs.HoldfastError("wrong")

    for read, said in (
        (trips, "KeyError"),
        (hangs, "more than"),
        (writes, "elsewhere"),
        (leaves, "log"),
        (mumbles, "no sentence"),
    ):
        kind = fuzz_inputs.Kind([b"a: 1\n"], fuzz_inputs.of_yaml, read, tmp_path / "in" / "a.yaml")
        with fuzz_inputs.alarmed():
            assert said in fuzz_inputs.run(0, 1, {"one": kind}, watch)[0], read
    kind = fuzz_inputs.Kind([b"a: 1\n"], fuzz_inputs.of_yaml, len, tmp_path / "in" / "a.yaml")
    kind.read = lambda path: path.read_bytes()
    assert fuzz_inputs.run(0, 1, {"one": kind}, watch)[0] == ""


@pytest.mark.parametrize("structure", ["of_bytes", "of_tokens", "of_yaml", "of_json", "of_xml", "of_table"])
def test_mutations_change_what_they_are_given(structure, rng):
    data = {"of_json": b'{"a": [1, {"b": 2}], "c": "d"}', "of_xml": fuzz_inputs.URDF, "of_table": fuzz_inputs.POSES}
    given = data.get(structure, fuzz_inputs.DH)
    change = getattr(fuzz_inputs, structure)
    assert len({change(given, np.random.default_rng(k)) for k in rng.integers(2**32, size=50)} - {given}) > 25
