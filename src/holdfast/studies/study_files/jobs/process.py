"""Compiled objects that the jobs of one process share, each made once for all threads."""

from __future__ import annotations

import ctypes
import threading
from abc import ABC, abstractmethod
from collections import OrderedDict
from collections.abc import Callable, Hashable
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Generic

from holdfast.control.laws.law import Law
from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.typing import T
from holdfast.kernels.threads import set_threads, thread_count
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import from_dict

# Parameters of mallopt, from malloc.h.
_TRIM_THRESHOLD = -1
_MMAP_THRESHOLD = -3
_MAX_COMPILED_CELLS = 32  # cells whose compiled objects are kept
_lock = threading.RLock()
_compiled_by_job: OrderedDict[Hashable, Any] = OrderedDict()


def compile_once(job: Hashable, make: Callable[[], T]) -> T:
    """Return the result of ``make`` for a job; ``make`` is called only once."""
    with _lock:
        if job not in _compiled_by_job:
            _compiled_by_job[job] = make()
            while len(_compiled_by_job) > _MAX_COMPILED_CELLS:
                _compiled_by_job.popitem(last=False)
        _compiled_by_job.move_to_end(job)
        compiled: T = _compiled_by_job[job]
        return compiled


@lru_cache(maxsize=1)
def _retain_memory() -> None:
    """Make this process retain memory between blocks.

    Dask's nanny makes the C library release every larger array at once. Allocating it again takes longer than the equations;
    chunks took 1.7 times as long.
    """
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for option, size in ((_MMAP_THRESHOLD, 32 << 20), (_TRIM_THRESHOLD, 256 << 20)):
            mallopt(option, size)


@dataclass(frozen=True, eq=False)
class PlannedJob(ABC, Generic[T]):
    """Job that is defined by its plan and compiles once per process for all its chunks.

    Subclasses are ``@dataclass(frozen=True, eq=False)``, because a comparing dataclass hashes its fields, and a plan has no
    hash.

    Attributes:
        plan: Arm and further data that define the values, as JSON data.
    """

    plan: dict[str, Any]

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    def __hash__(self) -> int:
        return hash((type(self), self.plan["fingerprint"], self.plan.get("law")))

    @abstractmethod
    def compile_plan(self) -> T:
        """Return the compiled objects of the plan."""

    @property
    def compiled_parts(self) -> T:
        """Result of :meth:`compile_plan`, which is called once."""
        return compile_once(self, self.compile_plan)

    def prepare(self, alone: bool) -> None:
        """Compile the objects of the plan before the first chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        with _lock:
            if alone:
                _retain_memory()
                if thread_count() != 1:
                    set_threads(1)
        compile_once(self, self.compile_plan)


@dataclass(frozen=True, eq=False)
class PlannedLaw(PlannedJob[T]):
    """Job whose plan names a law.

    Attributes:
        plan: Arm, task, law, and the settings of the job.
    """

    def make_law(self) -> Law:
        """Return the law of the plan."""
        task = Task.from_dict(self.plan["task"])
        plan_law: Law = LAW_REGISTRY.make(self.plan["law"], from_dict(self.plan["arm"]), option="laws", task=task)
        return plan_law


@dataclass(frozen=True, eq=False)
class LawJob(PlannedLaw[Law]):
    """Job that compiles only its law."""

    def compile_plan(self) -> Law:
        """Return the law."""
        return self.make_law()
