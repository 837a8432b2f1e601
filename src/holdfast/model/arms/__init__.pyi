from holdfast.model.arms.builtin import Builtin as Builtin
from holdfast.model.arms.builtin import about as about
from holdfast.model.arms.builtin import names as names
from holdfast.model.arms.dh_rows import DHTable as DHTable
from holdfast.model.arms.dh_rows import dh_table as dh_table
from holdfast.model.arms.loading import command_words as command_words
from holdfast.model.arms.loading import load as load
