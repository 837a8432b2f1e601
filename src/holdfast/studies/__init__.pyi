from holdfast.studies import assessment as assessment
from holdfast.studies import designs as designs
from holdfast.studies import planner_benchmark as planner_benchmark
from holdfast.studies import study_files as study_files
from holdfast.studies.study_files import StudyFile as StudyFile
from holdfast.studies.study_files import convert_folder as convert_folder
from holdfast.studies.study_files import read_study_file as read_study_file
