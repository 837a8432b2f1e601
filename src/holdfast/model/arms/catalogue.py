"""Find arms by built-in name or by the path of a URDF, MJCF, or DH file."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from os import PathLike
from pathlib import Path

from holdfast.core.errors import ArmError
from holdfast.core.files import reading
from holdfast.model.arm import urdf
from holdfast.model.arm.model import Arm
from holdfast.model.arms.builtin import Builtin, about, load, names

__all__ = ["Builtin", "about", "command_words", "load", "names", "resolve"]

URDF_ENDINGS = (".urdf", ".xml")
MJCF_ENDINGS = (".mjcf",)
TABLE_ENDINGS = (".yaml", ".yml")


def resolve(spec: str, base: str | None = None, tip: str | None = None, *, hold: Mapping[str, float] | None = None) -> Arm:
    """Return the arm that a user names on the command line.

    Args:
        spec: Built-in name (see :func:`names`); path of a URDF or MJCF file ending in ``.urdf``, ``.mjcf`` or ``.xml`` (then
            the outermost element decides); or path of a DH table ending in ``.yaml`` or ``.yml`` (see
            :mod:`holdfast.model.arms.dh_file`).
        base: Link of a URDF file or body of an MJCF file on which the arm is mounted; see
            :func:`holdfast.model.arm.urdf.load_urdf` and :func:`holdfast.model.arm.mjcf.load_mjcf`.
        tip: Link of a URDF file, or body or site of an MJCF file, whose frame is the tool.
        hold: Values, rad or m, of held joints of a URDF or MJCF file.

    Raises:
        ArmError: There is no such arm, the file is wrong, or base, tip or hold are given although ``spec`` is neither a URDF
            nor an MJCF file.
        HoldfastError: The file is an MJCF file and MuJoCo is not installed.
    """
    if not isinstance(spec, (str, PathLike)) or "\0" in str(spec):
        raise ArmError(f"the arm is {spec!r}; give a built-in name or the path of a file")
    spec = str(spec)
    ending = Path(spec).suffix.lower()
    if spec in names() or ending in TABLE_ENDINGS:
        if base is not None or tip is not None or hold:
            raise ArmError(
                f"'{spec}' is not a URDF or MJCF file, so it has no links or joints to choose; leave out base, tip and hold"
            )
        if spec in names():
            return load(spec)
        from holdfast.model.arms import dh_file as table

        return table.load_dh_file(spec)
    if ending in MJCF_ENDINGS or (ending == ".xml" and root_element_name(spec) == "mujoco"):
        return Arm.from_mjcf(spec, base, tip, hold=hold)
    if ending in URDF_ENDINGS:
        return Arm.from_urdf(spec, base, tip, hold=hold)
    if ending == ".xacro":
        raise ArmError(f"'{spec}' is a xacro file; {urdf.xacro_advice(Path(spec))}")
    if reading.path_exists(spec):
        raise ArmError(
            f"'{spec}' is neither a URDF file (.urdf, .xml), an MJCF file (.mjcf, .xml) nor a DH table (.yaml, .yml); "
            "rename or convert it"
        )
    try:
        return load(spec)
    except ArmError as error:
        raise ArmError(
            f"{error}; give one of these (see 'holdfast arms'), a .urdf file, an .mjcf file or a .yaml DH table"
        ) from error


def command_words(arm: Arm) -> tuple[str, list[str], str]:
    """Return the command-line words for ``arm``: ARM, its options, and a remark on the parts that the reader must insert."""
    if arm.name in names() and load(arm.name).fingerprint == arm.fingerprint:
        return arm.name, [], ""
    is_file = arm.source.lower().endswith((*URDF_ENDINGS, *MJCF_ENDINGS, *TABLE_ENDINGS)) and "\n" not in arm.source
    spec = arm.source if is_file else "ARM"
    remark = "the file of the arm where you have it" if is_file else "ARM is the file of the arm"
    if arm.chain is None:
        return spec, [], remark
    tip = [] if arm.chain.tip is None else [("tip", arm.chain.tip)]
    options = [("base", arm.chain.base), *tip, *(("hold", f"{name}={value!r}") for name, value in arm.chain.held)]
    return spec, [f"--{option} {shlex.quote(value)}" for option, value in options], remark


def root_element_name(path: str) -> str:
    """Return the name of the outermost element of an XML file; empty if it is not valid XML, which its reader reports."""
    import io
    from xml.etree import ElementTree

    try:
        for _, element in ElementTree.iterparse(io.BytesIO(reading.read_bytes(path)), events=("start",)):
            return str(element.tag)
    except (OSError, ElementTree.ParseError, LookupError, ValueError):
        pass
    return ""
