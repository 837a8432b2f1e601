"""Files that a person drops on the page: an arm or a motion, read without opening anything but what was sent."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from holdfast.arm.model import Arm
from holdfast.arm.postures import generic_configuration
from holdfast.arm.task import as_task
from holdfast.arms.spec import default_task
from holdfast.errors import HoldfastError, InputError
from holdfast.present.arm.body import Part
from holdfast.present.arm.visuals import body_of
from holdfast.studio.motions import Motion, read_motion
from holdfast.studio.scene.machine import Machine
from holdfast.studio.state import State

LARGEST = 4 << 20  # bytes
JOINTS = 40  # more take minutes to compile
ARMS, MOTIONS = (".urdf", ".xml", ".yaml", ".yml"), (".csv",)
_PART = 512 << 10  # bytes of a part of viser's
_TOO_LARGE = f"the file is too large; at most {LARGEST >> 20} MiB can be opened here"


def kind(name: str) -> str:
    """``arm`` or ``motion``, by the ending of a file's name.

    Raises:
        InputError: It is neither.
    """
    ending = Path(name).suffix.lower()
    if ending in MOTIONS:
        return "motion"
    if ending in ARMS:
        return "arm"
    what = "xacro files must be expanded first (xacro ARM.xacro > ARM.urdf); " if ending == ".xacro" else ""
    raise InputError(
        f"'{tidy(name)}' cannot be opened here: {what}"
        "give an arm as URDF (.urdf, .xml) or DH table (.yaml, .yml), or a motion as CSV"
    )


def tidy(name: str) -> str:
    """The last part of a file's name, without what does not belong into one."""
    found = re.sub(r"[^\w.+-]", "_", re.split(r"[/\\]", name)[-1])[-80:].lstrip(".-")
    return found or "file"


def read_machine(name: str, content: bytes) -> tuple[Machine, State, list[Part], str]:
    """The arm in a URDF file or a DH table that was sent, how it is shown first, its parts, and a note on missing meshes.

    Raises:
        HoldfastError: The file is too large, or wrong, or its arm has more than 40 joints.
    """
    with _alone(name, content) as file:
        if file.suffix.lower() in (".yaml", ".yml"):
            from holdfast.arms import dh_file

            arm = dh_file.load(file)
        else:
            arm = Arm.from_urdf(file)  # never MJCF: that may name other files, to be opened
        if arm.n > JOINTS:
            raise InputError(f"'{tidy(name)}' has {arm.n} joints; the page takes arms of at most {JOINTS}")
        task = default_task("", arm)
        machine, q = Machine(arm, as_task(arm, task)), generic_configuration(arm)
        state = State(file.name, arm.joint_names, tuple(float(x) for x in q), task=task)
        return machine, state, *body_of(arm, machine.size, meshes=False)


def read_sent_motion(arm: Arm, name: str, content: bytes) -> Motion:
    """The motion in a CSV file that was sent; see :func:`holdfast.studio.motions.read_motion`."""
    with _alone(name, content) as file:
        return read_motion(arm, file)


@contextmanager
def _alone(name: str, content: bytes) -> Iterator[Path]:
    """A block with the content in a file in a folder of its own; errors name the file as the person does."""
    if len(content) > LARGEST:
        raise InputError(f"'{tidy(name)}': {_TOO_LARGE}")
    with TemporaryDirectory(prefix="holdfast-studio-") as folder:
        file = Path(folder) / tidy(name)
        file.write_bytes(content)
        try:
            yield file
        except HoldfastError as error:
            raise type(error)(str(error).replace(f"{folder}/", "").replace(folder, "")) from None


def limit(gui: Any, refused: Any) -> None:
    """Let a client send one file at a time, of at most 4 MiB, and forget others as they come.

    Args:
        gui: The client's viser GUI.
        refused: Is told in a sentence.
    """
    from viser import _messages

    connection, begin = gui._websock_interface, gui._handle_file_transfer_start

    def checked(client: Any, message: Any) -> None:
        waiting = gui._current_file_upload_states
        if 0 <= message.size_bytes <= LARGEST and 0 <= message.part_count <= LARGEST // _PART and len(waiting) < 2:
            begin(client, message)
            return
        refused(f"'{tidy(message.filename)}': {_TOO_LARGE}")
        connection.queue_message(  # else the button waits for ever
            _messages.FileTransferPartAck(
                source_component_uuid=message.source_component_uuid,
                transfer_uuid=message.transfer_uuid,
                transferred_bytes=message.size_bytes,
                total_bytes=message.size_bytes,
            )
        )

    connection.unregister_handler(_messages.FileTransferStartUpload, begin)
    connection.register_handler(_messages.FileTransferStartUpload, checked)
