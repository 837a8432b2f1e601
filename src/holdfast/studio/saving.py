"""What a person saves, pictures and the cell: made beside the page, and handed to the browser as files."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.studio.scene.machine import Machine
from holdfast.studio.scene.stage import Stage
from holdfast.studio.state import State
from holdfast.studio.work import Worker

PICTURE = (900, 1200)  # largest height and width of a PNG


class Saver:
    """Saves what one client sees, named after the arm.

    Args:
        client: Of Viser; it is sent the files.
        machine: The arm.
        stage: What the client sees of it.
        saved: Is told in a sentence what was saved.
        complain: Is told what went wrong.
    """

    def __init__(
        self,
        client: Any,
        machine: Machine,
        stage: Stage,
        saved: Callable[[str], None],
        complain: Callable[[BaseException], None],
    ) -> None:
        self._client, self._machine, self._stage, self._saved = client, machine, stage, saved
        self._worker = Worker(complain)

    def stop(self) -> None:
        """Save nothing any more."""
        self._worker.stop()

    def save(self, what: str, state: State, ghosts: list[NDArray[np.float64]]) -> None:
        """The scene as ``png`` or ``svg``, or the ``cell-file``.

        Args:
            what: Which of them.
            state: What is shown.
            ghosts: Configurations (n,) of ghost arms.
        """
        match what:
            case "png":
                self._png()
            case "svg":
                self._svg(state, ghosts)
            case _:
                self._cell(state)

    def _png(self) -> None:
        """The scene as the client's camera sees it, without the handles."""
        camera = self._client.camera
        height = min(PICTURE[0], int(camera.image_height))
        width = min(PICTURE[1], int(camera.image_width))

        def job(_: Callable[[], None]) -> None:
            from holdfast.studio.picture import png

            handles = [h for h in (self._stage.gizmo, self._stage.target) if h.visible]
            for handle in handles:
                handle.visible = False
            try:
                picture = self._client.get_render(height, width, transport_format="png", timeout=60.0)
            finally:
                for handle in handles:
                    handle.visible = True
            self._send(f"{self._machine.arm.name}.png", png(picture))

        self._worker.ask(job)

    def _svg(self, state: State, ghosts: list[NDArray[np.float64]]) -> None:
        """A drawing of a state, with ghost arms at configurations (n,)."""

        def job(_: Callable[[], None]) -> None:
            from holdfast.studio.picture import drawing

            self._send(f"{self._machine.arm.name}.svg", drawing(self._machine, state, ghosts).encode())

        self._worker.ask(job)

    def _cell(self, state: State) -> None:
        """The cell with its objects where they are now; meshes and clouds are named by their whole paths."""

        def job(_: Callable[[], None]) -> None:
            from holdfast.cell import cell_file

            cell = self._machine.cell_with(state.moved)
            name = f"{re.sub(r'[^A-Za-z0-9._-]+', '-', cell.name).strip('-.') or 'cell'}.yaml"
            content = cell_file.text(cell.to_dict()).encode()
            self._send(name, content, f" From its folder: {replace(state, cell=name, moved=()).to_command()}")

        self._worker.ask(job)

    def _send(self, name: str, content: bytes, more: str = "") -> None:
        self._client.send_file_download(name, content, save_immediately=True)
        self._saved(f"Saved {name}.{more}")
