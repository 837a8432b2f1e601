"""A small view of bodies on a chain of joints that can be turned, inline in a page: no server, no network, no other file.

The script, ``templates/viewer.js``, is built from ``page/src/viewer`` by ``make page``; it is holdfast's own, 20 kB of WebGL,
and lies once in a page however many views there are. Without JavaScript, without WebGL and on paper there is a drawing.
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

from holdfast.report.palette import BLUE, FAINT, ORANGE, SOFT

Array = NDArray[np.float64]

_HALF = np.tan(np.radians(14))  # of the angle of view, as in camera.ts
_WIDE, _TALL = 560, 400  # pixels of the drawing
_VIEW_NOTE = '<p class="view3d-note view3d-once">{}</p>'
_BODY = '<div class="view3d-body" data-key="{}" hidden><script type="application/json">{}</script></div>'


@dataclass(frozen=True)
class Scene:
    """What a view shows.

    Attributes:
        data: As ``page/src/viewer/scene.ts`` describes it.
        frames: (A, F, K, 4, 4) poses over the frames of a motion of each arm: base, joints, end effector.
        notes: Sentences under the view, such as what could not be shown.
        around: Corners (V, 3) in the world of each object around the arms, of which the drawing has the outline.
    """

    data: Mapping[str, Any]
    frames: Array
    notes: tuple[str, ...] = ()
    around: tuple[Array, ...] = ()

    def html(self, name: str, about: str) -> Markup:
        """The view as part of a page; :func:`with_library` makes it move.

        Args:
            name: Its id, once in a page.
            about: What it shows, for those who do not see it.
        """
        what = escape(about, quote=True)
        labels = [arm["label"] for arm in self.data["arms"]]
        swatch = '<i style="background:{}"></i>{}'
        colors = ["#8b96a1", "var(--view3d-green)", "var(--view3d-blue)", "var(--view3d-purple)", "var(--view3d-orange)"]
        legend = [swatch.format(colors[k % 5], escape(x)) for k, x in enumerate(labels)] if len(labels) > 1 else []
        marked = [j["name"] for j, t in zip(self.data["joints"], self.data["locked"], strict=True) if t is not None]
        free = [self.data["joints"][k]["name"] for k in self.data["free"]]
        lines = [f"{w}: {', '.join(x)}." for w, x in (("Locked", marked), ("Swinging freely", free)) if x]
        parts = scripted(self.data["parts"])
        key = sha256(parts.encode()).hexdigest()[:12]
        text = scripted({**self.data, "parts": key})
        return Markup(
            f'<div class="view3d" id="{escape(name, quote=True)}" role="group" aria-label="{what}">\n'
            f'<div class="view3d-stage">{drawing(self, about)}<canvas tabindex="0" role="img" aria-label="{what}"></canvas>'
            '</div>\n<div class="view3d-controls"></div>\n'
            + (f'<p class="view3d-legend">{" ".join(f"<span>{x}</span>" for x in legend)}</p>\n' if legend else "")
            + "".join(_VIEW_NOTE.format(escape(line)) + "\n" for line in self.notes)
            + "".join(f'<p class="view3d-note">{escape(line)}</p>\n' for line in lines)
            + '<p class="view3d-hint">Where JavaScript is on, this picture can be turned.</p>\n'
            f'<script type="application/json">{text}</script>\n{_BODY.format(key, parts)}\n</div>'
        )


def scripted(data: Any) -> str:
    """Data as JSON inside a script, where nothing is escaped, so that nothing may end it."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("</", "<\\/")


@cache
def template(name: str) -> str:
    """The text of one of the templates."""
    return resources.files("holdfast.report").joinpath("templates", name).read_text(encoding="utf-8")


def with_library(html: str) -> str:
    """A page with the style and the script of the views in it, and each body and note once; without views as it is."""
    if '<div class="view3d"' not in html:
        return html
    seen: set[str] = set()

    def once(found: re.Match[str]) -> str:
        if found[1] in seen:
            return ""
        seen.add(found[1])
        return found[0]

    for part in (_BODY, _VIEW_NOTE):
        html = re.sub(re.escape(part).replace(r"\{\}", "(.*?)"), once, html)
    styled = html.replace("</head>", f"<style>\n{template('viewer.css')}</style>\n</head>", 1)
    before, _, after = styled.rpartition("</body>")
    return f"{before}<script>{template('viewer.js').strip()}</script>\n</body>{after}"


# In a notebook: light or dark as the notebook is, which the frame around the page says.
_GROUND = """<script>
addEventListener("message", ({ data, source }) => {
  if (source !== parent || typeof data?.dark !== "boolean") return;
  document.documentElement.style.colorScheme = data.dark ? "dark" : "light";
});
</script>"""


def page(view: Markup, title: str) -> str:
    """A page that holds a view and nothing else, as large as its window, light or dark as the reader or the notebook has it."""
    return with_library(
        '<!DOCTYPE html>\n<html lang="en" class="view3d-page">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n{_GROUND}\n</head>\n"
        f"<body>\n<main>\n<h1>{escape(title)}</h1>\n{view}\n</main>\n</body>\n</html>\n"
    )


# ---- numbers -----------------------------------------------------------------------------------------------------------


def numbers(values: ArrayLike) -> list[Any]:
    """Nested lists of numbers with seven digits: a tenth of a micrometre of a metre."""
    a = np.asarray(values, dtype=np.float64)
    if a.ndim > 1:
        return [numbers(x) for x in a]
    return [float(f"{x:.7g}") + 0.0 for x in a]


def packed(vertices: Array, faces: NDArray[np.int64]) -> dict[str, Any]:
    """Triangles as text: corners to 1/65535 of the mesh's size, which no eye can tell.

    Args:
        vertices: (V, 3) m, at most 65536.
        faces: (F, 3) indices.
    """
    low = vertices.min(axis=0)
    side = float(np.ptp(vertices, axis=0).max()) or 1.0
    points = np.rint((vertices - low) * (65535 / side)).astype("<u2")
    text = {"points": points, "faces": faces.astype("<u2")}
    return {"low": numbers(low), "side": numbers([side])[0]} | {k: b64encode(v.tobytes()).decode() for k, v in text.items()}


def thinned(vertices: Array, faces: NDArray[np.int64], most: int) -> tuple[Array, NDArray[np.int64]]:
    """A mesh of at most so many triangles: corners that share a cell of a grid become one, in the finest grid that does it.

    Rossignac and Borrel 1993.

    Args:
        vertices: (V, 3) m.
        faces: (F, 3) indices.
        most: Triangles.
    """
    if len(faces) <= most and len(vertices) <= 65536:
        return vertices, faces
    low, span = vertices.min(axis=0), float(np.ptp(vertices, axis=0).max()) or 1.0
    coarse, fine = 2, 1024  # cells along the longest edge
    found = (vertices[:1], faces[:0])
    while coarse <= fine:
        cells = (coarse + fine) // 2
        place = np.minimum((vertices - low) * (cells / span), cells - 1).astype(np.int64)
        _, cell = np.unique(place @ [cells * cells, cells, 1], return_inverse=True)
        corners = cell[faces]
        kept = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
        if len(kept) <= most:
            count = np.bincount(cell)
            middle = np.stack([np.bincount(cell, vertices[:, k]) for k in range(3)], axis=1) / count[:, None]
            used, corners = np.unique(kept, return_inverse=True)
            found, coarse = (middle[used], corners.reshape(kept.shape)), cells + 1
        else:
            fine = cells - 1
    return found


# ---- without a script --------------------------------------------------------------------------------------------------


def eye(camera: Mapping[str, Any], up: ArrayLike) -> tuple[Array, Array, Array, float]:
    """Unit vectors (3,) to the right, upward and towards the eye, and its distance, m, as camera.ts has them."""
    upward = np.asarray(up, dtype=np.float64)
    east = np.eye(3)[0] if abs(upward[0]) < 0.9 else np.eye(3)[1]
    east = east - upward * (upward @ east)
    east /= np.linalg.norm(east)
    north = np.cross(upward, east)
    (c, s), e = (np.cos(camera["azimuth"]), np.sin(camera["azimuth"])), camera["elevation"]
    back = np.cos(e) * (c * east + s * north) + np.sin(e) * upward
    right = -s * east + c * north
    return right, np.cross(back, right), back, 1.04 * camera["radius"] / float(np.sin(np.arctan(_HALF)))


def drawing(scene: Scene, about: str) -> str:
    """The scene as SVG, as it is seen at first; a motion with its first and last position."""
    data = scene.data
    right, top, back, distance = eye(data["camera"], data["up"])
    center = np.array(data["camera"]["center"])

    def flat(points: ArrayLike) -> Array:
        p = np.asarray(points, dtype=np.float64) - center
        scale = _TALL / 2 / _HALF / (distance - p @ back)
        return np.stack([_WIDE / 2 + scale * (p @ right), _TALL / 2 - scale * (p @ top)], axis=-1)

    def line(points: ArrayLike, color: str, width: float, more: str = "") -> str:
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in flat(points).reshape(-1, 2))
        return f'<polyline points="{text}" fill="none" stroke="{color}" stroke-width="{width}"{more}/>'

    def word(text: str, point: ArrayLike) -> str:
        x, y = flat(point)
        x = np.clip(x, 3.6 * len(text), _WIDE - 3.6 * len(text))
        look = 'font-size="13" text-anchor="middle" fill="var(--view3d-orange)"'
        return f'<text x="{x:.1f}" y="{y - 12:.1f}" {look}>{escape(text)}</text>'

    out = [
        f'<svg viewBox="0 0 {_WIDE} {_TALL}" role="img" aria-label="{escape(about, quote=True)}" '
        'stroke-linejoin="round" stroke-linecap="round">'
    ]
    size, origin = data["size"], scene.frames[0, 0, 0, :3, 3]
    east = right - np.array(data["up"]) * (right @ data["up"])
    out.append(line([origin - 0.4 * size * east, origin + 0.4 * size * east], FAINT, 3))
    out += [_outline(flat(corners)) for corners in scene.around]
    for box in data["boxes"]:
        low, high = np.array(box["low"]), np.array(box["high"])
        corners = [np.where([k & 1, k & 2, k & 4], high, low) for k in range(8)]
        pairs = [(a, b) for a in range(8) for b in (a | 1, a | 2, a | 4) if b != a]
        out += [line([corners[a], corners[b]], SOFT, 1.2) for a, b in pairs]
    if len(data["path"]) > 1:
        out.append(line(data["path"], ORANGE, 1.6, ' stroke-dasharray="5 4"'))
    for target in data["targets"]:
        x, y = flat(np.reshape(target, (3, 4))[:, 3])
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="{ORANGE}" stroke-width="2"/>')
    locked = [t is not None for t in data["locked"]]
    colors = ("#8b96a1", "#3aa384", "#4a8cc4", "#c27aa5", "#d98a52")
    for k, motion in reversed(list(enumerate(scene.frames[..., :3, 3]))):
        if len(motion) > 1:
            out += [line(motion[0], FAINT, 7), line(motion[:, -1], BLUE, 2)]
        out.append(line(motion[-1], colors[k % 5], 9))
        for joint, (x, y) in enumerate(flat(motion[-1][1:-1])):
            fill = ORANGE if locked[joint] else "#48545f"
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="{fill}" stroke="#fff" stroke-width="1.5"/>')
        x, y = flat(motion[-1][-1])
        out.append(f'<path d="M{x:.1f} {y - 7:.1f}l7 7l-7 7l-7 -7z" fill="{ORANGE}" stroke="#fff" stroke-width="1.5"/>')
    tool = scene.frames[0, -1, -1, :3, 3]
    for each in data["lost"]:
        way = 0.26 * size * np.array(each["twist"][:3])
        out += [line([tool - way, tool + way], ORANGE, 3), word(each["words"], tool + way)]
    for k, joint in enumerate(data["joints"]):
        if locked[k]:
            out.append(word(f"{joint['name']} locked", scene.frames[0, -1, k + 1, :3, 3]))
    return "".join([*out, "</svg>"])


def _outline(points: Array) -> str:
    """What bodies without dents cover of a drawing; (V, 2) their corners there."""
    from scipy.spatial import ConvexHull

    hull = points[ConvexHull(points).vertices]
    text = " ".join(f"{x:.1f},{y:.1f}" for x, y in hull)
    return f'<polygon points="{text}" fill="#cdb27e" fill-opacity="0.35" stroke="#8a7446" stroke-width="1"/>'
