"""Find the files of robots in the package robot_descriptions, which clones a repository when a robot is first used."""

from __future__ import annotations

import contextlib
import sys
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from holdfast.core.errors import ArmError
from holdfast.core.extras import import_extra
from holdfast.core.formatting import suggest_name

NAME_PREFIX = "robot_descriptions:"
NAME_ENDING = "_description"


@dataclass(frozen=True)
class Description:
    """File of a robot.

    Attributes:
        file: URDF, MJCF, or xacro file.
        options: Options of :func:`holdfast.model.arms.load` that belong to it.
    """

    file: Path
    options: dict[str, Any] = field(default_factory=dict)


def is_description(text: str) -> bool:
    """Return whether a text is a name in robot_descriptions."""
    return text.startswith(NAME_PREFIX) or (text.isidentifier() and text.endswith(NAME_ENDING))


def suggest_description(name: str) -> str:
    """Return a hint for a sentence if robot_descriptions has a robot of this name; nothing is cloned for it."""
    module = f"{name.lower()}{NAME_ENDING}"
    return f"robot_descriptions has '{module}', which it clones when first used; " if module in _description_names() else ""


def locate_description(text: str) -> Description:
    """Return the file of a robot, as ``NAME_description`` or ``robot_descriptions:NAME_description.VARIANT``.

    Raises:
        ArmError: There is no such robot or variant, or its repository cannot be cloned.
        HoldfastError: robot_descriptions is not installed.
    """
    import_extra("robot_descriptions", "descriptions")
    name, _, variant = text.removeprefix(NAME_PREFIX).partition(".")
    known = _description_names()
    if name not in known:
        advice = f"{suggest_name(name, known)}give one of its {len(known)} names, or a file"
        raise ArmError(f"robot_descriptions has no '{name}'; {advice}")
    try:
        with contextlib.redirect_stdout(sys.stderr):  # progress of the clone, which must not become part of an answer
            module = import_module(f"robot_descriptions.{name}")
    except Exception as error:  # git, the network, and the file system have many
        reason = " ".join(str(error).split())
        raise ArmError(
            f"robot_descriptions cannot provide '{name}' ({reason}); it clones a repository when a robot is first used, so "
            "connect this computer to the network, or give a file"
        ) from error
    suffix = f"_{variant.upper()}" if variant else ""
    for kind in ("URDF_PATH", "MJCF_PATH", "XACRO_PATH"):
        if file := getattr(module, kind + suffix, None):
            options = {"srdf": getattr(module, "SRDF_PATH", None), "xacro": getattr(module, "XACRO_ARGS", None)}
            allowed = {"URDF_PATH": ("srdf",), "MJCF_PATH": (), "XACRO_PATH": ("srdf", "xacro")}[kind]
            return Description(Path(file), {key: options[key] for key in allowed if options[key]})
    variants = sorted({key.partition("_PATH_")[2].lower() for key in vars(module) if key.partition("_PATH_")[2]})
    raise ArmError(
        f"robot_descriptions has no variant '{variant}' of '{name}'; its variants are {', '.join(variants) or 'none'}"
    )


def _description_names() -> list[str]:
    specification = find_spec("robot_descriptions")
    if specification is None or not specification.submodule_search_locations:
        return []
    folder = Path(specification.submodule_search_locations[0])
    return sorted(path.stem for path in folder.glob(f"*{NAME_ENDING}.py") if not path.stem.startswith("_"))
