"""Tables for spreadsheets: the numbers are those of pandas, and nothing is a formula."""

import csv
import io

import numpy as np
import pandas as pd
import pytest

from holdfast.core.files.output import write_table
from holdfast.core.files.spreadsheet import escape_formula, unescape_formula, write_csv_text


@pytest.mark.parametrize("text", ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "-", "="])
def test_what_would_be_computed_is_text(text):
    assert escape_formula(text) == f"'{text}"
    first = pd.read_csv(io.StringIO(write_csv_text(pd.DataFrame({text: [text], "x": [1.5]}))))
    assert (first.columns[0], first.iloc[0, 0]) == (f"'{text}", f"'{text}")


@pytest.mark.parametrize("value", ["", "S01", "a=b", "-1.5", "+3", "-inf", -2.5, 3, None, "{}"])
def test_everything_else_stays(value):
    assert escape_formula(value) == value


@pytest.mark.parametrize("missing", ["", "NA"])
def test_tables_are_those_of_pandas(rng, missing):
    values = np.concatenate([rng.normal(size=200), 10.0 ** rng.uniform(-300, 300, 50), [0.0, -0.0, np.nan, 1e16, 5e-324]])
    numbers = pd.DataFrame({"trial": np.arange(len(values)), "x, m": values, "y": values[::-1]})
    for table in (numbers, numbers.assign(law="pseudoinverse"), numbers.head(0)):
        assert write_csv_text(table, missing) == table.to_csv(index=False, na_rep=missing, lineterminator="\n")


def test_names_in_the_head_of_a_table_are_cells(tmp_path):
    """Commas, quotes, and formulas in names leave the number of columns as it is, by the csv module."""
    names = ["time_s", 'a,b"c_rad', "=1+1_rad", "-x_m"]
    file = write_table(tmp_path / "t.csv", "motion", names, np.arange(8.0).reshape(2, 4))
    head, *rows = csv.reader(file.read_text(encoding="utf-8").splitlines())
    assert head == ["time_s", 'a,b"c_rad', "'=1+1_rad", "'-x_m"]
    assert [unescape_formula(text) for text in head] == names
    assert rows == [["0", "1", "2", "3"], ["4", "5", "6", "7"]]
