"""Write an arm to a file that can be read back as the same arm."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files.output import replace_file
from holdfast.core.progress import print_warning
from holdfast.model.arm.machine import GRAVITY
from holdfast.model.arm.model import Arm
from holdfast.model.arms import dh_file
from holdfast.model.arms.dh_rows import bodies_in_row_frames, dh_table
from holdfast.model.arms.loading import TABLE_ENDINGS


def write_arm(arm: Arm, file: Path) -> Path:
    """Write an arm as a URDF file or as a Denavit-Hartenberg table; see :meth:`holdfast.Arm.save`."""
    ending = file.suffix.lower()
    if ending == ".urdf":
        replace_file(file, arm.to_urdf(), "arm file")
        lost_data = quantities_lost_in_urdf(arm)
        if lost_data:
            print_warning(
                f"'{file}' lacks {', '.join(lost_data)}, for which URDF has no place; save a .yaml file to keep all numbers"
            )
    elif ending in TABLE_ENDINGS:
        table = dh_table(arm)
        links, payload = bodies_in_row_frames(arm, table)
        text = dh_file.format_dh_file(table, arm.name, arm.gravity, arm.source, links=links, payload=payload)
        replace_file(file, text, "arm file")
    else:
        raise InputError(f"'{file}' has the ending '{file.suffix}'; give a name that ends in .urdf or .yaml")
    return file


def quantities_lost_in_urdf(arm: Arm) -> list[str]:
    """Return the names of the numbers of an arm that a URDF file cannot store."""
    one_sided = any(np.isfinite(joint.lower) != np.isfinite(joint.upper) for joint in arm.joints)
    losses = {
        "the gravity vector": not np.array_equal(arm.gravity, GRAVITY),
        "the payload": arm.payload is not None,
        "rotor inertias": any(joint.armature for joint in arm.joints),
        "stiction": any(joint.stiction > joint.coulomb_friction for joint in arm.joints),
        "limits on one side": one_sided,
    }
    return [name for name, is_lost in losses.items() if is_lost]
