"""One open page: its state, and what its controls do."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import pose_numbers, pose_of
from holdfast.errors import HoldfastError, InputError
from holdfast.present.arm.body import Part
from holdfast.studio.aside import Aside
from holdfast.studio.compute import Extremes
from holdfast.studio.motions import Motion, read_motion
from holdfast.studio.page import upload
from holdfast.studio.saving import Saver
from holdfast.studio.scene.cloud import Cloud
from holdfast.studio.scene.machine import Machine
from holdfast.studio.scene.stage import GREEN, ORANGE, PURPLE
from holdfast.studio.sliding import Sliding
from holdfast.studio.state import State
from holdfast.studio.view import View
from holdfast.studio.watching import Watched
from holdfast.studio.work import Worker

Array = NDArray[np.float64]
Check = Callable[[], None]
Load = Callable[[Any, str, bytes], None]

OF_HERE = ("best-worst", "laws", "swing", "watch")  # what is of where the arm is, and of what has failed
ROUNDING = 1e-9  # of an index: below it a number says nothing


class Window(View):
    """One client of the studio, with an arm of its own.

    All changes of the state happen on one thread (``live``), in the order in which people ask, the newest of a kind only; what
    takes long is done beside it (``work``), where a newer request cancels the older one, and comes back as a change.

    Args:
        client: Of viser.
        machine: The arm.
        aside: The process for what takes long.
        state: What is shown at first.
        parts: What the arm is made of.
        note: A sentence for people about these parts.
        load: ``load(client, name, content)`` opens a file of another arm in place of this window, or raises and leaves it.
    """

    def __init__(
        self, client: Any, machine: Machine, aside: Aside, state: State, *, parts: list[Part], note: str, load: Load
    ) -> None:
        super().__init__(client, machine, state, parts, self.ask)
        self._aside, self._load = aside, load
        self.work = Worker(self._complain)
        self._sliding = Sliding(machine, self.panel, self._clock, where=lambda: (self.q, self.state.failed), place=self._place)
        self._saver = Saver(client, machine, self.stage, self._saved, self._complain)
        for k, handles in self.stage.figure.joints.items():
            for handle in handles:
                self._click(handle, k)
        self._handle(self.stage.gizmo, "hand")
        self._handle(self.stage.target, "goal")
        if note:
            self.panel.say(note)
        self.live.put("begin", self._begin)

    def close(self) -> None:
        """Stop all work for this window."""
        self._closed = True
        self._clock.stop()
        for thread in (self.live, self.work, self._saver):
            thread.stop()

    def settle(self, seconds: float = 30.0) -> bool:
        """Wait until all work is done; False if that took too long."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if not (self.work.settle(max(end - time.monotonic(), 0)) and self.live.settle(max(end - time.monotonic(), 0))):
                return False
            if not self.work.busy:
                return True
        return False

    # ---- what people do --------------------------------------------------------------------------------------------

    def ask(self, what: str, value: Any = None) -> None:
        """Do something as soon as possible; of several requests of a kind that wait, only the newest is done."""
        key = (what, value[0]) if what in ("joint", "fail") else what
        self.live.put(key, lambda: self._do(what, value))

    def _do(self, what: str, value: Any) -> None:
        action = getattr(self, f"_on_{what.replace('-', '_')}", None)
        if action is not None:
            action(value)
        elif what in ("take0", "take1"):
            self._take(int(what[-1]))
        elif what in ("png", "svg", "cell-file"):
            self._saver.save(what, self.state, list(self.player.ghosts))
        else:  # a choice that is a field of the state
            self.state = replace(self.state, **{what: value})
            self._refresh()

    def _click(self, handle: Any, joint: int) -> None:
        async def told(_: Any) -> None:
            order = {"healthy": "locked", "locked": "free", "free": "healthy"}
            self.ask("fail", (joint, order[self.state.conditions[joint]]))

        handle.on_click(told)

    def _handle(self, gizmo: Any, what: str) -> None:
        async def told(event: Any) -> None:
            if event.client is not None:
                w, x, y, z = event.target.wxyz
                self.ask(what, (event.phase, np.array(event.target.position), np.array([x, y, z, w])))

        gizmo.on_update(told)

    def _begin(self) -> None:
        for k, condition in enumerate(self.state.conditions):
            self.stage.paint(k, condition)
        if self.state.target is not None:
            self._show_target()
        self._refresh()
        with suppress(HoldfastError):  # said when somebody drags
            self.machine.reach(self.q, self.machine.hand(self.q), ())  # compiled while the browser draws
        start: str | None = self.state.show if self.state.show in (*OF_HERE, "file") else None
        if self.state.show == "region":
            start = "results" if self.state.region else "region"
        if start is not None:
            self._do(start, None)

    # ---- moving ----------------------------------------------------------------------------------------------------

    def _on_joint(self, value: tuple[int, float]) -> None:
        k, x = value
        if self.state.conditions[k] != "healthy":
            return
        q, joint = self.q, self.machine.arm.joints[k]
        q[k] = min(max(x, joint.lower), joint.upper)  # the ends of a slider are rounded
        self.held = k
        self._leave(q)
        self._place(q)
        self.held = None

    def _on_hand(self, value: tuple[str, Array, Array]) -> None:
        phase, position, quaternion = value
        self.held = None if phase == "end" else "hand"
        q, on = self.machine.reach(self.q, pose_of(position, quaternion), self.state.failed)
        locked = f" with {self._failed_names()} locked" if self.state.failed else ""
        self._leave(q)
        self._place(q)
        if on:
            self.panel.say("The end effector follows.")
        else:
            self.panel.say(f"Out of reach{locked}: the arm is as near as it gets from here.", bad=True)

    def _on_slide(self, value: float) -> None:
        if value:
            self.player.pause()
            if self.state.show != "best-worst":  # of the pose, which stays
                self._leave()
        self._sliding.start(float(value))

    def _on_way(self, value: int) -> None:
        self._sliding.turn(value)

    def _on_home(self, _: Any) -> None:
        self._leave(np.array(self._start.q))
        self._place(np.array(self._start.q))

    def _leave(self, q: Array | None = None) -> None:
        """Give up what was found for where the arm is, before it goes to q or changes: ghosts of elsewhere only mislead."""
        if self.state.show not in OF_HERE or (q is not None and np.array_equal(q, self.q)):
            return
        self._cancel()
        if self.player.ghosts:
            self.panel.say("The ghosts were for the previous configuration; ask again for this one.")
        self.player.clear()
        self.state = replace(self.state, show="arm", time=0.0)

    def _take(self, k: int) -> None:
        if k >= len(self.player.ghosts):
            self.panel.say("There is no such ghost arm; find best and worst, or move under two laws, first.", bad=True)
            return
        self._place(self.player.ghosts[k])

    # ---- failing ---------------------------------------------------------------------------------------------------

    def _on_fail(self, value: tuple[int, str]) -> None:
        k, condition = value
        conditions = list(self.state.conditions)
        conditions[k] = condition  # type: ignore[call-overload]
        self._fail(tuple(conditions))

    def _on_heal(self, _: Any) -> None:
        self._fail(("healthy",) * self.machine.arm.n)

    def _fail(self, conditions: tuple[Any, ...]) -> None:
        if conditions != self.state.conditions:
            self._leave()
        self.state = replace(self.state, conditions=conditions)
        self._sliding.turn()
        for k, condition in enumerate(conditions):
            self.stage.paint(k, condition)
        self.panel.fail(conditions)
        named = self._failed_names()
        self.panel.say(f"{named} failed." if named else "All joints are healthy.")
        self._refresh()

    def _failed_names(self) -> str:
        return " and ".join(f"{self.state.names[k]} ({self.state.conditions[k]})" for k in self.state.failed)

    # ---- what takes long -------------------------------------------------------------------------------------------

    def _start_work(self, text: str, job: str, show: Callable[[Any], None]) -> None:
        """Do a job beside the page; what it finds is shown by the live thread, unless something newer was asked for."""
        self.player.clear()
        self.panel.say(f"{text} ...")
        self._busy = True
        self.state = state = replace(self.state, show=job)  # type: ignore[arg-type]
        self._refresh()

        def run(check: Check) -> None:
            def progress(done: int, total: int) -> None:
                if done:
                    self.live.put("progress", lambda: self.panel.say(f"{text}: {done} of {total} ..."))

            found = self._aside.run(job, state, check, progress)
            check()
            self.live.put("result", lambda: finish(found))

        def finish(found: Any) -> None:
            self._busy = False
            show(found)

        self.work.ask(run)

    def _cancel(self) -> None:
        self.work.cancel()
        self._busy = False

    def _on_best_worst(self, _: Any) -> None:
        name = self.state.objective

        def show(found: Extremes) -> None:
            best, worst, here = ("0" if abs(x) < ROUNDING else f"{x:.4g}" for x in found.values)
            words = [f"best: {best}", f"worst: {worst}"]
            self.player.place(list(found.q), words)
            self.panel.say(f"{name} of this pose: {best} at best (green), {worst} at worst (orange), {here} here.")
            self._refresh()

        self._start_work("Looking for the best and the worst configuration of this pose", "best-worst", show)

    def _on_laws(self, value: tuple[str, str] | None) -> None:
        if value is not None:  # another law was chosen
            self.state = replace(self.state, laws=value)
            self._refresh()
            if self.state.show != "laws":
                return
        if self.state.target is None:
            self._on_target(None)
        if self._arrived():
            self.panel.say(
                "The end effector is at the target already: drag the second handle away, then move under both laws.", bad=True
            )
            return

        def show(motions: list[Motion]) -> None:
            self._show_motions(motions, (GREEN, ORANGE), "  |  ".join(m.label for m in motions))

        self._start_work("Simulating the motion under both laws", "laws", show)

    def _on_swing(self, _: Any) -> None:
        self._start_work(
            "Simulating the free swing", "swing", lambda found: self._show_motions(found, (PURPLE,), found[0].label)
        )

    def _on_inject(self, _: Any) -> None:  # up to now the motion is the same, whatever the fault
        self.state = replace(self.state, fault=(*self.state.fault[:2], self.state.time))
        self._on_watch(self.state.time)

    def _on_watch(self, now: float | None) -> None:
        if self.state.target is None:
            self._on_target(None)
        self.state = replace(self.state, time=now or 0.0)

        def show(found: Watched) -> None:
            self.watched = found
            self._show_motions(
                [found.motion], (ORANGE,), "A joint fails while the arm moves; the monitor sees what a robot would."
            )
            if now:
                self.player.play()

        self._start_work("Simulating healthy motions, and one with the fault", "watch", show)

    def _on_file(self, _: Any) -> None:
        if self._start.file is not None:  # as the command line has named it: no path comes from the page
            self._open_motion(read_motion(self.machine.arm, self._start.file), self._start.file)

    def _on_open(self, value: tuple[str, bytes]) -> None:
        name, content = value
        if upload.kind(name) == "motion":
            self._open_motion(upload.read_sent_motion(self.machine.arm, name, content), upload.tidy(name))
            return
        self.panel.say(f"Opening {upload.tidy(name)} ...")

        def load(_: Check) -> None:
            try:
                self._load(self.client, name, content)
            except HoldfastError as error:
                raise InputError(f"nothing was opened, and nothing has changed: {error}") from error

        self.work.ask(load)

    def _open_motion(self, motion: Motion, file: str) -> None:
        self._cancel()
        self.player.clear()
        self.state = replace(self.state, file=file, show="file", time=self.state.time if file == self._start.file else 0.0)
        self._show_motions([motion], (), f"{motion.label}: {len(motion.time)} rows")

    def _on_region(self, _: Any) -> None:
        self.state = replace(self.state, region=None)
        self._start_work("Assessing a region around the end effector", "region", self._show_cloud)

    def _on_results(self, _: Any) -> None:
        if self._start.region is not None:  # as the command line has named it: no path comes from the page
            self.state = replace(self.state, region=self._start.region)
            self._start_work("Reading the results", "region", self._show_cloud)

    def _show_cloud(self, cloud: Cloud) -> None:
        self.cloud = cloud
        self.stage.draw_cloud(cloud, lambda k: self.ask("point", k))
        self.panel.say(f"{cloud.label}. Click a point.")
        self._refresh()

    def _on_point(self, k: int) -> None:
        if self.cloud is None or not 0 <= k < len(self.cloud.q):
            return
        self.stage.mark_point(self.cloud.points[k])
        if not np.isfinite(self.cloud.q[k]).all():
            self.panel.say("No configuration of this pose was found.", bad=True)
            return
        self._leave(self.cloud.q[k])
        self.panel.say(f"Configuration of point {k + 1}: index {self.cloud.values[k]:.4g}.")
        self._place(self.cloud.q[k])

    def _on_clear(self, _: Any) -> None:
        self._cancel()
        self.player.clear()
        self.stage.draw_cloud(None, lambda _: None)
        self.stage.target.visible = False
        self.cloud = None
        self.state = replace(self.state, show="arm", target=None, file=None, region=None, time=0.0)
        self.panel.say("Cleared.")
        self._refresh()

    # ---- targets and motions ---------------------------------------------------------------------------------------

    def _on_target(self, _: Any) -> None:
        if self.state.target is None:
            self.state = replace(self.state, target=pose_numbers(self.machine.hand(self.machine.beside(self.q))))
        self._show_target()
        self.panel.say("Drag the second handle to where the end effector should go, or take it as it is.")
        self._refresh()

    def _on_goal(self, value: tuple[str, Array, Array]) -> None:
        phase, position, quaternion = value
        self.state = replace(self.state, target=(*position.tolist(), *quaternion.tolist()))
        self._refresh()
        if phase == "end" and self.state.show == "laws":
            self._on_laws(None)

    def _show_motions(self, motions: list[Motion], colors: tuple[Any, ...], text: str) -> None:
        self.panel.say(text)
        self.player.show(motions, colors, self.state.time)

    # ---- the tour --------------------------------------------------------------------------------------------------

    def _on_tour(self, _: Any) -> None:
        self._on_clear(None)
        self._on_heal(None)
        self.panel.index.value = "relative-manipulability"
        self._do("index", "relative-manipulability")
        if self._reading is not None:
            self._guide.begin(self._reading)
        self._refresh()

    def _on_next(self, _: Any) -> None:
        self._guide.next()
        self._refresh()

    def _on_skip(self, _: Any) -> None:
        self._guide.end()
