"""The small 3-D view: what stands in the page, and what a browser makes of it."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pytest

import axe
import chromium
import holdfast as hf
import oracles
from holdfast import arms
from holdfast.core.errors import InputError
from holdfast.interface.presentation.arm.view import scene
from holdfast.interface.report import page, viewer
from holdfast.model.arm import generic_configuration
from wellformed import check


def data(html):
    return json.loads(re.search(r'<script type="application/json">(.*?)</script>', html, re.DOTALL)[1])


def test_the_page_is_whole_and_asks_no_other_host():
    shown = arms.load("panda").show(locked=["panda_joint4"])
    html = shown.to_html()
    check(html, 1)
    assert not re.search(r"(?:https?:)?//[a-z0-9-]+\.[a-z]{2,}", html)
    assert len(html) < 45_000
    assert "</script" not in json.dumps(data(html))
    frame = shown._repr_html_()
    assert frame.startswith("<iframe srcdoc=")
    assert "<script" not in frame


def test_the_library_is_in_a_page_once_and_only_where_there_are_views():
    arm = arms.load("planar-3r")
    views = [page.Picture(scene(arm).to_html(f"view{k}", "An arm <b>"), "c") for k in range(3)]
    html = page.render(page.Page("t", "h", [page.Section("", views)]))
    assert html.count("WebGL") == viewer.build_view_page(scene(arm).to_html("alone", "An arm"), "t").count("WebGL")
    assert html.count('class="view3d"') == 3
    bare = page.render(page.Page("t", "h", [page.Section("", [page.Text("none")])]))
    assert "view3d" not in bare


def test_a_file_is_written_whole(tmp_path):
    shown = arms.load("planar-3r").show([0.1, 0.2, 0.3])
    assert shown.save(tmp_path / "arm.html").read_text() == shown.to_html()
    with pytest.raises(hf.StoreError, match="page"):
        shown.save(tmp_path / "none" / "arm.html")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"q": np.zeros(3)}, r"q for 'panda' has shape \(3,\)"),
        ({"q": np.full(7, np.nan)}, "finite"),
        ({"q": np.zeros((4, 7)), "time": [0, 1, 2]}, "time has 3 moments and the motion 4"),
        ({"labels": ["a", "b"]}, "labels must be 1"),
        ({"locked": ["elbow"]}, "no joint 'elbow'"),
        ({"targets": [np.zeros(2)]}, "a target has shape"),
        ({"points": np.zeros((4, 3)), "colors": np.zeros((2, 3))}, "colors are 2"),
    ],
)
def test_bad_input_gets_a_sentence(options, sentence):
    with pytest.raises(InputError, match=sentence):
        scene(arms.load("panda"), **options)


@pytest.mark.parametrize("turn", [0.0, 1.2])
def test_objects_of_a_cell_are_drawn_where_they_are(turn):
    pose = np.eye(4)
    pose[:3, 3] = 0.6, -0.2, 0.4
    base = np.eye(4)
    base[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    base[:3, 3] = 0.1, 0.2, 0.3
    solids = [
        hf.cell.Box("box", [0.2, 0.3, 0.4], pose=pose),
        hf.cell.Cylinder("cylinder", 0.1, 0.4, pose=pose),
        hf.cell.Capsule("capsule", 0.1, 0.4, pose=pose),
        hf.cell.Sphere("sphere", 0.2, pose=pose),
    ]
    shown = scene(arms.load("panda").with_base(base), cell=hf.Cell(solids))
    assert [x["name"] for x in shown.data["objects"]] == ["box", "cylinder", "capsule", "sphere"]
    drawn = viewer.draw_scene_svg(shown, "a cell")
    for solid, part in zip(solids, [p for p in shown.data["parts"] if "object" in p], strict=True):
        mesh = part["mesh"]
        numbers = np.frombuffer(base64.b64decode(mesh["points"]), "<u2").reshape(-1, 3)
        corners = (mesh["low"] + numbers * mesh["side"] / 65535) @ base[:3, :3].T + base[:3, 3]
        outside = solid.signed_distance(corners)
        assert np.abs(outside).min() < 2e-5  # its corners are on its surface, as far as they are rounded
        assert outside.max() < 2e-5
        np.testing.assert_allclose((corners.min(axis=0) + corners.max(axis=0)) / 2, pose[:3, 3], atol=0.002)
        directions = (d := np.random.default_rng(0).normal(size=(20, 3))) / np.linalg.norm(d, axis=1)[:, None]
        reach = (viewer.part_corners(part) @ base[:3, :3].T + base[:3, 3]) @ directions.T
        np.testing.assert_allclose(reach.max(axis=0), (corners @ directions.T).max(axis=0), atol=0.005)
    assert drawn.count('opacity="0.35"') == len(solids)


def test_meshes_are_thinned_and_packed(rng):
    t = np.linspace(0, np.pi, 120)
    around = np.linspace(0, 2 * np.pi, 240)
    sphere = np.stack(
        [np.outer(np.sin(t), np.cos(around)), np.outer(np.sin(t), np.sin(around)), np.outer(np.cos(t), around**0)], -1
    )
    k = np.arange(119 * 239)
    a = k // 239 * 240 + k % 239
    faces = np.concatenate([np.stack([a, a + 240, a + 1], 1), np.stack([a + 1, a + 240, a + 241], 1)])
    vertices = 3 * sphere.reshape(-1, 3) + rng.normal(size=3)
    few, corners = viewer.simplify_mesh(vertices, faces, 2000)
    assert 800 < len(corners) <= 2000
    assert corners.max() == len(few) - 1
    radius = np.linalg.norm(few - (vertices.max(axis=0) + vertices.min(axis=0)) / 2, axis=1)
    assert np.abs(radius - 3).max() < 0.15
    same, all_faces = viewer.simplify_mesh(few, corners, 2000)
    assert same is few
    assert all_faces is corners


def test_the_directions_that_a_lock_takes_are_those_no_joint_rate_gives():
    # The elbow of the iiwa is the one joint that changes how far the wrist is from the shoulder.
    arm = arms.load("iiwa14")
    q = generic_configuration(arm)
    [lost] = scene(arm, q, locked=[3]).data["lost"]
    reduced = np.delete(oracles.jacobian(arm, q[None])[0], 3, axis=1)
    assert lost["words"] == "lost"
    np.testing.assert_allclose(np.array(lost["twist"]) @ reduced, 0, atol=1e-6)
    assert scene(arm, q).data["lost"] == []
    assert scene(arm, np.stack([q, q]), time=[0, 1], locked=[3]).data["lost"] == []


def box_stl(file, size, per_edge):
    """A cube of ``12 per_edge^2`` triangles, binary STL."""
    u, v = (x.ravel() for x in np.meshgrid(np.arange(per_edge), np.arange(per_edge)))
    quads = np.stack([np.stack([u + a, v + b], 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], 1) / per_edge - 0.5
    sides = []
    for axis in range(3):
        for s in (-0.5, 0.5):
            corners = np.insert(quads, axis, s, axis=2)
            sides += [corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]
    triangles = size * np.concatenate(sides)
    rows = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = triangles
    file.write_bytes(b" " * 80 + np.uint32(len(rows)).tobytes() + rows.tobytes())


def test_meshes_never_blow_up_a_page(tmp_path):
    pytest.importorskip("trimesh")
    box_stl(tmp_path / "link.stl", 0.3, 30)
    visual = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
    links = [f'<link name="l{k}">{visual.format("none.stl" if k == 4 else "link.stl")}</link>' for k in range(5)]
    joints = [
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/><child link="l{k + 1}"/><origin xyz="0 0.1 0.4"/>'
        f'<axis xyz="{k % 2} 0 {1 - k % 2}"/></joint>'
        for k in range(4)
    ]
    file = tmp_path / "arm.urdf"
    file.write_text(f'<robot name="blocks">{"".join(links + joints)}</robot>')
    arm = hf.Arm.from_urdf(file)
    made = scene(arm, locked=["j1"])
    bodies = [p["mesh"] for p in made.data["parts"] if "mesh" in p]
    assert len(bodies) == 4
    assert sum(len(p["faces"]) for p in bodies) // 8 <= 16_000
    assert any("43,200 triangles" in note for note in made.notes)
    assert any("none.stl" in note for note in made.notes)
    [marked] = [p for p in made.data["parts"] if p.get("mark") and p["joint"] == 1]
    assert "tube" in marked
    both = viewer.build_view_page(made.to_html("one", "x") + scene(arm).to_html("two", "x"), "t")
    assert len(both) < 1.25 * len(viewer.build_view_page(made.to_html("one", "x"), "t")) < 350_000
    assert len(scene(arm, meshes=False).to_html("three", "x")) < 15_000


# ---- in Chromium ---------------------------------------------------------------------------------------------------------

COUNT = """canvas => {
  const c = canvas.getContext("2d"), d = c.getImageData(0, 0, canvas.width, canvas.height).data;
  const shades = new Set(); let sum = 0;
  for (let k = 0; k < d.length; k += 4) if (d[k + 3]) { shades.add(d[k] + 256 * d[k + 1] + 65536 * d[k + 2]); sum += k * d[k]; }
  return [shades.size, sum];
}"""


@pytest.fixture(scope="module")
def browser():
    with chromium.opened(chromium.required, scenes=True) as opened:
        yield opened


@pytest.fixture
def opened(browser, tmp_path):
    """``opened(html)``: a page that shows it, whose errors fail the test."""
    made = []

    def show(html, **options):
        context = browser.new_context(**{"viewport": {"width": 700, "height": 900}} | options)
        made.append(context)
        context.route(re.compile("^(?!file:)"), lambda route: pytest.fail(f"the page asks for {route.request.url}"))
        found = context.new_page()
        found.on("pageerror", lambda error: pytest.fail(str(error)))
        file = tmp_path / f"{len(made)}.html"
        file.write_text(html, encoding="utf-8")
        found.goto(file.as_uri())
        return found

    yield show
    for context in made:
        context.close()


def painted(found):
    """What is on the canvas, once something is."""
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[0] > 50")
    return found.locator("canvas").first.evaluate(COUNT)


def test_it_draws_the_arm_where_it_is_and_moves_it(opened, rng):
    arm = arms.load("ur5-rail")
    q = generic_configuration(arm)
    found = opened(arm.show(q, locked=[2]).to_html())
    first = painted(found)
    assert first[0] > 200
    assert axe.serious(found) == []

    def frames():
        return np.array(found.evaluate("document.querySelector('.view3d').view3d.frames()")).reshape(-1, 3, 4)

    np.testing.assert_allclose(frames(), np.array(oracles.frames(arm, q[None]))[:, 0, :3], atol=1e-6)
    found.get_by_text("Move the joints").click()
    slider = found.get_by_role("slider", name=arm.joint_names[1])
    slider.press("Home")
    moved = np.where(np.arange(arm.n) == 1, arm.lower, q)
    np.testing.assert_allclose(frames(), np.array(oracles.frames(arm, moved[None]))[:, 0, :3], atol=1e-6)
    assert found.get_by_role("slider", name=arm.joint_names[2]).is_disabled()
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {first[1]}")
    second = painted(found)
    found.locator("canvas").press("ArrowLeft")
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {second[1]}")


def test_a_motion_follows_its_slider_and_plays(opened):
    arm = arms.load("planar-3r")
    time = np.linspace(0, 2, 21)
    q = np.stack([np.sin(time), 0.5 * time, 0.3 + 0 * time], axis=1)
    html = scene(
        arm,
        [q, 0.5 * q],
        labels=["one", "other"],
        time=time,
        locked={2: 1.0},
        free=["joint2"],
        readings=[f"{t:.1f} s" for t in time],
    )
    found = opened(viewer.build_view_page(html.to_html("motion", "An arm moving"), "t"))
    before = painted(found)
    slider = found.get_by_role("slider", name="Time of the motion")
    slider.press("End")
    assert slider.get_attribute("aria-valuetext") == "2.0 s"
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {before[1]}")
    last = found.evaluate("document.querySelector('.view3d').view3d.configurations()")
    np.testing.assert_allclose(last, [q[-1], 0.5 * q[-1]], atol=1e-6)
    found.get_by_role("button", name="Play").click()
    found.wait_for_function("Number(document.querySelector('input').value) > 1")
    found.get_by_role("button", name="Pause").click()


@pytest.mark.parametrize("off", ["script", "canvas"])
def test_without_a_script_or_a_canvas_there_is_a_drawing(opened, off):
    html = arms.load("panda").show().to_html()
    if off == "canvas":
        html = html.replace("<script>", "<script>HTMLCanvasElement.prototype.getContext = () => null;", 1)
    found = opened(html, java_script_enabled=off == "canvas")
    assert found.locator(".view3d-stage svg").is_visible()
    assert not found.locator("canvas").is_visible()
    sentence = "cannot draw on a canvas" if off == "canvas" else "Enable JavaScript"
    assert sentence in found.locator(".view3d-hint").inner_text()


# What a page asks WebGL for, and what it says that it is.
WEBGL = """
const asked = HTMLCanvasElement.prototype.getContext, said = WebGLRenderingContext.prototype.getParameter;
const paint = WebGLRenderingContext.prototype.drawArrays;
window.contexts = 0; window.painted = 0;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  if (kind === "webgl") { window.contexts++; if (RENDERER === null) return null; }
  return asked.call(this, kind, ...rest);
};
WebGLRenderingContext.prototype.getParameter = function (name) {
  return RENDERER && (name === 37446 || name === 7937) ? RENDERER : said.call(this, name);
};
WebGLRenderingContext.prototype.drawArrays = function (...rest) { window.painted++; return paint.apply(this, rest); };
"""


@pytest.mark.parametrize("renderer", ["A graphics card", "SwiftShader", None])
@pytest.mark.parametrize("surroundings", ["none", "cell", "region", "points"])
def test_webgl_draws_objects_on_a_graphics_card_and_hulls_all_else(opened, renderer, surroundings):
    pose = np.eye(4)
    pose[:3, 3] = 0.6, -0.2, 0.4
    options = {
        "none": {},
        "cell": {"cell": hf.Cell([hf.cell.Box("box", [0.2, 0.3, 0.4], pose=pose)])},
        "region": {"region": [[0.3, -0.2, 0.3], [0.7, 0.2, 0.6]]},
        "points": {"points": [[0.3, -0.2, 0.3], [0.7, 0.2, 0.6]]},
    }[surroundings]
    html = scene(arms.load("panda"), locked=[1], **options).to_html("arm", "An arm")
    html = viewer.build_view_page(html, "t").replace(
        "<script>", f"<script>{WEBGL.replace('RENDERER', json.dumps(renderer))}", 1
    )
    found = opened(html)
    assert painted(found)[0] > 100
    contexts, triangles = found.evaluate("[contexts, painted]")
    assert (triangles > 0) is (surroundings == "cell" and renderer == "A graphics card")
    assert contexts == (surroundings == "cell")  # a page holds few contexts: none is taken in vain


def test_a_browser_without_graphics_card_and_webgl_draws_and_rotates(browser, tmp_path):
    file = tmp_path / "arm.html"
    arms.load("panda").show().save(file)
    flags = ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]
    with browser.browser_type.launch(executable_path=chromium.path(), args=flags) as flat:
        found = flat.new_page(viewport={"width": 700, "height": 900})
        found.goto(file.as_uri())
        assert found.evaluate("document.createElement('canvas').getContext('webgl')") is None
        first = painted(found)
        found.locator("canvas").press("ArrowLeft")
        found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {first[1]}")


# Closed polygons of each picture, in CSS pixels of the page.
POLYGONS = """
const own = CanvasRenderingContext2D.prototype, { clearRect, beginPath, lineTo, closePath } = own;
own.clearRect = function (...rest) { this.polygons = []; return clearRect.apply(this, rest); };
own.beginPath = function () { this.path = []; return beginPath.call(this); };
own.lineTo = function (x, y) { this.path.push([x, y]); return lineTo.call(this, x, y); };
own.closePath = function () { (this.polygons ??= []).push(this.path); return closePath.call(this); };
"""
ON_CANVAS = """canvas => {
  const { left, top, width } = canvas.getBoundingClientRect(), s = width / canvas.width;
  return canvas.getContext("2d").polygons.map(p => p.map(([x, y]) => [left + s * x, top + s * y]));
}"""
ON_DRAWING = """svg => [...svg.querySelectorAll("polygon")].map(polygon => [...polygon.points].map(point => {
  const at = point.matrixTransform(polygon.getScreenCTM());
  return [at.x, at.y];
}))"""


def apart(corners, polygon):
    """The largest distance of corners (N, 2) from the outline of a polygon (M, 2)."""
    a = np.asarray(polygon)
    way = np.roll(a, -1, axis=0) - a
    corners = np.asarray(corners)[:, None]
    t = np.clip(((corners - a) * way).sum(-1) / np.maximum((way**2).sum(-1), 1e-12), 0, 1)
    return np.linalg.norm(a + t[..., None] * way - corners, axis=-1).min(axis=1).max()


@pytest.fixture
def block_arm(tmp_path):
    """An arm of five blocks, which are meshes."""
    pytest.importorskip("trimesh")
    box_stl(tmp_path / "link.stl", 0.3, 30)
    visual = '<visual><origin xyz="0 0.02 0.05" rpy="0.2 0.5 0.1"/><geometry><mesh filename="link.stl"/></geometry></visual>'
    links = [f'<link name="l{k}">{visual}</link>' for k in range(5)]
    joints = [
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/><child link="l{k + 1}"/><origin xyz="0 0.3 0.4"/>'
        f'<axis xyz="{k % 2} 0 {1 - k % 2}"/></joint>'
        for k in range(4)
    ]
    (tmp_path / "arm.urdf").write_text(f'<robot name="blocks">{"".join(links + joints)}</robot>')
    return hf.Arm.from_urdf(tmp_path / "arm.urdf")


@pytest.mark.parametrize(("wide", "pixels"), [(1200, 1), (390, 2)])
@pytest.mark.parametrize("name", ["panda", "planar-3r", "ur5-rail", "blocks"])
def test_the_first_picture_has_its_corners_where_the_drawing_has_them(opened, block_arm, rng, name, wide, pixels):
    arm = block_arm if name == "blocks" else arms.load(name)
    q = generic_configuration(arm)
    other = q + rng.normal(size=arm.n) / 5
    html = scene(arm, [q, other], labels=["one", "other"], locked=[1]).to_html("arm", "An arm")
    html = viewer.build_view_page(html, "t").replace("<script>", f"<script>{POLYGONS}", 1)
    found = opened(html, viewport={"width": wide, "height": 700}, device_scale_factor=pixels)
    found.wait_for_selector(".view3d-drawn")
    canvas = found.locator("canvas").evaluate(ON_CANVAS)
    drawing = found.locator(".view3d-stage > svg").evaluate(ON_DRAWING)
    own = drawing[-len(canvas) :]  # the other arm is on a layer of its own
    assert len(drawing) > len(canvas) > 4
    for on_canvas, drawn in zip(canvas, own, strict=True):
        assert apart(on_canvas, drawn) < 1
        assert apart(drawn, on_canvas) < 1
    assert np.ptp(np.concatenate(canvas), axis=0).max() > 100  # they are not all at one place


OVERLAY = """([content, conditions]) => {
  const page = document.querySelector(".arm").armPage;
  page.overlayContent = () => content;
  page.state.conditions = conditions;
  page.draw();
  page.afterPicture();
  return content.trails[0].points.map(p => page.view.project(p));
}"""
STROKES = "[...document.querySelectorAll('.view3d-overlay:not(.pose-rings) path')].map(e => getComputedStyle(e).stroke)"


def test_the_overlay_draws_what_a_lock_takes(opened, rng):
    arm = arms.load("panda")
    q = generic_configuration(arm)
    found = opened(arm.page(q=q).to_html(), color_scheme="light", bypass_csp=True)
    painted(found)
    tool = arm.frames(q)[-1][:3, 3]
    directions = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    axes = {"center": tool.tolist(), "directions": directions.T.tolist()}
    points = (tool + 0.1 * rng.normal(size=(5, 3))).tolist()
    content = {
        "ellipsoids": [
            axes | {"halfAxes": [0.5, 0.4, 0.3], "style": "before"},
            axes | {"halfAxes": [0.5, 0.4, 0.0], "style": "after"},
        ],
        "trails": [{"points": points, "style": style} for style in ("solid", "dotted", "dashed")],
        "lost": [{"center": tool.tolist(), "twist": [0.6, 0, 0, 0, 0.8, 0], "words": "3 % <b>"}],
        "pointerLine": [tool.tolist(), points[0]],
    }
    conditions = ["locked" if k in (1, 3) else "healthy" for k in range(7)]
    projected = np.array(found.evaluate(OVERLAY, [content, conditions]))
    assert found.locator(".overlay-padlock").count() == 2
    assert found.locator(".overlay-lost text").text_content() == "3 % <b>"
    assert found.locator(".overlay-before path").count() == 3
    assert found.locator(".overlay-after path").count() == 4  # and its filled outline
    dashes = "e => getComputedStyle(e).strokeDasharray"
    assert len({found.locator(f".overlay-{style}").evaluate(dashes) for style in ("solid", "dotted", "dashed")}) == 3

    def corners(selector):
        paths = found.locator(selector).evaluate_all("all => all.map(e => e.getAttribute('d'))")
        return [np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", path), dtype=float) for path in paths]

    np.testing.assert_allclose(corners(".overlay-solid")[0], projected[:, :2], atol=0.1)
    # A flat ellipsoid keeps one curve as it was, and two of its curves are lines.
    before, after = corners(".overlay-before path"), corners(".overlay-after path")[1:]
    np.testing.assert_allclose(after[2], before[2], atol=0.11)
    for line in after[:2]:
        size = np.linalg.svd(line - line.mean(axis=0), compute_uv=False)
        assert size[1] < 0.03 * size[0]
    assert apart(after[2], corners(".overlay-after .overlay-fill")[0]) < 0.5
    # A press goes through the overlay to the picture, and other colours come with another theme.
    box = found.locator("canvas").bounding_box()
    middle = [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]
    assert found.evaluate("([x, y]) => document.elementFromPoint(x, y).tagName", middle) == "CANVAS"
    light = found.evaluate(STROKES)
    shades = painted(found)
    found.emulate_media(color_scheme="dark")
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {shades[1]}")
    assert all(a != b for a, b in zip(light, found.evaluate(STROKES), strict=True) if a != "none")
    found.evaluate(OVERLAY, [{"trails": [{"points": points, "style": "solid"}]}, ["healthy"] * 7])
    assert found.locator(".view3d-overlay:not(.pose-rings) > *").count() == 1


def test_the_arm_page_drives_its_view(opened, rng):
    arm = arms.load("panda")
    q = generic_configuration(arm)
    found = opened(arm.page(q=q).to_html(), bypass_csp=True)
    before = painted(found)
    page = "document.querySelector('.arm').armPage"
    # Points that are displaced on the picture are where a pointer put them, and as far from the eye.
    tool = arm.frames(q)[-1][:3, 3].tolist()
    seen, moved = np.array(
        found.evaluate(f"tool => [{page}.view.project(tool), {page}.view.project({page}.view.displace(tool, 37, -21))]", tool)
    )
    np.testing.assert_allclose(moved - seen, [37, -21, 0], atol=1e-3)
    ghost = q + rng.normal(size=7) / 4
    found.evaluate(f"q => {{ {page}.step.ghosts = [q]; {page}.draw(); }}", ghost.tolist())
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] !== {before[1]}")
    np.testing.assert_allclose(found.evaluate(f"{page}.view.configurations()"), [q, ghost], atol=1e-6)
    found.evaluate(f"{page}.step.ghosts = []; {page}.draw()")
    found.wait_for_function(f"(({COUNT})(document.querySelector('canvas')))[1] === {before[1]}")
    assert found.evaluate("getComputedStyle(document.querySelector('canvas')).touchAction") == "pan-y"


def framed(shown, ground, ink, wide):
    """A notebook or a column of the documentation that holds a view."""
    style = f"margin: 0 auto; width: {wide}px; background: {ground}; color: {ink}"
    return f'<!DOCTYPE html><html lang="en"><title>n</title><body style="{style}">{shown._repr_html_()}</body></html>'


def inside(found, script):
    return found.frames[1].evaluate(script)


GROUND = "getComputedStyle(document.documentElement).backgroundColor"


@pytest.mark.parametrize(("ground", "ink", "scheme", "shade"), [("#111", "#eee", "light", 20), ("#fff", "#222", "dark", 255)])
def test_in_a_notebook_a_view_is_dark_as_the_notebook_is_whatever_the_system_is(opened, ground, ink, scheme, shade):
    shown = arms.load("planar-3r").show()
    found = opened(framed(shown, ground, ink, 640), color_scheme=scheme)
    found.wait_for_function("document.querySelector('iframe').contentWindow")
    found.frames[1].wait_for_function(f"{GROUND}.startsWith('rgb({shade},')")
    found.evaluate(f"document.body.style.color = '{ground}'")  # another theme is chosen
    found.frames[1].wait_for_function(f"{GROUND}.startsWith('rgb({275 - shade},')")


@pytest.mark.parametrize("wide", [390, 690, 1000])
def test_the_frame_of_a_view_cuts_nothing_off(opened, wide):
    arm = arms.load("panda")
    q = generic_configuration(arm)
    shown = arm.show([q, q + 0.1], labels=["as it is", "best found"], locked=["panda_joint2", "panda_joint4"])
    found = opened(framed(shown, "#fff", "#222", wide))
    found.frames[1].wait_for_selector(".view3d-drawn")
    tall, room = inside(found, "[document.documentElement.scrollHeight, innerHeight]")
    assert tall <= room == shown.height
    assert inside(found, "document.querySelector('.view3d-stage').clientHeight") > 300
    inside(found, "document.querySelector('details').open = true")
    assert inside(found, "document.querySelector('.view3d-stage').clientHeight") >= 258  # the arm stays beside its sliders


def test_the_drawing_stays_until_the_view_is_drawn(opened):
    html = arms.load("planar-3r").show().to_html().replace("<main>", '<main style="margin-top: 3000px">')
    found = opened(html)
    seen = "getComputedStyle(document.querySelector('.view3d-stage svg')).visibility"
    found.wait_for_selector(".view3d-live", state="attached")
    assert found.evaluate(seen) == "visible"  # nothing was drawn: it is out of sight
    found.locator(".view3d-stage").scroll_into_view_if_needed()
    found.wait_for_function(f"{seen} === 'hidden'")
    assert painted(found)[0] > 50
