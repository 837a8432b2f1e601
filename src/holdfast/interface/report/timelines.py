"""Figures of quantities over time during a motion: large panels one below another, and small panels side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from markupsafe import Markup

from holdfast.core.formatting import shorten_to_one_line
from holdfast.core.progress import count_finished_part
from holdfast.core.typing import FloatArray
from holdfast.interface.report.page import create_template_environment
from holdfast.interface.report.palette import BLUE, INK, ORANGE, SOFT
from holdfast.interface.report.scales import AxisScale, Kind

Look = Literal["first", "second", "third", "compared", "level"]

# Colours of Okabe and Ito, darkened for thin lines; dashes distinguish lines that look alike in a black-and-white print.
LINE_COLORS = (BLUE, ORANGE, "#1b7f5c", "#8a3d82", "#8f6a00", "#2a93c0", SOFT, "#a32638", INK)
_LINE_DASHES: tuple[tuple[float, ...], ...] = ((), (5, 1.5), (1.5, 1.2))  # in multiples of the line width
_LOOK_STYLES: dict[Look, tuple[str, float, tuple[float, ...]]] = {
    "first": (BLUE, 2.1, ()),
    "second": (ORANGE, 1.9, (5, 1.5)),
    "third": ("#1b7f5c", 1.9, (1.5, 1.2)),
    "compared": (INK, 1.6, (4.5, 2)),
    "level": (SOFT, 1.5, (1.2, 1.6)),
}
_MOMENT_STYLE = {"color": ORANGE, "width": 1.3, "dashes": "", "label": "algorithmic singularity"}
_PAGE_WIDTH_PX = 960  # width of a page, pixels
_LETTER_WIDTH_PX = 7.2  # upper estimate of the average width of a letter, pixels
_LEGEND_ROW_PX = 17  # height of a line of a legend, pixels


@dataclass(frozen=True)
class TimelineLine:
    """Quantity over time: values (T,), label, and style; without a style, the line gets the next unused colour."""

    values: FloatArray
    label: str
    look: Look | None = None


@dataclass(frozen=True)
class Timeline:
    """Panel with lines over one time axis.

    Attributes:
        lines: Quantities to draw.
        ylabel: Label of the vertical axis, with the unit.
        title: Title of the panel.
        moments: Times, s, that are marked by a vertical line.
        scale: Scale of the values: ``linear``, ``log``, or ``symlog``, which is linear between ``-small`` and ``small``.
        small: Half width of the linear part of a ``symlog`` scale.
    """

    lines: Sequence[TimelineLine]
    ylabel: str
    title: str
    moments: Sequence[float] = ()
    scale: Kind = "linear"
    small: float = 1.0


def draw_stacked_panels(time: FloatArray, panels: Sequence[Timeline], about: str) -> Markup:
    """Draw panels over times (T,), s, one below another, each with a legend to its right if it has several lines.

    Returns SVG with the text alternative ``about``.
    """
    layouts = [_PanelLayout(time, timeline, 190, 8) for timeline in panels]
    legends = [
        layout.legend if len(timeline.lines) > 1 or timeline.moments else []
        for layout, timeline in zip(layouts, panels, strict=True)
    ]
    legend_width = max((_label_width_px([entry["label"] for entry in entries]) + 60 for entries in legends), default=0)
    left_margin = 28 + max(layout.tick_label_width for layout in layouts)
    axes_width, panel_top, placed_panels = _PAGE_WIDTH_PX - left_margin - 12 - legend_width, 0.0, []
    for panel_index, (panel, layout, entries) in enumerate(zip(panels, layouts, legends, strict=True)):
        panel_top += 26
        legend = [
            {**entry, "x": left_margin + axes_width + 14, "y": panel_top + 12 + _LEGEND_ROW_PX * entry_row}
            for entry_row, entry in enumerate(entries)
        ]
        xlabel = "time, s" if panel_index == len(panels) - 1 else ""
        placed_panels.append(
            {
                **layout.to_template_data(left_margin, panel_top, axes_width),
                "left": 14,
                "ylabel": panel.ylabel,
                "xlabel": xlabel,
                "legend": legend,
            }
        )
        panel_top += max(190, _LEGEND_ROW_PX * len(legend)) + 12
    return _render_panels(placed_panels, panel_top + 28, [], about)


def draw_small_multiples(time: FloatArray, panels: Sequence[Timeline], about: str, xlabel: str = "time, s") -> Markup:
    """Draw small panels over times (T,), three in a row, with one legend below, that of the panel with the most lines.

    Returns SVG with the text alternative ``about``.
    """
    column_count = min(3, len(panels))
    layouts = [_PanelLayout(time, timeline, 132, 4) for timeline in panels]
    units = [
        timeline.ylabel if panel_index % column_count == 0 or timeline.ylabel != panels[panel_index - 1].ylabel else ""
        for panel_index, timeline in enumerate(panels)
    ]
    columns = [range(panel_index, len(panels), column_count) for panel_index in range(column_count)]
    left_margins = [
        10 + max(layouts[index].tick_label_width for index in column) + (18 if any(units[index] for index in column) else 0)
        for column in columns
    ]
    axes_width = (_PAGE_WIDTH_PX - sum(left_margins) - 14 * column_count) / column_count
    row_top, placed_panels = 0.0, []
    for row_start in range(0, len(panels), column_count):
        row = range(row_start, min(row_start + column_count, len(panels)))
        is_lowest = [panel_index >= len(panels) - column_count for panel_index in row]  # the last of its column
        row_top += 28
        for panel_index, has_xlabel in zip(row, is_lowest, strict=True):
            panel_left = sum(left_margins[: panel_index - row_start + 1]) + (axes_width + 14) * (panel_index - row_start)
            label_left, time_label = panel_left - left_margins[panel_index - row_start] + 14, xlabel if has_xlabel else ""
            placed_panels.append(
                {
                    **layouts[panel_index].to_template_data(panel_left, row_top, axes_width),
                    "left": label_left,
                    "ylabel": units[panel_index],
                    "xlabel": time_label,
                    "legend": [],
                }
            )
        row_top += 132 + (40 if any(is_lowest) else 8)
    entries = max((layout.legend for layout in layouts), key=len)
    entry_width = _label_width_px([entry["label"] for entry in entries]) + 60
    entries_per_row = max(1, min(len(entries), 5, int(_PAGE_WIDTH_PX / entry_width)))
    legend_left = (_PAGE_WIDTH_PX - entry_width * entries_per_row) / 2
    legend = [
        {
            **entry,
            "x": legend_left + entry_width * (entry_index % entries_per_row),
            "y": row_top + 18 + _LEGEND_ROW_PX * (entry_index // entries_per_row),
        }
        for entry_index, entry in enumerate(entries)
    ]
    return _render_panels(
        placed_panels, row_top + 26 + _LEGEND_ROW_PX * (-(-len(entries) // entries_per_row) - 1), legend, about
    )


def _render_panels(panels: list[dict[str, Any]], height: float, legend: list[dict[str, Any]], about: str) -> Markup:
    count_finished_part("figure")
    template = create_template_environment().get_template("timelines.html")
    return Markup(
        template.render(
            panels=panels, below=legend, about=about, width=_PAGE_WIDTH_PX, height=round(height), ink=INK, soft=SOFT
        )
    )


def _label_width_px(labels: Sequence[str]) -> float:
    """Return the width in pixels of the longest label."""
    return _LETTER_WIDTH_PX * max((len(text) for text in labels), default=0)


class _PanelLayout:
    """Layout of a panel before it is placed: ``tall_px`` pixels high, with about ``max_ticks`` ticks on the time axis."""

    def __init__(self, time: FloatArray, panel: Timeline, tall_px: float, max_ticks: int) -> None:
        self._time, self._panel, self._height = time, panel, tall_px
        all_values = np.concatenate([line.values for line in panel.lines])
        self._value_scale = AxisScale(
            all_values, panel.scale, panel.small, 0.1 if panel.scale == "linear" else 0.05, int(tall_px / 24)
        )
        self._time_scale = AxisScale(time[[0, -1]], max_spaces=max_ticks)
        self.tick_label_width = _label_width_px([text for _, text in self._value_scale.ticks])
        self._line_styles = [_style_line(line_index, line) for line_index, line in enumerate(panel.lines)]
        self.legend = self._line_styles + ([_MOMENT_STYLE] if panel.moments else [])

    def to_template_data(self, x: float, y: float, axes_width: float) -> dict[str, Any]:
        """Return the data for the template, with the upper left corner of the axes at x, y (pixels)."""
        moments = self._time_scale.to_fraction(np.array(self._panel.moments, dtype=float))
        across = x + axes_width * self._time_scale.to_fraction(self._time)
        heights = (y + self._height * (1 - self._value_scale.to_fraction(line.values)) for line in self._panel.lines)
        paths = (_to_svg_path(across, height) for height in heights)
        styled_paths = list(zip(self._line_styles, paths, strict=True))
        styled_paths += [(_MOMENT_STYLE, f"M{x + axes_width * fraction:.2f} {y:g}v{self._height:g}") for fraction in moments]
        return {
            "x": round(x, 2),
            "y": y,
            "wide": round(axes_width, 2),
            "tall": self._height,
            "title": shorten_to_one_line(self._panel.title, 90),
            "across": [(round(x + axes_width * fraction, 2), text) for fraction, text in self._time_scale.ticks],
            "upward": [(round(y + self._height * (1 - fraction), 2), text) for fraction, text in self._value_scale.ticks],
            "curves": [{**line_style, "way": path} for line_style, path in styled_paths],
        }


def _style_line(line_index: int, line: TimelineLine) -> dict[str, Any]:
    """Return the colour, width, dashes, and label of a line of a panel, by its index from 0."""
    own_style = (LINE_COLORS[line_index % len(LINE_COLORS)], 1.9, _LINE_DASHES[(line_index // 3) % len(_LINE_DASHES)])
    color, width, dashes = own_style if line.look is None else _LOOK_STYLES[line.look]
    scaled = " ".join(f"{width * dash:.3g}" for dash in dashes)
    return {"color": color, "width": width, "dashes": scaled, "label": shorten_to_one_line(line.label)}


def _to_svg_path(x: FloatArray, y: FloatArray) -> str:
    """Convert points (T,) to an SVG path, interrupted where a value is not finite."""
    is_finite = np.isfinite(y)
    is_start = is_finite & ~np.r_[False, is_finite[:-1]]
    points = np.round(np.stack([x, y], axis=1)[is_finite], 1).tolist()
    return "".join(
        f"{'M' if starts_piece else 'L'}{point_x:g} {point_y:g}"
        for starts_piece, (point_x, point_y) in zip(is_start[is_finite].tolist(), points, strict=True)
    )
