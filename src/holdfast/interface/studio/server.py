"""Server of the studio, with a separate window for each open page."""

from __future__ import annotations

import io
import socket
import threading
from collections.abc import Callable
from contextlib import redirect_stdout, suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.interface.presentation.arm.body import MeshPart
from holdfast.interface.presentation.arm.visuals import build_body
from holdfast.interface.studio.page.access import AccessFilter
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.interface.studio.worker_process import WorkerProcess
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import Task, as_task
from holdfast.model.arms.spec import default_task
from holdfast.model.cell.cell import Cell

if TYPE_CHECKING:
    from holdfast.interface.studio.window import Window

LOOPBACK_HOST = "127.0.0.1"
DEFAULT_PORT = 8123


class Studio:
    """Running studio server.

    Args:
        server: Viser server.
        machine: Compiled arm.
        state: Initial state of each window.
        parts: Meshes of the arm.
        note: Sentence for the user about these meshes.

    Attributes:
        url: URL of the server.
        host: Address on which it listens.
        port: Port on which it listens.
        windows: Window of each open page, by number.
    """

    def __init__(self, server: Any, machine: CompiledArm, state: State, *, parts: list[MeshPart], note: str) -> None:
        from holdfast.interface.studio.page import upload
        from holdfast.interface.studio.window import Window

        self._server, self._window_class = server, Window
        self.host, self.port = server.get_host(), server.get_port()
        self.url = get_server_url(server)
        self.windows: dict[int, Window] = {}
        self.machine = machine
        self._worker_process = WorkerProcess(machine.arm, machine.task, machine.cell)
        self._own_processes: dict[int, WorkerProcess] = {}  # of windows with an uploaded arm
        self._stopped = threading.Event()

        def open_client(client: Any) -> None:
            if _is_portrait(client):
                client.camera.position, client.camera.look_at = _choose_camera(machine, np.array(state.q), portrait=True)
            upload.limit_uploads(client.gui, lambda text: self.windows[client.client_id].show_refusal(text))
            self._open_window(client, machine, self._worker_process, state, parts, note)

        def close_client(client: Any) -> None:
            self._close_window(client.client_id)

        server.on_client_connect(open_client)
        server.on_client_disconnect(close_client)

    def _open_window(
        self, client: Any, machine: CompiledArm, worker_process: WorkerProcess, state: State, parts: list[MeshPart], note: str
    ) -> None:
        self.windows[client.client_id] = self._window_class(
            client, machine, worker_process, state, parts=parts, note=note, load_arm=self._load_arm
        )
        if client.client_id not in self._server.get_clients():  # disconnected before its window was open
            self._close_window(client.client_id)

    def _close_window(self, number: int) -> None:
        window, worker_process = self.windows.pop(number, None), self._own_processes.pop(number, None)
        if window is not None:
            window.close()
        if worker_process is not None:
            worker_process.stop()

    def _load_arm(self, client: Any, name: str, content: bytes) -> None:
        """Open the arm of an uploaded file in a client's window; errors of the file are raised before the window changes."""
        from holdfast.interface.studio.page.upload import read_uploaded_arm

        machine, state, parts, note = read_uploaded_arm(name, content)
        q = np.array(state.q)
        # Everything is prepared first, so that an arm that cannot be shown changes nothing.
        machine.evaluate_live_reading(q, (), state.index, state.susceptibility, state.powerless)
        self._close_window(client.client_id)
        client.gui.reset()
        client.scene.reset()
        client.camera.position, client.camera.look_at = _choose_camera(machine, q, _is_portrait(client))
        worker_process = self._own_processes[client.client_id] = WorkerProcess(machine.arm, machine.task, machine.cell)
        self._open_window(client, machine, worker_process, state, parts, note)

    def wait(self) -> None:
        """Wait until :meth:`stop` is called or the program is interrupted."""
        self._stopped.wait()

    def stop(self) -> None:
        """Close all windows and the server."""
        for number in list(self.windows):
            self._close_window(number)
        self._worker_process.stop()
        with redirect_stdout(io.StringIO()):
            self._server.stop()
        self._stopped.set()

    def __enter__(self) -> Studio:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()


def serve(
    arm: Arm,
    state: State | None = None,
    host: str = LOOPBACK_HOST,
    *,
    port: int = DEFAULT_PORT,
    task: Task | None = None,
    cell: Cell | None = None,
    ready: Callable[[str], None] = lambda url: None,
) -> Studio:
    """Open the studio of an arm and serve it until :meth:`Studio.stop`.

    Each open page has its own arm, which begins with ``state``. The studio sends no request to any other host.

    Args:
        arm: Arm to show.
        state: Initial state. Default: all joints healthy, in a generic configuration.
        host: Address on which the server listens. It admits only pages that it has served, but everyone who reaches the address
            can open such a page. Therefore, use another address than the loopback address only in a trusted network.
        port: Port on which the server listens; 0: any free port.
        task: Task, if its name in ``state`` does not determine it.
        cell: Objects around the arm, which can be dragged. None: no objects.
        ready: Function that is called with the URL as soon as a browser may open it; the arm is sent while the page loads.

    Raises:
        HoldfastError: Viser is not installed; it comes with ``holdfast-arms[view]``.
        InputError: The port is in use, the host is not an address of this machine, or the arm's base touches an object.
        TaskError: The task does not fit the arm.
    """
    if find_spec("viser") is None:
        raise HoldfastError("the studio needs viser; install it with: pip install 'holdfast-arms[view]'")
    if state is None:
        q = tuple(float(value) for value in generic_configuration(arm))
        state = State(arm.name, arm.joint_names, q, task=default_task(arm.name, arm))
    machine = CompiledArm(arm, task or as_task(arm, state.task), cell)
    machine.get_clearance(state.moved)  # raises errors of the cell before a page is open
    bound_port = find_free_port(host, port)
    # Before a page can connect, because a page that is already open keeps its initial view.
    camera_position, look_at = _choose_camera(machine, np.array(state.q))
    import viser

    server = _start_private_server(viser, host, bound_port)
    server.initial_camera.position, server.initial_camera.look_at = camera_position, look_at
    server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="large")
    server.scene.configure_environment_map(hdri=None)
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.add_light_ambient("/ambient", intensity=1.6)
    ready(get_server_url(server))
    threading.Thread(target=_compile_first_view, args=(machine, state), daemon=True, name="studio warm-up").start()
    parts, note = build_body(arm, machine.size)
    return Studio(server, machine, state, parts=parts, note=note)


def get_server_url(server: Any) -> str:
    """Return the URL of a viser server."""
    return f"http://{server.get_host()}:{server.get_port()}"


def _start_private_server(viser: Any, host: str, port: int) -> Any:
    """Start a viser server that never offers its page to others through a relay."""

    class Private(viser.ViserServer):  # type: ignore[misc]
        def request_share_url(self, verbose: bool = True) -> None:
            del verbose

    with (
        AccessFilter(host).filter_requests(),
        redirect_stdout(io.StringIO()),
    ):  # viser prints a box with the address in spite of its options
        return Private(host=host, port=port, label="holdfast", verbose=False)


def find_free_port(host: str, port: int) -> int:
    """Return the port if it is not in use, or any free port for 0.

    Raises:
        InputError: The port is in use or invalid, or the host is not an address of this machine.
    """
    if not 0 <= port <= 65535:
        raise InputError(f"port {port} is not a port; give a number from 0 (any that is free) to 65535")
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        try:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
        except socket.gaierror as error:
            raise InputError(f"host '{host}' is not known; give an address of this machine, such as {LOOPBACK_HOST}") from error
        except OSError as error:
            raise InputError(
                f"port {port} of {host} cannot be used ({error.strerror or error}); choose another with --port, or 0 for any"
            ) from error
        return int(probe.getsockname()[1])


def _is_portrait(client: Any) -> bool:
    """Return True if a client's picture is higher than wide, as on a phone, where the controls cover its lower half."""
    return bool(client.camera.image_height > client.camera.image_width)


def _choose_camera(machine: CompiledArm, q: Any, portrait: bool = False) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Choose the first camera position of a window and the point at its center."""
    positions = machine.arm.frames(q)[:, :3, 3]
    look_at = 0.5 * (positions.min(axis=0) + positions.max(axis=0))
    linear_rows = machine.task.rows[:, :3]
    seen_from_above = (
        len(machine.task.rows) <= 3 and float(np.abs(linear_rows[:, 2]).max()) < 1e-9 and not machine.task.rows[:, 3:5].any()
    )
    view_direction = np.array([0.0, -0.5, 1.4]) if seen_from_above else np.array([0.95, -0.8, 0.45])
    arm_direction = positions[-1, :2] - positions[0, :2]
    if not seen_from_above and np.linalg.norm(arm_direction) > 0.1 * machine.size:  # rather from the side than from the front
        forward = arm_direction / np.linalg.norm(arm_direction)
        view_direction[:2] = 0.6 * forward + 1.1 * np.array([forward[1], -forward[0]])
    # The controls cover the right side, or the lower half of the picture.
    sideways = np.cross(-view_direction, [0.0, 0.0, 1.0])
    shift = np.cross(sideways, view_direction) if portrait else sideways
    look_at = look_at + (0.45 if portrait else 0.22) * machine.size * shift / np.linalg.norm(shift)
    camera_position = look_at + (1.5 if portrait else 0.85) * machine.size * view_direction
    return tuple(camera_position.tolist()), tuple(look_at.tolist())


def _compile_first_view(machine: CompiledArm, state: State) -> None:
    """Compile the functions of the first picture while the browser loads the page."""
    with suppress(HoldfastError):  # the window reports it
        machine.evaluate_live_reading(np.array(state.q), state.failed_joints, state.index, state.susceptibility)
