"""What the tables say of one unit: made where the unit is made, so that whoever collects reads little."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from poseshift.fleet.units import Unit


def rows_of(unit: Unit, status: str, documents: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of the robot, and rows of the other tables, without the robot's name."""
    found = [finding | {"job": unit.job} for document in documents.values() for finding in document["findings"]]
    return {
        "robot": _robot(unit, documents),
        "programs": _programs(unit, status, documents) if unit.job == "programs" else [],
        "findings": found,
        "effects": [_effect(effect) for effect in documents.get("diagnosis", {}).get("effects", [])],
        "message": _message(status, documents, found),
    }


def _robot(unit: Unit, documents: Mapping[str, Any]) -> dict[str, Any]:
    row: dict[str, Any] = {}
    if unit.job == "programs":
        row["programs"] = len(unit.named("program"))
    if "compensation" in documents:
        s = documents["compensation"]["summary"]
        row |= {key: s[key] for key in ("targets", "compensated", "mean_shift_mm", "max_shift_mm")}
    if "check" in documents:
        s = documents["check"]["summary"]
        row |= {key: s[key] for key in ("max_path_error_mm", "collisions")}
    if unit.job == "since":
        row["changed_effect"] = _found(documents)
    elif "diagnosis" in documents:
        d = documents["diagnosis"]
        row |= {"verdict": d["verdict"], "noise_mm": d["noise_mm"], "effect": _found(documents)}
        for key in ("before", "after"):
            row[f"held_out_{key}_mm"] = (d["held_out"][key] or {}).get("rms_mm")
    return row


def _found(documents: Mapping[str, Any]) -> str:
    """The effects of a diagnosis."""
    return ", ".join(_label(effect) for effect in documents.get("diagnosis", {"effects": []})["effects"])


def _label(effect: Mapping[str, Any]) -> str:
    place = (f"{key} {effect[key]}" for key in ("joint", "link", "on", "order", "row", "tool") if key in effect)
    return " ".join([str(effect["effect"]), *place])


def _effect(effect: Mapping[str, Any]) -> dict[str, Any]:
    errors = {f"{key}_mm": (effect[key] or {}).get("rms_mm") for key in ("before", "after")}
    return {"effect": _label(effect), "sentence": effect["sentence"], "p_value": effect["evidence"]["p_value"]} | errors


def _message(status: str, documents: Mapping[str, Any], found: list[dict[str, Any]]) -> str:
    if status == "changed":
        return f"its error has changed: {_found(documents) or 'no effect is found in the rows since'}"
    errors = [finding for finding in found if finding["severity"] == "error"]
    return str(errors[0]["message"]) if errors and status == "refused" else ""


def _programs(unit: Unit, status: str, documents: Mapping[str, Any]) -> list[dict[str, Any]]:
    targets, moves = documents.get("compensation", {}).get("targets", []), documents.get("check", {}).get("moves", [])
    rows = []
    for program in unit.named("program"):
        mine = [target for target in targets if target["file"] == program]
        before = [target["before_mm"] for target in mine if target["before_mm"] is not None]
        driven = [move["max_path_error_mm"] for move in moves if move["file"] == program]
        rows.append({
            "program": program,
            "status": status,
            "targets": len(mine),
            "mean_before_mm": sum(before) / len(before) if before else None,
            "max_shift_mm": max((t["shift_mm"] for t in mine), default=None),
            "max_path_error_mm": max((error for error in driven if error is not None), default=None),
        })  # fmt: skip
    return rows
