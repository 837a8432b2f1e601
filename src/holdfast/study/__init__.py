"""Studies: sweeps of jobs in chunks that survive crashes and grow over machines. Knows no robots."""

from holdfast.study.cluster import Cluster
from holdfast.study.job import Cell, Chunk, Job
from holdfast.study.merge import Merged, merge
from holdfast.study.runner import Result, Runner, Task, Threads
from holdfast.study.store import Column, Store
from holdfast.study.study import CellStatus, Damage, Study

__all__ = [
    "Cell",
    "CellStatus",
    "Chunk",
    "Cluster",
    "Column",
    "Damage",
    "Job",
    "Merged",
    "Result",
    "Runner",
    "Store",
    "Study",
    "Task",
    "Threads",
    "merge",
]
