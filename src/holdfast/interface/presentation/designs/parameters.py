"""Parameters of the best design, its parameters at bounds, and its arm file, for both kinds of design search."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.presentation import Notice, TableSpec
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.report.page import Block, Code, Section, Text
from holdfast.studies.designs.space import DesignParameter, DesignSpace

ARM_FILE = "best-arm.yaml"
_BOUND_TOLERANCE = 1e-6  # fraction of the distance between the bounds
_PARAMETER_DESCRIPTIONS = {
    "a": "length of link {row} (a)",
    "alpha": "twist of link {row} (alpha)",
    "d": "offset of joint {row} (d)",
    "theta": "angle of joint {row} at 0 (theta)",
    "lower": "lower limit of joint {row}",
    "upper": "upper limit of joint {row}",
    "x": "x of the tool point",
    "y": "y of the tool point",
    "z": "z of the tool point",
    "roll": "roll of the tool",
    "pitch": "pitch of the tool",
    "yaw": "yaw of the tool",
}


def _name_reached_bound(parameter: DesignParameter, value: float) -> str:
    """Return ``lower`` or ``upper`` if a value is at that bound of the parameter, else an empty string."""
    slack = _BOUND_TOLERANCE * (parameter.upper - parameter.lower)
    return "lower" if value <= parameter.lower + slack else "upper" if value >= parameter.upper - slack else ""


def list_bound_notices(space: DesignSpace, best: FloatArray) -> list[Notice]:
    """Return a notice with the parameters of the best design (k,) that are at their bounds, if any."""
    bounded = [
        f"{parameter.name} ({parameter.text(value)})"
        for parameter, value in zip(space.parameters, best.tolist(), strict=True)
        if _name_reached_bound(parameter, value)
    ]
    if not bounded:
        return []
    verb_phrase = "is at its bound" if len(bounded) == 1 else "are at their bounds"
    text = f"{', '.join(bounded)} of the best design {verb_phrase}. Wider bounds may give a better design, if it can be built."
    return [Notice(text, title="Bounds")]


def tabulate_parameters(space: DesignSpace, best: FloatArray) -> TableSpec:
    """Tabulate the parameters of the baseline arm and of the best design (k,); a section of the page contains this table."""
    columns = ["parameter", "description", "baseline arm", "best design", "bounds", ""]
    rows = []
    for parameter, before, after in zip(space.parameters, space.start.tolist(), best.tolist(), strict=True):
        row_number = None if parameter.row is None else parameter.row + 1
        description = _PARAMETER_DESCRIPTIONS[parameter.kind].format(row=row_number)
        bound_name = _name_reached_bound(parameter, after)
        bounds = f"{parameter.text(parameter.lower)} to {parameter.text(parameter.upper)}"
        remark = f"at the {bound_name} bound" if bound_name else ""
        rows.append([parameter.name, description, parameter.text(before), parameter.text(after), bounds, remark])
    title = "Design parameters in the Denavit-Hartenberg table of the arm, with rows and joints numbered from the base"
    return TableSpec(title, columns, rows, on_page=False)


def build_arm_section(
    space: DesignSpace, best: FloatArray, arm_file: str, remark: str, further_blocks: Sequence[Block] = ()
) -> Section:
    """Build the section with the parameters of the best design (k,), and its arm file, which every command accepts."""
    table = build_table_block(tabulate_parameters(space, best).texts())
    label = Markup("File of the best arm, <code>{}</code>, which every command accepts as ARM:").format(ARM_FILE)
    return Section("Best design", [table, Code(arm_file.rstrip(), label), Text(remark, quiet=True), *further_blocks])
