"""Names that changed before the first release, with their successors, for error messages."""

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
OPTION_SUCCESSORS = {
    "--anywhere": "--any-pose",
    "--body": "--robot",
    "--climbs": "--local-searches",
    "--fresh": "--check-poses",
    "--inject": "--test-locks",
    "--notice": "--monitor",
}
_PUBLIC_NAMES = """
holdfast: bench=planner_benchmark ceilings=index_bounds clearance=collision engine=sweeps keep=tool_constraints
  motion=path_following reaction=supervisor Endurance=LockSurvival Reach=PoseSolutions endurance_of=evaluate_motion
  endure=plan_motion
  endure_to=plan_motion_to best_law=compare_laws target_measures=workspace
holdfast.control.convergence: best_law=compare_laws target_measures=workspace
holdfast.studies.planner_benchmark: Case=BenchmarkCase Motion=BenchmarkMotion trouble=find_violation
holdfast.kinematics.index_bounds: Average=AverageBound Ceiling=UpperBound CeilingSearch=UpperBoundSearch
  CeilingTable=UpperBoundTable SingularValueCeiling=SingularValueBound best_average=bound_average look_up=upper_bound
  of_index=bound_of_index
  search=search_null_space singular_value=bound_singular_value singular_value_of_index=bound_singular_value_of_index
  table=bound_table
holdfast.model.collision: Capsule=LinkCapsule
holdfast.studies.designs: Book=RecordBook Check=HeldOutCheck Checked=HeldOutResult Judgement=ArmComparison Measured=ArmMeasures
  Orders=JointOrders Parameter=DesignParameter PlanarRest=PlanarStationarySets Record=DesignRecord judge=compare_arms
  judge_orders=compare_joint_orders record=record_design records=record_designs written=write_dh_table
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


def find_successor(package: str, name: str) -> str | None:
    """Return the full new name of a public function or class that was renamed; None for any other name."""
    table = re.search(rf"^{re.escape(package)}:(.*(?:\n  .*)*)", _PUBLIC_NAMES, re.MULTILINE)
    pairs = dict(pair.split("=") for pair in table.group(1).split()) if table else {}
    return f"{package}.{pairs[name]}" if name in pairs else None
