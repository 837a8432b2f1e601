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
from holdfast.errors import HoldfastError
from holdfast.present.arm.body import Part
from holdfast.studio.aside import Aside
from holdfast.studio.compute import Extremes
from holdfast.studio.motions import Motion, read_motion
from holdfast.studio.panel import Panel
from holdfast.studio.saving import Saver
from holdfast.studio.scene.cloud import Cloud
from holdfast.studio.scene.machine import SLIDE, TOLERANCE, Machine, sentence
from holdfast.studio.scene.stage import GREEN, ORANGE, PURPLE, Stage
from holdfast.studio.state import State
from holdfast.studio.work import Clock, Latest, Worker

Array = NDArray[np.float64]
Check = Callable[[], None]

TICK = 1 / 30  # s between two pictures of what moves by itself
OF_HERE = ("best-worst", "laws", "swing")  # what is of where the arm is, and of what has failed
ROUNDING = 1e-9  # of an index: below it a number says nothing
SPEED = 0.8  # rad/s along a self-motion at the end of its slider


class Window:
    """One client of the studio, with an arm of its own.

    All changes of the state happen on one thread (``live``), in the order in which people ask, the newest of a kind only; what
    takes long is done beside it (``work``), where a newer request cancels the older one, and comes back as a change.
    """

    def __init__(self, client: Any, machine: Machine, aside: Aside, state: State, parts: list[Part], note: str = "") -> None:
        self.client, self.machine, self.state = client, machine, state
        self._aside = aside
        self._start = state
        self.updates = 0  # pictures sent
        self._held: str | int | None = None  # what a person holds: the end effector, or a slider
        self._motions: list[Motion] = []
        self._ghosts: list[Array] = []
        self._cloud: Cloud | None = None
        self._along = np.zeros(machine.arm.n)
        self._way, self._rate = 0, 0.0
        self._playing = False
        self._closed = False
        self.live = Latest(self._complain)
        self._clock = Clock(self.live, TICK)
        self.work = Worker(self._complain)
        with client.atomic():
            self.stage = Stage(client.scene, machine, parts)
            self.stage.move(machine.arm.frames(self.q), gizmo=True)
            self.panel = Panel(client.gui, machine, state, self.ask)
        self._saver = Saver(client, machine, self.stage, self._saved, self._complain)
        for k, handles in self.stage.figure.joints.items():
            for handle in handles:
                self._click(handle, k)
        self._handle(self.stage.gizmo, "hand")
        self._handle(self.stage.target, "goal")
        if note:
            self.panel.say(note)
        self.live.put("begin", self._begin)

    @property
    def q(self) -> Array:
        """(n,) where the arm is, rad and m."""
        return np.array(self.state.q)

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
            self.stage.figure.paint(k, condition)
        self.panel.disable(self.state.conditions)
        if self.state.target is not None:
            self._show_target()
        self._refresh()
        with suppress(HoldfastError):  # said when somebody drags
            self.machine.reach(self.q, self.machine.hand(self.q), ())  # compiled while the browser draws
        start = {"best-worst": "best-worst", "laws": "laws", "swing": "swing", "file": "file"}.get(self.state.show)
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
        self._held = k
        self._leave(q)
        self._place(q)
        self._held = None

    def _on_hand(self, value: tuple[str, Array, Array]) -> None:
        phase, position, quaternion = value
        self._held = None if phase == "end" else "hand"
        q, on = self.machine.reach(self.q, pose_of(position, quaternion), self.state.failed)
        locked = f" with {self._failed_names()} locked" if self.state.failed else ""
        self._leave(q)
        self._place(q)
        if on:
            self.panel.say("The end effector follows.")
        else:
            self.panel.say(f"Out of reach{locked}: the arm is as near as it gets from here.", bad=True)

    def _on_slide(self, value: float) -> None:
        self._rate = float(value)
        if self._rate == 0.0:
            return
        if self._playing:
            self._on_play(None)
        if self.state.show != "best-worst":  # of the pose, which stays
            self._leave()
        self._clock.start(self._slide_on)

    def _on_way(self, value: int) -> None:
        self._way, self._along = value, np.zeros(self.machine.arm.n)

    def _slide_on(self) -> None:
        if self._rate == 0.0:
            self._clock.stop()
            return
        ways = self.machine.self_motions(self.q, self.state.failed)
        if not len(ways):
            self._clock.stop()
            self.panel.slide.value = self._rate = 0.0
            self.panel.say("There is no self-motion here: every joint that is left is needed to hold the tool.", bad=True)
            return
        if not np.any(self._along):
            self._along = ways[min(self._way, len(ways) - 1)]
            # Always the same way at the same place: the largest part counts up.
            self._along = self._along * np.sign(self._along[int(np.abs(self._along).argmax())])
        length = min(abs(self._rate) * SPEED * TICK, SLIDE)
        sign = np.sign(self._rate)
        q, direction = self.machine.slide(self.q, sign * length * self._along, self.state.failed)
        if not np.any(direction):
            self._clock.stop()
            self.panel.slide.value = self._rate = 0.0
            self._along = np.zeros(self.machine.arm.n)
            self.panel.say("The self-motion ends here, at a joint limit.", bad=True)
            return
        self._along = sign * direction
        self.panel.say("Sliding along the self-motion: the end effector is still.")
        self._place(q)

    def _on_home(self, _: Any) -> None:
        self._leave(np.array(self._start.q))
        self._place(np.array(self._start.q))

    def _leave(self, q: Array | None = None) -> None:
        """Give up what was found for where the arm is, before it goes to q or changes: ghosts of elsewhere only mislead."""
        if self.state.show not in OF_HERE or (q is not None and np.array_equal(q, self.q)):
            return
        self.work.cancel()
        if self._ghosts:
            self.panel.say("The ghosts were for the previous configuration; ask again for this one.")
        self._drop_ghosts()
        self.state = replace(self.state, show="arm", time=0.0)

    def _take(self, k: int) -> None:
        if k >= len(self._ghosts):
            self.panel.say("There is no such ghost arm; find best and worst, or move under two laws, first.", bad=True)
            return
        self._place(self._ghosts[k])

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
        self._along = np.zeros(self.machine.arm.n)
        for k, condition in enumerate(conditions):
            self.stage.figure.paint(k, condition)
        self.panel.disable(conditions)
        named = self._failed_names()
        self.panel.say(f"{named} failed." if named else "All joints are healthy.")
        self._refresh()

    def _failed_names(self) -> str:
        return " and ".join(f"{self.state.names[k]} ({self.state.conditions[k]})" for k in self.state.failed)

    # ---- what takes long -------------------------------------------------------------------------------------------

    def _start_work(self, text: str, job: str, show: Callable[[Any], None]) -> None:
        """Do a job beside the page; what it finds is shown by the live thread, unless something newer was asked for."""
        self._drop_ghosts()
        self.panel.say(f"{text} ...")
        self.state = state = replace(self.state, show=job)  # type: ignore[arg-type]

        def run(check: Check) -> None:
            def progress(done: int, total: int) -> None:
                if done:
                    self.live.put("progress", lambda: self.panel.say(f"{text}: {done} of {total} ..."))

            found = self._aside.run(job, state, check, progress)
            check()
            self.live.put("result", lambda: show(found))

        self.work.ask(run)

    def _on_best_worst(self, _: Any) -> None:
        name = self.state.objective

        def show(found: Extremes) -> None:
            best, worst, here = ("0" if abs(x) < ROUNDING else f"{x:.4g}" for x in found.values)
            words = [f"best: {best}", f"worst: {worst}"]
            self._haunt(
                list(found.q), words, f"{name} of this pose: {best} at best (green), {worst} at worst (orange), {here} here."
            )

        self._start_work("Looking for the best and the worst configuration of this pose", "best-worst", show)

    def _haunt(self, configurations: list[Array], labels: list[str], text: str) -> None:
        self._drop_motions()
        self._ghosts = configurations
        self.stage.haunt(labels)
        self.stage.move_ghosts([self.machine.arm.frames(q) for q in configurations])
        self.panel.say(text)
        self._refresh()

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

    def _arrived(self) -> bool:
        """The end effector is where the target says, as far as the task looks."""
        target = self.state.target
        return target is not None and self.machine.apart(self.q, pose_of(target[:3], target[3:])) < TOLERANCE

    def _on_swing(self, _: Any) -> None:
        self._start_work(
            "Simulating the free swing", "swing", lambda found: self._show_motions(found, (PURPLE,), found[0].label)
        )

    def _on_file(self, _: Any) -> None:
        path = self.panel.file.value.strip().strip("'\"")
        motion = read_motion(self.machine.arm, path)
        self._drop_ghosts()
        self.state = replace(self.state, file=path, show="file")
        self.work.cancel()
        self._show_motions([motion], (), f"{motion.label}: {len(motion.time)} rows")

    def _on_region(self, _: Any) -> None:
        self.state = replace(self.state, region=None)
        self._start_work("Assessing a region around the end effector", "region", self._show_cloud)

    def _on_results(self, _: Any) -> None:
        self.state = replace(self.state, region=self.panel.folder.value.strip().strip("'\""))
        self._start_work("Reading the results", "region", self._show_cloud)

    def _show_cloud(self, cloud: Cloud) -> None:
        self._cloud = cloud
        self.stage.draw_cloud(cloud, lambda k: self.ask("point", k))
        self.panel.say(f"{cloud.label}. Click a point.")
        self._refresh()

    def _on_point(self, k: int) -> None:
        if self._cloud is None or not 0 <= k < len(self._cloud.q):
            return
        self.stage.mark_point(self._cloud.points[k])
        if not np.isfinite(self._cloud.q[k]).all():
            self.panel.say("No configuration of this pose was found.", bad=True)
            return
        self._leave(self._cloud.q[k])
        self.panel.say(f"Configuration of point {k + 1}: index {self._cloud.values[k]:.4g}.")
        self._place(self._cloud.q[k])

    def _on_clear(self, _: Any) -> None:
        self.work.cancel()
        self._drop_ghosts()
        self.stage.draw_cloud(None, lambda _: None)
        self.stage.target.visible = False
        self._cloud = None
        self.state = replace(self.state, show="arm", target=None, file=None, region=None, time=0.0)
        self.panel.say("Cleared.")
        self._refresh()

    # ---- targets and motions ---------------------------------------------------------------------------------------

    def _on_target(self, _: Any) -> None:
        if self.state.target is None:
            hand = self.machine.hand(self.q)
            self.state = replace(self.state, target=pose_numbers(hand))
        self._show_target()
        self._refresh()

    def _show_target(self) -> None:
        numbers = self.state.target or ()
        self.stage.target.position = numbers[:3]
        self.stage.target.wxyz = (numbers[6], *numbers[3:6])
        self.stage.target.visible = True

    def _on_goal(self, value: tuple[str, Array, Array]) -> None:
        phase, position, quaternion = value
        self.state = replace(self.state, target=(*position.tolist(), *quaternion.tolist()))
        self._refresh()
        if phase == "end" and self.state.show == "laws":
            self._on_laws(None)

    def _show_motions(self, motions: list[Motion], colors: tuple[Any, ...], text: str) -> None:
        self._drop_motions()
        self._motions = motions
        self.stage.haunt([m.label.partition(":")[0] for m in motions] if colors else [], colors)
        end = max(float(m.time[-1]) for m in motions)
        begin = min(self.state.time, end) if self.state.time > 0 else 0.0
        self.panel.time_range(end, begin, f"time, {motions[0].unit}" if motions[0].unit != "rad" else "travel, rad")
        self.panel.say(text)
        self._seek(begin)
        # What was asked for moves at once; a view that a command line brought back stays where it was.
        if colors and end > 0 and not begin:
            self._on_play(None)

    def _drop_ghosts(self) -> None:
        """Take ghosts and motions away."""
        self._drop_motions()
        self.stage.lay()
        self._ghosts = []

    def _drop_motions(self) -> None:
        self._clock.stop()
        self._playing = False
        self.panel.play.label = "Play"
        self._motions = []
        self.panel.time_range(0.0, 0.0, "")

    def _on_time(self, value: float) -> None:
        if self._playing:
            self._on_play(None)  # who takes the slider stops what plays
        self._seek(value)

    def _seek(self, value: float) -> None:
        if not self._motions:
            return
        self.state = replace(self.state, time=float(value))
        if abs(self.panel.time.value - value) > self.panel.time.step:
            self.panel.time.value = self.state.time
        shown = [m.at(value) for m in self._motions]
        if self.stage.ghosts:
            self._ghosts = shown
            with self.client.atomic():
                self.stage.move_ghosts([self.machine.arm.frames(q) for q in shown])
            self._refresh()
        else:
            self._place(shown[0])

    def _on_play(self, _: Any) -> None:
        if self._playing or not self._motions:
            self._playing = False
            self._clock.stop()
            self.panel.play.label = "Play"
            return
        self._playing, self.panel.play.label = True, "Stop"
        end = max(float(m.time[-1]) for m in self._motions)
        if self.state.time >= end * (1 - 1e-9):
            self.state = replace(self.state, time=0.0)
        # What takes longer than ten seconds is played in ten; a swing in real time shows best.
        pace = max(end / 10.0, 1.0) if self._motions[0].unit == "s" else end / 10.0

        def on() -> None:
            now = self.state.time + TICK * pace
            self._seek(min(now, end))
            if now >= end:
                self._on_play(None)

        self._clock.start(on)

    # ---- showing ---------------------------------------------------------------------------------------------------

    def _on_png(self, _: Any) -> None:
        self._saver.png()

    def _on_svg(self, _: Any) -> None:
        self._saver.svg(self.state, list(self._ghosts))

    def _on_losses(self, value: bool) -> None:
        self.stage.show_losses(value)
        self._refresh()

    def _place(self, q: Array) -> None:
        self.state = replace(self.state, q=tuple(float(x) for x in q))
        self._refresh()

    def _refresh(self) -> None:
        """Show the state: the arm at once, and what a failure takes."""
        q, state = self.q, self.state
        frames = self.machine.arm.frames(q)
        with self.client.atomic():
            self.stage.move(frames, gizmo=self._held != "hand")
            self.panel.follow(q, self._held if isinstance(self._held, int) else None)
        reading = self.machine.read(q, state.failed, state.index, state.susceptibility)
        with self.client.atomic():
            self.stage.read(reading, frames[-1])
            self.panel.read(reading, state)
        self.updates += 1

    def _saved(self, text: str) -> None:
        self.live.put("saved", lambda: self.panel.say(text))

    def _complain(self, error: BaseException) -> None:
        if not self._closed:
            if not isinstance(error, HoldfastError):
                import traceback

                traceback.print_exception(error)
            self.panel.say(sentence(error), bad=True)
