"""Holdfast in the kernel of a notebook: the quickstart from top to bottom, then what only a kernel shows."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

pytest.importorskip("ipykernel")
NOTEBOOK = Path(__file__).parents[3] / "examples" / "quickstart.ipynb"
LONG = 200  # s; nothing waits for it but what hangs


class Notebook:
    """A kernel, and what its cells show."""

    def __init__(self, folder):
        from jupyter_client.manager import KernelManager

        self.manager = KernelManager(kernel_name="python3")
        self.manager.start_kernel(cwd=str(folder))
        self.client = self.manager.blocking_client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=LONG)

    def end(self):
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=True)
        self.manager.cleanup_resources()

    def run(self, code, seen=lambda text: None):
        """The outputs of a cell as the page shows them in the end; ``seen`` is told what comes."""
        asked, outputs = self.client.execute(code), []
        while True:
            message = self.client.get_iopub_msg(timeout=LONG)
            content, kind = message["content"], message["msg_type"]
            assert message["parent_header"].get("msg_id") == asked
            if kind == "status" and content["execution_state"] == "idle":
                return [output for output, _ in outputs]
            if kind == "stream":
                outputs.append(({"text/plain": content["text"]}, None))
            elif kind == "error":
                outputs.append(({"error": content["ename"]}, None))
            elif kind in ("execute_result", "display_data"):
                outputs.append((content["data"], content.get("transient", {}).get("display_id")))
            elif kind == "update_display_data":
                (k,) = [k for k, (_, which) in enumerate(outputs) if which == content["transient"]["display_id"]]
                outputs[k] = content["data"], content["transient"]["display_id"]
            else:
                continue
            seen(outputs[-1][0].get("text/plain", ""))


@pytest.fixture(scope="module")
def notebook(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOLDFAST_BACKEND", "casadi")
        patch.delenv("HOLDFAST_NOTICES", raising=False)
        made = Notebook(tmp_path_factory.mktemp("notebook"))
    yield made
    made.end()


@pytest.fixture(scope="module")
def quickstart(notebook):
    """Outputs of its cells by id, without the first one, which would install holdfast from the network."""
    first, *cells = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
    assert first["source"] == ["%pip install --quiet 'holdfast-arms[report]'"]
    return {cell["id"]: notebook.run("".join(cell["source"])) for cell in cells}


def test_the_quickstart_runs_and_holds_no_outputs(quickstart):
    assert [name for name, outputs in quickstart.items() if any("error" in each for each in outputs)] == []
    written = json.loads(NOTEBOOK.read_text())
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in written["cells"] if "outputs" in cell)


def test_its_cells_end_with_a_card(quickstart):
    for name in ("arm", "assess", "unnoticed", "optimise"):
        assert "<table" in quickstart[name][-1]["text/html"], name
    assert "After an undetected lock of" in quickstart["unnoticed"][-1]["text/html"]
    before, after = map(float, re.findall(r"\d\.\d+", quickstart["optimise"][-2]["text/plain"]))
    assert before < after
    said = quickstart["assess"][-1]["text/plain"]
    assert said.startswith("With probability")
    assert "array(" not in said


@pytest.mark.parametrize("before", ["", "%matplotlib inline\n", "import matplotlib.pyplot\n"])
def test_a_figure_is_shown_once(quickstart, notebook, before):
    assert [sorted(output) for output in notebook.run(f"{before}result.plot()")] == [["image/png", "text/plain"]]


def test_a_cell_is_interrupted_and_its_line_ends(quickstart, notebook):
    lines = []

    def seen(text):
        lines.append(text)
        if len(lines) == 1:
            notebook.manager.interrupt_kernel()

    line, error = notebook.run("hf.assess(arm, region, index, poses=10**6)", seen)
    assert lines[0].startswith("holdfast: assessing poses")
    assert line["text/plain"].startswith("holdfast: assessing poses: stopped after")
    assert error == {"error": "KeyboardInterrupt"}
    assert notebook.run("1 + 1") == [{"text/plain": "2"}]
