"""Arms of URDF files on a page with a menu, in Chromium: their numbers against Python's reader, and what is refused."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import axe
import holdfast as hf
from holdfast import arms
from holdfast.model.arm.formats.urdf_writing import urdf_text

ARM = "document.querySelector('.arm').armPage.arm"
LAWS = ("pseudoinverse", "failure-tolerant")


def joint(name, parent, child, kind="revolute", origin='xyz="0 0 0.2"', axis="0 0 1", more='<limit lower="-2.5" upper="2"/>'):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin {origin}/>'
        f'<axis xyz="{axis}"/>{more}</joint>'
    )


def robot(*joints):
    links = sorted({link for text in joints for link in re.findall(r'link="([^"]*)"', text)})
    bodies = "".join(f'<link name="{link}"/>' for link in links)
    return f'<?xml version="1.0"?><robot name="made">{bodies}{"".join(joints)}</robot>'


def serial(count, **options):
    """Joints 1 to ``count`` between the links l0 to lN, about x and y in turn."""
    return [joint(f"j{k}", f"l{k - 1}", f"l{k}", axis=("1 0 0", "0 1 0")[k % 2], **options) for k in range(1, count + 1)]


def odd_arm(rng, count):
    """Arbitrary axes, angles with few digits, fixed joints in between, a joint without limits, and a gripper after the tool."""
    joints, parent = [], "base"
    for k in range(count):
        xyz, rpy, axis = (" ".join(f"{x:.4g}" for x in rng.uniform(-scale, scale, 3)) for scale in (0.3, 3, 1))
        rpy = "1.57079632679 0 -3.1415926536" if k == 2 else rpy
        joints.append(joint(f"fixed{k}", parent, f"plate{k}", "fixed", f'xyz="{xyz}" rpy="0 0.3 {k}"'))
        kind = ("revolute", "continuous")[k == 4]
        joints.append(joint(f"turn {k}", f"plate{k}", f"arm{k}", kind, f'rpy="{rpy}" xyz="{xyz}"', axis))
        parent = f"arm{k}"
    joints.append(joint("flange", parent, "tool", "fixed", 'xyz="0.01 0.02 0.1" rpy="0.1 0 0"'))
    joints += [joint(f"finger{k}", "tool", f"finger{k}", "prismatic") for k in (1, 2)]
    joints.append(joint("pan", "base", "camera", axis="0 0 1"))
    return robot(*joints)


def urdf_of(name):
    if name == "recorded":
        return (Path(__file__).parents[3] / "tools" / "recorded" / "arm.urdf").read_text(encoding="utf-8")
    arm = arms.load(name)
    return urdf_text(arm) if arm.chain is None else Path(arm.chain.file).read_text(encoding="utf-8")


def load(page, text, name="my arm.urdf"):
    """Open a text as a file of a visitor, and return the sentence about it."""
    page.locator("input[type=file]").set_input_files({"name": name, "mimeType": "text/xml", "buffer": text.encode()})
    status = page.locator("header [role=status]:not(:empty)")
    status.wait_for()
    sentence = status.inner_text()
    status.evaluate("(element) => element.replaceChildren()")
    return sentence


@pytest.fixture(scope="module")
def menu_html():
    return arms.load("panda").page(beside=[arms.load("iiwa14"), arms.load("pa10-9dof"), arms.load("ur5")]).to_html()


def read_python(text, tip, folder):
    file = folder / "arm.urdf"
    file.write_text(text, encoding="utf-8")
    return hf.Arm.from_urdf(file, tip=tip)


SOURCES = ["panda", "xarm7", "iiwa14", "openarm", "pa10-7dof", "pa10-9dof", "recorded", "odd 7", "odd 8", "odd 9"]


@pytest.mark.parametrize("source", SOURCES)
def test_a_file_has_the_numbers_of_python(opened, menu_html, tmp_path, rng, source):
    text = odd_arm(rng, int(source[-1])) if source.startswith("odd") else urdf_of(source)
    page = opened(menu_html)
    sentence = load(page, text)
    tip = re.fullmatch(r"my arm.urdf is shown. Its tool is the link (.*)\.", sentence)[1]
    arm = read_python(text, tip, tmp_path)
    if source.startswith("odd"):
        assert tip == "tool"
    elif source != "recorded" and arms.load(source).chain is not None:
        assert tip == arms.load(source).chain.tip
    q = rng.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3), (200, arm.n))
    velocity = rng.normal(size=(200, 3))
    shown = page.evaluate(
        f"""([rows, velocities]) => rows.map((q, k) => [
            {ARM}.frames(q).map((pose) => [...pose]), {ARM}.jacobian(q).map((row) => [...row]),
            {ARM}.nullSpace(q).map((row) => [...row]),
            {json.dumps(LAWS)}.map((law) => [...{ARM}.commandRates(law, q, velocities[k])])])""",
        [q.tolist(), velocity.tolist()],
    )
    poses, jacobians, null_rows, rates = (np.array(part) for part in zip(*shown, strict=True))
    frames = arm.frames(q)
    np.testing.assert_allclose(poses[:, -1].reshape(-1, 3, 4), frames[:, -1, :3], atol=2e-14)
    np.testing.assert_allclose(poses[:, 1:-1].reshape(200, -1, 3, 4)[..., 3], frames[:, 1:-1, :3, 3], atol=2e-14)
    axes = np.einsum("tkij,kj->tki", frames[:, 1:-1, :3, :3], [joint.axis for joint in arm.joints])
    np.testing.assert_allclose(poses[:, 1:-1].reshape(200, -1, 3, 4)[..., 2], axes, atol=2e-14)
    np.testing.assert_allclose(jacobians, arm.jacobian(q), atol=1e-13)
    assert null_rows.shape == (200, arm.n - 6, arm.n)
    products = null_rows @ null_rows.swapaxes(1, 2)
    np.testing.assert_allclose(products, np.broadcast_to(np.eye(arm.n - 6), products.shape), atol=1e-12)
    index = hf.indices.relative_manipulability(arm, "pose")
    np.testing.assert_allclose(np.linalg.norm(null_rows, axis=1), index.evaluate(q).by_failure, atol=1e-12)
    for k, label in enumerate(LAWS):
        expected = hf.laws.by_name(label, arm, task="position").velocity(q, velocity)
        np.testing.assert_allclose(rates[:, k], expected, rtol=1e-9, atol=1e-9 * abs(expected).max())
    limits = page.evaluate(f"[{ARM}.lower, {ARM}.upper].map((side) => [...side].map((x) => Number.isFinite(x) ? x : null))")
    for side, expected in zip(limits, (arm.lower, arm.upper), strict=True):
        assert side == [x if np.isfinite(x) else None for x in expected]
    bound = page.evaluate("document.querySelector('.arm').armPage.data.bound")
    assert bound == pytest.approx(hf.kinematics.index_bounds.upper_bound(n=arm.n, m=6).bound, abs=1e-12)


def test_a_step_of_the_inverse_kinematics_is_that_of_damped_least_squares(opened, menu_html, tmp_path, rng):
    text = odd_arm(rng, 8)
    page = opened(menu_html)
    load(page, text)
    arm = read_python(text, "tool", tmp_path)
    lower, upper = np.maximum(arm.lower, -3), np.minimum(arm.upper, 3)
    q, goal = rng.uniform(lower, upper, (2, 50, arm.n))
    q[::2, 3] = arm.upper[3]
    poses, goals = arm.forward_kinematics(q), arm.forward_kinematics(goal)
    free = np.where(np.arange(arm.n) == 1, 0, np.ones((50, arm.n)))
    rows = [
        [list(start), target[:3].reshape(-1).tolist(), list(mask)] for start, target, mask in zip(q, goals, free, strict=True)
    ]
    shown = page.evaluate(
        f"(rows) => rows.map((row) => {{ const {{ next, error }} = {ARM}.stepTowards(...row); return [[...next], error]; }})",
        rows,
    )
    for k, (following, size) in enumerate(shown):
        turn = Rotation.from_matrix(goals[k, :3, :3] @ poses[k, :3, :3].T).as_rotvec()
        error = np.r_[goals[k, :3, 3] - poses[k, :3, 3], turn]
        jacobian = arm.jacobian(q[k]) * free[k]
        pressed = ((q[k] >= arm.upper) & (jacobian.T @ error > 0)) | ((q[k] <= arm.lower) & (jacobian.T @ error < 0))
        jacobian = jacobian * ~pressed
        damping = 1e-3 * error @ error + 1e-12
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping * np.eye(6), error)
        np.testing.assert_allclose(following, np.clip(q[k] + step, arm.lower, arm.upper), atol=1e-9)
        assert size == pytest.approx(np.linalg.norm(error), rel=1e-12)


# ---- what the visitor sees -----------------------------------------------------------------------------------------------


def test_a_dropped_file_tells_the_story_without_a_power_cut(opened, menu_html, rng):
    page = opened(menu_html, reduced_motion="reduce")
    page.evaluate(
        """(text) => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([text], "eight.urdf"));
            const drop = new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer });
            document.querySelector("canvas").dispatchEvent(drop);
        }""",
        odd_arm(rng, 8),
    )
    page.locator(".bars button").nth(7).wait_for()
    assert page.get_by_label("Arm").input_value() == "eight.urdf"
    assert page.locator(".arm-steps button").evaluate_all("(all) => all.map((each) => each.dataset.step)") == [
        *("healthy", "lock", "prepare", "undetected")
    ]
    best = page.evaluate("document.querySelector('.arm').armPage.worst")
    page.locator('[data-step="lock"]').click()
    assert f"Joint {best + 1} is locked" in page.locator(".arm-headline").inner_text()
    page.locator('[data-step="undetected"]').click()
    assert page.locator(".law-key").count() == 3
    assert "8 joints" in page.locator(".bars-note").first.inner_text()
    before = page.evaluate(f"[...{ARM}.toolPosition(document.querySelector('.arm').armPage.state.q)]")
    page.locator('[data-step="healthy"]').click()
    page.locator(".tool-handle").focus()
    page.keyboard.press("ArrowRight")
    after = page.evaluate(f"[...{ARM}.toolPosition(document.querySelector('.arm').armPage.state.q)]")
    assert 1e-4 < np.linalg.norm(np.subtract(after, before)) < 0.2
    page.get_by_label("Arm").select_option("panda")
    assert page.locator(".arm-steps button").count() == 5
    assert page.locator(".bars button").count() == 7


def test_the_menu_has_the_built_in_arms(opened, menu_html):
    page = opened(menu_html)
    for name, count in (("iiwa14", 7), ("pa10-9dof", 9), ("ur5", 6)):
        page.get_by_label("Arm").select_option(name)
        page.wait_for_selector(".view3d-drawn")
        assert page.locator(".arm .bars button").count() == count
        page.wait_for_timeout(600)
        shell = page.locator(".command-shell").first.text_content()
        assert shell.split(" --")[0] in (f"holdfast index {name}", f"holdfast describe {name}")
    page.locator('[data-step="prepare"]').click()
    assert "Every joint counts" in page.locator(".arm-headline").inner_text()
    page.get_by_label("Arm").select_option("pa10-9dof")
    page.wait_for_timeout(600)
    again = opened(menu_html, fragment=page.evaluate("location.hash"))
    assert again.get_by_label("Arm").input_value() == "pa10-9dof"
    assert again.evaluate("document.querySelector('.arm').armPage.state.q.length") == 9


def test_the_command_gives_the_shown_numbers(opened, menu_html, cli, tmp_path, monkeypatch, rng, capsys):
    monkeypatch.chdir(tmp_path)
    name = "it's an arm.urdf"
    (tmp_path / name).write_text(odd_arm(rng, 7), encoding="utf-8")
    page = opened(menu_html)
    load(page, (tmp_path / name).read_text(encoding="utf-8"), name)
    page.wait_for_timeout(600)
    shell, python = (page.locator(f".command-{kind}").first.text_content() for kind in ("shell", "python"))
    code, _, error = cli(*shlex.split(shell)[1:])
    assert (code, error) == (0, "")
    capsys.readouterr()
    exec(compile(python, "page", "exec"), {})
    printed = [float(x) for x in re.findall(r"\d+\.?\d*(?:e-?\d+)?", capsys.readouterr().out)]
    np.testing.assert_allclose(printed, page.evaluate("[...document.querySelector('.arm').armPage.fractions]"), atol=1e-6)


LONE = [joint("j1", "a", "b"), joint("j1b", "c", "d")]
REFUSED = {
    "It is not a URDF file": ["<robot", "<model/>", "", '<!DOCTYPE robot [<!ENTITY a "b">]><robot/>'],
    "Its links do not form one tree": [robot(*LONE), robot(joint("j1", "a", "b"), joint("j2", "a", "b")), "<robot/>"],
    "The page needs 6 to 9 revolute joints, not 5": [robot(*serial(5))],
    "The page needs 6 to 9 revolute joints, not 10": [robot(*serial(10))],
    "Joint rail is prismatic, not revolute": [robot(joint("rail", "base", "l0", "prismatic"), *serial(7))],
    "Joint j0 is a mimic joint, not revolute": [
        robot(joint("j0", "base", "l0", more='<limit lower="0" upper="1"/><mimic joint="j1"/>'), *serial(7))
    ],
    "Joint j1 needs a lower limit below its upper limit": [
        robot(*serial(7, more=more)) for more in ("", "<limit effort='1'/>", '<limit lower="1" upper="-1"/>')
    ],
    "The axis of joint j7 is 0 0 0": [robot(*serial(6), joint("j7", "l6", "l7", axis="0 0 0"))],
    'It has "0 0 ${h}" in place of 3 numbers': [robot(*serial(7, origin='xyz="0 0 ${h}"'))],
    'It has "1 2" in place of 3 numbers': [robot(*serial(7, origin='xyz="1 2"'))],
}


def test_other_files_are_refused_in_one_sentence_that_names_the_command(opened, menu_html, tmp_path):
    page = opened(menu_html)
    for reason, texts in REFUSED.items():
        for text in texts:
            assert load(page, text) == f"{reason}; for other arms, run 'holdfast page my arm.urdf'."
            assert page.get_by_label("Arm").input_value() == "panda"
            if "6 to 9" not in reason and "prismatic" not in reason:  # those are arms for the command
                with pytest.raises(hf.HoldfastError):
                    read_python(text, None, tmp_path)
    page.get_by_label("Arm").select_option("iiwa14")
    load(page, "<robot/>")
    assert page.get_by_label("Arm").input_value() == "iiwa14"


@pytest.mark.parametrize("name", ["</script><img src=x onerror=alert(1)>.urdf", "constructor", "__proto__", "panda"])
def test_names_in_a_file_are_never_read_as_html(opened, menu_html, name):
    bad = "&lt;/script>&lt;img src=x onerror=alert(1)>"
    text = robot(*serial(7)).replace('"l7"', f'"{bad}"').replace('"j3"', f'"{bad}"')
    page = opened(menu_html)
    sentence = load(page, text, name)
    assert sentence == f"{name} is shown. Its tool is the link </script><img src=x onerror=alert(1)>."
    for step in ("lock", "prepare", "undetected"):
        page.locator(f'[data-step="{step}"]').click()
    page.get_by_role("button", name="Names").click()
    page.wait_for_timeout(600)
    assert page.locator("img").count() == 0
    assert "</script><img" in page.locator(".view3d-joint").nth(2).text_content()


def test_the_page_stays_small_and_its_policy_strict(menu_html):
    assert len(menu_html.encode()) <= 235_000
    assert "innerHTML" not in menu_html
    assert "unsafe-eval" not in menu_html
    assert "anyArm" not in arms.load("planar-3r").page().to_html()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1200, 390])
def test_the_menu_and_the_file_button_are_accessible(opened, menu_html, scheme, width, rng):
    page = opened(menu_html, width=width, color_scheme=scheme)
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.type") == "file"
    load(page, odd_arm(rng, 9))
    for step in ("healthy", "lock", "prepare", "undetected"):
        page.locator(f'[data-step="{step}"]').click()
        page.wait_for_timeout(600)
        assert axe.serious(page) == []
    if width == 390:
        page.set_viewport_size({"width": 320, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= 320


def test_a_file_opens_in_a_sandboxed_frame(opened, rng):
    frame = arms.load("panda").page(beside=[arms.load("iiwa14")])._repr_html_().replace("onload=", "data-onload=")
    page = opened(f"<!DOCTYPE html><title>t</title>{frame}")
    inner = page.frame_locator("iframe")
    file = {"name": "a.urdf", "mimeType": "text/xml", "buffer": odd_arm(rng, 7).encode()}
    inner.locator("input[type=file]").set_input_files(file)
    inner.locator("header [role=status]", has_text="a.urdf is shown").wait_for()
    inner.locator('[data-step="lock"]').click()
    assert "is locked" in inner.locator(".arm-headline").inner_text()
    page.wait_for_timeout(600)


def test_the_menu_has_the_task_of_the_page(opened, tmp_path, rng):
    page = opened(arms.load("panda").page(task="position", beside=[arms.load("iiwa14")]).to_html())
    text = odd_arm(rng, 8)
    load(page, text)
    arm = read_python(text, "tool", tmp_path)
    q = page.evaluate("[...document.querySelector('.arm').armPage.state.q]")
    expected = hf.indices.relative_manipulability(arm, "position").evaluate(q).by_failure
    np.testing.assert_allclose(page.evaluate("[...document.querySelector('.arm').armPage.fractions]"), expected, atol=1e-12)
    bound = page.evaluate("document.querySelector('.arm').armPage.data.bound")
    assert bound == pytest.approx(hf.kinematics.index_bounds.upper_bound(n=8, m=3).bound, abs=1e-12)
