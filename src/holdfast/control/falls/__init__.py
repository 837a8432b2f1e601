"""Falls of arms whose joints lose their torque, simulated in batches up to their first contacts."""

from holdfast.core._lazy import offer

offer(__name__)
