"""The page: one server, and a window of its own for everyone who opens it."""

from __future__ import annotations

import io
import socket
import threading
from collections.abc import Callable
from contextlib import redirect_stdout, suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import HoldfastError, InputError
from holdfast.present.arm.body import Part
from holdfast.present.arm.visuals import body_of
from holdfast.studio.aside import Aside
from holdfast.studio.scene.machine import Machine
from holdfast.studio.state import State

if TYPE_CHECKING:
    from holdfast.studio.window import Window

LOOPBACK = "127.0.0.1"
PORT = 8123


class Studio:
    """A page that is being served.

    Attributes:
        url: Where it is.
        host: The address it listens on.
        port: The port it listens on.
        windows: One for each open page, by number.
    """

    def __init__(self, server: Any, machine: Machine, state: State, *, parts: list[Part], note: str) -> None:
        from holdfast.studio.window import Window

        self._server = server
        self.host, self.port = server.get_host(), server.get_port()
        self.url = address(server)
        self.windows: dict[int, Window] = {}
        self.machine = machine
        self._aside = Aside(machine.arm, machine.task)
        self._stopped = threading.Event()

        def come(client: Any) -> None:
            window = self.windows[client.client_id] = Window(client, machine, self._aside, state, parts, note)
            if client.client_id not in server.get_clients():  # gone before it was there
                window.close()
                self.windows.pop(client.client_id, None)

        def go(client: Any) -> None:
            window = self.windows.pop(client.client_id, None)
            if window is not None:
                window.close()

        server.on_client_connect(come)
        server.on_client_disconnect(go)

    def wait(self) -> None:
        """Until :meth:`stop` is called, or the program is interrupted."""
        self._stopped.wait()

    def stop(self) -> None:
        """Close all windows and the server."""
        for window in list(self.windows.values()):
            window.close()
        self.windows.clear()
        self._aside.stop()
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
    host: str = LOOPBACK,
    *,
    port: int = PORT,
    task: Task | None = None,
    ready: Callable[[str], None] = lambda url: None,
) -> Studio:
    """Open the studio of an arm; it is served until :meth:`Studio.stop`.

    Everyone who opens the page has an arm of his own there, which begins with ``state``. Nothing is asked of any other host.

    Args:
        arm: The arm.
        state: What is shown at first; all joints healthy in the middle of their range if not given.
        host: The address to listen on. Who can reach it can read the motions and results that the page opens: other than
            the loopback address only in a network where all are trusted.
        port: The port; 0: any that is free.
        task: The task, where its name in ``state`` does not say it all.
        ready: Told the address as soon as a browser may open it; the arm comes while the browser loads the page.

    Raises:
        HoldfastError: Viser is not installed; it comes with ``holdfast[view]``.
        InputError: The port is in use, or the host is not an address of this machine.
        TaskError: A task that does not fit the arm.
    """
    if find_spec("viser") is None:
        raise HoldfastError("the studio needs viser; install it with: pip install 'holdfast[view]'")
    if state is None:
        state = State(arm.name, arm.joint_names, tuple(middle(arm)), task="pose")
    machine = Machine(arm, task or as_task(arm, state.task))
    free = free_port(host, port)
    # Before anybody can come: a page that is open already keeps the view that it began with.
    eye, centre = _camera(machine, np.array(state.q))
    import viser

    server = _private_server(viser, host, free)
    server.initial_camera.position, server.initial_camera.look_at = eye, centre
    server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="large")
    server.scene.configure_environment_map(hdri=None)
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.add_light_ambient("/ambient", intensity=1.6)
    ready(address(server))
    threading.Thread(target=_warm, args=(machine, state), daemon=True, name="studio warm-up").start()
    parts, note = body_of(arm, machine.size)
    return Studio(server, machine, state, parts=parts, note=note)


def address(server: Any) -> str:
    """Where a viser server is."""
    return f"http://{server.get_host()}:{server.get_port()}"


def _private_server(viser: Any, host: str, port: int) -> Any:
    """A viser server that never offers its page to others through a relay."""

    class Private(viser.ViserServer):  # type: ignore[misc]
        def request_share_url(self, verbose: bool = True) -> None:
            del verbose

    with redirect_stdout(io.StringIO()):  # it prints a box with the address, whatever it is told
        return Private(host=host, port=port, label="holdfast", verbose=False)


def free_port(host: str, port: int) -> int:
    """The port itself if nobody listens there, or any free one for 0.

    Raises:
        InputError: It is in use, not a port, or the host is not an address of this machine.
    """
    if not 0 <= port <= 65535:
        raise InputError(f"port {port} is not a port; give a number from 0 (any that is free) to 65535")
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        try:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
        except socket.gaierror as error:
            raise InputError(f"host '{host}' is not known; give an address of this machine, such as {LOOPBACK}") from error
        except OSError as error:
            raise InputError(
                f"port {port} of {host} cannot be used ({error.strerror or error}); choose another with --port, or 0 for any"
            ) from error
        return int(probe.getsockname()[1])


def middle(arm: Arm) -> np.ndarray[Any, np.dtype[np.float64]]:
    """A configuration (n,) between the limits, joints a little apart from special places."""
    low, high = (np.where(np.isfinite(x), x, s * 1.0) for x, s in ((arm.lower, -1), (arm.upper, 1)))
    share = 0.5 + 0.13 * np.sin(1.0 + 2.0 * np.arange(arm.n))
    return np.asarray(low + share * (high - low))


def _camera(machine: Machine, q: Any) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The first view of a window: from where, and at what."""
    places = machine.arm.frames(q)[:, :3, 3]
    centre = 0.5 * (places.min(axis=0) + places.max(axis=0))
    flat = machine.task.rows[:, :3]
    up = len(machine.task.rows) <= 3 and float(np.abs(flat[:, 2]).max()) < 1e-9 and not machine.task.rows[:, 3:5].any()
    way = np.array([0.0, -0.5, 1.4]) if up else np.array([0.95, -0.8, 0.45])
    # The controls cover the right side.
    beside = np.cross(-way, [0.0, 0.0, 1.0])
    centre = centre + 0.22 * machine.size * beside / np.linalg.norm(beside)
    eye = centre + 0.85 * machine.size * way
    return tuple(eye.tolist()), tuple(centre.tolist())


def _warm(machine: Machine, state: State) -> None:
    """Compile what the first picture shows while the browser loads the page."""
    with suppress(HoldfastError):  # the window says it
        machine.read(np.array(state.q), state.failed, state.index, state.susceptibility)
