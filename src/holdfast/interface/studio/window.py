"""Open page with its state and the actions of its controls."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import MeshPart
from holdfast.interface.studio.compute import ExtremeConfigurations
from holdfast.interface.studio.monitor_demo import MonitorDemo
from holdfast.interface.studio.motions import PlayedMotion, read_motion
from holdfast.interface.studio.page import upload
from holdfast.interface.studio.saving import ViewSaver
from holdfast.interface.studio.scene.cloud import RegionCloud
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.interface.studio.scene.stage import GREEN_RGB, ORANGE_RGB, PURPLE_RGB
from holdfast.interface.studio.self_motion_slider import SelfMotionSlider
from holdfast.interface.studio.state import State
from holdfast.interface.studio.view import StudioView
from holdfast.interface.studio.work import LongJobWorker
from holdfast.interface.studio.worker_process import WorkerProcess
from holdfast.model.arm.poses import pose_from_quaternion, pose_numbers

Check = Callable[[], None]
Load = Callable[[Any, str, bytes], None]

STATE_DEPENDENT_SHOWS = ("best-worst", "laws", "fall", "watch")  # results that depend on the configuration and the failures
INDEX_ROUNDING = 1e-9  # of an index: smaller values are rounding errors


class Window(StudioView):
    """Client of the studio, with its own arm.

    All changes of the state happen on one thread (``live``), in the order of the requests, of which only the newest of a kind
    is executed. Long computations run in another thread (``worker``), where a newer request cancels the older one; their
    results return as changes.

    Args:
        client: Client of viser.
        machine: Compiled arm.
        worker_process: Process for long computations.
        state: Initial state.
        parts: Meshes of the arm.
        note: Sentence for the user about these meshes.
        load_arm: ``load(client, name, content)`` opens a file of another arm in this window, or raises and changes nothing.
    """

    def __init__(
        self,
        client: Any,
        machine: CompiledArm,
        worker_process: WorkerProcess,
        state: State,
        *,
        parts: list[MeshPart],
        note: str,
        load_arm: Load,
    ) -> None:
        super().__init__(client, machine, state, parts, self.request_action)
        self._worker_process, self._load_arm = worker_process, load_arm
        self.worker = LongJobWorker(self._show_error)
        self._self_motion_slider = SelfMotionSlider(
            machine,
            self.panel,
            self._clock,
            current_state=lambda: (self.q, self.state.failed_joints),
            set_configuration=self._set_configuration,
        )
        self._saver = ViewSaver(client, machine, self.stage, self._show_saved, self._show_error)
        for joint, handles in self.stage.figure.joints.items():
            for handle in handles:
                self._attach_click(handle, joint)
        self._attach_gizmo(self.stage.gizmo, "hand")
        self._attach_gizmo(self.stage.target, "goal")
        if note:
            self.panel.show_message(note)
        self.live.submit("begin", self._show_initial_state)

    def close(self) -> None:
        """Stop all work of this window."""
        self._is_closed = True
        self._clock.stop()
        for thread in (self.live, self.worker, self._saver):
            thread.stop()

    def wait_until_done(self, seconds: float = 30.0) -> bool:
        """Wait until all work is done; return False if the time runs out."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if not (
                self.worker.wait_until_done(max(end - time.monotonic(), 0))
                and self.live.wait_until_done(max(end - time.monotonic(), 0))
            ):
                return False
            if not self.worker.is_busy:
                return True
        return False

    # ---- actions ---------------------------------------------------------------------------------------------------

    def request_action(self, action: str, value: Any = None) -> None:
        """Request an action as soon as possible; of several waiting requests of one kind, only the newest is executed."""
        key = (action, value[0]) if action in ("joint", "fail") else action
        self.live.submit(key, lambda: self._perform_action(action, value))

    def _perform_action(self, name: str, value: Any) -> None:
        action = getattr(self, f"_on_{name.replace('-', '_')}", None)
        if action is not None:
            action(value)
        elif name in ("take0", "take1"):
            self._move_to_ghost(int(name[-1]))
        elif name in ("png", "svg", "cell-file"):
            self._saver.save(name, self.state, list(self.player.ghosts))
        else:  # the action is a field of the state
            self.state = replace(self.state, **{name: value})
            self._refresh()

    def _attach_click(self, handle: Any, joint: int) -> None:
        async def on_click(_: Any) -> None:
            order = {"healthy": "locked", "locked": "free", "free": "healthy"}
            self.request_action("fail", (joint, order[self.state.conditions[joint]]))

        handle.on_click(on_click)

    def _attach_gizmo(self, gizmo: Any, action: str) -> None:
        async def on_update(event: Any) -> None:
            if event.client is not None:
                w, x, y, z = event.target.wxyz
                self.request_action(action, (event.phase, np.array(event.target.position), np.array([x, y, z, w])))

        gizmo.on_update(on_update)

    def _show_initial_state(self) -> None:
        for joint, condition in enumerate(self.state.conditions):
            self.stage.paint_joint(joint, condition)
        if self.state.target is not None:
            self._show_target()
        self._refresh()
        with suppress(HoldfastError):  # reported when the user drags the end effector
            self.machine.solve_pose_near(self.q, self.machine.tool_pose(self.q), ())  # compiled while the browser draws
        first_action: str | None = self.state.show if self.state.show in (*STATE_DEPENDENT_SHOWS, "file") else None
        if self.state.show == "region":
            first_action = "results" if self.state.region else "region"
        if first_action is not None:
            self._perform_action(first_action, None)

    # ---- motion ----------------------------------------------------------------------------------------------------

    def _on_joint(self, value: tuple[int, float]) -> None:
        index, requested = value
        if self.state.conditions[index] != "healthy":
            return
        q, joint = self.q, self.machine.arm.joints[index]
        q[index] = min(max(requested, joint.lower), joint.upper)  # the ends of a slider are rounded values
        self.dragged = index
        self._discard_results(q)
        self._set_configuration(q)
        self.dragged = None

    def _on_hand(self, value: tuple[str, FloatArray, FloatArray]) -> None:
        phase, position, quaternion = value
        self.dragged = None if phase == "end" else "hand"
        q, is_reached = self.machine.solve_pose_near(
            self.q, pose_from_quaternion(position, quaternion), self.state.failed_joints
        )
        locked = f" with {self._format_failed_joints()} locked" if self.state.failed_joints else ""
        self._discard_results(q)
        self._set_configuration(q)
        if is_reached:
            self.panel.show_message("The end effector follows the handle.")
        else:
            self.panel.show_message(f"Out of reach{locked}. The arm is as close as it gets from here.", is_error=True)

    def _on_slide(self, value: float) -> None:
        if value:
            self.player.pause()
            if self.state.show != "best-worst":  # ghosts of the pose, which does not change
                self._discard_results()
        self._self_motion_slider.start(float(value))

    def _on_way(self, value: int) -> None:
        self._self_motion_slider.reset_direction(value)

    def _on_home(self, _: Any) -> None:
        self._discard_results(np.array(self._initial_state.q))
        self._set_configuration(np.array(self._initial_state.q))

    def _discard_results(self, q: FloatArray | None = None) -> None:
        """Discard results of the present configuration before it changes to q or a joint fails; their ghosts would mislead."""
        if self.state.show not in STATE_DEPENDENT_SHOWS or (q is not None and np.array_equal(q, self.q)):
            return
        self._cancel_work()
        if self.player.ghosts:
            self.panel.show_message(
                "The ghost arms belonged to the previous configuration and were removed. Repeat the request for this one."
            )
        self.player.remove_ghosts()
        self.state = replace(self.state, show="arm", time=0.0)

    def _move_to_ghost(self, ghost: int) -> None:
        if ghost >= len(self.player.ghosts):
            self.panel.show_message(
                "There is no such ghost arm; find best and worst, or move under two laws, first.", is_error=True
            )
            return
        self._set_configuration(self.player.ghosts[ghost])

    # ---- failures --------------------------------------------------------------------------------------------------

    def _on_fail(self, value: tuple[int, str]) -> None:
        joint, condition = value
        conditions = list(self.state.conditions)
        conditions[joint] = condition  # type: ignore[call-overload]
        self._set_conditions(tuple(conditions))

    def _on_heal(self, _: Any) -> None:
        self._set_conditions(("healthy",) * self.machine.arm.n)

    def _set_conditions(self, conditions: tuple[Any, ...]) -> None:
        if conditions != self.state.conditions:
            self._discard_results()
        self.state = replace(self.state, conditions=conditions)
        self._self_motion_slider.reset_direction()
        for joint, condition in enumerate(conditions):
            self.stage.paint_joint(joint, condition)
        self.panel.show_conditions(conditions)
        failed_names = self._format_failed_joints()
        self.panel.show_message(f"{failed_names} failed." if failed_names else "All joints are healthy.")
        self._refresh()

    def _format_failed_joints(self) -> str:
        return " and ".join(f"{self.state.names[joint]} ({self.state.conditions[joint]})" for joint in self.state.failed_joints)

    # ---- long computations -----------------------------------------------------------------------------------------

    def _start_work(self, text: str, job: str, show_result: Callable[[Any], None]) -> None:
        """Run a job in the worker process; the live thread shows its result unless there was a newer request."""
        self.player.remove_ghosts()
        self.panel.show_message(f"{text} ...")
        self._is_busy = True
        self.state = state = replace(self.state, show=job)  # type: ignore[arg-type]
        self._refresh()

        def run_job(check: Check) -> None:
            def report_progress(done: int, total: int) -> None:
                if done:
                    self.live.submit("progress", lambda: self.panel.show_message(f"{text}: {done} of {total} ..."))

            result = self._worker_process.run(job, state, check, report_progress)
            check()
            self.live.submit("result", lambda: finish_job(result))

        def finish_job(result: Any) -> None:
            self._is_busy = False
            show_result(result)

        self.worker.submit(run_job)

    def _cancel_work(self) -> None:
        self.worker.cancel()
        self._is_busy = False

    def _on_best_worst(self, _: Any) -> None:
        name = self.state.objective

        def show_extremes(extremes: ExtremeConfigurations) -> None:
            best, worst, current = ("0" if abs(value) < INDEX_ROUNDING else f"{value:.4g}" for value in extremes.values)
            labels = [f"best: {best}", f"worst: {worst}"]
            self.player.place_ghosts(list(extremes.q), labels)
            self.panel.show_message(
                f"{name} of this pose: best found {best} (green), worst found {worst} (orange), here {current}."
            )
            self._refresh()

        self._start_work("Searching for the best and the worst configuration of this pose", "best-worst", show_extremes)

    def _on_laws(self, value: tuple[str, str] | None) -> None:
        if value is not None:  # another law was selected
            self.state = replace(self.state, laws=value)
            self._refresh()
            if self.state.show != "laws":
                return
        if self.state.target is None:
            self._on_target(None)
        if self._is_at_target():
            self.panel.show_message(
                "The end effector is already at the target. Drag the second handle away, then move under both laws.",
                is_error=True,
            )
            return

        def show_law_motions(motions: list[PlayedMotion]) -> None:
            self._show_motions(motions, (GREEN_RGB, ORANGE_RGB), "  |  ".join(motion.label for motion in motions))

        self._start_work("Simulating the motion under both laws", "laws", show_law_motions)

    def _on_fall(self, _: Any) -> None:
        self._start_work("Simulating the fall", "fall", lambda found: self._show_motions(found, (PURPLE_RGB,), found[0].label))

    def _on_friction(self, value: float) -> None:
        self.state = replace(self.state, friction=value)
        self._refresh()

    def _on_inject(self, _: Any) -> None:  # until now the motion is the same for every fault
        self.state = replace(self.state, fault=(*self.state.fault[:2], self.state.time))
        self._on_watch(self.state.time)

    def _on_watch(self, current: float | None) -> None:
        if self.state.target is None:
            self._on_target(None)
        self.state = replace(self.state, time=current or 0.0)

        def show_demo(demo: MonitorDemo) -> None:
            self.monitor_demo = demo
            self._show_motions(
                [demo.motion],
                (ORANGE_RGB,),
                "A joint fails while the arm moves. The monitor reads the same signals as on a robot.",
            )
            if current:
                self.player.toggle_play()

        self._start_work("Simulating healthy motions and one with the fault", "watch", show_demo)

    def _on_file(self, _: Any) -> None:
        if self._initial_state.file is not None:  # from the command line, because no path comes from the page
            self._open_motion(read_motion(self.machine.arm, self._initial_state.file), self._initial_state.file)

    def _on_open(self, value: tuple[str, bytes]) -> None:
        name, content = value
        if upload.detect_file_kind(name) == "motion":
            self._open_motion(upload.read_uploaded_motion(self.machine.arm, name, content), upload.sanitise_file_name(name))
            return
        self.panel.show_message(f"Opening {upload.sanitise_file_name(name)} ...")

        def load_file(_: Check) -> None:
            try:
                self._load_arm(self.client, name, content)
            except HoldfastError as error:
                raise InputError(f"the file was not opened, and nothing has changed: {error}") from error

        self.worker.submit(load_file)

    def _open_motion(self, motion: PlayedMotion, file: str) -> None:
        self._cancel_work()
        self.player.remove_ghosts()
        self.state = replace(
            self.state, file=file, show="file", time=self.state.time if file == self._initial_state.file else 0.0
        )
        self._show_motions([motion], (), f"{motion.label}: {len(motion.time)} rows")

    def _on_region(self, _: Any) -> None:
        self.state = replace(self.state, region=None)
        self._start_work("Assessing a region around the end effector", "region", self._show_cloud)

    def _on_results(self, _: Any) -> None:
        if self._initial_state.region is not None:  # from the command line, because no path comes from the page
            self.state = replace(self.state, region=self._initial_state.region)
            self._start_work("Reading the results", "region", self._show_cloud)

    def _show_cloud(self, cloud: RegionCloud) -> None:
        self.cloud = cloud
        self.stage.draw_cloud(cloud, lambda k: self.request_action("point", k))
        self.panel.show_message(f"{cloud.label}. Click a point.")
        self._refresh()

    def _on_point(self, number: int) -> None:
        if self.cloud is None or not 0 <= number < len(self.cloud.q):
            return
        self.stage.mark_point(self.cloud.points[number])
        if not np.isfinite(self.cloud.q[number]).all():
            self.panel.show_message("No configuration of this pose was found.", is_error=True)
            return
        self._discard_results(self.cloud.q[number])
        self.panel.show_message(f"Configuration of point {number + 1}: index {self.cloud.values[number]:.4g}.")
        self._set_configuration(self.cloud.q[number])

    def _on_clear(self, _: Any) -> None:
        self._cancel_work()
        self.player.remove_ghosts()
        self.stage.draw_cloud(None, lambda _: None)
        self.stage.target.visible = False
        self.cloud = None
        self.state = replace(self.state, show="arm", target=None, file=None, region=None, time=0.0)
        self.panel.show_message("Cleared.")
        self._refresh()

    # ---- targets and motions ---------------------------------------------------------------------------------------

    def _on_target(self, _: Any) -> None:
        if self.state.target is None:
            self.state = replace(
                self.state, target=pose_numbers(self.machine.tool_pose(self.machine.nearby_configuration(self.q)))
            )
        self._show_target()
        self.panel.show_message("Drag the second handle to the target of the end effector, or keep the suggested target.")
        self._refresh()

    def _on_goal(self, value: tuple[str, FloatArray, FloatArray]) -> None:
        phase, position, quaternion = value
        self.state = replace(self.state, target=(*position.tolist(), *quaternion.tolist()))
        self._refresh()
        if phase == "end" and self.state.show == "laws":
            self._on_laws(None)

    def _show_motions(self, motions: list[PlayedMotion], colors: tuple[Any, ...], text: str) -> None:
        self.panel.show_message(text)
        self.player.show_motions(motions, colors, self.state.time)

    # ---- the tour --------------------------------------------------------------------------------------------------

    def _on_tour(self, _: Any) -> None:
        self._on_clear(None)
        self._on_heal(None)
        self.panel.index.value = "relative-manipulability"
        self._perform_action("index", "relative-manipulability")
        if self._reading is not None:
            self._guide.begin_tour(self._reading)
        self._refresh()

    def _on_next(self, _: Any) -> None:
        self._guide.show_next()
        self._refresh()

    def _on_skip(self, _: Any) -> None:
        self._guide.end_tour()
