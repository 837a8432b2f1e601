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
from holdfast.arm.postures import generic_configuration
from holdfast.arm.task import Task, as_task
from holdfast.arms.spec import default_task
from holdfast.cell.cell import Cell
from holdfast.errors import HoldfastError, InputError
from holdfast.present.arm.body import Part
from holdfast.present.arm.visuals import body_of
from holdfast.studio.aside import Aside
from holdfast.studio.page.entrance import Entrance
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
        from holdfast.studio.page import upload
        from holdfast.studio.window import Window

        self._server, self._window = server, Window
        self.host, self.port = server.get_host(), server.get_port()
        self.url = address(server)
        self.windows: dict[int, Window] = {}
        self.machine = machine
        self._aside = Aside(machine.arm, machine.task, machine.cell)
        self._own: dict[int, Aside] = {}  # of windows with an arm of their own
        self._stopped = threading.Event()

        def come(client: Any) -> None:
            if _is_tall(client):
                client.camera.position, client.camera.look_at = _camera(machine, np.array(state.q), tall=True)
            upload.limit(client.gui, lambda text: self.windows[client.client_id].refuse(text))
            self._open(client, machine, self._aside, state, parts, note)

        def go(client: Any) -> None:
            self._close(client.client_id)

        server.on_client_connect(come)
        server.on_client_disconnect(go)

    def _open(self, client: Any, machine: Machine, aside: Aside, state: State, parts: list[Part], note: str) -> None:
        self.windows[client.client_id] = self._window(client, machine, aside, state, parts=parts, note=note, load=self._load)
        if client.client_id not in self._server.get_clients():  # gone before it was there
            self._close(client.client_id)

    def _close(self, number: int) -> None:
        window, aside = self.windows.pop(number, None), self._own.pop(number, None)
        if window is not None:
            window.close()
        if aside is not None:
            aside.stop()

    def _load(self, client: Any, name: str, content: bytes) -> None:
        """Open the arm of a file that was sent, in place of a client's window; what is wrong with it is raised before that."""
        from holdfast.studio.page.upload import read_machine

        machine, state, parts, note = read_machine(name, content)
        q = np.array(state.q)
        machine.read(q, (), state.index, state.susceptibility)  # nothing is given up for an arm that cannot be shown
        self._close(client.client_id)
        client.gui.reset()
        client.scene.reset()
        client.camera.position, client.camera.look_at = _camera(machine, q, _is_tall(client))
        aside = self._own[client.client_id] = Aside(machine.arm, machine.task, machine.cell)
        self._open(client, machine, aside, state, parts, note)

    def wait(self) -> None:
        """Until :meth:`stop` is called, or the program is interrupted."""
        self._stopped.wait()

    def stop(self) -> None:
        """Close all windows and the server."""
        for number in list(self.windows):
            self._close(number)
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
    cell: Cell | None = None,
    ready: Callable[[str], None] = lambda url: None,
) -> Studio:
    """Open the studio of an arm; it is served until :meth:`Studio.stop`.

    Everyone who opens the page has an arm of his own there, which begins with ``state``. Nothing is asked of any other host.

    Args:
        arm: The arm.
        state: What is shown at first; all joints healthy, in a generic configuration, if not given.
        host: The address to listen on. Only pages that it has served itself are let in, but whoever reaches it can open such a
            page: other than the loopback address only in a network where all are trusted.
        port: The port; 0: any that is free.
        task: The task, where its name in ``state`` does not say it all.
        cell: The objects around the arm, which can be dragged.
        ready: Told the address as soon as a browser may open it; the arm comes while the browser loads the page.

    Raises:
        HoldfastError: Viser is not installed; it comes with ``holdfast[view]``.
        InputError: The port is in use, the host is not an address of this machine, or the arm's base touches an object.
        TaskError: A task that does not fit the arm.
    """
    if find_spec("viser") is None:
        raise HoldfastError("the studio needs viser; install it with: pip install 'holdfast[view]'")
    if state is None:
        q = tuple(float(x) for x in generic_configuration(arm))
        state = State(arm.name, arm.joint_names, q, task=default_task(arm.name, arm))
    machine = Machine(arm, task or as_task(arm, state.task), cell)
    machine.clearance(state.moved)  # what is wrong with it is said before anybody comes
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

    with Entrance(host).before(), redirect_stdout(io.StringIO()):  # it prints a box with the address, whatever it is told
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


def _is_tall(client: Any) -> bool:
    """Whether a client's picture is higher than it is wide, as on a phone: there the controls cover its lower half."""
    return bool(client.camera.image_height > client.camera.image_width)


def _camera(machine: Machine, q: Any, tall: bool = False) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The first view of a window: from where, and at what."""
    places = machine.arm.frames(q)[:, :3, 3]
    centre = 0.5 * (places.min(axis=0) + places.max(axis=0))
    flat = machine.task.rows[:, :3]
    up = len(machine.task.rows) <= 3 and float(np.abs(flat[:, 2]).max()) < 1e-9 and not machine.task.rows[:, 3:5].any()
    way = np.array([0.0, -0.5, 1.4]) if up else np.array([0.95, -0.8, 0.45])
    out = places[-1, :2] - places[0, :2]
    if not up and np.linalg.norm(out) > 0.1 * machine.size:  # more from the side than from the front
        ahead = out / np.linalg.norm(out)
        way[:2] = 0.6 * ahead + 1.1 * np.array([ahead[1], -ahead[0]])
    # The controls cover the right side, or the lower half.
    beside = np.cross(-way, [0.0, 0.0, 1.0])
    away = np.cross(beside, way) if tall else beside
    centre = centre + (0.45 if tall else 0.22) * machine.size * away / np.linalg.norm(away)
    eye = centre + (1.5 if tall else 0.85) * machine.size * way
    return tuple(eye.tolist()), tuple(centre.tolist())


def _warm(machine: Machine, state: State) -> None:
    """Compile what the first picture shows while the browser loads the page."""
    with suppress(HoldfastError):  # the window says it
        machine.read(np.array(state.q), state.failed, state.index, state.susceptibility)
