"""Files dropped on the page, an arm or a motion, which are read without opening any other file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from holdfast.core.errors import HoldfastError, InputError
from holdfast.interface.presentation.arm.body import MeshPart
from holdfast.interface.presentation.arm.visuals import build_body
from holdfast.interface.studio.motions import PlayedMotion, read_motion
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import as_task
from holdfast.model.arms.spec import default_task

MAX_FILE_BYTES = 4 << 20  # bytes
MAX_JOINTS = 40  # an arm with more joints takes minutes to compile
ARM_SUFFIXES = (".urdf", ".xml", ".yaml", ".yml")
MOTION_SUFFIXES = (".csv",)
_PART_BYTES = 512 << 10  # size of one part of an upload through viser, bytes
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


def read_uploaded_arm(name: str, content: bytes) -> tuple[CompiledArm, State, list[MeshPart], str]:
    """Read the arm of an uploaded URDF file or DH table; return it with its state, meshes, and a note on missing ones.

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
        task = default_task("", arm)
        machine, q = CompiledArm(arm, as_task(arm, task)), generic_configuration(arm)
        state = State(file.name, arm.joint_names, tuple(float(value) for value in q), task=task)
        return machine, state, *build_body(arm, machine.size, meshes=False)


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


def limit_uploads(gui: Any, on_refused: Any) -> None:
    """Allow a client one upload at a time, of at most 4 MiB, and reject others on arrival.

    Args:
        gui: Viser GUI of the client.
        on_refused: Function that is called with the reason, one sentence.
    """
    from viser import _messages

    connection, start_transfer = gui._websock_interface, gui._handle_file_transfer_start

    def check_upload(client: Any, message: Any) -> None:
        waiting = gui._current_file_upload_states
        if (
            0 <= message.size_bytes <= MAX_FILE_BYTES
            and 0 <= message.part_count <= MAX_FILE_BYTES // _PART_BYTES
            and len(waiting) < 2
        ):
            start_transfer(client, message)
            return
        on_refused(f"'{sanitise_file_name(message.filename)}': {_TOO_LARGE}")
        connection.queue_message(  # otherwise the button would wait indefinitely
            _messages.FileTransferPartAck(
                source_component_uuid=message.source_component_uuid,
                transfer_uuid=message.transfer_uuid,
                transferred_bytes=message.size_bytes,
                total_bytes=message.size_bytes,
            )
        )

    connection.unregister_handler(_messages.FileTransferStartUpload, start_transfer)
    connection.register_handler(_messages.FileTransferStartUpload, check_upload)
