"""Load arms from whatever describes them: built-in names, files, texts, and model objects of other libraries."""

from __future__ import annotations

import hashlib
import io
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.files import reading
from holdfast.core.formatting import suggest_name
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.arms import robot_descriptions, xacro_file
from holdfast.model.arms.builtin import load_builtin, names

URDF_ENDINGS = (".urdf", ".xml")
MJCF_ENDINGS = (".mjcf",)
TABLE_ENDINGS = (".yaml", ".yml")
KNOWN_SOURCES = (
    "a built-in name, a file (.urdf, .xacro, .mjcf, .xml, or a .yaml DH table), the text of a URDF or MJCF file, a name of "
    "robot_descriptions, or a model object of MuJoCo, Pinocchio, yourdfpy, or the Robotics Toolbox"
)


@check_arguments
def load(
    source: object,
    *,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    group: str | None = None,
    name: str | None = None,
    srdf: str | Path | None = None,
    xacro: Mapping[str, str] | None = None,
    packages: str | Path | None = None,
) -> Arm:
    """Load an arm from whatever describes it.

    The libraries of model objects are not imported to recognise an object. An option that does not fit the source is an error.

    Args:
        source: One of these:

            - name of a built-in arm (see :func:`names`), which gives the same object each time
            - path of a URDF, MJCF, or xacro file, or of a DH table (``.yaml``, see :mod:`holdfast.model.arms.dh_file`); for
              ``.xml`` the outermost element decides
            - text of a URDF or MJCF file
            - name in the package robot_descriptions, such as ``gen3_description``, or
              ``robot_descriptions:NAME.VARIANT``; the first use clones a repository
            - ``mujoco.MjModel``, ``mujoco.MjSpec``, ``pinocchio.Model``, ``yourdfpy.URDF``, or a robot of the Robotics Toolbox
            - an :class:`~holdfast.Arm`
        base: Link or body on which the arm is mounted; default: the root.
        tip: Link, body, or site whose frame is the tool; default: the only end that is no finger.
        hold: Values, rad or m, of held joints, on the chain or next to it.
        group: Group of the SRDF file that gives base and tip.
        name: Name of the arm; default: that of the source.
        srdf: SRDF file; default: the file of the same name beside the URDF file, if it exists.
        xacro: Arguments of a xacro file.
        packages: Folder with the ROS packages that ``package://`` and ``$(find ...)`` name, which is searched first.

    Raises:
        ArmError: The source describes no serial arm, or an option does not fit it; the message names the joint or link.
        HoldfastError: The source needs a package that is not installed; the message contains the command that installs it.
    """
    options = {
        "base": base,
        "tip": tip,
        "hold": hold,
        "group": group,
        "name": name,
        "srdf": srdf,
        "xacro": xacro,
        "packages": packages,
    }
    given = {option: value for option, value in options.items() if value is not None and value != {}}
    label, reader = _find_reader(source)
    unused = [option for option in given if option not in reader.options]
    if unused:
        pronoun = "it" if len(unused) == 1 else "them"
        raise ArmError(f"{', '.join(unused)} cannot be chosen for {label}, which is {reader.title}; leave {pronoun} out")
    return reader.read(source, **given)


# ---- readers -----------------------------------------------------------------------------------------------------

_CHAIN_OPTIONS = ("base", "tip", "hold", "name")
_URDF_OPTIONS = (*_CHAIN_OPTIONS, "group", "srdf", "packages")


@dataclass(frozen=True)
class _Reader:
    """Reader of one kind of source.

    Attributes:
        title: Kind of the source, with an article.
        read: Function that takes the source and the options that were given.
        options: Options of :func:`load` that fit the source.
    """

    title: str
    read: Callable[..., Arm]
    options: tuple[str, ...]


def _find_reader(source: object) -> tuple[str, _Reader]:
    """Return the name of a source in error messages, and its reader."""
    libraries = {each.__module__.partition(".")[0] for each in type(source).__mro__}
    for library in _OBJECT_READERS.keys() & libraries:
        return f"this {type(source).__name__}", _OBJECT_READERS[library]
    if isinstance(source, Arm):
        return f"'{source.name}'", _Reader("an arm already", _rename, ("name",))
    is_text = isinstance(source, (str, PathLike))
    if not is_text or "\0" in str(source):
        shown = repr(source) if is_text else f"a {type(source).__module__}.{type(source).__name__}"
        raise ArmError(f"no arm can be made of {shown}; give {KNOWN_SOURCES}")
    text = str(source)
    if text.lstrip().startswith("<"):
        is_mjcf = root_element_name(io.BytesIO(text.lstrip().encode())) == "mujoco"
        return "the text", _MJCF_TEXT_READER if is_mjcf else _URDF_TEXT_READER
    if text in names():
        return f"'{text}'", _Reader("a built-in arm", lambda _, name=None: _rename(load_builtin(text), name), ("name",))
    if robot_descriptions.is_description(text):
        return f"'{text}'", _Reader("a robot description", _read_description, (*_URDF_OPTIONS, "xacro"))
    return f"'{text}'", _find_file_reader(Path(text))


def _find_file_reader(path: Path) -> _Reader:
    ending = path.suffix.lower()
    if ending in TABLE_ENDINGS:
        return _Reader("a DH table", _read_table, ("name",))
    if ending in MJCF_ENDINGS or (ending == ".xml" and root_element_name(path) == "mujoco"):
        return _Reader("an MJCF file", Arm.from_mjcf, _CHAIN_OPTIONS)
    if ending == ".xacro":
        return _Reader("a xacro file", _read_xacro, (*_URDF_OPTIONS, "xacro"))
    if ending in URDF_ENDINGS:
        return _Reader("a URDF file", _read_urdf, _URDF_OPTIONS)
    if reading.path_exists(path):
        raise ArmError(f"'{path}' is not a file of a known kind; give {KNOWN_SOURCES}")
    raise ArmError(
        f"there is no built-in arm or file '{path}'; {suggest_name(str(path).lower(), names())}"
        f"{robot_descriptions.suggest_description(str(path))}the built-in arms are {', '.join(names())}; "
        f"give {KNOWN_SOURCES}"
    )


def _rename(arm: Arm, name: str | None = None) -> Arm:
    return arm if name is None else replace(arm, name=name)


def _read_table(path: str | Path, name: str | None = None) -> Arm:
    from holdfast.model.arms import dh_file

    return _rename(dh_file.load_dh_file(path), name)


def _read_urdf(path: str | Path, packages: str | Path | None = None, **options: Any) -> Arm:
    return Arm.from_urdf(path, meshes=packages, **options)


def _read_xacro(path: str | Path, xacro: Mapping[str, str] | None = None, **options: Any) -> Arm:
    text = xacro_file.expand_xacro(Path(path), xacro or {}, options.get("packages"))
    return _read_urdf(_store_model(text.encode(), ".urdf"), label=Path(path).name, **options)


def _read_description(text: str, **options: Any) -> Arm:
    description = robot_descriptions.locate_description(text)
    options = {**description.options, **options}
    return replace(load(description.file, **options), source=text)


def _read_yourdfpy_object(robot: Any, **options: Any) -> Arm:
    label = f"yourdfpy model '{robot.robot.name}'"
    return _read_urdf(_store_model(robot.write_xml_string(), ".urdf"), label=label, **options)


def _read_mujoco_object(model: Any, **options: Any) -> Arm:
    from holdfast.model.arm.formats.mjcf import import_mujoco, model_name

    mujoco = import_mujoco()
    if isinstance(model, mujoco.MjSpec):
        model = model.copy().compile()  # a copy, because compiling changes the caller's spec
    if not isinstance(model, mujoco.MjModel):
        raise ArmError(f"no arm can be made of a mujoco.{type(model).__name__}; give its MjModel or MjSpec")
    content = np.empty(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, content)
    label = f"MuJoCo model '{model_name(model)}'"
    return Arm.from_mjcf(_store_model(content.tobytes(), ".mjb"), label=label, **options)


def _read_pinocchio_object(model: Any, **options: Any) -> Arm:
    from holdfast.model.arm.formats.pinocchio_model import import_pinocchio

    if not isinstance(model, import_pinocchio().Model):
        raise ArmError(f"no arm can be made of a pinocchio.{type(model).__name__}; give its Model")
    return Arm.from_pinocchio(model, **options)


def _read_toolbox_object(robot: Any, **options: Any) -> Arm:
    from holdfast.model.arms.robotics_toolbox import read_toolbox_robot

    return read_toolbox_robot(robot, **options)


def _read_urdf_text(text: str, **options: Any) -> Arm:
    return _read_urdf(_store_model(text.lstrip().encode(), ".urdf"), label="URDF text", **options)


def _read_mjcf_text(text: str, **options: Any) -> Arm:
    return Arm.from_mjcf(_store_model(text.lstrip().encode(), ".xml"), label="MJCF text", **options)


_URDF_TEXT_READER = _Reader("the text of a URDF file", _read_urdf_text, _URDF_OPTIONS)
_MJCF_TEXT_READER = _Reader("the text of an MJCF file", _read_mjcf_text, _CHAIN_OPTIONS)
_OBJECT_READERS = {
    "mujoco": _Reader("an object of MuJoCo", _read_mujoco_object, _CHAIN_OPTIONS),
    "pinocchio": _Reader("an object of Pinocchio", _read_pinocchio_object, _CHAIN_OPTIONS),
    "yourdfpy": _Reader("an object of yourdfpy", _read_yourdfpy_object, _URDF_OPTIONS),
    "roboticstoolbox": _Reader("an object of the Robotics Toolbox", _read_toolbox_object, _CHAIN_OPTIONS),
}


@cache
def _model_folder() -> TemporaryDirectory[str]:
    return TemporaryDirectory(prefix="holdfast-models-")


def _store_model(content: bytes, ending: str) -> Path:
    """Write a model to a file that exists as long as this process, from which the shapes of the arm are read later."""
    path = Path(_model_folder().name, hashlib.sha256(content).hexdigest()[:16] + ending)
    path.write_bytes(content)
    return path


def command_words(arm: Arm) -> tuple[str, list[str], str]:
    """Return the command-line words for ``arm``: ARM, its options, and a remark on the parts that the reader must insert."""
    if arm.name in names() and load_builtin(arm.name).fingerprint == arm.fingerprint:
        return arm.name, [], ""
    is_file = arm.source.lower().endswith((*URDF_ENDINGS, *MJCF_ENDINGS, *TABLE_ENDINGS, ".xacro")) and "\n" not in arm.source
    spec = arm.source if is_file else "ARM"
    remark = "the file of the arm where you have it" if is_file else "ARM is the file of the arm"
    if arm.chain is None:
        return spec, [], remark
    tip = [] if arm.chain.tip is None else [("tip", arm.chain.tip)]
    options = [("base", arm.chain.base), *tip, *(("hold", f"{name}={value!r}") for name, value in arm.chain.held)]
    return spec, [f"--{option} {shlex.quote(value)}" for option, value in options], remark


def is_mujoco_file(path: str | Path) -> bool:
    """Return whether MuJoCo reads a file: a stored model, or an XML file whose outermost element is ``mujoco``."""
    return Path(path).suffix == ".mjb" or root_element_name(path) == "mujoco"


def root_element_name(file: str | Path | io.BytesIO) -> str:
    """Return the name of the outermost element of an XML file; empty if it is not valid XML, which its reader reports."""
    from xml.etree import ElementTree

    try:
        content = file if isinstance(file, io.BytesIO) else io.BytesIO(reading.read_bytes(file))
        for _, element in ElementTree.iterparse(content, events=("start",)):
            return str(element.tag)
    except (OSError, ElementTree.ParseError, LookupError, ValueError):
        pass
    return ""
