"""Numbers and text of records and their checks, and of arms made from null spaces."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.printing import TextTable
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.model.arms.dh_rows import dh_table
from holdfast.studies.designs.arm_comparison.orders import JointOrders
from holdfast.studies.designs.record_book.entries import DesignRecord, RecordBook, RecordCheck
from holdfast.studies.designs.synthesis.arms import Synthesis

BookResult = RecordBook | DesignRecord | RecordCheck | Synthesis | JointOrders

_MAX_ORDERS = 10  # orders in a table
_RECORD_HEADER = ["record", "task", "joints", "locked", "value", "no arm can beat", "by", "gap"]


def format_record_row(record: DesignRecord) -> list[str]:
    """Format a record as a row of a table."""
    kind, bound = record.data.kind, record.data.proven_bound
    task_text, gap_text = kind.task or f"any of {kind.rows} rows", "0" if record.gap < 1e-8 else format_percent(record.gap)
    return [record.id, task_text, f"{kind.joints}", f"{kind.failures}", record.amount, f"{bound.value:.7g}", bound.by, gap_text]


def to_dict(result: BookResult) -> dict[str, Any]:
    """Return the content of the file, the claims of a check, or the tables of a synthesis, as JSON data."""
    if isinstance(result, RecordBook):
        return {"records": [to_dict(record) for record in result.values()]}
    if isinstance(result, DesignRecord):
        return result.data.model_dump(by_alias=True, exclude_none=True)
    if isinstance(result, RecordCheck):
        return {
            "record": result.record.id,
            "ok": result.ok,
            "claims": [{"said": claim, "holds": holds} for claim, holds in result.claims],
        }
    if isinstance(result, JointOrders):
        numbers = {
            "samples": result.samples,
            "seed": result.seed,
            "at_home": result.at_home,
            "thresholds": list(result.thresholds),
        }
        return (
            numbers
            | {"orders": result.orders.tolist(), "fractions": result.fractions.tolist(), "mean": result.mean.tolist()}
            | {
                "lengths": result.lengths.tolist(),
                "front": result.front.tolist(),
                "fresh": result.fresh.tolist(),
            }
        )
    arm_tables = [format_dh_file(dh_table(arm), arm.name) for arm in result.arms]
    numbers = {"task": result.task, "failures": result.failures, "value": result.value, "bound": result.bound}
    return numbers | {"residual": result.residual, "losses": result.losses, "tables": arm_tables}


def tables(result: BookResult) -> list[TextTable]:
    """Return a row for each record, order or arm."""
    if isinstance(result, RecordBook):
        return [TextTable(_RECORD_HEADER, [format_record_row(item) for item in result.values()])]
    if isinstance(result, JointOrders):
        best_orders = result.mean.argsort()[::-1][:_MAX_ORDERS]
        header = ["order", *(f"at least {threshold:g}" for threshold in result.thresholds), "mean"]
        order_cells = [
            [
                " ".join(str(index + 1) for index in result.orders[order_index]),
                *map(format_percent, result.fractions[order_index]),
            ]
            for order_index in best_orders
        ]
        return [
            TextTable(
                header,
                [
                    [*cells, f"{result.mean[order_index]:.4f}"]
                    for order_index, cells in zip(best_orders, order_cells, strict=True)
                ],
                "best means",
            )
        ]
    if isinstance(result, Synthesis):
        table_rows = []
        for index, (arm, loss) in enumerate(zip(result.arms, result.losses, strict=True), 1):
            table = dh_table(arm).rows
            condition = np.linalg.cond(arm.jacobian(np.zeros(arm.n)))
            lengths = sum(abs(item.a) + abs(item.d) for item in table[:-1])
            table_rows.append([f"{index}", f"{result.value - loss:.6g}", f"{loss:.1e}", f"{condition:.3g}", f"{lengths:.3f}"])
        return [TextTable(["arm", "value", "lost by rounding", "condition", "sum of |a| and |d|, m"], table_rows)]
    return []


def key_table(result: BookResult) -> TextTable:
    """Return a row for each record, order, arm or claim, for notebooks."""
    if isinstance(result, DesignRecord):
        return TextTable(_RECORD_HEADER, [format_record_row(result)])
    if isinstance(result, RecordCheck):
        return TextTable(["claim", "holds"], [[claim, "yes" if holds else "no"] for claim, holds in result.claims])
    return tables(result)[0]


def next_steps(result: BookResult, name: str) -> list[str]:
    """Suggest a use of the result."""
    if isinstance(result, RecordBook):
        return [f'{name}["pose-9R-k2-001"].check()  # measures it again']
    if isinstance(result, DesignRecord):
        return [f"{name}.check()  # measures it again"]
    if isinstance(result, RecordCheck):
        return [f"{name}.ok  # every claim holds"]
    if isinstance(result, JointOrders):
        return [f"{name}.interval({int(result.mean.argmax())}, 0)  # of the order with the best mean, at the first threshold"]
    return [f"hf.arms.dh_table({name}.arms[0])  # to build it"]
