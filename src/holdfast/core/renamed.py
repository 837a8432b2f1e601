"""Names that changed or left the package before the first release, with their successors, for error messages."""

import re

COMMAND_SUCCESSORS = {
    "best-law": "compare-laws --best",
    "ceiling": "upper-bound",
    "endure": "plan-motion",
    "judge": "compare-arms",
    "observe": "predict-detection",
    "probe": "identify",
    "records": "record-designs",
    "rehearse": "simulate-logs",
    "target-measures": "workspace --over targets",
}
REPOSITORY_COMMANDS = {"bench": "python -m benchmarks.planners", "synthesise": "python -m measurements.synthesis"}
OPTION_SUCCESSORS = {
    "--anywhere": "--any-pose",
    "--body": "--robot",
    "--climbs": "--local-searches",
    "--fresh": "--check-poses",
    "--inject": "--test-locks",
    "--notice": "--monitor",
    "--view": "holdfast page ARM --out FILE",
}
_PUBLIC_NAMES = """
holdfast: ceilings=index_bounds clearance=collision engine=sweeps keep=tool_constraints
  motion=path_following reaction=supervisor Endurance=LockSurvival Reach=PoseSolutions endurance_of=evaluate_motion
  endure=plan_motion
  endure_to=plan_motion_to best_law=compare_laws target_measures=workspace
holdfast.control.convergence: best_law=compare_laws target_measures=workspace
holdfast.kinematics.index_bounds: Average=AverageBound Ceiling=UpperBound CeilingTable=UpperBoundTable
  SingularValueCeiling=SingularValueBound best_average=bound_average look_up=upper_bound of_index=bound_of_index
  singular_value=bound_singular_value singular_value_of_index=bound_singular_value_of_index
  table=bound_table
holdfast.model.arms: resolve=load
holdfast.model.collision: Capsule=LinkCapsule
holdfast.studies.designs: Book=RecordBook Check=HeldOutCheck Checked=HeldOutResult Judgement=ArmComparison Measured=ArmMeasures
  Parameter=DesignParameter PlanarRest=PlanarStationarySets Record=DesignRecord judge=compare_arms
  record=record_design records=record_designs
holdfast.response.diagnosis: Finding=Identification Probe=ProbingMotion Push=ExternalForce Verdict=FaultVerdict decide=identify
  observe=predict_detection plan_probe=plan_identification rehearse=simulate_log rehearse_many=simulate_logs
holdfast.kinematics.interval_search: Finding=SearchOutcome parted=prove_leg_impossible
holdfast.response.lock_survival: Compared=BaselineMotion Endurance=LockSurvival Found=SearchBounds Injection=LockTests
  endurance_of=evaluate_motion endure=plan_motion endure_to=plan_motion_to
holdfast.core.sweeps: Cell=SweepCell Damage=DamagedChunk Job=SweepJob Merged=MergeReport Result=ChunkResult Task=ChunkTask
  Threads=ThreadRunner Verification=StudyVerification merge=merge_studies verify=verify_studies
holdfast.model.failure_modes: locks_given=locks_with_values
holdfast.response.faults: Faults=FaultModel Success=SuccessRate recorded=read_episodes success=success_rate
holdfast.kinematics.indices: Evaluation=IndexEvaluation Opposite=NegatedObjective Part=ObjectivePart
holdfast.kinematics.indices.susceptibility: Evaluation=SusceptibilityEvaluation Formula=SusceptibilityFormula
  Together=SusceptibilityBatch
holdfast.kinematics.tool_constraints: Kept=ToolConstraint
holdfast.kernels: BACKENDS=BACKEND_NAMES Single=SingleRowKernel Step=ControlStep pool=shared_pool recalled=cached_kernel
  recalled_data=cached_json settle=wait_for_compiler
holdfast.response.recovery: Ending=RecoveryOutcome RowsGivenUp=RelaxedRows Verdict=RecoveryVerdict WhatIsLeft=RemainingWorkspace
holdfast.interface.report: binned=bin_positions finished=settle_layout together=insert_nonbreaking_spaces
holdfast.control.simulation: Outcome=RunOutcome Path=RunPath
holdfast.kinematics.solvers: Reach=PoseSolutions
holdfast.studies: read=read_study_file
holdfast.studies.study_files: read=read_study_file
holdfast.teleop: Computer=ComputerOperator Detour=WaypointOperator Entry=TrialRecord Kind=TrialKind Next=NextTrial
  Plant=JoystickPlant Recorded=RecordedOperator Rules=EndRules State=SubjectState Stick=Joystick Who=SubjectKind
  binning=bin_tasks cpm=compute_cpm dictionary=describe_columns drive=drive_trials export=export_tables
  measures=compute_measures most_disorienting=find_most_disorienting next_row=choose_next_row population=sample_people
  random_tasks=sample_tasks rate=rate_comfort replay=replay_trials run=run_tasks scenario_orders=shuffle_scenarios
  select=select_tasks task_bank=make_task_bank trapped=find_trapped_task williams=williams_square
holdfast.teleop.analysis: Cells=CellMeans Groups=TaskGroups Mixed=MixedModel Observed=TrialTable Paired=PairedComparison
  correlation=correlate holm=correct_by_holm paired=compare_pairs
holdfast.teleop.bank: Detour=WaypointOperator binning=bin_tasks most_disorienting=find_most_disorienting
  random_tasks=sample_tasks run=run_tasks select=select_tasks task_bank=make_task_bank trapped=find_trapped_task
holdfast.teleop.protocol: next_row=choose_next_row scenario_orders=shuffle_scenarios williams=williams_square
holdfast.teleop.records: Entry=TrialRecord Kind=TrialKind Next=NextTrial State=SubjectState Who=SubjectKind
  dictionary=describe_columns export=export_tables replay=replay_trials
holdfast.teleop.trials: Computer=ComputerOperator Plant=JoystickPlant Recorded=RecordedOperator Rules=EndRules
  Stick=Joystick cpm=compute_cpm drive=drive_trials measures=compute_measures population=sample_people rate=rate_comfort
"""


_REPOSITORY_NAMES = """
holdfast: bench=benchmarks.planners planner_benchmark=benchmarks.planners
holdfast.studies: planner_benchmark=benchmarks.planners
holdfast.kinematics.index_bounds: CeilingSearch=measurements.upper_bounds.ascent_search.UpperBoundSearch
  UpperBoundSearch=measurements.upper_bounds.ascent_search.UpperBoundSearch
  search=measurements.upper_bounds.ascent_search.search_null_space
  search_null_space=measurements.upper_bounds.ascent_search.search_null_space
  bounds_by_arrangement=measurements.upper_bounds.minor_programmes.bounds_by_arrangement
holdfast.studies.designs: Orders=measurements.synthesis.orders.JointOrders
  JointOrders=measurements.synthesis.orders.JointOrders
  judge_orders=measurements.synthesis.orders.compare_joint_orders
  compare_joint_orders=measurements.synthesis.orders.compare_joint_orders
  EvolvedDesign=measurements.record_designs.found.EvolvedDesign
  design_for_self_motion=measurements.record_designs.self_motions.design_for_self_motion
  design_for_workspace=measurements.record_designs.workspaces.design_for_workspace
  Synthesis=measurements.synthesis.arms.Synthesis
  synthesise=measurements.synthesis.arms.synthesise
  written=measurements.synthesis.arms.write_dh_table
  write_dh_table=measurements.synthesis.arms.write_dh_table
"""


def find_successor(package: str, name: str) -> str | None:
    """Return the full new name of a public function or class that was renamed or moved; None for any other name."""
    if name in (moved := _read_pairs(_REPOSITORY_NAMES, package)):
        return f"{moved[name]}, which is not installed; it is in the repository"
    renamed = _read_pairs(_PUBLIC_NAMES, package)
    return f"{package}.{renamed[name]}" if name in renamed else None


def _read_pairs(table: str, package: str) -> dict[str, str]:
    line = re.search(rf"^{re.escape(package)}:(.*(?:\n  .*)*)", table, re.MULTILINE)
    return dict(pair.split("=") for pair in line.group(1).split()) if line else {}
