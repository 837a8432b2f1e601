"""The page's numerics, bundled by its own tools and called in Node."""

from __future__ import annotations

import json
import re
import subprocess
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

import chromium
import holdfast as hf
from holdfast import arms
from holdfast.interface.presentation.arm_page.printed_kernels import print_page_kernels
from holdfast.model.arm.task import as_task, default_path_task
from javascript import node

PAGE = Path(__file__).parents[3] / "page"
MODULES = ("arm_model", "closed_loop", "commands", "failures", "power_loss", "self_motion", "small_matrices", "tool_drag")
CRANE = Path(__file__).parents[1] / "studio" / "arms" / "inspection-crane.urdf"
_MAIN = """\
import {{ readFileSync, writeFileSync }} from "node:fs";
import * as page from "./page.mjs";
const data = JSON.parse(readFileSync("data.json", "utf8"));
const arm = new page.ArmModel({kernels}, data.joints, data.taskRows);
const call = ({function});
const plain = (_, value) => ArrayBuffer.isView(value) ? Array.from(value) : value;
writeFileSync("results.json", JSON.stringify(data.rows.map((row) => call(page, arm, row)), plain));
"""


class PageArm:
    """An arm on a page, for a task."""

    def __init__(self, arm: hf.Arm, folder: Path, task: str = "") -> None:
        self.arm, self.folder = arm, folder
        self.task = as_task(arm, task or default_path_task(arm, oriented=True))
        if self.task.m == arm.n:
            self.task = as_task(arm, default_path_task(arm, oriented=False))
        self.kernels = print_page_kernels(arm, self.task)

    def call(self, function: str, rows: list) -> list:
        """Results of ``(page, arm, row) => ...`` for each row; ``page`` is all of the page's numerics."""
        limits = [(joint.lower, joint.upper, joint.prismatic) for joint in self.arm.joints]
        joints = [
            {"low": low if np.isfinite(low) else None, "high": high if np.isfinite(high) else None, "slides": slides}
            for low, high, slides in limits
        ]
        data = {"rows": rows, "joints": joints, "taskRows": self.task.rows.tolist()}
        text = json.dumps(data, default=lambda value: value.tolist())
        (self.folder / "data.json").write_text(text, encoding="utf-8")
        (self.folder / "main.mjs").write_text(_MAIN.format(kernels=self.kernels, function=function), encoding="utf-8")
        done = subprocess.run([node(), "main.mjs"], cwd=self.folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return json.loads((self.folder / "results.json").read_text(encoding="utf-8"))


def bundle(folder: Path) -> None:
    """Bundle the page's numerics into ``page.mjs`` of a folder."""
    assert (PAGE / "node_modules").is_dir(), "the page's tools are not installed: 'make test' installs them"
    entry, sources = folder / "entry.ts", PAGE / "src" / "arm_page"
    entry.write_text("".join(f'export * from "{(sources / module).as_posix()}";\n' for module in MODULES), encoding="utf-8")
    command = [str(PAGE / "node_modules" / ".bin" / "rolldown"), str(entry), "-f", "esm", "-o", str(folder / "page.mjs")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="session")
def page_arm(tmp_path_factory):
    """``page_arm("arm")`` or ``page_arm("arm task")``: a built-in arm, or ``crane``: a URDF with a slide and six hinges."""
    folder = tmp_path_factory.mktemp("page")
    bundle(folder)

    @lru_cache
    def make(name: str) -> PageArm:
        label, _, task = name.partition(" ")
        return PageArm(hf.Arm.from_urdf(CRANE) if label == "crane" else arms.load(label), folder, task)

    return make


@pytest.fixture(scope="module")
def browser():
    """A running headless Chromium."""
    with chromium.opened(chromium.required) as opened:
        yield opened


@pytest.fixture
def opened(browser, tmp_path):
    """``opened(html)``: the page from disk, whose errors, console texts, and requests fail the test."""
    contexts, faults = [], []

    def show(html, width=1200, fragment="", **options):
        context = browser.new_context(viewport={"width": width, "height": 900}, offline=True, **options)
        contexts.append(context)
        context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url))
        page = context.new_page()
        page.on("pageerror", lambda error: faults.append(f"{error} {error.stack}"))
        page.on("console", lambda message: faults.append(message.text))
        file = tmp_path / f"{len(contexts)}.html"
        file.write_text(html, encoding="utf-8")
        page.goto(file.as_uri() + fragment)
        return page

    yield show
    for context in contexts:
        context.close()
    assert faults == []
