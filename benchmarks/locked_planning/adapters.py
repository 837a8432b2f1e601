"""Adapters: one class per planner, from a problem to an answer."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from benchmarks.locked_planning.problems import Problem
from benchmarks.locked_planning.validator import Floats, Json, rotation_matrix


class Answer(NamedTuple):
    """Answer of a planner.

    Attributes:
        verdict: ``solved``, ``proved infeasible``, or ``undecided``.
        path: (K, 7) waypoints, rad, if solved.
        note: Kind of the proof, or reason for an undecided problem.
    """

    verdict: str
    path: Floats | None = None
    note: str = ""


class Planner:
    """Planner for one robot; subclasses override the attributes and :meth:`solve`.

    Attributes:
        package, module: Names of the package on PyPI and in Python.
        tracks: Tracks on which it can run.
        needs_goals: True if it takes goal configurations, which the runner finds outside the measured time.
    """

    package = module = ""
    tracks: tuple[str, ...] = ("spheres", "meshes")
    needs_goals = True

    def __init__(self, robot: Json, urdf: Path) -> None:
        self.robot, self.urdf = robot, urdf

    @classmethod
    def missing(cls) -> str:
        """Return why the planner cannot run, or an empty string if it can."""
        return "" if find_spec(cls.module) else f"it is not installed; install it with: pip install {cls.package}"

    @classmethod
    def version(cls) -> str:
        """Return the version of the package."""
        try:
            return version(cls.package)
        except PackageNotFoundError:
            return str(import_module(cls.module).__version__)

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        """Return the answer within a time limit, s; the runner measures this method."""
        raise NotImplementedError


def _pose(shape: Json) -> Floats:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation_matrix(shape["quaternion_xyzw"]), shape["position"]
    return pose


def _exact_ends(path: Any, problem: Problem, goal: Floats) -> Floats:
    """Return the path with the exact start, goal, and locked joint, which single precision rounds."""
    q = np.array(path, dtype=float)
    q[0], q[-1] = problem.start, goal
    if problem.joint is not None:
        q[:, problem.joint] = problem.value
    return q


class Holdfast(Planner):
    """:func:`holdfast.recover`; a healthy problem is an arm with the whole range of its first joint."""

    package = module = "holdfast"
    needs_goals = False

    def __init__(self, robot: Json, urdf: Path) -> None:
        super().__init__(robot, urdf)
        self.hf: Any = import_module("holdfast")
        self.hf.set_threads(1)  # as the other planners
        self.arm = self.hf.arms.load(str(urdf), srdf=urdf.with_suffix(".srdf"))
        self.clearance = self.hf.Clearance(self.arm, cell=self.hf.Cell([], shape="meshes"))

    def cell_clearance(self, problem: Problem) -> Any:
        """Return the clearance among the objects of a problem."""
        makers = {
            "box": lambda o: self.hf.cell.Box(o["name"], o["size"], pose=_pose(o)),
            "cylinder": lambda o: self.hf.cell.Cylinder(o["name"], o["radius"], o["length"], pose=_pose(o)),
            "capsule": lambda o: self.hf.cell.Capsule(o["name"], o["radius"], o["length"], pose=_pose(o)),
            "sphere": lambda o: self.hf.cell.Sphere(o["name"], o["radius"], pose=_pose(o)),
        }
        return self.clearance.with_cell(self.hf.Cell([makers[o["kind"]](o) for o in problem.objects], shape="meshes"))

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        if problem.joint is None:
            degraded = self.hf.Degraded(self.arm, ranges={0: (self.arm.lower[0], self.arm.upper[0])})
        else:
            degraded = self.hf.Degraded(self.arm, locked={problem.joint: problem.value})
        recovery = self.hf.recover(
            self.arm,
            degraded,
            problem.start,
            goal=problem.goal_pose if problem.goal is None else problem.goal,
            clearance=self.cell_clearance(problem),
            samples=0,
            relax=False,
            time_limit=seconds,
        )
        verdict = recovery.verdict
        if verdict.answer in ("solved", "proved infeasible"):
            return Answer(verdict.answer, recovery.q if verdict.is_solved else None, verdict.kind)
        return Answer("undecided", None, str(verdict))


class Vamp(Planner):
    """VAMP's RRT-Connect and simplification, with its own sphere model and cylinders as capsules, as in its own evaluation.

    A lock is a sampling box without width, which needs the change ``vamp_lock.patch`` of VAMP's source.
    """

    package, module = "vamp-planner", "vamp"
    tracks = ("spheres",)

    def __init__(self, robot: Json, urdf: Path) -> None:
        import vamp

        super().__init__(robot, urdf)
        self.vamp = vamp
        self.panda, self.plan, self.settings, self.simplify = vamp.configure_robot_and_planner_with_kwargs("panda", "rrtc")
        self.sampler = self.panda.halton()

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        if problem.joint is not None and not hasattr(self.panda, "set_sampling_box"):
            return Answer("undecided", None, "a lock needs VAMP with vamp_lock.patch")
        if hasattr(self.panda, "set_sampling_box"):
            lower, upper = np.array(self.robot["lower"]), np.array(self.robot["upper"])
            if problem.joint is not None:
                lower[problem.joint] = upper[problem.joint] = problem.value
            self.panda.set_sampling_box(lower.tolist(), upper.tolist())
        environment = self._environment(problem)
        self.sampler.reset()
        result = self.plan(problem.start.tolist(), goals.tolist(), environment, self.settings, self.sampler)
        if not result.solved:
            return Answer("undecided", None, "no path found")
        path = self.panda.simplify(result.path, environment, self.simplify, self.sampler).path.numpy()
        return Answer("solved", _exact_ends(path, problem, goals[np.abs(goals - path[-1]).max(axis=1).argmin()]))

    def _environment(self, problem: Problem) -> Any:
        from scipy.spatial.transform import Rotation

        environment = self.vamp.Environment()
        for o in problem.objects:
            where = o["position"], Rotation.from_quat(o["quaternion_xyzw"]).as_euler("xyz").tolist()
            if o["kind"] == "box":
                environment.add_cuboid(self.vamp.Cuboid(*where, [size / 2 for size in o["size"]]))
            elif problem.name.startswith("box/"):  # a grasp from above, which a capsule would block
                environment.add_cuboid(self.vamp.Cuboid(*where, [o["radius"], o["radius"], o["length"] / 2]))
            else:
                environment.add_capsule(self.vamp.Cylinder(*where, o["radius"], o["length"]))
        return environment


class Ompl(Holdfast):
    """RRT-Connect and simplification of OMPL at its default resolution; holdfast's exact distances check states."""

    package = module = "ompl"
    needs_goals = True

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        from ompl import base, geometric, util

        util.setLogLevel(util.LOG_ERROR)
        clearance = self.cell_clearance(problem)
        free = [joint for joint in range(7) if joint != problem.joint]
        space = base.RealVectorStateSpace(len(free))
        bounds = base.RealVectorBounds(len(free))
        for index, joint in enumerate(free):
            bounds.setLow(index, float(self.robot["lower"][joint]))
            bounds.setHigh(index, float(self.robot["upper"][joint]))
        space.setBounds(bounds)

        def configuration(state: Any) -> Floats:
            q = problem.start.copy()
            q[free] = [state[index] for index in range(len(free))]
            return q

        def state_of(q: Floats) -> Any:
            state = space.allocState()
            for index, joint in enumerate(free):
                state[index] = float(q[joint])
            return state

        setup = geometric.SimpleSetup(space)
        setup.setStateValidityChecker(lambda state: bool(clearance.sign(configuration(state))))
        setup.setStartState(state_of(problem.start))
        ends = base.GoalStates(setup.getSpaceInformation())
        for goal in goals:
            ends.addState(state_of(goal))
        setup.setGoal(ends)
        setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
        setup.solve(seconds)
        if not setup.haveExactSolutionPath():
            return Answer("undecided", None, "no path found")
        setup.simplifySolution()
        path = np.stack([configuration(state) for state in setup.getSolutionPath().getStates()])
        return Answer("solved", _exact_ends(path, problem, goals[np.abs(goals - path[-1]).max(axis=1).argmin()]))


class Roboplan(Planner):
    """RRT-Connect and shortcuts of roboplan at its default step of 0.05 rad; the goals are tried in turn."""

    package = module = "roboplan"

    def __init__(self, robot: Json, urdf: Path) -> None:
        from roboplan import core, rrt

        super().__init__(robot, urdf)
        self.core, self.rrt = core, rrt
        self.scene = core.Scene("panda", core.loadUrdfSceneDescription(str(urdf)))
        self.scene.importSrdf(urdf.with_suffix(".srdf").read_text())
        names = [f"joint{joint + 1}" for joint in range(7)]
        for lock in (None, *range(7)):
            self.scene.addGroup(f"without {lock}", [name for joint, name in enumerate(names) if joint != lock])

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        names = [f"object{index}" for index in range(len(problem.objects))]
        for name, o in zip(names, problem.objects, strict=True):
            color, pose = np.ones(4), np.asfortranarray(_pose(o))
            if o["kind"] == "box":
                self.scene.addBoxGeometry(name, "universe", self.core.Box(*o["size"]), pose, color)
            else:
                self.scene.addCylinderGeometry(name, "universe", self.core.Cylinder(o["radius"], o["length"]), pose, color)
        self.scene.setCollisions([(one, other) for one in names for other in names if one < other], False)
        try:
            return self._plan(problem, goals, seconds)
        finally:
            for name in names:
                self.scene.removeGeometry(name)

    def _plan(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        group, free = f"without {problem.joint}", [joint for joint in range(7) if joint != problem.joint]
        self.scene.setJointPositions(problem.start)
        options = self.rrt.RRTOptions(group_name=group, rrt_connect=True, max_planning_time=seconds / len(goals))
        reason = "no path found"
        for goal in goals:
            joints = [f"joint{joint + 1}" for joint in free]
            ends = [self.core.JointConfiguration(joints, q[free]) for q in (problem.start, goal)]
            try:
                route = self.rrt.RRT(self.scene, options).plan(*ends)
            except RuntimeError as error:
                reason = str(error)
                continue
            route = self.core.PathShortcutter(self.scene, self.core.PathShortcuttingOptions(group_name=group)).shortcut(route)
            path = np.tile(problem.start, (len(route.positions), 1))
            path[:, free] = np.array(route.positions)
            return Answer("solved", _exact_ends(path, problem, goal))
        return Answer("undecided", None, reason)


class Mplib(Planner):
    """RRT-Connect and simplification of MPlib, without its timed trajectory.

    MPlib needs NumPy 1 and holdfast NumPy 2, so the meshes of holdfast's Panda are not available to it.
    """

    package = module = "mplib"
    tracks = ("spheres",)

    @classmethod
    def missing(cls) -> str:
        if not super().missing() and int(np.__version__.split(".")[0]) > 1:
            return "it crashes with NumPy 2; run it in an environment of its own with: pip install mplib 'numpy<2' pyyaml"
        return super().missing()

    def __init__(self, robot: Json, urdf: Path) -> None:
        import mplib

        super().__init__(robot, urdf)
        self.mplib = mplib
        self.planner = mplib.Planner(str(urdf), "tool", srdf=str(urdf.with_suffix(".srdf")))

    def solve(self, problem: Problem, goals: Floats, seconds: float) -> Answer:
        from mplib.collision_detection import fcl
        from mplib.planning.ompl import FixedJoint

        world = self.planner.planning_world
        names = [f"object{index}" for index in range(len(problem.objects))]
        for name, o in zip(names, problem.objects, strict=True):
            solid = fcl.Box(o["size"]) if o["kind"] == "box" else fcl.Cylinder(o["radius"], o["length"])
            x, y, z, w = o["quaternion_xyzw"]
            world.add_object(name, fcl.CollisionObject(solid, self.mplib.Pose(o["position"], [w, x, y, z])))
        try:
            self.planner.robot.set_qpos(problem.start, True)
            fixed = set() if problem.joint is None else {FixedJoint(0, problem.joint, problem.value)}
            status, path = self.planner.planner.plan(
                problem.start, list(goals), time=seconds, fixed_joints=fixed, simplify=True
            )
        finally:
            for name in names:
                world.remove_object(name)
        if status != "Exact solution":
            return Answer("undecided", None, str(status))
        return Answer("solved", _exact_ends(path, problem, goals[np.abs(goals - path[-1]).max(axis=1).argmin()]))


ADAPTERS: dict[str, type[Planner]] = {
    "holdfast": Holdfast,
    "vamp": Vamp,
    "ompl": Ompl,
    "roboplan": Roboplan,
    "mplib": Mplib,
}
