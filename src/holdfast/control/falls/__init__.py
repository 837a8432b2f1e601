"""Falls of arms whose joints lose their torque, simulated in batches without contacts."""

from holdfast.core._lazy import offer

offer(__name__)
