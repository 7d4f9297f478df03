"""Columns by name, which every library of tables reads."""

from __future__ import annotations

import html
import importlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import polars
    from numpy.typing import NDArray

__all__ = ["Table"]

_SHOWN = 20


class Table(Mapping[str, Sequence[Any]]):
    """Columns of equal length. polars, pandas, DuckDB and pyarrow read it as it is, through Arrow."""

    def __init__(self, columns: Mapping[str, Sequence[Any]]) -> None:
        self._columns = {name: list(column) for name, column in columns.items()}
        lengths = {len(column) for column in self._columns.values()}
        if len(lengths) > 1:
            raise ValueError(f"columns have different lengths: {sorted(lengths)}")
        self._rows = lengths.pop() if lengths else 0

    @classmethod
    def of_rows(cls, rows: Iterable[Mapping[str, Any]], names: Sequence[str] = ()) -> Table:
        """Of rows; columns in the order in which they first occur, what a row lacks is `None`."""
        rows = list(rows)
        columns = dict.fromkeys(names) | {name: None for row in rows for name in row}
        return cls({name: [row.get(name) for row in rows] for name in columns})

    def __getitem__(self, name: str) -> Sequence[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """How many columns; `rows` is how many rows."""
        return len(self._columns)

    @property
    def rows(self) -> int:
        """How many rows."""
        return self._rows

    def iter_rows(self) -> Iterator[dict[str, Any]]:
        """Each row by the names of its columns."""
        for index in range(self._rows):
            yield {name: column[index] for name, column in self._columns.items()}

    def column(self, name: str) -> NDArray[Any]:
        """A column as an array: missing numbers are nan."""
        values = self._columns[name]
        if any(isinstance(value, str | list | dict) for value in values):
            return np.array(values, dtype=object)
        if any(value is None for value in values):
            return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
        return np.asarray(values)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        columns = [self.column(name) for name in self._columns]
        if not columns:
            return np.empty((self._rows, 0), dtype=dtype)
        return np.asarray(np.column_stack(columns), dtype=dtype)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_arrow(self) -> Any:
        """As `pyarrow.Table`."""
        return _library("pyarrow").table(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """As `pandas.DataFrame`."""
        return _library("pandas").DataFrame(self._columns)

    def to_polars(self) -> polars.DataFrame:
        """As `polars.DataFrame`."""
        return _library("polars").DataFrame(self._columns)

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{html.escape(name)}</th>" for name in self._columns)
        lines: list[str] = []
        for row in self.iter_rows():
            if len(lines) == _SHOWN:
                break
            lines.append("<tr>" + "".join(f"<td>{_shown(value)}</td>" for value in row.values()) + "</tr>")
        more = f"<p>{_SHOWN} of {self._rows} rows</p>" if self._rows > _SHOWN else ""
        return f"<table><thead><tr>{heads}</tr></thead><tbody>{''.join(lines)}</tbody></table>{more}"

    def __repr__(self) -> str:
        return f"<Table {self._rows} rows: {', '.join(self._columns)}>"


def _shown(value: object) -> str:
    if value is None:
        return ""
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def _library(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"this needs {name}: pip install {name}") from error
