"""Results and files by their hashes: written once, whole or not at all."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import shutil
import tempfile
import time
from pathlib import Path
from typing import Any

# a file changed within this time of its reading may change again within the resolution of its clock, seconds
YOUNG_S = 2.0


def sha256(data: bytes) -> str:
    """The hash as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def write_whole(path: Path, data: bytes) -> None:
    """Writes next to the place, then puts it there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".new-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name)
        raise


class Store:
    """A folder of results and files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def place(self, key: str) -> Path:
        """Where a unit's result is."""
        return self.folder / "results" / key[:2] / f"{key}.json"

    def blob_place(self, digest: str) -> Path:
        """Where a file is."""
        return self.folder / "blobs" / digest[:2] / digest

    def result(self, key: str) -> dict[str, Any] | None:
        """A unit's result; `None` where there is none, or one that is damaged, or whose files are."""
        try:
            head, body = self.place(key).read_bytes().split(b"\n", 1)
        except (FileNotFoundError, ValueError):
            return None
        if head.decode("ascii", "replace") != sha256(body):
            return None
        found: dict[str, Any] = json.loads(body)
        sizes = ((self.blob_place(digest), size) for digest, size in found["files"].values())
        with contextlib.suppress(FileNotFoundError):
            if all(place.stat().st_size == size for place, size in sizes):
                return found
        return None

    def keep(self, key: str, found: dict[str, Any]) -> None:
        """Keeps a unit's result, the hash of its text in the first line."""
        body = json.dumps(found, sort_keys=True, ensure_ascii=False, separators=(",", ":")).encode()
        write_whole(self.place(key), sha256(body).encode() + b"\n" + body)

    def keep_blob(self, data: bytes) -> tuple[str, int]:
        """Keeps a file; its hash and size."""
        digest = sha256(data)
        write_whole(self.blob_place(digest), data)
        return digest, len(data)

    def blob(self, digest: str) -> bytes:
        """A file, as it was kept."""
        data = self.blob_place(digest).read_bytes()
        if sha256(data) != digest:
            raise OSError(f"{self.blob_place(digest)} is damaged: remove it, and run again")
        return data

    def sweep(self) -> None:
        """Removes what workers that died were writing. Nobody may be at work."""
        for top in ("results", "blobs", "tables", "out", "pages", "."):
            pattern = ".new-*" if top == "." else "**/.new-*"
            for left in (self.folder / top).glob(pattern):
                shutil.rmtree(left) if left.is_dir() else left.unlink(missing_ok=True)

    def notes(self, name: str) -> dict[str, Any]:
        """What a run notes for the next: it saves time, and nothing depends on it."""
        with contextlib.suppress(OSError, ValueError):
            read = json.loads((self.folder / f"{name}.json").read_text(encoding="utf-8"))
            if isinstance(read, dict):
                return read
        return {}

    def note(self, name: str, notes: dict[str, Any]) -> None:
        """Notes for the next run."""
        write_whole(self.folder / f"{name}.json", json.dumps(notes, sort_keys=True).encode())


class Hashes:
    """Hashes of input files; one whose size and time are as they were is not read again."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._known = store.notes("index")
        self._seen: dict[str, list[Any]] = {}

    def of(self, path: Path) -> str:
        """The hash of a file."""
        state = path.stat()
        name = str(path.absolute())
        mark = [state.st_size, state.st_mtime_ns, state.st_ino]
        known = self._known.get(name) or self._seen.get(name)
        if known is None or known[:3] != mark:
            known = [*mark, sha256(path.read_bytes())]
        if time.time() - state.st_mtime > YOUNG_S:
            self._seen[name] = known
        return str(known[3])

    def keep(self) -> None:
        """Keeps the hashes of the files of this run."""
        if self._seen != self._known:
            self._store.note("index", self._seen)
