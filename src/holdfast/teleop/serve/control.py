"""State of the running server: the threads of the records, the connected pages, and the actions of the experimenter."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from holdfast.core.errors import InputError
from holdfast.teleop.records.check import REPLAY_TOLERANCE, replay_trials
from holdfast.teleop.records.entries import SubjectState, TrialKind, TrialRecord
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import training_tasks
from holdfast.teleop.serve.live import StatusBroadcaster
from holdfast.teleop.serve.messages import Bye, Cycles, Hello, Message, Refused, Sequenced, Welcome
from holdfast.teleop.serve.station import Admission, MessageOutcome, Station, admit_page
from holdfast.teleop.serve.writer import RecordsThread
from holdfast.teleop.trials.recordings import End

DIFFERENCE_EVENT = "replay differs"
_PAUSED_EVENT = "paused"
_RESUMED_EVENT = "goes on"
_EXPERIMENTER_DATA = {"by": "experimenter"}
# _MAX_GREETING_PAGES and _MAX_PAGES: largest numbers of pages before and after hello
_MAX_GREETING_PAGES = 64
_MAX_PAGES = 256


class _Page(Protocol):
    """Connected page, as seen by the server: a ``Connection``."""

    code: str | None

    def send_reply(self, reply: Message | Exception) -> None: ...
    def pause(self, paused: bool) -> None: ...
    def report_write_failure(self) -> None: ...
    def close_silently(self) -> None: ...
    def bye(self, reason: str) -> None: ...


class Control:
    """State of the server and the experimenter's actions; for use inside the event loop only.

    Args:
        folder: Folder of the experiment.
        loop: Event loop of the server.

    Attributes:
        folder: Folder of the experiment.
        writer: Thread that writes the records.
        reader: Thread with a separate connection, for long jobs that change nothing.
        live: Broadcast of the state to the experimenter's pages.
        protocol: Protocol of the experiment.

    Raises:
        StoreError: The folder cannot be opened.
    """

    def __init__(self, folder: Path, loop: asyncio.AbstractEventLoop) -> None:
        self.folder = folder
        self.writer = RecordsThread(folder, loop, writes=True, on_fault=self._on_record_error_change)
        self.reader = RecordsThread(folder, loop, writes=False)
        self.live = StatusBroadcaster()
        self.protocol = self.writer.protocol
        self._pages: dict[str, _Page] = {}
        self._greeting_pages: dict[_Page, None] = {}  # oldest first
        self._all_paused = False
        self._paused: set[str] = set()
        self._failed = [scenario.failed for scenario in self.protocol.scenarios]
        self._refresh_task = loop.create_task(self.live.publish_subjects(self.describe_state))

    async def begin(self) -> None:
        """Compile all that a session needs, so that no station waits for it, and replay the trials missed before a kill."""
        await asyncio.to_thread(training_tasks, self.protocol, 0)
        await self.reader.run_job(lambda records: records.protocol.plants)
        self._all_paused, self._paused = await self.reader.run_job(_read_pauses)
        self.reader.submit_job(_find_replay_differences, self._record_replay_differences)

    def close(self) -> None:
        """Write the changes in progress, and close the files."""
        self._refresh_task.cancel()
        self.reader.close()
        self.writer.close()

    # ---- pages -----------------------------------------------------------------------------------------------------

    @contextmanager
    def track_until_hello(self, page: _Page) -> Iterator[None]:
        """List a page among those that have not sent hello; above the limit, the oldest one is disconnected."""
        self._greeting_pages[page] = None
        if len(self._greeting_pages) > _MAX_GREETING_PAGES:
            oldest = next(iter(self._greeting_pages))
            del self._greeting_pages[oldest]
            oldest.close_silently()
        try:
            yield
        finally:
            self._greeting_pages.pop(page, None)

    async def enter_session(self, page: _Page, hello: Hello) -> Welcome | Refused | Bye:
        """Admit a page that sends hello to its session, and disconnect the page that held the session before.

        Raises:
            StoreError: The records cannot be written.
        """
        if len(self._pages) >= _MAX_PAGES:
            raise InputError(f"{_MAX_PAGES} pages take part already, the largest number; try again later")
        if (fault := self.writer.fault) is not None:
            # Whether it is over shows when something is written.
            await self.writer.run_job(lambda records: records.add_event("written again", data={"after": fault}))
        entered = await self.writer.run_job(lambda records: admit_page(records, hello))
        if not isinstance(entered, Admission):
            return entered
        code = entered.code
        previous_page = self._pages.get(code)
        self._pages[code] = page
        page.code = code
        if previous_page is not None and previous_page is not page:
            previous_page.bye("the session has moved to another page")
        subject = await self.writer.run_job(lambda records: records.subject(code))
        # Not in the writer, because it takes a while, and the other pages should not wait for it.
        await asyncio.to_thread(training_tasks, self.protocol, subject.number)
        welcome = await self.writer.run_job(
            lambda records: Station(records, code).make_welcome(entered.key, self.is_paused(code))
        )
        self.mark_subjects_changed()
        return welcome

    def apply_message(self, page: _Page, message: Sequenced, size: int = 0) -> None:
        """Apply a message of ``size`` bytes from a page that holds a session, and send the page the reply."""
        code = page.code
        assert code is not None

        def on_result(result: Any) -> None:
            page.send_reply(result.reply if isinstance(result, MessageOutcome) else result)
            if isinstance(result, MessageOutcome):
                self._publish_outcome(code, message, result)

        self.writer.submit_job(lambda records: Station(records, code).apply_message(message, size), on_result)

    def release_session(self, page: _Page) -> None:
        """Release the session of a page whose connection is over."""
        if page.code is not None and self._pages.get(page.code) is page:
            del self._pages[page.code]
            self.live.forget_topic(page.code)
            self.mark_subjects_changed()

    def _on_record_error_change(self, record_error: str | None) -> None:
        """Notify the pages when the records cannot be written, and refresh the experimenter's list on any change."""
        if record_error is not None:
            for page in list(self._pages.values()):
                page.report_write_failure()
        self.mark_subjects_changed()

    def _publish_outcome(self, code: str, message: Sequenced, outcome: MessageOutcome) -> None:
        if outcome.reply.type != "ack":
            return
        if outcome.finished is not None:
            number = outcome.finished
            self.reader.submit_job(lambda records: _find_replay_differences(records, number), self._record_replay_differences)
        if isinstance(message, Cycles):
            if self.live.is_watched and outcome.entry is not None:
                self.live.publish(self._describe_cycle(message, outcome.entry), topic=code)
        else:
            self.mark_subjects_changed()

    def _describe_cycle(self, message: Cycles, entry: TrialRecord) -> dict[str, Any]:
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

    def _record_replay_differences(self, differing: Any) -> None:
        """Record an event for each trial whose replay differs from the page's record."""
        if isinstance(differing, Exception) or not differing:
            return

        def record_events(records: Records) -> None:
            with records.transaction():
                flagged = {event["trial"] for event in records.events(DIFFERENCE_EVENT)}
                for entry, data in differing:
                    if entry.id not in flagged:
                        records.add_event(DIFFERENCE_EVENT, entry.subject, entry.id, k=None, data=data)

        self.writer.submit_job(record_events, lambda _: self.mark_subjects_changed())

    # ---- the experimenter ------------------------------------------------------------------------------------------

    def mark_subjects_changed(self) -> None:
        """Mark the experimenter's list of subjects as changed."""
        self.live.mark_subjects_changed()

    def is_paused(self, code: str) -> bool:
        """Return whether a subject's session is paused."""
        return self._all_paused or code in self._paused

    async def pause(self, subject: str | None, paused: bool) -> None:
        """Pause a session, or all of them, after the current trial, or resume.

        Raises:
            InputError: There is no such subject, or one session is resumed while all are paused.
        """
        if subject is None:
            self._all_paused = paused
            if not paused:
                self._paused.clear()
        else:
            await self.writer.run_job(lambda records: records.subject(subject))
            if self._all_paused and not paused:
                raise InputError(f"all sessions are paused; {subject} resumes when all do")
            (self._paused.add if paused else self._paused.discard)(subject)
        kind = _PAUSED_EVENT if paused else _RESUMED_EVENT
        await self.writer.run_job(lambda records: records.add_event(kind, subject, None, k=None, data=_EXPERIMENTER_DATA))
        for code, page in self._pages.items():
            if subject in (None, code):
                page.pause(self.is_paused(code))
        self.mark_subjects_changed()

    async def set_note(self, subject: str, note: str) -> None:
        """Replace the note about a subject.

        Raises:
            InputError: There is no such subject, or the note is longer than 10,000 characters.
        """
        if len(note) > 10_000:
            raise InputError("a note has at most 10,000 characters")
        await self.writer.run_job(lambda records: records.set_note(subject, note))
        self.mark_subjects_changed()

    async def drop_subject(self, subject: str) -> None:
        """End a subject's session permanently; its records are kept.

        Raises:
            InputError: There is no such subject.
        """
        await self.writer.run_job(lambda records: records.set_state(subject, SubjectState.DROPPED))
        if (page := self._pages.get(subject)) is not None:
            page.bye(f"the session of {subject} was ended by the experimenter")
        self.mark_subjects_changed()

    async def renew_key(self, subject: str) -> str:
        """Return a new key with which another page resumes a session; the earlier key becomes invalid.

        Raises:
            InputError: There is no such subject, or the session is over.
        """

        def give_key(records: Records) -> str:
            if records.subject(subject).state == SubjectState.DROPPED:
                raise InputError(f"the session of {subject} was ended; it cannot be resumed")
            return records.give_key(subject)

        key = await self.writer.run_job(give_key)
        if (page := self._pages.get(subject)) is not None:
            page.bye("the session has moved to another page")
        self.mark_subjects_changed()
        return key

    async def describe_state(self) -> dict[str, Any]:
        """Return for JSON whether all sessions are paused, and the state of each."""
        return {"paused": self._all_paused, "fault": self.writer.fault, "subjects": await self.describe_subjects()}

    async def describe_subjects(self) -> list[dict[str, Any]]:
        """Return the state of every subject's session for JSON."""
        rows = await self.reader.run_job(
            lambda records: (records.subjects(), records.count_trials(), _count_replay_differences(records))
        )
        subjects, progress, flagged = rows
        trial_count = len(self.protocol.tasks) * len(self.protocol.scenarios)
        return [
            {
                "subject": subject.code,
                "kind": subject.kind.value,
                "state": subject.state.value,
                "since": subject.since,
                "note": subject.note,
                "row": subject.row,
                "training": progress.get((subject.code, TrialKind.TRAINING), 0),
                "trials": progress.get((subject.code, TrialKind.TRIAL), 0),
                "of": trial_count,
                "connected": subject.code in self._pages,
                "paused": self.is_paused(subject.code),
                "differing": flagged.get(subject.code, 0),
            }
            for subject in subjects
        ]


def _read_pauses(records: Records) -> tuple[bool, set[str]]:
    """Return whether all sessions were paused when the last server ended, and the set of paused sessions."""
    all_paused, paused_subjects = False, set[str]()
    for event in records.events():
        if event["kind"] not in (_PAUSED_EVENT, _RESUMED_EVENT) or event["data"] != _EXPERIMENTER_DATA:
            continue
        paused, subject = event["kind"] == _PAUSED_EVENT, event["subject"]
        if subject is not None:
            (paused_subjects.add if paused else paused_subjects.discard)(subject)
        else:
            all_paused = paused
            if not paused:
                paused_subjects.clear()
    return all_paused, paused_subjects


def _count_replay_differences(records: Records) -> dict[str, int]:
    flagged = [event["subject"] for event in records.events(DIFFERENCE_EVENT)]
    return {code: flagged.count(code) for code in set(flagged)}


def _find_replay_differences(records: Records, number: int | None = None) -> list[tuple[TrialRecord, dict[str, Any]]]:
    """Return the finished trials, all or one, whose replay with the Python kernel differs from the record."""
    candidates = records.entries() if number is None else [records.entry(number)]
    entries = [candidate for candidate in candidates if candidate is not None and candidate.ended is not None]
    if not entries:
        return []
    result = replay_trials(records, entries)
    distances = np.linalg.norm(result.trials.x_end - result.trials.target, axis=1)
    differing: list[tuple[TrialRecord, dict[str, Any]]] = []
    for entry, difference, distance in zip(entries, result.difference.tolist(), distances.tolist(), strict=True):
        outside = entry.end == End.ARRIVED and distance > records.protocol.radius + REPLAY_TOLERANCE
        if not difference <= REPLAY_TOLERANCE or outside:
            # JSON has no infinity.
            differing.append((entry, {"difference": difference if np.isfinite(difference) else None, "outside": outside}))
    return differing
