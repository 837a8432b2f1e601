"""An arm: a machine with its kinematics, statics and dynamics."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, checked_class
from holdfast.arm.dh import DH, build
from holdfast.arm.machine import GRAVITY, Link, Machine, transform
from holdfast.caching import cached_property
from holdfast.files.html import Html
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.result import Shown

Array = NDArray[np.float64]


@checked_class
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Arm(Shown, Machine):
    """A serial arm: the data of a :class:`~holdfast.arm.machine.Machine`, which it is made of, and what can be asked of it."""

    # ---- builders ----------------------------------------------------------------------------------------------

    @classmethod
    @checked
    def from_dh(
        cls,
        rows: Sequence[DH],
        links: Sequence[Link | None] | None = None,
        convention: Literal["standard", "modified"] = "standard",
        *,
        base: ArrayLike | None = None,
        tool: ArrayLike | None = None,
        gravity: ArrayLike = GRAVITY,
        payload: Link | None = None,
        name: str = "arm",
        source: str = "",
    ) -> Arm:
        """An arm from Denavit-Hartenberg rows; see :class:`holdfast.arm.dh.DH`.

        Args:
            rows: One per joint.
            links: One per joint, each in its row's frame (distal for ``standard``, proximal for ``modified``).
            convention: ``standard``: ``Rz(theta) Tz(d) Tx(a) Rx(alpha)``; ``modified``: ``Rx(alpha) Tx(a) Rz(theta) Tz(d)``.
            base: (4, 4) pose of the base in the world; the identity if not given.
            tool: (4, 4) pose of the tool in the last row's frame; the identity if not given.
            gravity: (3,) acceleration in the world frame in which ``base`` is given.
            payload: In the last row's frame.
            name: For people and files.
            source: Where the numbers come from.

        Raises:
            ArmError: What is wrong with which row.
        """
        return cls._of(build(rows, links, convention, base, tool, gravity, payload, name, source))

    @classmethod
    @checked
    def from_urdf(cls, path: str | Path, base: str | None = None, tip: str | None = None, **options: Any) -> Arm:
        """The chain from link ``base`` to link ``tip`` of a URDF file; see :func:`holdfast.arm.urdf.load`.

        Raises:
            ArmError: The file cannot be read, or the chain is not unique or not serial; the message names the link or joint.
        """
        from holdfast.arm.urdf import load

        return cls._of(load(path, base, tip, **options))

    @classmethod
    @checked
    def from_mjcf(cls, path: str | Path, base: str | None = None, tip: str | None = None, **options: Any) -> Arm:
        """The chain from body ``base`` to body or site ``tip`` of an MJCF file; see :func:`holdfast.arm.mjcf.load`.

        Raises:
            ArmError: The file cannot be read, or the chain is not unique or not serial; the message names the body or joint.
            HoldfastError: MuJoCo is not installed; it comes with ``holdfast[physics]``.
        """
        from holdfast.arm.mjcf import load

        return cls._of(load(path, base, tip, **options))

    @classmethod
    def _of(cls, machine: Machine) -> Arm:
        return cls(**machine.__getstate__())

    @checked
    def with_tool(self, tool: ArrayLike) -> Arm:
        """The same arm with another tool, given as ``from_dh`` and URDF files do: (4, 4) in the last link's own frame."""
        chain = None if self.chain is None else replace(self.chain, tip=None)
        return replace(self, tool=self.flange @ transform(tool, f"tool of arm '{self.name}'"), chain=chain)

    @checked
    def with_payload(self, payload: Link | None) -> Arm:
        """The same arm holding another body, given in the last link's own frame; None: nothing."""
        return replace(self, payload=None if payload is None else payload.moved(self.flange))

    @checked
    def with_base(self, base: ArrayLike) -> Arm:
        """The same arm mounted elsewhere: ``base`` (4, 4) in the world; gravity stays the world's."""
        return replace(self, base=np.asarray(base, dtype=np.float64))

    @checked
    def with_limits(self, lower: ArrayLike, upper: ArrayLike) -> Arm:
        """The same arm with other limits (n,) of its joints, rad and m; infinite where there are none."""
        limits = zip(self.joints, *(self.check_configurations(limit).tolist() for limit in (lower, upper)), strict=True)
        return replace(self, joints=tuple(replace(j, lower=low, upper=high) for j, low, high in limits))

    @cached_property
    def without_limits(self) -> Arm:
        """The arm as a law sees it: every revolute joint has period 2 pi."""
        return self.with_limits(np.full(self.n, -np.inf), np.full(self.n, np.inf))

    @cached_property
    def without_idle_limits(self) -> Arm:
        """The arm without the limits of joints that may make a whole turn: those exclude no posture."""
        idle = ~self.prismatic & (self.upper - self.lower >= 2 * np.pi - 1e-6)
        if not idle.any():
            return self
        return self.with_limits(np.where(idle, -np.inf, self.lower), np.where(idle, np.inf, self.upper))

    # ---- what it is called --------------------------------------------------------------------------------------

    @property
    def title(self) -> str:
        """Name, base and tip, as headings have them."""
        return self.name if self.chain is None else f"{self.name} ({self.chain})"

    @property
    def provenance(self) -> str:
        """Source, base and tip, for reports."""
        return "; ".join([self.source or "no source given", *([] if self.chain is None else [str(self.chain)])])

    def entry(self) -> dict[str, Any]:
        """``arm``, ``base`` and ``tip`` by name, and the joints ``held``: what a JSON answer about the arm begins with."""
        base, tip, held = (None, None, ()) if self.chain is None else (self.chain.base, self.chain.tip, self.chain.held)
        return {"arm": self.name, "base": base, "tip": tip, "held": dict(held)}

    def describe(self) -> list[str]:
        """Describe joints, single points of failure, and data problems: the lines of ``holdfast describe``."""
        lines: list[str] = self._presented("describe")
        return lines

    def save(self, file: str | Path) -> Path:
        """Write the arm as a URDF file (``.urdf``) or as a Denavit-Hartenberg table (``.yaml``).

        A table holds all numbers of the arm. A URDF file has no place for gravity, payload, rotor inertia and limits on one
        side; what is lost is said. Frames are written as angles, so numbers read from the file may differ in the last digits,
        and then :attr:`fingerprint` does. A table has frames of its own between the joints.

        Args:
            file: The file, replaced in one step. :meth:`from_urdf` reads one, :func:`holdfast.arms.resolve` both.

        Returns:
            The file.

        Raises:
            InputError: Another ending.
            StoreError: The file cannot be written.
        """
        written: Path = self._presented("save", Path(file))
        return written

    # ---- how it looks ------------------------------------------------------------------------------------------

    def show(self, q: ArrayLike | None = None, **options: Any) -> Html:
        """The arm in a small 3-D view, one page that needs no server, no network and no other file.

        In a notebook it is seen as it is; ``arm.show().save("arm.html")`` writes it. Without WebGL there is a drawing.

        Args:
            q: (n,) rad and m; (A, n) several, the first solid and the others see-through; with ``time`` a motion (F, n), or
                (A, F, n) several; a configuration in which nothing is special if not given.
            options: What else is shown: ``labels``, ``locked``, ``targets``, ``region``, ``path``, ``time``, ...; see
                :func:`holdfast.present.arm.view.scene`.

        Raises:
            InputError: Options that do not fit the arm or each other.
        """
        page: Html = self._presented("page", q, **options)
        return page

    # ---- kinematics --------------------------------------------------------------------------------------------

    def _compiled(self, name: str, expression: Callable[[Arm, SX], SX]) -> Kernel:
        from holdfast.arm import kinematics

        q = kinematics.joint_symbols(self)
        return Kernel(name, [q], [expression(self, q)])

    @cached_property
    @recalled
    def _pose_kernel(self) -> Kernel:
        from holdfast.arm import kinematics

        return self._compiled("pose", kinematics.tool_pose)

    @cached_property
    @recalled
    def _jacobian_kernel(self) -> Kernel:
        from holdfast.arm import kinematics

        return self._compiled("jacobian", kinematics.jacobian)

    @cached_property
    @recalled
    def _jacobian_derivative_kernel(self) -> Kernel:
        from holdfast.arm import kinematics

        return self._compiled("jacobian derivative", kinematics.jacobian_derivative)

    @cached_property
    @recalled
    def _gravity_torque_kernel(self) -> Kernel:
        from holdfast.arm import statics

        return self._compiled("gravity torque", lambda arm, q: statics.gravity_torques(arm, statics.composite(arm, q)))

    @cached_property
    @recalled
    def _inertia_diagonal_kernel(self) -> Kernel:
        from holdfast.arm import statics

        return self._compiled("inertia diagonal", lambda arm, q: statics.inertia_diagonal(arm, statics.composite(arm, q)))

    @cached_property
    @recalled
    def _dynamics_kernel(self) -> Kernel:
        from holdfast.arm import dynamics

        return dynamics.torque_kernel(self)

    @cached_property
    @recalled
    def _frames_kernel(self) -> Kernel:
        from holdfast.arm import kinematics

        return self._compiled("frames of the arm", kinematics.body_poses)

    def frames(self, q: ArrayLike) -> Array:
        """Poses in the world of the base, of what moves with each joint and of the tool, rad, m.

        The origin of frame k + 1 is where joint k, from 0, is; a prismatic joint is where its slide is. So
        ``frames(q)[..., :3, 3]`` is the arm as a stick figure.

        Args:
            q: (n,) or (N, n), rad and m.

        Returns:
            (n + 2, 4, 4) or (N, n + 2, 4, 4); the first is ``base``, the last is :meth:`forward_kinematics`.
        """
        a = self.check_configurations(q)
        out = np.zeros((*a.shape[:-1], self.n + 2, 4, 4))
        out[..., :3, :] = self._frames_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], self.n + 2, 3, 4))
        out[..., 3, 3] = 1.0
        return out

    def forward_kinematics(self, q: ArrayLike) -> Array:
        """Tool pose in the world, (4, 4), or (N, 4, 4) for ``q`` (N, n); rad, m."""
        a = self.check_configurations(q)
        return self._pose_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], 4, 4))

    def jacobian(self, q: ArrayLike) -> Array:
        """Geometric Jacobian at the tool point, (6, n) or (N, 6, n).

        Rows: linear velocity, then angular velocity, both in the world frame; m/rad and rad/rad for revolute columns.
        """
        a = self.check_configurations(q)
        return self._jacobian_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], 6, self.n))

    def jacobian_derivative(self, q: ArrayLike) -> Array:
        """Derivative of the Jacobian, ``out[..., j, :, i] = d J[:, i] / d q_j``, (n, 6, n) or (N, n, 6, n)."""
        a = self.check_configurations(q)
        return self._jacobian_derivative_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], self.n, 6, self.n))

    def gravity_torque(self, q: ArrayLike) -> Array:
        """Torques and forces, N m and N, that hold the arm and its payload still against gravity, (n,) or (N, n).

        Raises:
            ArmError: A link of which nothing is known.
        """
        a = self.check_configurations(q)
        return self._gravity_torque_kernel.rows(np.atleast_2d(a)).reshape(a.shape)

    def inertia_diagonal(self, q: ArrayLike) -> Array:
        """Diagonal of the joint-space inertia matrix, payload and armature included, (n,) or (N, n); kg m^2 and kg.

        Raises:
            ArmError: A link of which nothing is known, or whose inertia no body has.
        """
        a = self.check_configurations(q)
        return self._inertia_diagonal_kernel.rows(np.atleast_2d(a)).reshape(a.shape)

    def inverse_dynamics(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> Array:
        """Torques and forces of a motion, ``M(q) qdd + C(q, qd) qd + B qd + g(q)``, (n,) or (N, n); N m and N.

        Payload, armature and viscous friction included.

        Args:
            q: (n,) or (N, n), rad and m.
            qd: (n,) or (N, n), rad/s and m/s.
            qdd: (n,) or (N, n), rad/s^2 and m/s^2.

        Source: English and Maciejewski 1998, eq. (5).

        Raises:
            ArmError: A link of which nothing is known, or whose inertia no body has.
            InputError: Shapes that do not fit; NaN or infinity in a single state (in a batch such a row gets NaN).
        """
        inertial, viscous, gravity = self.torque_terms(q, qd, qdd)
        return inertial + viscous + gravity

    def torque_terms(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> tuple[Array, Array, Array]:
        """The terms of :meth:`inverse_dynamics`: ``M qdd + C qd``, ``B qd`` and ``g``, each (n,) or (N, n); N m and N."""
        from holdfast.arm.dynamics import check_states

        states, single = check_states(self, q, qd, qdd)
        inertial, viscous, gravity = np.split(self._dynamics_kernel.rows(*states), 3, axis=1)
        return (inertial[0], viscous[0], gravity[0]) if single else (inertial, viscous, gravity)
