"""Interactive 3-D view of an arm, embedded in a page without a server, network, or other file.

The script ``templates/viewer.js`` (23 kB) is built from ``page/src/viewer`` by ``make page``. A page contains it once, for any
number of views. A still drawing is shown until the script has drawn the same picture, without JavaScript, and in print.
"""

from __future__ import annotations

import json
import re
from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from html import escape
from importlib import resources
from typing import Any

import numpy as np
from markupsafe import Markup
from numpy.typing import ArrayLike, NDArray

from holdfast.core.typing import FloatArray
from holdfast.interface.report.palette import BLUE, FAINT, GREEN, ORANGE, PURPLE, SOFT

_TAN_HALF_VIEW_ANGLE = np.tan(np.radians(14))  # the same angle of view as in camera.ts
_DRAWING_SIDE_PX = 400  # side of the square that a view always contains; it draws beyond the square where there is room
_RING_CORNERS = 20  # corners of each end of a tube, as in hulls.ts
_MESH_DIRECTIONS = 320  # directions in which a mesh keeps its extreme vertex, as in hulls.ts
_HULL_DIRECTIONS = 72  # directions on the drawing in which a hull has its corners
_DRAWING_COLORS = {  # those of viewer.css; a page without it has the second colour
    name: f"var(--view3d-{name}, {color})"
    for name, color in (
        *(("green", GREEN), ("blue", BLUE), ("purple", PURPLE), ("orange", ORANGE)),
        *(("soft", SOFT), ("faint", FAINT), ("outline", SOFT)),
    )
}
_VIEW_NOTE = '<p class="view3d-note view3d-once">{}</p>'
_BODY_HTML = '<div class="view3d-body" data-key="{}" hidden><script type="application/json">{}</script></div>'


@dataclass(frozen=True)
class ViewerScene:
    """Content of a 3-D view.

    Attributes:
        data: Data for the script; ``page/src/viewer/scene.ts`` describes the fields.
        frames: (A, F, K, 4, 4) poses of base, joints, and end effector of each arm, in each frame of its motion.
        notes: Sentences below the view, for example on missing meshes.
    """

    data: Mapping[str, Any]
    frames: FloatArray
    notes: tuple[str, ...] = ()

    def to_html(self, name: str, about: str) -> Markup:
        """Return the view as part of a page; :func:`embed_viewer_library` adds the script that makes it interactive.

        Args:
            name: Id of the view, unique in the page.
            about: Text alternative of the view.
        """
        escaped_about = escape(about, quote=True)
        labels = [arm["label"] for arm in self.data["arms"]]
        swatch = '<span><i style="background:{}"></i>{}</span>'
        colors = ["#8b96a1", "var(--view3d-green)", "var(--view3d-blue)", "var(--view3d-purple)", "var(--view3d-orange)"]
        legend = " ".join(swatch.format(colors[k % 5], escape(label)) for k, label in enumerate(labels))
        locked_names = [
            joint["name"] for joint, value in zip(self.data["joints"], self.data["locked"], strict=True) if value is not None
        ]
        free_names = [self.data["joints"][arm_index]["name"] for arm_index in self.data["free"]]
        joint_notes = [
            f"{condition}: {', '.join(text_part)}."
            for condition, text_part in (("Locked", locked_names), ("Swinging freely", free_names))
            if text_part
        ]
        body_json = to_script_json(self.data["parts"])
        body_key = sha256(body_json.encode()).hexdigest()[:12]
        scene_json = to_script_json({**self.data, "parts": body_key})
        return Markup(
            f'<div class="view3d" id="{escape(name, quote=True)}" role="group" aria-label="{escaped_about}">\n'
            f'<div class="view3d-stage">{draw_scene_svg(self, about)}<canvas tabindex="0" role="img" '
            f'aria-label="{escaped_about}"></canvas>'
            '</div>\n<div class="view3d-controls"></div>\n'
            + (f'<p class="view3d-legend">{legend}</p>\n' if len(labels) > 1 else "")
            + "".join(_VIEW_NOTE.format(escape(line)) + "\n" for line in self.notes)
            + "".join(f'<p class="view3d-note">{escape(line)}</p>\n' for line in joint_notes)
            + '<p class="view3d-hint">Enable JavaScript to rotate this view.</p>\n'
            f'<script type="application/json">{scene_json}</script>\n{_BODY_HTML.format(body_key, body_json)}\n</div>'
        )


def to_script_json(data: Any) -> str:
    """Encode data as JSON that cannot end the surrounding script element."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("</", "<\\/").replace("<!--", "\\u003c!--")


@cache
def read_template(name: str) -> str:
    """Return the text of a template."""
    return resources.files("holdfast.interface.report").joinpath("templates", name).read_text(encoding="utf-8")


def embed_viewer_library(html: str) -> str:
    """Add the viewer's style and script to a page, and keep one copy of each body and note; a page without views is
    unchanged.
    """
    if '<div class="view3d"' not in html:
        return html
    embedded: set[str] = set()

    def keep_first(match: re.Match[str]) -> str:
        if match[1] in embedded:
            return ""
        embedded.add(match[1])
        return match[0]

    for pattern in (_BODY_HTML, _VIEW_NOTE):
        html = re.sub(re.escape(pattern).replace(r"\{\}", "(.*?)"), keep_first, html)
    styled = html.replace("</head>", f"<style>\n{read_template('viewer.css')}</style>\n</head>", 1)
    page_start, _, tail = styled.rpartition("</body>")
    return f"{page_start}<script>{read_template('viewer.js').strip()}</script>\n</body>{tail}"


# In a notebook, the frame around the page sends a message with the theme of the notebook, light or dark.
COLOR_SCHEME_SCRIPT = """
addEventListener("message", ({ data, source }) => {
  if (source !== parent || typeof data?.dark !== "boolean") return;
  document.documentElement.style.colorScheme = data.dark ? "dark" : "light";
});
"""


def build_view_page(view: Markup, title: str) -> str:
    """Build a page with only a view, as large as the window, in the light or dark theme of the browser or the notebook."""
    return embed_viewer_library(
        '<!DOCTYPE html>\n<html lang="en" class="view3d-page">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<script>{COLOR_SCHEME_SCRIPT}</script>\n</head>\n"
        f"<body>\n<main>\n<h1>{escape(title)}</h1>\n{view}\n</main>\n</body>\n</html>\n"
    )


# ---- numbers -----------------------------------------------------------------------------------------------------------


def round_to_seven_digits(values: ArrayLike) -> list[Any]:
    """Round values to seven significant digits (0.1 micrometre per metre), as nested lists."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim > 1:
        return [round_to_seven_digits(item) for item in array]
    return [float(f"{item:.7g}") + 0.0 for item in array]


def pack_mesh(vertices: FloatArray, faces: NDArray[np.int64]) -> dict[str, Any]:
    """Encode a mesh as base64 text, with vertices rounded to 1/65535 of its size, which is not visible.

    Args:
        vertices: (V, 3) vertices, m; at most 65536.
        faces: (F, 3) vertex indices of the triangles.
    """
    lower = vertices.min(axis=0)
    longest_side = float(np.ptp(vertices, axis=0).max()) or 1.0
    points = np.rint((vertices - lower) * (65535 / longest_side)).astype("<u2")
    arrays = {"points": points, "faces": faces.astype("<u2")}
    return {"low": round_to_seven_digits(lower), "side": round_to_seven_digits([longest_side])[0]} | {
        key: b64encode(array.tobytes()).decode() for key, array in arrays.items()
    }


def simplify_mesh(vertices: FloatArray, faces: NDArray[np.int64], max_faces: int) -> tuple[FloatArray, NDArray[np.int64]]:
    """Reduce a mesh to at most ``max_faces`` triangles by vertex clustering in the finest grid that suffices.

    Rossignac and Borrel 1993.

    Args:
        vertices: (V, 3) vertices, m.
        faces: (F, 3) vertex indices of the triangles.
        max_faces: Maximum number of triangles.
    """
    if len(faces) <= max_faces and len(vertices) <= 65536:
        return vertices, faces
    lower, longest_side = vertices.min(axis=0), float(np.ptp(vertices, axis=0).max()) or 1.0
    min_cells, max_cells = 2, 1024  # cells along the longest edge
    simplified = (vertices[:1], faces[:0])
    while min_cells <= max_cells:
        cells = (min_cells + max_cells) // 2
        cell_coordinates = np.minimum((vertices - lower) * (cells / longest_side), cells - 1).astype(np.int64)
        _, vertex_cells = np.unique(cell_coordinates @ [cells * cells, cells, 1], return_inverse=True)
        corners = vertex_cells[faces]
        retained_faces = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
        if len(retained_faces) <= max_faces:
            cell_counts = np.bincount(vertex_cells)
            centers = (
                np.stack([np.bincount(vertex_cells, vertices[:, axis]) for axis in range(3)], axis=1) / cell_counts[:, None]
            )
            used_cells, corners = np.unique(retained_faces, return_inverse=True)
            simplified, min_cells = (centers[used_cells], corners.reshape(retained_faces.shape)), cells + 1
        else:
            max_cells = cells - 1
    return simplified


# ---- still drawing --------------------------------------------------------------------------------------------------


def camera_axes(camera: Mapping[str, Any], up: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return unit vectors (3,) to the right, upward and towards the camera, and its distance, m, as camera.ts does."""
    upward = np.asarray(up, dtype=np.float64)
    east = np.eye(3)[0] if abs(upward[0]) < 0.9 else np.eye(3)[1]
    east = east - upward * (upward @ east)
    east /= np.linalg.norm(east)
    north = np.cross(upward, east)
    (azimuth_cos, azimuth_sin), elevation = (np.cos(camera["azimuth"]), np.sin(camera["azimuth"])), camera["elevation"]
    back = np.cos(elevation) * (azimuth_cos * east + azimuth_sin * north) + np.sin(elevation) * upward
    right = -azimuth_sin * east + azimuth_cos * north
    return right, np.cross(back, right), back, 1.04 * camera["radius"] / float(np.sin(np.arctan(_TAN_HALF_VIEW_ANGLE)))


def part_corners(part: Mapping[str, Any]) -> FloatArray:
    """Return points (V, 3), m, whose convex hull is that of an encoded part, in the frame of its link, as hulls.ts does."""
    if "mesh" in part:
        low, side, points = (part["mesh"][key] for key in ("low", "side", "points"))
        vertices = np.array(low) + np.frombuffer(b64decode(points), "<u2").reshape(-1, 3) * (side / 65535)
        return np.asarray(vertices[np.unique(np.argmax(vertices @ _spread_directions(_MESH_DIRECTIONS).T, axis=0))])
    start, end, radius = np.array(part["tube"][:3]), np.array(part["tube"][3:6]), part["tube"][6]
    axis = (end - start) / np.linalg.norm(end - start)
    first = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
    first /= np.linalg.norm(first)
    angles = np.linspace(0, 2 * np.pi, _RING_CORNERS, endpoint=False)[:, None]
    ring = radius * (np.cos(angles) * first + np.sin(angles) * np.cross(axis, first))
    return np.concatenate([start + ring, end + ring])


def _spread_directions(count: int) -> FloatArray:
    """Return unit vectors (count, 3) that are spread evenly over a sphere, on a spiral by the golden angle."""
    index = np.arange(count)
    heights, angles = 1 - (2 * index + 1) / count, np.pi * (3 - np.sqrt(5)) * index
    radii = np.sqrt(1 - heights**2)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles), heights], axis=1)


def draw_scene_svg(scene: ViewerScene, about: str) -> str:
    """Draw the initial view of the scene as SVG, and the last frame of a motion as a transparent arm."""
    data, colors = scene.data, _DRAWING_COLORS
    right, upward, towards_camera, distance = camera_axes(data["camera"], data["up"])
    center = np.array(data["camera"]["center"])

    def project(points: ArrayLike) -> FloatArray:
        centered = np.asarray(points, dtype=np.float64) - center
        scale = _DRAWING_SIDE_PX / 2 / _TAN_HALF_VIEW_ANGLE / (distance - centered @ towards_camera)
        return _DRAWING_SIDE_PX / 2 + np.stack([scale * (centered @ right), -scale * (centered @ upward)], axis=-1)

    def draw_lines(points: ArrayLike, color: str, width: float, attributes: str = "") -> str:
        """Draw a polyline (P, 3), or several (L, P, 3)."""
        pixels = project(points)
        lines = "".join("M" + _format_points(line) for line in pixels.reshape(-1, *pixels.shape[-2:]))
        return f'<path d="{lines}" fill="none" stroke="{color}" stroke-width="{width}"{attributes}/>'

    def draw_label(text: str, point: ArrayLike) -> str:
        x, y = project(point)
        x = np.clip(x, 3.6 * len(text), _DRAWING_SIDE_PX - 3.6 * len(text))
        text_style = f'font-size="13" text-anchor="middle" fill="{colors["orange"]}"'
        return f'<text x="{x:.1f}" y="{y - 12:.1f}" {text_style}>{escape(text)}</text>'

    def draw_arm(arm: int, frame: int, opacity: float = 1.0, marks: bool = False) -> str:
        """Draw the hulls of an arm, objects and far parts first, or the marks of failed joints."""
        failed = {
            joint: color for joint, (color, since) in failures.items() if not data["time"] or since <= data["time"][frame]
        }
        shapes = []
        for part in data["parts"]:
            is_shown = part.get("joint") in failed if marks else part["frame"] or not arm
            if part.get("mark", False) is marks and is_shown:
                pose = scene.frames[arm, frame, part["frame"]]
                points = part_corners(part) @ pose[:3, :3].T + pose[:3, 3]
                depth_mm = round(1000 * float(distance - (points.mean(axis=0) - center) @ towards_camera))
                color = arm_colors[arm % 5] if arm else "rgb({},{},{})".format(*part["color"])
                hull = _draw_hull(part, project(points), failed.get(part.get("joint"), color))
                shapes.append(("object" not in part, -depth_mm, hull))
        hulls = "".join(hull for *_, hull in sorted(shapes, key=lambda shape: shape[:2]))
        return f'<g stroke="{colors["outline"]}" opacity="{opacity}">{hulls}</g>'

    failures = dict.fromkeys(data["free"], (colors["purple"], 0.0))
    failures |= {joint: (colors["orange"], since) for joint, since in enumerate(data["locked"]) if since is not None}
    arm_colors = ["currentColor", *colors.values()]
    elements = [
        f'<svg viewBox="0 0 {_DRAWING_SIDE_PX} {_DRAWING_SIDE_PX}" role="img" aria-label="{escape(about, quote=True)}" '
        'stroke-linejoin="round" stroke-linecap="round">',
        draw_lines(_floor_lines(data), colors["faint"], 1),
    ]
    arms, last_frame = range(len(scene.frames)), scene.frames.shape[1] - 1
    elements += [draw_arm(arm, last_frame, 0.5) for arm in reversed(arms) if last_frame]
    elements += [draw_arm(arm, 0, 0.5) for arm in reversed(arms) if arm]
    elements += [draw_arm(0, 0), draw_arm(0, 0, 0.75, marks=True)]
    for box in data["boxes"]:
        corners = np.array(
            [[(box["high"] if index >> axis & 1 else box["low"])[axis] for axis in range(3)] for index in range(8)]
        )
        edges = [(corner, corner | bit) for corner in range(8) for bit in (1, 2, 4) if not corner & bit]
        elements.append(draw_lines(corners[edges], colors["soft"], 1.4))
    if len(data["path"]) > 1:
        elements.append(draw_lines(data["path"], colors["orange"], 1.8, ' stroke-dasharray="5 4"'))
    if last_frame:
        elements.append(draw_lines(scene.frames[:, :, -1, :3, 3], colors["blue"], 2.4))
    for target in data["targets"]:
        x, y = project(np.reshape(target, (3, 4))[:, 3])
        elements.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="{colors["orange"]}" stroke-width="2"/>')
    tool = scene.frames[0, -1, -1, :3, 3]
    for lost_direction in data["lost"]:
        half_line = 0.26 * data["size"] * np.array(lost_direction["twist"][:3])
        elements += [
            draw_lines([tool - half_line, tool + half_line], colors["orange"], 3),
            draw_label(lost_direction["words"], tool + half_line),
        ]
    for index, joint in enumerate(data["joints"]):
        if data["locked"][index] is not None:
            elements.append(draw_label(f"{joint['name']} locked", scene.frames[0, -1, index + 1, :3, 3]))
    return "".join([*elements, "</svg>"])


def _format_points(points: FloatArray) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def _draw_hull(part: Mapping[str, Any], points: FloatArray, color: str) -> str:
    """Draw the convex hull of the drawing coordinates (V, 2) of a part, and the visible flat end of a tube."""
    turn = np.linspace(0, 2 * np.pi, _HULL_DIRECTIONS, endpoint=False)
    extremes = np.argmax(points @ [np.cos(turn), np.sin(turn)], axis=0)
    attributes = f'fill="{color}"' + (' opacity="0.35"' if "object" in part else "")
    hull = f'<polygon points="{_format_points(points[list(dict.fromkeys(extremes.tolist()))])}" {attributes}/>'
    if "tube" in part:
        for ring in (points[:_RING_CORNERS][::-1], points[_RING_CORNERS:]):
            x, y = ring.T
            if x @ np.roll(y, -1) < y @ np.roll(x, -1):  # the ring turns as seen from outside
                hull += f'<polygon points="{_format_points(ring)}" fill="#fff" fill-opacity="0.2"/>'
    return hull


def _floor_lines(data: Mapping[str, Any]) -> FloatArray:
    """Return the ends (L, 2, 3) of the lines of the floor, m, as things.ts does."""
    length = 2 * data["size"] / 8
    power = 10.0 ** np.floor(np.log10(length))
    step = power * next((factor for factor in (5, 2) if factor * power <= length), 1)
    count = min(int(np.ceil(1.1 * data["size"] / step)), 12)
    right, up, back, _ = camera_axes({"azimuth": 0.0, "elevation": 0.0, "radius": 1.0}, data["up"])
    center = np.reshape(data["base"], (3, 4))[:, 3] - 0.004 * data["size"] * up
    offsets, ends = step * np.arange(-count, count + 1), step * count * np.array([-1, 1])
    return np.concatenate(
        [center + offsets[:, None, None] * across + ends[:, None] * along for across, along in ((right, back), (back, right))]
    )
