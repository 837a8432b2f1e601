"""Pictures that a person saves: made beside the page, and handed to the browser as files."""

from __future__ import annotations

from collections.abc import Callable
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

    def png(self) -> None:
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
            self._send("png", png(picture))

        self._worker.ask(job)

    def svg(self, state: State, ghosts: list[NDArray[np.float64]]) -> None:
        """A drawing of a state, with ghost arms at configurations (n,)."""

        def job(_: Callable[[], None]) -> None:
            from holdfast.studio.picture import drawing

            self._send("svg", drawing(self._machine, state, ghosts).encode())

        self._worker.ask(job)

    def _send(self, kind: str, content: bytes) -> None:
        name = f"{self._machine.arm.name}.{kind}"
        self._client.send_file_download(name, content, save_immediately=True)
        self._saved(f"Saved {name}.")
