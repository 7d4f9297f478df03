"""What a run notes for the next: it saves time, and nothing depends on it."""

from __future__ import annotations

import contextlib
import json
import os
import sqlite3
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from poseshift.fleet.store import Store, sha256

# a file changed within this time of its reading may change again within the resolution of its clock, seconds
YOUNG_S = 2.0
# files that several robots have are hashed once: so many are remembered
SHARED = 4096
_TABLE = "CREATE TABLE IF NOT EXISTS notes (robot TEXT, kind TEXT, value TEXT, PRIMARY KEY (robot, kind)) WITHOUT ROWID"


class Notes:
    """Notes of robots by kind, in a file of the store. One that is damaged begins anew."""

    def __init__(self, store: Store) -> None:
        self._path = store.folder / "notes.db"
        self._open: sqlite3.Connection | None = None

    def __enter__(self) -> Notes:
        return self

    def __exit__(self, *_: object) -> None:
        if self._open is not None:
            self._open.commit()
            self._open.close()
            self._open = None

    def _notes(self) -> sqlite3.Connection:
        if self._open is None:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            try:
                self._open = self._begun()
            except sqlite3.OperationalError:
                raise
            except sqlite3.DatabaseError:
                self._path.unlink()
                self._open = self._begun()
        return self._open

    def _begun(self) -> sqlite3.Connection:
        opened = sqlite3.connect(self._path)
        try:
            opened.execute(_TABLE)
            opened.execute("SELECT * FROM notes LIMIT 1").fetchall()
        except sqlite3.DatabaseError:
            opened.close()
            raise
        return opened

    def of(self, robot: str, kind: str) -> Any:
        """A note; `None` where there is none. Nothing is written where there are no notes yet."""
        if self._open is None and not self._path.exists():
            return None
        row = self._notes().execute("SELECT value FROM notes WHERE robot = ? AND kind = ?", (robot, kind)).fetchone()
        return None if row is None else json.loads(row[0])

    def put(self, robot: str, kind: str, value: Any) -> None:
        """Notes a value."""
        text = json.dumps(value, sort_keys=True, separators=(",", ":"))
        self._notes().execute("INSERT OR REPLACE INTO notes VALUES (?, ?, ?)", (robot, kind, text))

    def drop(self, robot: str, kind: str) -> None:
        """Forgets a note."""
        self._notes().execute("DELETE FROM notes WHERE robot = ? AND kind = ?", (robot, kind))

    def keep(self) -> None:
        """What is noted stays, whatever ends this process."""
        self._notes().commit()

    def forget_between(self, after: str, up_to: str | None, robots: Sequence[str]) -> None:
        """Forgets robots behind one name and up to another that are none of these."""
        there = self._notes().execute(
            "SELECT DISTINCT robot FROM notes WHERE robot > ?1 AND (?2 IS NULL OR robot <= ?2)", (after, up_to)
        )
        for (robot,) in set(there) - {(robot,) for robot in robots}:
            self._notes().execute("DELETE FROM notes WHERE robot = ?", (robot,))


class Hashes:
    """Hashes of input files; one whose size and time are as they were is not read again."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes
        self._shared: dict[str, list[Any]] = {}

    def of(self, robot: str, paths: Sequence[Path]) -> tuple[list[str], dict[str, Any] | None]:
        """The hashes of a robot's files, and what is to be noted of them where that is new."""
        known: dict[str, list[Any]] = self._notes.of(robot, "files") or {}
        found, hashes = {}, []
        for path in paths:
            name = os.path.abspath(path)
            state = os.stat(path)
            mark = [state.st_size, state.st_mtime_ns, state.st_ino]
            seen = known.get(name) or self._shared.get(name)
            if seen is None or seen[:3] != mark:
                seen = [*mark, sha256(path.read_bytes())]
            if time.time() - state.st_mtime > YOUNG_S:
                found[name] = seen
            hashes.append(str(seen[3]))
        if len(self._shared) > SHARED:
            self._shared.clear()
        self._shared |= found
        return hashes, None if found == known else found
