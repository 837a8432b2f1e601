"""What runs while the server runs: the records' threads, the pages that are connected, and what the experimenter may do."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from holdfast.errors import InputError
from holdfast.teleop.records.check import SAME, replay
from holdfast.teleop.records.entries import Entry, Kind, State
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import training_tasks
from holdfast.teleop.serve.live import Live
from holdfast.teleop.serve.messages import Bye, Cycles, Hello, Message, Refused, Sequenced, Welcome
from holdfast.teleop.serve.station import Entered, Station, Taken, enter
from holdfast.teleop.serve.writer import Keeper
from holdfast.teleop.trials.recordings import End

DIFFERS = "replay differs"
_PAUSED, _GOES_ON, _EXPERIMENTER = "paused", "goes on", {"by": "experimenter"}
_GREETING, _PAGES = 64, 256  # pages at once that have not said hello, and that have


class _Page(Protocol):
    """A page that is connected, as far as the server tells it something: a ``Connection``."""

    code: str | None

    def answered(self, reply: Message | Exception) -> None: ...
    def pause(self, paused: bool) -> None: ...
    def unstored(self) -> None: ...
    def turn_away(self) -> None: ...
    def bye(self, reason: str) -> None: ...


class Control:
    """The server's state and what the experimenter can do; for use inside the event loop only.

    Args:
        folder: Of the experiment.
        loop: The event loop.

    Attributes:
        folder: Of the experiment.
        writer: Owns the records that are written.
        reader: Owns a connection of its own, for what takes longer and changes nothing.
        live: What is watched.
        protocol: Of the experiment.

    Raises:
        StoreError: The folder cannot be opened.
    """

    def __init__(self, folder: Path, loop: asyncio.AbstractEventLoop) -> None:
        self.folder = folder
        self.writer = Keeper(folder, loop, writes=True, on_fault=self._fault)
        self.reader = Keeper(folder, loop, writes=False)
        self.live = Live()
        self.protocol = self.writer.protocol
        self._pages: dict[str, _Page] = {}
        self._greeting: dict[_Page, None] = {}  # oldest first
        self._all_paused = False
        self._paused: set[str] = set()
        self._failed = [s.failed for s in self.protocol.scenarios]
        self._fresh = loop.create_task(self.live.keep_fresh(self.state))

    async def begin(self) -> None:
        """Compile all that a session needs, so that no station waits for it; then replay what was not before a kill."""
        await asyncio.to_thread(training_tasks, self.protocol, 0)
        await self.reader.do(lambda records: records.protocol.plants)
        self._all_paused, self._paused = await self.reader.do(_pauses)
        self.reader.put(_differing, self._flag)

    def close(self) -> None:
        """Write what is under way, and close the files."""
        self._fresh.cancel()
        self.reader.close()
        self.writer.close()

    # ---- pages -----------------------------------------------------------------------------------------------------

    @contextmanager
    def greeted(self, page: _Page) -> Iterator[None]:
        """A page is to say hello inside; where too many are, the oldest is turned away."""
        self._greeting[page] = None
        if len(self._greeting) > _GREETING:
            oldest = next(iter(self._greeting))
            del self._greeting[oldest]
            oldest.turn_away()
        try:
            yield
        finally:
            self._greeting.pop(page, None)

    async def enter(self, page: _Page, hello: Hello) -> Welcome | Refused | Bye:
        """A page says hello; if it is let in it holds the session, and who held it before is told.

        Raises:
            StoreError: The records cannot be written.
        """
        if len(self._pages) >= _PAGES:
            raise InputError(f"{_PAGES} pages take part already, the most there may be; try again later")
        if (fault := self.writer.fault) is not None:
            # Whether it is over shows when something is written.
            await self.writer.do(lambda records: records.event("written again", data={"after": fault}))
        entered = await self.writer.do(lambda records: enter(records, hello))
        if not isinstance(entered, Entered):
            return entered
        code = entered.code
        before = self._pages.get(code)
        self._pages[code] = page
        page.code = code
        if before is not None and before is not page:
            before.bye("the session has moved to another page")
        subject = await self.writer.do(lambda records: records.subject(code))
        # Not in the writer: it takes a while, and the others should not wait for it.
        await asyncio.to_thread(training_tasks, self.protocol, subject.number)
        welcome = await self.writer.do(lambda records: Station(records, code).welcome(entered.key, self.is_paused(code)))
        self.changed()
        return welcome

    def take(self, page: _Page, message: Sequenced, size: int = 0) -> None:
        """A message, of so many bytes, of a page that holds a session; the page is given the reply."""
        code = page.code
        assert code is not None

        def taken(result: Any) -> None:
            page.answered(result.reply if isinstance(result, Taken) else result)
            if isinstance(result, Taken):
                self._after(code, message, result)

        self.writer.put(lambda records: Station(records, code).take(message, size), taken)

    def leave(self, page: _Page) -> None:
        """A connection is over."""
        if page.code is not None and self._pages.get(page.code) is page:
            del self._pages[page.code]
            self.live.forget(page.code)
            self.changed()

    def _fault(self, fault: str | None) -> None:
        """The records cannot be written, or can again: nobody continues as if nothing had happened."""
        if fault is not None:
            for page in list(self._pages.values()):
                page.unstored()
        self.changed()

    def _after(self, code: str, message: Sequenced, taken: Taken) -> None:
        if taken.reply.type != "ack":
            return
        if taken.finished is not None:
            number = taken.finished
            self.reader.put(lambda records: _differing(records, number), self._flag)
        if isinstance(message, Cycles):
            if self.live.watched and taken.entry is not None:
                self.live.publish(self._cycle(message, taken.entry), topic=code)
        else:
            self.changed()

    def _cycle(self, message: Cycles, entry: Entry) -> dict[str, Any]:
        healthy = [1] * len(entry.q0)
        if entry.joint >= 0 and self._failed[entry.scenario]:
            healthy[entry.joint] = 0
        return {
            "type": "cycle",
            "subject": entry.subject,
            "kind": entry.kind.value,
            "position": entry.position,
            "scenario": entry.scenario,
            "cycle": message.first + len(message.time),
            "q0": entry.q0.tolist(),
            "q": message.q[-1],
            "velocity": message.velocity[-1],
            "target": entry.target.tolist(),
            "healthy": healthy,
        }

    def _flag(self, differing: Any) -> None:
        """Note trials that do not come out as the page had them."""
        if isinstance(differing, Exception) or not differing:
            return

        def note(records: Records) -> None:
            with records.together():
                there = {e["trial"] for e in records.events(DIFFERS)}
                for entry, data in differing:
                    if entry.id not in there:
                        records.event(DIFFERS, entry.subject, entry.id, k=None, data=data)

        self.writer.put(note, lambda _: self.changed())

    # ---- the experimenter ------------------------------------------------------------------------------------------

    def changed(self) -> None:
        """Something that the list of subjects shows is not as it was."""
        self.live.stale()

    def is_paused(self, code: str) -> bool:
        """Whether a subject's session waits."""
        return self._all_paused or code in self._paused

    async def pause(self, subject: str | None, paused: bool) -> None:
        """Let a session, or all of them, wait after the trial under way, or resume.

        Raises:
            InputError: There is no such subject, or it is to resume while all are paused.
        """
        if subject is None:
            self._all_paused = paused
            if not paused:
                self._paused.clear()
        else:
            await self.writer.do(lambda records: records.subject(subject))
            if self._all_paused and not paused:
                raise InputError(f"all sessions are paused; {subject} resumes when all do")
            (self._paused.add if paused else self._paused.discard)(subject)
        kind = _PAUSED if paused else _GOES_ON
        await self.writer.do(lambda records: records.event(kind, subject, None, k=None, data=_EXPERIMENTER))
        for code, page in self._pages.items():
            if subject in (None, code):
                page.pause(self.is_paused(code))
        self.changed()

    async def note(self, subject: str, note: str) -> None:
        """Write a note about a subject, in place of an earlier one.

        Raises:
            InputError: There is no such subject, or the note is longer than 10,000 characters.
        """
        if len(note) > 10_000:
            raise InputError("a note has at most 10,000 characters")
        await self.writer.do(lambda records: records.set_note(subject, note))
        self.changed()

    async def drop(self, subject: str) -> None:
        """End a subject's session for good; what was recorded stays.

        Raises:
            InputError: There is no such subject.
        """
        await self.writer.do(lambda records: records.set_state(subject, State.DROPPED))
        if (page := self._pages.get(subject)) is not None:
            page.bye(f"the session of {subject} was ended by the experimenter")
        self.changed()

    async def new_key(self, subject: str) -> str:
        """A key with which another page resumes a session; the earlier key is void.

        Raises:
            InputError: There is no such subject, or the session is over.
        """

        def give(records: Records) -> str:
            if records.subject(subject).state == State.DROPPED:
                raise InputError(f"the session of {subject} was ended; it cannot be resumed")
            return records.give_key(subject)

        key = await self.writer.do(give)
        if (page := self._pages.get(subject)) is not None:
            page.bye("the session has moved to another page")
        self.changed()
        return key

    async def state(self) -> dict[str, Any]:
        """Whether all sessions are paused, and the state of each, as JSON takes it."""
        return {"paused": self._all_paused, "fault": self.writer.fault, "subjects": await self.subjects()}

    async def subjects(self) -> list[dict[str, Any]]:
        """The state of every subject's session, as JSON takes it."""
        rows = await self.reader.do(lambda records: (records.subjects(), records.progress(), _flagged(records)))
        subjects, progress, flagged = rows
        total = len(self.protocol.tasks) * len(self.protocol.scenarios)
        return [
            {
                "subject": s.code,
                "kind": s.kind.value,
                "state": s.state.value,
                "since": s.since,
                "note": s.note,
                "row": s.row,
                "training": progress.get((s.code, Kind.TRAINING), 0),
                "trials": progress.get((s.code, Kind.TRIAL), 0),
                "of": total,
                "connected": s.code in self._pages,
                "paused": self.is_paused(s.code),
                "differing": flagged.get(s.code, 0),
            }
            for s in subjects
        ]


def _pauses(records: Records) -> tuple[bool, set[str]]:
    """Whether all sessions were paused when a server ended, and which."""
    every, some = False, set[str]()
    for event in records.events():
        if event["kind"] not in (_PAUSED, _GOES_ON) or event["data"] != _EXPERIMENTER:
            continue
        paused, subject = event["kind"] == _PAUSED, event["subject"]
        if subject is not None:
            (some.add if paused else some.discard)(subject)
        else:
            every = paused
            if not paused:
                some.clear()
    return every, some


def _flagged(records: Records) -> dict[str, int]:
    found = [e["subject"] for e in records.events(DIFFERS)]
    return {code: found.count(code) for code in set(found)}


def _differing(records: Records, number: int | None = None) -> list[tuple[Entry, dict[str, Any]]]:
    """Finished trials, all or one, that do not come out as recorded when the Python kernel is given their commands."""
    found = records.entries() if number is None else [records.entry(number)]
    entries = [e for e in found if e is not None and e.ended is not None]
    if not entries:
        return []
    result = replay(records, entries)
    away = np.linalg.norm(result.trials.x_end - result.trials.target, axis=1)
    out: list[tuple[Entry, dict[str, Any]]] = []
    for entry, difference, distance in zip(entries, result.difference.tolist(), away.tolist(), strict=True):
        outside = entry.end == End.ARRIVED and distance > records.protocol.radius + SAME
        if not difference <= SAME or outside:
            # JSON has no infinity.
            out.append((entry, {"difference": difference if np.isfinite(difference) else None, "outside": outside}))
    return out
