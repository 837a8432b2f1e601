from holdfast.studies import assessment as assessment
from holdfast.studies import designs as designs
from holdfast.studies import study_files as study_files
from holdfast.studies.study_files import *
