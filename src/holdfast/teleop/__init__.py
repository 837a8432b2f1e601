"""With a person at the stick: tasks, protocol, recorded trials, measures, operators and statistics.

The statistics are in :mod:`holdfast.teleop.analysis`, which needs statsmodels and is not imported with the rest.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003.
"""

from holdfast.teleop.allocation import write_allocation
from holdfast.teleop.bank_figure import bank_figure
from holdfast.teleop.drive import Computer, Operator, Recorded, Rules, drive
from holdfast.teleop.entries import Entry, Kind, State, Subject, Who
from holdfast.teleop.experiment import simulate_experiment
from holdfast.teleop.measures import CPM, MEASURES, Measure, cpm, measures
from holdfast.teleop.operators import Person, SimulatedPeople, population, rate
from holdfast.teleop.order import next_row, scenario_orders, williams
from holdfast.teleop.plant import Plant
from holdfast.teleop.point_task import SCENARIOS, PointTasks, Scenario
from holdfast.teleop.protocol import Protocol, Training, training_limit
from holdfast.teleop.protocol import read as read_protocol
from holdfast.teleop.records import Records
from holdfast.teleop.replay import Replay, replay
from holdfast.teleop.selection import Binning, Detour, binning, can_be_steered, most_disorienting, select, trapped
from holdfast.teleop.session import Next, Session, training_tasks
from holdfast.teleop.stick import Stick
from holdfast.teleop.tables import bank_table, computer_table, cycle_table, dictionary, export, hand_paths, trial_table
from holdfast.teleop.tasks import TaskBank, random_tasks, run, task_bank
from holdfast.teleop.trials import End, RecordedCycles, Trials

__all__ = [
    "CPM",
    "MEASURES",
    "SCENARIOS",
    "Binning",
    "Computer",
    "Detour",
    "End",
    "Entry",
    "Kind",
    "Measure",
    "Next",
    "Operator",
    "Person",
    "Plant",
    "PointTasks",
    "Protocol",
    "Recorded",
    "RecordedCycles",
    "Records",
    "Replay",
    "Rules",
    "Scenario",
    "Session",
    "SimulatedPeople",
    "State",
    "Stick",
    "Subject",
    "TaskBank",
    "Training",
    "Trials",
    "Who",
    "bank_figure",
    "bank_table",
    "binning",
    "can_be_steered",
    "computer_table",
    "cpm",
    "cycle_table",
    "dictionary",
    "drive",
    "export",
    "hand_paths",
    "measures",
    "most_disorienting",
    "next_row",
    "population",
    "random_tasks",
    "rate",
    "read_protocol",
    "replay",
    "run",
    "scenario_orders",
    "select",
    "simulate_experiment",
    "task_bank",
    "training_limit",
    "training_tasks",
    "trapped",
    "trial_table",
    "williams",
    "write_allocation",
]
