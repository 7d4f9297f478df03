"""Findings of `poseshift check --json` as annotations of the lines of a pull request."""

import json
import sys
from pathlib import Path

LEVELS = {"error": "error", "warning": "warning", "note": "notice"}


def escaped(text: str, *, inside: bool) -> str:
    """A text as a workflow command has it; `inside` a property."""
    for sign, code in (("%", "%25"), ("\r", "%0D"), ("\n", "%0A")):
        text = text.replace(sign, code)
    if inside:
        text = text.replace(":", "%3A").replace(",", "%2C")
    return text


def annotation(finding: dict) -> str:
    """One finding as a workflow command."""
    message = finding["message"] + (f"\n{finding['hint']}" if finding.get("hint") else "")
    place = {"file": finding["file"], "line": finding["line"] or 1, "title": finding["id"]}
    words = ",".join(f"{key}={escaped(str(value), inside=True)}" for key, value in place.items())
    return f"::{LEVELS[finding['severity']]} {words}::{escaped(message, inside=False)}"


if __name__ == "__main__":
    for one in json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))["findings"]:
        print(annotation(one))
