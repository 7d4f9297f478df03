"""The fleet on one page without a script: the robots that need somebody first."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import Any

# the worst first
ORDER = ("none", "crashed", "error", "refused", "changed", "done")
# robots on the page
MOST = 1000
_COLUMNS = ("status", "max_path_error_mm", "collisions", "max_shift_mm", "verdict", "effect", "held_out_before_mm", "error_mm", "changed_since",
            "changed_before_mm", "changed_after_mm", "message")  # fmt: skip
_STYLE = (
    ":root{color-scheme:light dark;--ink:#222;--ground:#fff;--rule:#ddd;--link:#0b62a8;--bad:#a00;--no:#a04000;--good:#060}"
    "@media(prefers-color-scheme:dark){"
    ":root{--ink:#e7ebf0;--ground:#14181e;--rule:#38424e;--link:#6cb6f5;--bad:#ff8a80;--no:#f0c05a;--good:#3fd0b4}}"
    "body{font:15px system-ui;margin:2em auto;padding:0 1em;max-width:90em;color:var(--ink);background:var(--ground)}"
    "table{border-collapse:collapse}.rows{overflow-x:auto}a{color:var(--link)}"
    "td,th{padding:.25em .7em;text-align:left;border-bottom:1px solid var(--rule)}"
    "td{overflow-wrap:break-word;max-width:40ch}td.number{text-align:right;font-variant-numeric:tabular-nums}"
    ".none,.crashed,.error{color:var(--bad)}.refused,.changed{color:var(--no)}.done{color:var(--good)}"
)


class Page:
    """Takes the rows of robots one after another, and keeps those that need somebody most."""

    def __init__(self) -> None:
        self._lines: list[tuple[tuple[Any, ...], str]] = []
        self._robots = 0

    def add(self, row: Mapping[str, Any], pages: Sequence[str]) -> None:
        """A robot's row and the names of its pages."""
        self._robots += 1
        held, path = row.get("held_out_before_mm") or 0.0, row.get("max_path_error_mm") or 0.0
        need = ORDER.index(row["status"]), -(row.get("collisions") or 0), -held, -path, row["robot_id"]
        robot = html.escape(row["robot_id"])
        links = " ".join(f'<a href="pages/{robot}/{html.escape(n)}">{html.escape(n.removesuffix(".html"))}</a>' for n in sorted(pages))
        cells = "".join(_cell(name, row.get(name)) for name in _COLUMNS)
        self._lines.append((need, f'<tr><th scope="row">{robot}</th>{cells}<td>{links}</td></tr>'))
        if len(self._lines) >= 2 * MOST:
            self._cut()

    def _cut(self) -> None:
        self._lines.sort()
        del self._lines[MOST:]

    def text(self, by_status: Mapping[str, int], run_id: str) -> str:
        """The page."""
        self._cut()
        counts = ", ".join(f"{count} {status}" for status, count in by_status.items() if count)
        left_out = self._robots - len(self._lines)
        more = f"<p>{left_out} more, which need somebody less, are in the table robots.</p>" if left_out else ""
        heads = "".join(f'<th scope="col">{name}</th>' for name in (n.replace("_", " ") for n in ("robot", *_COLUMNS, "pages")))
        return (
            '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Fleet</title>'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">"
            f"<style>{_STYLE}</style></head><body><main><h1>{self._robots} robots</h1><p>{counts}; run {run_id}</p>{more}"
            '<div class="rows" tabindex="0" role="region" aria-label="Robots">'
            f"<table><thead><tr>{heads}</tr></thead><tbody>\n"
            + "\n".join(line for _, line in self._lines)
            + "\n</tbody></table></div></main></body></html>\n"
        )


def _cell(name: str, value: Any) -> str:
    if isinstance(value, int | float):
        return f'<td class="number">{value:.3f}</td>' if isinstance(value, float) else f'<td class="number">{value}</td>'
    text = html.escape("" if value is None else str(value))
    return f'<td class="{text}">{text}</td>' if name == "status" else f"<td>{text}</td>"
