"""Answers to the questions of the studio's page as plain data for JSON; ``page/src/arm_page/answers.ts`` declares them."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from pydantic import Base64Bytes, TypeAdapter, ValidationError

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY, Registry
from holdfast.core.typing import T
from holdfast.interface.studio import upload
from holdfast.interface.studio.machine import CompiledArm, describe_error
from holdfast.interface.studio.monitor_demo import FAULT_PARAMETERS, LATEST_ONSET_S
from holdfast.interface.studio.motions import read_motion
from holdfast.interface.studio.state import State
from holdfast.interface.studio.worker_process import WorkerProcess
from holdfast.model.arm.poses import pose_numbers

LONG_QUESTIONS = ("best-worst", "laws", "fall", "stow", "region", "watch")  # jobs of the worker process, see compute.py
MORE_LAWS = ("failure-tolerant:0.1", "failure-tolerant:0.9")


@dataclass(frozen=True)
class SentFile:
    """File that a visitor opens; the content is sent in base64."""

    name: str
    content: Base64Bytes


@dataclass(frozen=True)
class Request:
    """Body of a question.

    Attributes:
        state: View of the visitor.
        file: File that the visitor opens, or None.
        ghosts: Further configurations (n,) of a drawing, rad and m.
    """

    state: State
    file: SentFile | None = None
    ghosts: tuple[tuple[float, ...], ...] = ()


_REQUEST_READER = TypeAdapter(Request)


class ServedArm:
    """Arm that the studio serves.

    Args:
        machine: Compiled arm.
        state: First view of each visitor. Paths are accepted from this view only, never from a page.
    """

    def __init__(self, machine: CompiledArm, state: State) -> None:
        self.machine, self.state = machine, state
        self.worker_process = WorkerProcess(machine.arm, machine.task, machine.cell)

    @cached_property
    def choices(self) -> Mapping[str, tuple[str, ...]]:
        """Indices, susceptibilities, laws and faults that a visitor may choose; those of the first view are among them."""
        return {
            "indices": self._list_labels(INDEX_REGISTRY, self.state.index, self.state.objective),
            "susceptibilities": self._list_labels(SUSCEPTIBILITY_REGISTRY, self.state.susceptibility, self.state.objective),
            "laws": (*dict.fromkeys((*self._list_labels(LAW_REGISTRY), *MORE_LAWS, *self.state.laws)),),
            "faults": tuple(FAULT_PARAMETERS),
        }

    def _list_labels(self, registry: Registry, *first: str) -> tuple[str, ...]:
        labels = registry.labels(self.machine.arm, self.machine.task)
        return (*dict.fromkeys((*labels, *(label for label in first if registry.covers(label)))),)

    def page_data(self, token: str) -> dict[str, Any]:
        """Return the ``StudioData`` of the page with a token."""
        cell = self.machine.cell
        objects = [] if cell is None else [{"name": solid.name, "pose": solid.pose[:3].ravel().tolist()} for solid in cell]
        return {"token": token, "state": dataclasses.asdict(self.state), **self.choices, "objects": objects}

    def read_request(self, content: bytes) -> Request:
        """Read the body of a question, and check it against the arm.

        Raises:
            InputError: The body is not a question about this arm.
        """
        try:
            request = _REQUEST_READER.validate_json(content, strict=True)
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(str(key) for key in first["loc"]) or "the question"
            raise InputError(f"{place} cannot be read: {first['msg']}") from None
        state, first_state = request.state, self.state
        if state.names != first_state.names:
            raise InputError(f"the question is about another arm than '{first_state.arm}'; load the page again")
        for name, text, known in (
            ("index", state.index, self.choices["indices"]),
            ("susceptibility", state.susceptibility, self.choices["susceptibilities"]),
            ("objective", state.objective, self.choices["indices"] + self.choices["susceptibilities"]),
            *(("law", law, self.choices["laws"]) for law in state.laws),
            ("fault", state.fault[0], self.choices["faults"]),
            ("joint of the fault", state.fault[1], state.names),
        ):
            if text not in known:
                raise InputError(f"{name} is '{text[:80]}'; choose one of {', '.join(known)}")
        if not 0 <= state.fault[2] <= LATEST_ONSET_S:
            raise InputError(f"the fault begins at {state.fault[2]:g} s; choose a time from 0 to {LATEST_ONSET_S:g} s")
        if state.region not in (None, first_state.region):
            raise InputError("results are opened from the command line only; start the studio with --region FOLDER")
        if any(len(ghost) != len(state.q) for ghost in request.ghosts) or len(request.ghosts) > 3:
            raise InputError(f"ghosts must be at most 3 configurations of {len(state.q)} values")
        return request


def answer_reading(served: ServedArm, request: Request) -> dict[str, Any]:
    """Evaluate the indices of each joint, the beginning of a fall, the nearest object, and a target nearby."""
    state, machine, q = request.state, served.machine, np.array(request.state.q)

    def evaluate_or_explain(evaluate: Callable[..., T], *arguments: Any) -> T | str:
        try:
            return evaluate(*arguments)
        except HoldfastError as error:
            return describe_error(error)

    nearest = evaluate_or_explain(machine.find_nearest_object, q, state.moved)
    return {
        "index": evaluate_or_explain(machine.evaluate_index_bars, q, state.index),
        "susceptibility": evaluate_or_explain(machine.evaluate_susceptibility_bars, q, state.susceptibility),
        "powerLoss": evaluate_or_explain(machine.describe_power_loss, q, state.powerless, state.friction),
        "clearance": nearest if isinstance(nearest, str) else nearest[0],
        "nearest": None if isinstance(nearest, str) else nearest[1],
        "target": pose_numbers(machine.tool_pose(machine.nearby_configuration(q))),
        "command": state.to_command(),
    }


def answer_drawing(served: ServedArm, request: Request) -> dict[str, Any]:
    """Draw the view and its ghosts."""
    from holdfast.interface.studio.picture import draw_view_svg

    return {"svg": draw_view_svg(served.machine, request.state, request.ghosts)}


def answer_cell_file(served: ServedArm, request: Request) -> dict[str, Any]:
    """Write the cell with the present poses of its objects; it names meshes and clouds by absolute paths.

    Raises:
        InputError: The arm has no cell, or an object that moved is not in it.
    """
    from holdfast.model.cell import cell_file

    cell = served.machine.cell_with_moved(request.state.moved)
    name = f"{re.sub(r'[^A-Za-z0-9._-]+', '-', cell.name).strip('-.') or 'cell'}.yaml"
    command = replace(request.state, cell=name, moved=()).to_command()
    return {"name": name, "text": cell_file.format_cell(cell.to_dict()), "command": command}


def open_motion(served: ServedArm, request: Request) -> dict[str, Any]:
    """Read the motion that the visitor sends, or without a file the one of the command line.

    Raises:
        InputError: There is no such file, or it is not a motion of this arm.
    """
    arm = served.machine.arm
    if request.file is not None:
        motion = upload.read_uploaded_motion(arm, request.file.name, request.file.content)
    elif served.state.file is not None:
        motion = read_motion(arm, served.state.file)
    else:
        raise InputError("there is no motion; open a CSV file, or start the studio with --file")
    return {"motion": motion.to_plain() | {"label": f"{motion.label}: {len(motion.time)} rows"}}


QUICK_ANSWERS: Mapping[str, Callable[[ServedArm, Request], Any]] = MappingProxyType(
    {"reading": answer_reading, "drawing": answer_drawing, "cell-file": answer_cell_file, "open": open_motion}
)
