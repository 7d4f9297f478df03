"""Results and files by their hashes: written once, whole or not at all."""

from __future__ import annotations

import contextlib
import filecmp
import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any


def sha256(data: bytes) -> str:
    """The hash as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


@contextlib.contextmanager
def writing(path: Path) -> Iterator[Path]:
    """A new file next to the place, put there at the end; what is there already stays where it is the same."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".new-")
    os.close(handle)
    new = Path(name)
    try:
        yield new
        if path.exists() and filecmp.cmp(new, path, shallow=False):
            return
        with new.open("rb+") as file:
            os.fsync(file.fileno())
        new.chmod(0o644)
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def write_whole(path: Path, data: bytes) -> None:
    """Writes next to the place, then puts it there."""
    with writing(path) as new:
        new.write_bytes(data)


class Store:
    """A folder of results and files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._blobs = os.fspath(folder / "blobs")

    def place(self, key: str) -> Path:
        """Where a unit's result is."""
        return self.folder / "results" / key[:2] / f"{key}.json"

    def blob_place(self, digest: str) -> Path:
        """Where a file is."""
        return Path(self._blobs, digest[:2], digest)

    def result(self, key: str) -> dict[str, Any] | None:
        """A unit's result; `None` where there is none, or one that is damaged, or whose files are."""
        try:
            head, body = self.place(key).read_bytes().split(b"\n", 1)
        except (FileNotFoundError, ValueError):
            return None
        if head.decode("ascii", "replace") != sha256(body):
            return None
        found: dict[str, Any] = json.loads(body)
        files = found["files"].values()
        with contextlib.suppress(FileNotFoundError):
            if all(os.stat(f"{self._blobs}/{digest[:2]}/{digest}").st_size == size for digest, size in files):
                return found
        return None

    def has(self, key: str) -> bool:
        """Whether there is a unit's result."""
        return self.result(key) is not None

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
            self.blob_place(digest).unlink(missing_ok=True)
            raise OSError(f"{self.blob_place(digest)} was damaged, and is removed: run again, and it is made anew")
        return data

    def sweep(self) -> None:
        """Removes what workers that died were writing. Nobody may be at work."""
        for folder, folders, files in os.walk(self.folder):
            for name in (name for name in [*folders, *files] if name.startswith(".new-")):
                left = Path(folder, name)
                shutil.rmtree(left) if left.is_dir() else left.unlink(missing_ok=True)
            folders[:] = [name for name in folders if not name.startswith(".new-")]
