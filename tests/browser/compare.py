"""What stands in the records against what was said, number by number."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.teleop.records.check import replay_trials
from holdfast.teleop.records.entries import TrialRecord
from holdfast.teleop.records.records import Records

ENDS = {"arrived": "ARRIVED", "aborted": "ABORTED", "time": "TIME", "broken-off": "BROKEN_OFF"}


@dataclass
class Done:
    """A trial as the page told of it."""

    kind: str
    position: int
    time: list[float] = field(default_factory=list)
    velocity: list[list[float]] = field(default_factory=list)
    q: list[list[float]] = field(default_factory=list)
    end: str | None = None
    rating: int | None = None


def trials(said: dict[int, dict[str, Any]]) -> list[Done]:
    """The trials of a session, from its messages; none of these is missing."""
    assert sorted(said) == list(range(1, len(said) + 1))
    done: list[Done] = []
    for _, message in sorted(said.items()):
        match message["type"]:
            case "begin":
                done.append(Done(message["kind"], message["position"]))
            case "cycles":
                assert message["first"] == len(done[-1].q)
                for name in ("time", "velocity", "q"):
                    getattr(done[-1], name).extend(message[name])
            case "end":
                done[-1].end = message["end"]
                done[-1].q.append(message["q"])
            case "rate":
                done[-1].rating = message["rating"]
    return done


def compare(folder: Path, code: str, said: dict[int, dict[str, Any]]) -> tuple[list[Done], list[TrialRecord]]:
    """Every trial, every cycle, every answer and event of a session is on record once, as it was; and all trials replay."""
    done = trials(said)
    with Records.open(folder) as records:
        assert records.last_seq(code) == len(said)
        entries = records.entries(code)
        assert [(e.kind.value, e.position) for e in entries] == [(d.kind, d.position) for d in done]
        recorded = records.read_trials(entries)
        for k, (d, e) in enumerate(zip(done, entries, strict=True)):
            cycles = slice(recorded.first[k], recorded.first[k + 1])
            # Of a trial without an end, the last configuration is where the last cycle began.
            np.testing.assert_array_equal(recorded.configurations(k), d.q or [e.q0])
            np.testing.assert_array_equal(recorded.velocity[cycles].ravel(), np.ravel(d.velocity[: recorded.cycles[k]]))
            np.testing.assert_array_equal(records.read_times(e), d.time)
            assert e.end.name == ENDS[d.end or "broken-off"]
            assert e.rating == d.rating
            assert (e.ended is not None) == (d.end is not None)
        speed = np.linalg.norm(recorded.velocity, axis=1)
        assert speed.max(initial=0) <= records.protocol.stick.limit * (1 + 1e-9)
        assert not replay_trials(records, entries).differing_entries
        events = [e for e in records.events() if e["subject"] == code]
        told = [(m["kind"], m["data"]) for _, m in sorted(said.items()) if m["type"] == "event"]
        kinds = {kind for kind, _ in told}
        assert [(e["kind"], e["data"]) for e in events if e["kind"] in kinds] == told
        assert "replay differs" not in {e["kind"] for e in events}
        answers = records.subject(code).answers
        for message in said.values():
            for name, answer in message["answers"].items() if message["type"] == "answers" else ():
                assert answers[f"{message['form']}.{name}"] == answer
    return done, entries
