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


class Cancelled(Exception):
    """Raised inside a job whose answer nobody awaits any more."""


class WorkerProcess:
    """Worker process, started on first use, and killed and restarted if a request is not cancelled in time."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self._inputs = replace(arm), task, cell  # without compiled functions
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: queue.Queue[tuple[str, Any]] = queue.Queue()
        self._request_lock = threading.Lock()
        self._request_number = 0

    def run(self, job_name: str, state: State, check: Callable[[], None], progress: Progress) -> Any:
        """Run a job of :mod:`holdfast.interface.studio.compute` for a state.

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
            self._ensure_started()
            self._request_number += 1
            self._send_message((self._request_number, job_name, state))
            return self._await_answer(check, progress)
        except BaseException as error:
            if not isinstance(error, (HoldfastError, Cancelled)):
                self.stop()
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
                    try:
                        pipe.close()
                    except OSError:
                        continue  # the pipe is closed, so unsent data cannot be sent

    def _ensure_started(self) -> None:
        if self._process is not None and self._process.poll() is None:
            return
        self.stop()
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(entry for entry in sys.path if entry)}
        command = [sys.executable, "-c", "from holdfast.interface.studio.worker_process import main; main()"]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        answers: queue.Queue[tuple[str, Any]] = queue.Queue()
        self._process, self._answers = process, answers
        threading.Thread(target=_collect_answers, args=(process.stdout, answers), daemon=True, name="studio answers").start()
        self._send_message(self._inputs)

    def _send_message(self, message: Any) -> None:
        if self._process is None or self._process.stdin is None:
            raise HoldfastError("the computation was stopped; request it again")
        try:
            pickle.dump(message, self._process.stdin)
            self._process.stdin.flush()
        except (OSError, ValueError) as error:
            raise HoldfastError("the computation ended unexpectedly; request it again") from error

    def _await_answer(self, check: Callable[[], None], progress: Progress) -> Any:
        while True:
            try:
                check()
            except BaseException:
                self._cancel_job()
                raise
            try:
                kind, value = self._answers.get(timeout=_POLL_INTERVAL_S)
            except queue.Empty:
                continue
            if kind == "done":
                return value
            if kind == "error":
                raise value
            if kind == "progress":
                progress(*value)

    def _cancel_job(self) -> None:
        """Cancel the job, or kill its process if it does not stop."""
        self._send_message((self._request_number, "cancel", None))
        try:
            while self._answers.get(timeout=CANCEL_TIMEOUT_S)[0] == "progress":
                continue
        except queue.Empty:
            self.stop()


def _collect_answers(pipe: IO[bytes], answers: queue.Queue[tuple[str, Any]]) -> None:
    while True:
        try:
            answers.put(pickle.load(pipe))
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            answers.put(("error", HoldfastError("the computation ended unexpectedly; request it again")))
            return


# ---- in the worker process ------------------------------------------------------------------------------------------


def main() -> None:
    """Answer requests until the parent process ends."""
    requests, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # output of libraries must not mix with the answers
    arm, task, cell = pickle.load(requests)

    from holdfast.interface.studio.compute import JOB_FUNCTIONS
    from holdfast.interface.studio.machine import CompiledArm, describe_error

    machine, pending = CompiledArm(arm, task, cell), queue.SimpleQueue[Any]()
    newest_cancelled = [0]  # number of the newest cancelled request

    def read_requests() -> None:
        while True:
            try:
                message = pickle.load(requests)
            except (EOFError, OSError, pickle.UnpicklingError):
                os._exit(0)  # the parent process has ended, so no result is needed
            if message[1] == "cancel":
                newest_cancelled[0] = message[0]
            else:
                pending.put(message)

    def send_answer(kind: str, value: Any) -> None:
        pickle.dump((kind, value), answers)
        answers.flush()

    threading.Thread(target=read_requests, daemon=True).start()
    while True:
        number, job, state = pending.get()

        def report_progress(done: int, total: int, number: int = number) -> None:
            if newest_cancelled[0] >= number:
                raise Cancelled
            send_answer("progress", (done, total))

        try:
            send_answer("done", JOB_FUNCTIONS[job](machine, state, report_progress))
        except HoldfastError as error:
            send_answer("error", error)
        except Exception as error:
            send_answer("error", HoldfastError(describe_error(error)))
