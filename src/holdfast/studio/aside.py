"""A process beside the page for what takes long: building a law keeps Python busy for seconds, and a page must not wait.

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

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.cell.cell import Cell
from holdfast.errors import HoldfastError
from holdfast.studio.state import State
from holdfast.studio.work import Cancelled

Progress = Callable[[int, int], None]
PATIENCE = 2.0  # s that a request gets to give up before its process is ended
_POLL = 0.02  # s


class Aside:
    """The process, started when it is first needed, ended and started again where a request does not give up in time."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self._of = replace(arm), task, cell  # without what has been compiled
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: queue.Queue[tuple[str, Any]] = queue.Queue()
        self._turn = threading.Lock()
        self._number = 0

    def run(self, job: str, state: State, check: Callable[[], None], progress: Progress) -> Any:
        """Do a job of :mod:`holdfast.studio.compute` for a state.

        Args:
            job: Its name.
            state: What it is of.
            check: Called 50 times a second; raises to give up.
            progress: Told of (done, in all).

        Raises:
            Cancelled: As ``check`` raises it.
            HoldfastError: What the job raised, or that its process ended.
        """
        while not self._turn.acquire(timeout=_POLL):
            check()
        try:
            check()
            self._start()
            self._number += 1
            self._send((self._number, job, state))
            return self._wait(check, progress)
        except BaseException as error:
            if not isinstance(error, (HoldfastError, Cancelled)):
                self.stop()
            raise
        finally:
            self._turn.release()

    def stop(self) -> None:
        """End the process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    try:
                        pipe.close()
                    except OSError:
                        continue  # what was not sent yet cannot be sent any more

    def _start(self) -> None:
        if self._process is not None and self._process.poll() is None:
            return
        self.stop()
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(x for x in sys.path if x)}
        command = [sys.executable, "-c", "from holdfast.studio.aside import main; main()"]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        answers: queue.Queue[tuple[str, Any]] = queue.Queue()
        self._process, self._answers = process, answers
        threading.Thread(target=_listen, args=(process.stdout, answers), daemon=True, name="studio answers").start()
        self._send(self._of)

    def _send(self, message: Any) -> None:
        if self._process is None or self._process.stdin is None:
            raise HoldfastError("the computation was ended; ask again")
        try:
            pickle.dump(message, self._process.stdin)
            self._process.stdin.flush()
        except (OSError, ValueError) as error:
            raise HoldfastError("the computation ended unexpectedly; ask again") from error

    def _wait(self, check: Callable[[], None], progress: Progress) -> Any:
        while True:
            try:
                check()
            except BaseException:
                self._give_up()
                raise
            try:
                kind, value = self._answers.get(timeout=_POLL)
            except queue.Empty:
                continue
            if kind == "done":
                return value
            if kind == "error":
                raise value
            if kind == "progress":
                progress(*value)

    def _give_up(self) -> None:
        """Have the job end, or end its process."""
        self._send((self._number, "cancel", None))
        try:
            while self._answers.get(timeout=PATIENCE)[0] == "progress":
                continue
        except queue.Empty:
            self.stop()


def _listen(pipe: IO[bytes], answers: queue.Queue[tuple[str, Any]]) -> None:
    while True:
        try:
            answers.put(pickle.load(pipe))
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            answers.put(("error", HoldfastError("the computation ended unexpectedly; ask again")))
            return


# ---- in the process ----------------------------------------------------------------------------------------------


def main() -> None:
    """Answer requests until the parent is gone."""
    requests, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # what a library prints must not get between the answers
    arm, task, cell = pickle.load(requests)

    from holdfast.studio.compute import JOBS
    from holdfast.studio.scene.machine import Machine, sentence

    machine, waiting = Machine(arm, task, cell), queue.SimpleQueue[Any]()
    given_up = [0]  # the newest request that is of no interest any more

    def read() -> None:
        while True:
            try:
                message = pickle.load(requests)
            except (EOFError, OSError, pickle.UnpicklingError):
                os._exit(0)  # the parent is gone: nobody waits for what is under way
            if message[1] == "cancel":
                given_up[0] = message[0]
            else:
                waiting.put(message)

    def tell(kind: str, value: Any) -> None:
        pickle.dump((kind, value), answers)
        answers.flush()

    threading.Thread(target=read, daemon=True).start()
    while True:
        number, job, state = waiting.get()

        def progress(done: int, total: int, number: int = number) -> None:
            if given_up[0] >= number:
                raise Cancelled
            tell("progress", (done, total))

        try:
            tell("done", JOBS[job](machine, state, progress))
        except HoldfastError as error:
            tell("error", error)
        except Exception as error:
            tell("error", HoldfastError(sentence(error)))
