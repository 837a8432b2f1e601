"""Single control step, as fast as Python can call it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import KernelError
from holdfast.core.typing import FloatArray
from holdfast.kernels.kernel import Kernel


class ControlStep:
    """Control step ``(q, velocity) -> rates`` with its own buffer, not for several threads at once.

    Nothing is checked. The bits are those of the law's batch.
    """

    def __init__(self, kernel: Kernel, n: int) -> None:
        single = kernel.single_row()
        self._run, self._in, self._n = single.run, single.inputs, n
        self._out = np.full(kernel.program.n_out, np.nan)
        # Memory views are filled in half the time that NumPy's slices take.
        self._q: Any = self._in.data[:n]
        self._velocity: Any = self._in.data[n:]

    def __call__(self, q: FloatArray, velocity: FloatArray) -> FloatArray:
        """Rates (n,) of a configuration (n,) and a velocity of the end effector."""
        try:
            self._q[:] = q
            self._velocity[:] = velocity
        except (TypeError, ValueError):  # whole numbers, or lists
            self._in[: self._n], self._in[self._n :] = q, velocity
        self._out = outputs = self._run()
        return outputs[: self._n]

    @property
    def extra_outputs(self) -> FloatArray:
        """Further outputs of the kernel in the last call: of a resolution the fractions and the damping."""
        return self._out[self._n :]


class Steppable(ABC):
    """Base of objects with a control step, once it is prepared."""

    @abstractmethod
    def _step_kernel(self) -> tuple[Kernel, int]:
        """Return the kernel of a step, joint rates first, and the number of joints."""

    @cached_property
    def _prepared_step(self) -> ControlStep:
        return ControlStep(*self._step_kernel())

    def prepare(self) -> ControlStep:
        """Compile :attr:`step`, which takes up to a few seconds at first use and milliseconds later; returns it.

        A loop that controls a robot calls this before it begins.
        """
        return self._prepared_step

    @property
    def step(self) -> ControlStep:
        """``step(q, velocity) -> rates`` for one configuration: for a control loop, without any checks.

        It never compiles; what else was computed is in ``step.others``.

        Raises:
            KernelError: :meth:`prepare` was not called.
        """
        if "_prepared_step" not in self.__dict__:
            raise KernelError("the step of this law is not compiled yet; call its prepare() once, before the control loop")
        return self._prepared_step
