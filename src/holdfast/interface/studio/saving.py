"""Pictures and cells saved by the user: created by a worker thread, and sent to the browser as files."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.interface.studio.scene.stage import Stage
from holdfast.interface.studio.state import State
from holdfast.interface.studio.work import LongJobWorker

MAX_PICTURE_PX = (900, 1200)  # largest height and width of a PNG


class ViewSaver:
    """Saver of one client's view; the files are named after the arm.

    Args:
        client: Client of viser, which receives the files.
        machine: Compiled arm.
        stage: Scene of the client.
        on_saved: Function that is called with a sentence about the saved file.
        on_error: Function that is called with an exception.
    """

    def __init__(
        self,
        client: Any,
        machine: CompiledArm,
        stage: Stage,
        on_saved: Callable[[str], None],
        on_error: Callable[[BaseException], None],
    ) -> None:
        self._client, self._machine, self._stage, self._on_saved = client, machine, stage, on_saved
        self._worker = LongJobWorker(on_error)

    def stop(self) -> None:
        """Stop the worker thread."""
        self._worker.stop()

    def save(self, file_kind: str, state: State, ghosts: list[NDArray[np.float64]]) -> None:
        """Save the scene as ``png`` or ``svg``, or the cell as ``cell-file``.

        Args:
            file_kind: Kind of the file.
            state: State of the view.
            ghosts: Configurations (n,) of ghost arms.
        """
        match file_kind:
            case "png":
                self._save_png()
            case "svg":
                self._save_svg(state, ghosts)
            case _:
                self._save_cell(state)

    def _save_png(self) -> None:
        """Save the scene from the client's camera, without the handles."""
        camera = self._client.camera
        height = min(MAX_PICTURE_PX[0], int(camera.image_height))
        width = min(MAX_PICTURE_PX[1], int(camera.image_width))

        def render_and_send(_: Callable[[], None]) -> None:
            from holdfast.interface.studio.picture import encode_png

            handles = [control for control in (self._stage.gizmo, self._stage.target) if control.visible]
            for handle in handles:
                handle.visible = False
            try:
                picture = self._client.get_render(height, width, transport_format="png", timeout=60.0)
            finally:
                for handle in handles:
                    handle.visible = True
            self._send_file(f"{self._machine.arm.name}.png", encode_png(picture))

        self._worker.submit(render_and_send)

    def _save_svg(self, state: State, ghosts: list[NDArray[np.float64]]) -> None:
        """Save a drawing of a state, with ghost arms at configurations (n,)."""

        def draw_and_send(_: Callable[[], None]) -> None:
            from holdfast.interface.studio.picture import draw_view_svg

            self._send_file(f"{self._machine.arm.name}.svg", draw_view_svg(self._machine, state, ghosts).encode())

        self._worker.submit(draw_and_send)

    def _save_cell(self, state: State) -> None:
        """Save the cell with the current poses of its objects; meshes and clouds are named by absolute paths."""

        def write_and_send(_: Callable[[], None]) -> None:
            from holdfast.model.cell import cell_file

            cell = self._machine.cell_with_moved(state.moved)
            name = f"{re.sub(r'[^A-Za-z0-9._-]+', '-', cell.name).strip('-.') or 'cell'}.yaml"
            content = cell_file.format_cell(cell.to_dict()).encode()
            self._send_file(
                name, content, f" To open it, run in its folder: {replace(state, cell=name, moved=()).to_command()}"
            )

        self._worker.submit(write_and_send)

    def _send_file(self, name: str, content: bytes, note: str = "") -> None:
        self._client.send_file_download(name, content, save_immediately=True)
        self._on_saved(f"Saved {name}.{note}")
