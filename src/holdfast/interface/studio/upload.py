"""Files dropped on the page, an arm or a motion, which are read without opening any other file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from holdfast.core.errors import HoldfastError, InputError
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.motions import PlayedMotion, read_motion
from holdfast.interface.studio.state import State
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import as_task
from holdfast.model.arms.spec import default_task

MAX_FILE_BYTES = 4 << 20  # bytes
MAX_JOINTS = 40  # an arm with more joints takes minutes to compile
ARM_SUFFIXES = (".urdf", ".xml", ".yaml", ".yml")
MOTION_SUFFIXES = (".csv",)
_TOO_LARGE = f"the file is too large; at most {MAX_FILE_BYTES >> 20} MiB can be opened here"


def detect_file_kind(name: str) -> str:
    """Return ``arm`` or ``motion``, according to the suffix of a file's name.

    Raises:
        InputError: The suffix is unknown.
    """
    ending = Path(name).suffix.lower()
    if ending in MOTION_SUFFIXES:
        return "motion"
    if ending in ARM_SUFFIXES:
        return "arm"
    hint = "xacro files must be expanded first (xacro ARM.xacro > ARM.urdf); " if ending == ".xacro" else ""
    raise InputError(
        f"'{sanitise_file_name(name)}' cannot be opened here: {hint}"
        "give an arm as URDF (.urdf, .xml) or DH table (.yaml, .yml), or a motion as CSV"
    )


def sanitise_file_name(name: str) -> str:
    """Return the last part of a file's name, with other characters than letters, digits and ``+-._`` replaced."""
    cleaned = re.sub(r"[^\w.+-]", "_", re.split(r"[/\\]", name)[-1])[-80:].lstrip(".-")
    return cleaned or "file"


@contextmanager
def open_uploaded_arm(name: str, content: bytes) -> Iterator[tuple[CompiledArm, State]]:
    """Open the arm of an uploaded URDF file or DH table, with its first view, in a ``with`` block in which the file exists.

    Raises:
        HoldfastError: The file is too large or invalid, or its arm has more than 40 joints.
    """
    with _provide_temporary_file(name, content) as file:
        if file.suffix.lower() in (".yaml", ".yml"):
            from holdfast.model.arms import dh_file

            arm = dh_file.load_dh_file(file)
        else:
            arm = Arm.from_urdf(file)  # never MJCF, which may name other files that would be opened
        if arm.n > MAX_JOINTS:
            raise InputError(f"'{sanitise_file_name(name)}' has {arm.n} joints; the page takes arms of at most {MAX_JOINTS}")
        task, q = default_task("", arm), generic_configuration(arm)
        state = State(file.name, arm.joint_names, tuple(float(value) for value in q), task=task)
        yield CompiledArm(arm, as_task(arm, task)), state


def read_uploaded_motion(arm: Arm, name: str, content: bytes) -> PlayedMotion:
    """Read the motion of an uploaded CSV file; see :func:`holdfast.interface.studio.motions.read_motion`."""
    with _provide_temporary_file(name, content) as file:
        return read_motion(arm, file)


@contextmanager
def _provide_temporary_file(name: str, content: bytes) -> Iterator[Path]:
    """Provide the content in a ``with`` block as a file in a separate folder; errors contain only the name of the upload."""
    if len(content) > MAX_FILE_BYTES:
        raise InputError(f"'{sanitise_file_name(name)}': {_TOO_LARGE}")
    with TemporaryDirectory(prefix="holdfast-studio-") as folder:
        file = Path(folder) / sanitise_file_name(name)
        file.write_bytes(content)
        try:
            yield file
        except HoldfastError as error:
            raise type(error)(str(error).replace(f"{folder}/", "").replace(folder, "")) from None
