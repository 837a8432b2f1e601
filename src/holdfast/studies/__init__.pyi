from holdfast.studies.study_file import StudyFile as StudyFile
from holdfast.studies.study_file import read as read
