from holdfast.arms.builtin import Builtin as Builtin
from holdfast.arms.builtin import about as about
from holdfast.arms.builtin import load as load
from holdfast.arms.builtin import names as names
from holdfast.arms.catalogue import command_words as command_words
from holdfast.arms.catalogue import resolve as resolve
from holdfast.arms.dh_rows import DHTable as DHTable
from holdfast.arms.dh_rows import dh_table as dh_table
