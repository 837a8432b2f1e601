from holdfast.studies.study_files.conversion import convert_folder as convert_folder
from holdfast.studies.study_files.study_file import StudyFile as StudyFile
from holdfast.studies.study_files.study_file import read_study_file as read_study_file
