"""Worker process next to the server for long computations, because building a law keeps Python busy for seconds.

The parent sends pickled requests to its standard input and reads pickled answers from its standard output.
"""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import IO, Any

from holdfast.core.errors import HoldfastError
from holdfast.interface.studio.state import State
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.cell.cell import Cell

Progress = Callable[[int, int], None]
CANCEL_TIMEOUT_S = 2.0  # time that a cancelled request has before its process is killed, s
_POLL_INTERVAL_S = 0.02  # interval of calls of ``check``, s
_END_TEXT = "the computation ended unexpectedly; request it again"


class Cancelled(Exception):
    """Raised inside a job whose answer nobody awaits any more."""


class WorkerProcess:
    """Worker process, started on first use, and killed and restarted if a request is not cancelled in time."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self._inputs = replace(arm), task, cell  # without compiled functions
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: queue.Queue[tuple[str, Any]] = queue.Queue()
        self._request_lock = threading.Lock()

    def run(self, job_name: str, state: State, check: Callable[[], None], progress: Progress) -> Any:
        """Run a job of :mod:`holdfast.interface.studio.compute` for a state, after the jobs of other pages.

        Args:
            job_name: Name of the job.
            state: State for which it runs.
            check: Function that is called 50 times a second, and raises an exception to cancel.
            progress: Function that is called with (done, total).

        Raises:
            Cancelled: ``check`` raised it.
            HoldfastError: The job raised it, or its process ended.
        """
        while not self._request_lock.acquire(timeout=_POLL_INTERVAL_S):
            check()
        try:
            check()
            if self._process is None or self._process.poll() is not None:
                self._start()
            self._send_message((job_name, state))
            while True:
                with suppress(queue.Empty):
                    kind, value = self._answers.get(timeout=_POLL_INTERVAL_S)
                    if kind == "done":
                        return value
                    if kind == "error":
                        raise value
                    progress(*value)
                try:
                    check()
                except BaseException:
                    self._cancel_job()
                    raise
        finally:
            self._request_lock.release()

    def stop(self) -> None:
        """Kill the process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    with suppress(OSError):  # unsent data cannot be sent
                        pipe.close()

    def _start(self) -> None:
        self.stop()
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(entry for entry in sys.path if entry)}
        command = [sys.executable, "-c", "from holdfast.interface.studio.worker_process import main; main()"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self._answers = queue.Queue()
        arguments = self._process.stdout, self._answers
        threading.Thread(target=_collect_answers, args=arguments, daemon=True, name="studio answers").start()
        self._send_message(self._inputs)

    def _send_message(self, message: Any) -> None:
        if self._process is None or self._process.stdin is None:
            raise HoldfastError("the computation was stopped; request it again")
        try:
            pickle.dump(message, self._process.stdin)
            self._process.stdin.flush()
        except (OSError, ValueError) as error:
            raise HoldfastError(_END_TEXT) from error

    def _cancel_job(self) -> None:
        """Cancel the job, or kill its process if it does not stop."""
        try:
            self._send_message(None)
            while self._answers.get(timeout=CANCEL_TIMEOUT_S)[0] == "progress":
                continue
        except (queue.Empty, HoldfastError):
            self.stop()


def _collect_answers(pipe: IO[bytes], answers: queue.Queue[tuple[str, Any]]) -> None:
    with suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):
        while True:
            answers.put(pickle.load(pipe))
    answers.put(("error", HoldfastError(_END_TEXT)))


# ---- in the worker process ---------------------------------------------------------------------------------------


def main() -> None:
    """Answer requests until the parent process ends."""
    requests, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # output of libraries must not mix with the answers
    arm, task, cell = pickle.load(requests)

    from holdfast.interface.studio.compute import JOB_FUNCTIONS
    from holdfast.interface.studio.machine import CompiledArm, describe_error

    machine, pending, cancelled = CompiledArm(arm, task, cell), queue.SimpleQueue[Any](), threading.Event()

    def read_requests() -> None:
        with suppress(EOFError, OSError, pickle.UnpicklingError):
            while True:
                message = pickle.load(requests)
                if message is None:
                    cancelled.set()
                else:  # the parent sends a request only after the previous one has ended
                    cancelled.clear()
                    pending.put(message)
        os._exit(0)  # the parent process has ended, so no result is needed

    def send_answer(kind: str, value: Any) -> None:
        pickle.dump((kind, value), answers)
        answers.flush()

    def report_progress(done: int, total: int) -> None:
        if cancelled.is_set():
            raise Cancelled
        send_answer("progress", (done, total))

    threading.Thread(target=read_requests, daemon=True).start()
    while True:
        job, state = pending.get()
        try:
            send_answer("done", JOB_FUNCTIONS[job](machine, state, report_progress))
        except HoldfastError as error:
            send_answer("error", error)
        except Exception as error:
            send_answer("error", HoldfastError(describe_error(error)))
