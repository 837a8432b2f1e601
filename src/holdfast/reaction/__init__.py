"""From a fault to an action: the arm fails, a monitor names the joint, the controller reacts and the task goes on."""

from holdfast._lazy import offer

offer(__name__)
