"""Arm: its data with kinematics, statics, and dynamics."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.files.html import Html
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, check_constructor
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.model.arm.dh import DH, build_from_rows
from holdfast.model.arm.machine import GRAVITY, ArmData, Chain, Joint, Link, check_transform  # noqa: F401  # for inherited fields


@check_constructor
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Arm(Presentable, ArmData):
    """Serial arm: the data of an :class:`~holdfast.model.arm.machine.ArmData` with its kinematics, dynamics, and reports."""

    # ---- builders ----------------------------------------------------------------------------------------------

    @classmethod
    @check_arguments
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
        """Return an arm from Denavit-Hartenberg rows; see :class:`holdfast.model.arm.dh.DH`.

        Args:
            rows: One row per joint.
            links: One body per joint, each in its row's frame (distal for ``standard``, proximal for ``modified``).
            convention: ``standard``: ``Rz(theta) Tz(d) Tx(a) Rx(alpha)``; ``modified``: ``Rx(alpha) Tx(a) Rz(theta) Tz(d)``.
            base: (4, 4) pose of the base in the world, m; default: the identity.
            tool: (4, 4) pose of the tool in the last row's frame, m; default: the identity.
            gravity: (3,) acceleration in the world frame, m/s^2.
            payload: Body held by the end effector, in the last row's frame.
            name: Name for people and files.
            source: Origin of the numbers.

        Raises:
            ArmError: A row is wrong; the message names the row and the problem.
        """
        return cls._from_data(build_from_rows(rows, links, convention, base, tool, gravity, payload, name, source))

    @classmethod
    @check_arguments
    def from_urdf(cls, path: str | Path, base: str | None = None, tip: str | None = None, **options: Any) -> Arm:
        """Return the chain from link ``base`` to link ``tip`` of the URDF file ``path``.

        ``options`` are the further arguments of :func:`holdfast.model.arm.formats.urdf.load_urdf`.

        Raises:
            ArmError: The file cannot be read, or the chain is not unique or not serial; the message names the link or joint.
        """
        from holdfast.model.arm.formats.urdf import load_urdf

        return cls._from_data(load_urdf(path, base, tip, **options))

    @classmethod
    @check_arguments
    def from_mjcf(cls, path: str | Path, base: str | None = None, tip: str | None = None, **options: Any) -> Arm:
        """Return the chain from body ``base`` to body or site ``tip`` of the MJCF file ``path``.

        ``options`` are the further arguments of :func:`holdfast.model.arm.formats.mjcf.load_mjcf`.

        Raises:
            ArmError: The file cannot be read, or the chain is not unique or not serial; the message names the body or joint.
            HoldfastError: MuJoCo is not installed; it comes with ``holdfast-arms[physics]``.
        """
        from holdfast.model.arm.formats.mjcf import load_mjcf

        return cls._from_data(load_mjcf(path, base, tip, **options))

    @classmethod
    @check_arguments
    def from_pinocchio(cls, model: object, base: str | None = None, tip: str | None = None, **options: Any) -> Arm:
        """Return the chain from frame ``base`` to frame ``tip`` of the ``pinocchio.Model`` ``model``.

        ``options`` are the further arguments of :func:`holdfast.model.arm.formats.pinocchio_model.read_pinocchio_model`.

        Raises:
            ArmError: The chain is not unique or not serial; the message names the frame or joint.
            HoldfastError: Pinocchio is not installed; it comes with ``holdfast-arms[pinocchio]``.
        """
        from holdfast.model.arm.formats.pinocchio_model import read_pinocchio_model

        return cls._from_data(read_pinocchio_model(model, base, tip, **options))

    @classmethod
    def _from_data(cls, data: ArmData) -> Arm:
        return cls(**data.__getstate__())

    @check_arguments
    def with_tool(self, tool: ArrayLike) -> Arm:
        """Return the arm with another ``tool`` pose (4, 4), m, in the last link's own frame, as in ``from_dh`` and URDF."""
        chain = None if self.chain is None else replace(self.chain, tip=None)
        return replace(self, tool=self.flange @ check_transform(tool, f"tool of arm '{self.name}'"), chain=chain)

    @check_arguments
    def with_payload(self, payload: Link | None) -> Arm:
        """Return the arm with another ``payload``, a body in the last link's own frame; None removes the payload."""
        return replace(self, payload=None if payload is None else payload.in_frame(self.flange))

    @check_arguments
    def with_base(self, base: ArrayLike) -> Arm:
        """Return the arm mounted at another pose ``base`` (4, 4) in the world, m; gravity does not change."""
        return replace(self, base=np.asarray(base, dtype=np.float64))

    @check_arguments
    def with_limits(self, lower: ArrayLike, upper: ArrayLike) -> Arm:
        """Return the arm with other joint limits ``lower`` and ``upper`` (n,), rad and m; infinite for no limit."""
        limits = zip(self.joints, *(self.check_configurations(limit).tolist() for limit in (lower, upper)), strict=True)
        return replace(self, joints=tuple(replace(j, lower=low, upper=high) for j, low, high in limits))

    @cached_property
    def without_limits(self) -> Arm:
        """Arm without joint limits, as a control law sees it: every revolute joint has period 2 pi."""
        return self.with_limits(np.full(self.n, -np.inf), np.full(self.n, np.inf))

    @cached_property
    def without_idle_limits(self) -> Arm:
        """Arm without the limits of joints with a range of a full revolution, because such limits exclude no configuration."""
        excludes_nothing = ~self.prismatic & (self.upper - self.lower >= 2 * np.pi - 1e-6)
        if not excludes_nothing.any():
            return self
        return self.with_limits(np.where(excludes_nothing, -np.inf, self.lower), np.where(excludes_nothing, np.inf, self.upper))

    # ---- names ------------------------------------------------------------------------------------------------

    @property
    def title(self) -> str:
        """Name, base, and tip, as headings show them."""
        return self.name if self.chain is None else f"{self.name} ({self.chain})"

    @property
    def provenance(self) -> str:
        """Source, base and tip, for reports."""
        return "; ".join([self.source or "no source given", *([] if self.chain is None else [str(self.chain)])])

    def entry(self) -> dict[str, Any]:
        """Return the names ``arm``, ``base``, ``tip``, and the locked joints ``held``, with which every JSON answer begins."""
        base, tip, held = (None, None, ()) if self.chain is None else (self.chain.base, self.chain.tip, self.chain.held)
        return {"arm": self.name, "base": base, "tip": tip, "held": dict(held)}

    def describe(self) -> list[str]:
        """Describe joints, single points of failure, and data problems: the lines of ``holdfast describe``."""
        lines: list[str] = self._present("describe")
        return lines

    def save(self, file: str | Path) -> Path:
        """Write the arm as a URDF file (``.urdf``) or as a Denavit-Hartenberg table (``.yaml``).

        A table contains all numbers of the arm. The URDF format lacks gravity, payload, rotor inertia, stiction and one-sided
        limits; a message lists lost data. Frames are written as angles, so numbers read back may differ in the last digits, and
        so may :attr:`fingerprint`. A table has its own frames between the joints.

        Args:
            file: Path of the file, replaced in one step. :func:`holdfast.model.arms.load` reads both formats.

        Returns:
            Path of the file.

        Raises:
            InputError: The file name has another ending.
            StoreError: The file cannot be written.
        """
        written: Path = self._present("save", Path(file))
        return written

    def to_urdf(self) -> str:
        """Return the arm as the text of a URDF file, with a rod from each joint to the next as its shape.

        The format lacks gravity, payload, rotor inertia, stiction, one-sided limits, and named configurations: see
        :meth:`save`.
        """
        from holdfast.model.arm.formats.urdf_writing import urdf_text

        return urdf_text(self)

    def to_mujoco(self) -> Any:
        """Return the arm as a ``mujoco.MjSpec`` in which all joints move, with limits, effort, and named configurations.

        ``qpos`` are the joint values, the site ``tool`` is the tool, and the world is the arm's world. MuJoCo has no velocity
        limits, and raises the principal moments of rods and points to 1e-9 of the body's largest.

        Raises:
            ArmError: A link has no inertial data or an impossible inertia, or a joint carries no mass.
            HoldfastError: MuJoCo is not installed.
        """
        from holdfast.model.arm.formats.mujoco_spec import build_whole_spec

        return build_whole_spec(self)

    def to_pinocchio(self) -> Any:
        """Return the arm as a ``pinocchio.Model`` with one coordinate per joint, also for joints without limits.

        The frame ``tool`` is the tool. The payload is part of the last body.

        Raises:
            HoldfastError: Pinocchio is not installed.
        """
        from holdfast.model.arm.formats.pinocchio_model import build_pinocchio_model

        return build_pinocchio_model(self)

    # ---- display -----------------------------------------------------------------------------------------------

    def show(self, q: ArrayLike | None = None, **options: Any) -> Html:
        """Return a page with the arm in a small 3-D view that needs no server, network, or other file.

        A notebook shows the page; ``arm.show().save("arm.html")`` writes it. Without JavaScript there is a drawing.

        Args:
            q: (n,) configuration, rad and m, or (A, n) several, the first solid and the others transparent; with ``time`` a
                motion (F, n), or (A, F, n) several. Default: a generic configuration.
            options: Further content: ``labels``, ``locked``, ``targets``, ``region``, ``path``, ``time``, ...; see
                :func:`holdfast.interface.presentation.arm.view.scene`.

        Raises:
            InputError: Options do not fit the arm or each other.
        """
        return self._present("page", q, **options)  # type: ignore[no-any-return]

    def page(self, file: str | Path | None = None, *, q: ArrayLike | None = None, **options: Any) -> Html:
        """Return an interactive page of the arm: one file that needs no server, network, or Python.

        Args:
            file: HTML file to write; None: do not write.
            q: (n,) first configuration, rad and m. Default: a configuration that its self-motion improves most.
            options: ``locked``, ``laws``, ``target``, ``task``, ``cell``, ``beside``, or ``plain``, as in
                ``build_page`` of ``holdfast.interface.presentation.arm_page.build``, which states the errors.
        """
        return self._present("build_page", q, file=file, **options)  # type: ignore[no-any-return]

    # ---- kinematics --------------------------------------------------------------------------------------------

    def _compile_kernel(self, name: str, expression: Callable[[Arm, SX], SX]) -> Kernel:
        from holdfast.model.arm import kinematics

        q = kinematics.joint_symbols(self)
        return Kernel(name, [q], [expression(self, q)])

    @cached_property
    @cached_kernel
    def _pose_kernel(self) -> Kernel:
        from holdfast.model.arm import kinematics

        return self._compile_kernel("pose", kinematics.tool_pose)

    @cached_property
    @cached_kernel
    def _jacobian_kernel(self) -> Kernel:
        from holdfast.model.arm import kinematics

        return self._compile_kernel("jacobian", kinematics.world_jacobian)

    @cached_property
    @cached_kernel
    def _jacobian_derivative_kernel(self) -> Kernel:
        from holdfast.model.arm import kinematics

        return self._compile_kernel("jacobian derivative", kinematics.jacobian_derivative)

    @cached_property
    @cached_kernel
    def _gravity_torque_kernel(self) -> Kernel:
        from holdfast.model.arm import statics

        return self._compile_kernel(
            "gravity torque", lambda arm, q: statics.gravity_torques(arm, statics.composite_bodies(arm, q))
        )

    @cached_property
    @cached_kernel
    def _inertia_diagonal_kernel(self) -> Kernel:
        from holdfast.model.arm import statics

        return self._compile_kernel(
            "inertia diagonal", lambda arm, q: statics.inertia_diagonal(arm, statics.composite_bodies(arm, q))
        )

    @cached_property
    @cached_kernel
    def _dynamics_kernel(self) -> Kernel:
        from holdfast.model.arm import dynamics

        return dynamics.torque_terms_kernel(self)

    @cached_property
    @cached_kernel
    def _frames_kernel(self) -> Kernel:
        from holdfast.model.arm import kinematics

        return self._compile_kernel("frames of the arm", kinematics.body_poses)

    def frames(self, q: ArrayLike) -> FloatArray:
        """Return the world poses of the base, of the link that moves with each joint, and of the tool, rad, m.

        The origin of frame k + 1 is at joint k, from 0; for a prismatic joint it moves with the slide. Therefore
        ``frames(q)[..., :3, 3]`` is the arm as a stick figure.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Returns:
            (n + 2, 4, 4) or (N, n + 2, 4, 4); the first is ``base``, the last is :meth:`forward_kinematics`.
        """
        checked_q = self.check_configurations(q)
        poses = np.zeros((*checked_q.shape[:-1], self.n + 2, 4, 4))
        poses[..., :3, :] = self._frames_kernel.rows(np.atleast_2d(checked_q)).reshape(
            (*checked_q.shape[:-1], self.n + 2, 3, 4)
        )
        poses[..., 3, 3] = 1.0
        return poses

    def forward_kinematics(self, q: ArrayLike) -> FloatArray:
        """Return the tool pose in the world, (4, 4), or (N, 4, 4) for ``q`` (N, n); rad, m."""
        a = self.check_configurations(q)
        return self._pose_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], 4, 4))

    def jacobian(self, q: ArrayLike) -> FloatArray:
        """Return the geometric Jacobian at the tool point, (6, n) or (N, 6, n), at ``q`` (n,) or (N, n), rad and m.

        Rows: linear velocity, then angular velocity, both in the world frame; m/rad and rad/rad for revolute columns.
        """
        checked_q = self.check_configurations(q)
        return self._jacobian_kernel.rows(np.atleast_2d(checked_q)).reshape((*checked_q.shape[:-1], 6, self.n))

    def jacobian_derivative(self, q: ArrayLike) -> FloatArray:
        """Return ``out[..., j, :, i] = d J[:, i] / d q_j``, (n, 6, n) or (N, n, 6, n), at ``q`` (n,) or (N, n), rad and m."""
        a = self.check_configurations(q)
        return self._jacobian_derivative_kernel.rows(np.atleast_2d(a)).reshape((*a.shape[:-1], self.n, 6, self.n))

    def gravity_torque(self, q: ArrayLike) -> FloatArray:
        """Return torques and forces that hold arm and payload still at ``q`` (n,) or (N, n), of the same shape, N m and N.

        Raises:
            ArmError: The mass of a link is unknown.
        """
        checked_q = self.check_configurations(q)
        return self._gravity_torque_kernel.rows(np.atleast_2d(checked_q)).reshape(checked_q.shape)

    def inertia_diagonal(self, q: ArrayLike) -> FloatArray:
        """Return the diagonal of the joint-space inertia matrix at ``q`` (n,) or (N, n), of the same shape; kg m^2 and kg.

        It includes payload and armature.

        Raises:
            ArmError: The mass or inertia of a link is unknown, or impossible for a body.
        """
        checked_q = self.check_configurations(q)
        return self._inertia_diagonal_kernel.rows(np.atleast_2d(checked_q)).reshape(checked_q.shape)

    def inverse_dynamics(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> FloatArray:
        """Return torques and forces of a motion, ``M(q) qdd + C(q, qd) qd + B qd + g(q)``, (n,) or (N, n); N m and N.

        They include payload, armature and viscous friction.

        Args:
            q: (n,) or (N, n) configurations, rad and m.
            qd: (n,) or (N, n) joint rates, rad/s and m/s.
            qdd: (n,) or (N, n) joint accelerations, rad/s^2 and m/s^2.

        Source: English and Maciejewski 1998, eq. (5).

        Raises:
            ArmError: The mass or inertia of a link is unknown, or impossible for a body.
            InputError: Shapes do not fit, or a single state contains NaN or infinity (in a batch such a row gets NaN).
        """
        inertial, viscous, gravity = self.torque_terms(q, qd, qdd)
        return inertial + viscous + gravity

    def torque_terms(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return ``M qdd + C qd``, ``B qd``, and ``g`` of :meth:`inverse_dynamics` at ``q``, ``qd``, ``qdd`` (..., n)."""
        from holdfast.model.arm.dynamics import check_states

        states, single = check_states(self, q, qd, qdd)
        inertial, viscous, gravity = np.split(self._dynamics_kernel.rows(*states), 3, axis=1)
        return (inertial[0], viscous[0], gravity[0]) if single else (inertial, viscous, gravity)
