"""JavaScript in Node, as the tests run it: text and numbers in, numbers out."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

_FRAME = """\
import fs from "node:fs";
const read=fs.readFileSync(process.argv[2]);
const input=new Float64Array(read.buffer.slice(read.byteOffset,read.byteOffset+read.byteLength));
const output=new Float64Array({size});
{script}
fs.writeFileSync(process.argv[3],Buffer.from(output.buffer));
"""


def node() -> str:
    """Path of Node; a test that needs it fails without it, because the page would otherwise go untested."""
    path = shutil.which("node")
    assert path, "the arm of the page runs in JavaScript, and its tests need Node 20 or newer: 'make test' installs it"
    return path


def run(script: str, numbers: np.ndarray, size: int, **files: str) -> np.ndarray:
    """Run the script of an ES module.

    Args:
        script: Reads the Float64Array ``input``, writes the Float64Array ``output``.
        numbers: What is in ``input``.
        size: Of ``output``.
        files: Other modules: ``arm="..."`` can be imported as ``./arm.mjs``.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for stem, text in files.items():
            (folder / f"{stem}.mjs").write_text(text, encoding="utf-8")
        (folder / "main.mjs").write_text(_FRAME.format(size=size, script=script), encoding="utf-8")
        (folder / "input").write_bytes(np.ascontiguousarray(numbers, dtype="<f8").tobytes())
        arguments = [node(), "main.mjs", "input", "output"]
        done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode == 0, f"Node says: {done.stderr.strip()}"
        assert not done.stdout + done.stderr
        return np.frombuffer((folder / "output").read_bytes(), dtype="<f8")


def rows(text: str, name: str, inputs: np.ndarray, width: int) -> np.ndarray:
    """What a printed program makes of rows (N, n_in): (N, n_out)."""
    count, n = inputs.shape
    script = f"""{text}
const x=new Float64Array({n}),y=new Float64Array({width});
for(let k=0;k<{count};k++){{
x.set(input.subarray(k*{n},(k+1)*{n}));
{name}(x,y);
output.set(y,k*{width});
}}"""
    return run(script, inputs, count * width).reshape(count, width)
