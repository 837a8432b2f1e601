"""Interactive 3-D view of an arm, embedded in a page without a server, network, or other file.

The script ``templates/viewer.js`` (20 kB of WebGL) is built from ``page/src/viewer`` by ``make page``. A page contains it once,
for any number of views. Without JavaScript or WebGL, and in print, a still drawing is shown.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
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
from holdfast.interface.report.palette import BLUE, FAINT, ORANGE, SOFT

_TAN_HALF_VIEW_ANGLE = np.tan(np.radians(14))  # the same angle of view as in camera.ts
_DRAWING_WIDTH_PX = 560
_DRAWING_HEIGHT_PX = 400
_VIEW_NOTE = '<p class="view3d-note view3d-once">{}</p>'
_BODY_HTML = '<div class="view3d-body" data-key="{}" hidden><script type="application/json">{}</script></div>'


@dataclass(frozen=True)
class ViewerScene:
    """Content of a 3-D view.

    Attributes:
        data: Data for the script; ``page/src/viewer/scene.ts`` describes the fields.
        frames: (A, F, K, 4, 4) poses of base, joints, and end effector of each arm, in each frame of its motion.
        notes: Sentences below the view, for example on missing meshes.
        object_corners: Corners (V, 3) in the world, m, of each object around the arms; the still drawing shows its outline.
    """

    data: Mapping[str, Any]
    frames: FloatArray
    notes: tuple[str, ...] = ()
    object_corners: tuple[FloatArray, ...] = ()

    def to_html(self, name: str, about: str) -> Markup:
        """Return the view as part of a page; :func:`embed_viewer_library` adds the script that makes it interactive.

        Args:
            name: Id of the view, unique in the page.
            about: Text alternative of the view.
        """
        escaped_about = escape(about, quote=True)
        labels = [arm["label"] for arm in self.data["arms"]]
        swatch = '<i style="background:{}"></i>{}'
        colors = ["#8b96a1", "var(--view3d-green)", "var(--view3d-blue)", "var(--view3d-purple)", "var(--view3d-orange)"]
        legend = [swatch.format(colors[k % 5], escape(part)) for k, part in enumerate(labels)] if len(labels) > 1 else []
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
            + (
                f'<p class="view3d-legend">{" ".join(f"<span>{text_part}</span>" for text_part in legend)}</p>\n'
                if legend
                else ""
            )
            + "".join(_VIEW_NOTE.format(escape(line)) + "\n" for line in self.notes)
            + "".join(f'<p class="view3d-note">{escape(line)}</p>\n' for line in joint_notes)
            + '<p class="view3d-hint">Enable JavaScript to rotate this view.</p>\n'
            f'<script type="application/json">{scene_json}</script>\n{_BODY_HTML.format(body_key, body_json)}\n</div>'
        )


def to_script_json(data: Any) -> str:
    """Encode data as JSON that cannot end the surrounding script element."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("</", "<\\/")


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


def draw_scene_svg(scene: ViewerScene, about: str) -> str:
    """Draw the initial view of the scene as SVG, with the first and the last frame of a motion."""
    data = scene.data
    right, upward, towards_camera, distance = camera_axes(data["camera"], data["up"])
    center = np.array(data["camera"]["center"])

    def project(points: ArrayLike) -> FloatArray:
        centered = np.asarray(points, dtype=np.float64) - center
        scale = _DRAWING_HEIGHT_PX / 2 / _TAN_HALF_VIEW_ANGLE / (distance - centered @ towards_camera)
        return np.stack(
            [_DRAWING_WIDTH_PX / 2 + scale * (centered @ right), _DRAWING_HEIGHT_PX / 2 - scale * (centered @ upward)], axis=-1
        )

    def draw_polyline(points: ArrayLike, color: str, width: float, attributes: str = "") -> str:
        coordinates = " ".join(f"{x:.1f},{y:.1f}" for x, y in project(points).reshape(-1, 2))
        return f'<polyline points="{coordinates}" fill="none" stroke="{color}" stroke-width="{width}"{attributes}/>'

    def draw_label(text: str, point: ArrayLike) -> str:
        x, y = project(point)
        x = np.clip(x, 3.6 * len(text), _DRAWING_WIDTH_PX - 3.6 * len(text))
        text_style = 'font-size="13" text-anchor="middle" fill="var(--view3d-orange)"'
        return f'<text x="{x:.1f}" y="{y - 12:.1f}" {text_style}>{escape(text)}</text>'

    elements = [
        f'<svg viewBox="0 0 {_DRAWING_WIDTH_PX} {_DRAWING_HEIGHT_PX}" role="img" aria-label="{escape(about, quote=True)}" '
        'stroke-linejoin="round" stroke-linecap="round">'
    ]
    size, origin = data["size"], scene.frames[0, 0, 0, :3, 3]
    east = right - np.array(data["up"]) * (right @ data["up"])
    elements.append(draw_polyline([origin - 0.4 * size * east, origin + 0.4 * size * east], FAINT, 3))
    elements += [_draw_convex_outline(project(corners)) for corners in scene.object_corners]
    for box in data["boxes"]:
        lower, upper = np.array(box["low"]), np.array(box["high"])
        corners = [np.where([index & 1, index & 2, index & 4], upper, lower) for index in range(8)]
        pairs = [
            (corner, neighbor) for corner in range(8) for neighbor in (corner | 1, corner | 2, corner | 4) if neighbor != corner
        ]
        elements += [draw_polyline([corners[corner], corners[neighbor]], SOFT, 1.2) for corner, neighbor in pairs]
    if len(data["path"]) > 1:
        elements.append(draw_polyline(data["path"], ORANGE, 1.6, ' stroke-dasharray="5 4"'))
    for target in data["targets"]:
        x, y = project(np.reshape(target, (3, 4))[:, 3])
        elements.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="{ORANGE}" stroke-width="2"/>')
    locked = [locked_value is not None for locked_value in data["locked"]]
    colors = ("#8b96a1", "#3aa384", "#4a8cc4", "#c27aa5", "#d98a52")
    for index, motion in reversed(list(enumerate(scene.frames[..., :3, 3]))):
        if len(motion) > 1:
            elements += [draw_polyline(motion[0], FAINT, 7), draw_polyline(motion[:, -1], BLUE, 2)]
        elements.append(draw_polyline(motion[-1], colors[index % 5], 9))
        for joint, (x, y) in enumerate(project(motion[-1][1:-1])):
            joint_color = ORANGE if locked[joint] else "#48545f"
            elements.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="{joint_color}" stroke="#fff" stroke-width="1.5"/>')
        x, y = project(motion[-1][-1])
        elements.append(f'<path d="M{x:.1f} {y - 7:.1f}l7 7l-7 7l-7 -7z" fill="{ORANGE}" stroke="#fff" stroke-width="1.5"/>')
    tool = scene.frames[0, -1, -1, :3, 3]
    for lost_direction in data["lost"]:
        half_line = 0.26 * size * np.array(lost_direction["twist"][:3])
        elements += [
            draw_polyline([tool - half_line, tool + half_line], ORANGE, 3),
            draw_label(lost_direction["words"], tool + half_line),
        ]
    for index, joint in enumerate(data["joints"]):
        if locked[index]:
            elements.append(draw_label(f"{joint['name']} locked", scene.frames[0, -1, index + 1, :3, 3]))
    return "".join([*elements, "</svg>"])


def _draw_convex_outline(points: FloatArray) -> str:
    """Draw the outline of a convex body whose corners have the drawing coordinates (V, 2)."""
    from scipy.spatial import ConvexHull

    hull = points[ConvexHull(points).vertices]
    coordinates = " ".join(f"{x:.1f},{y:.1f}" for x, y in hull)
    return f'<polygon points="{coordinates}" fill="#cdb27e" fill-opacity="0.35" stroke="#8a7446" stroke-width="1"/>'
