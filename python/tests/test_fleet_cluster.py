"""A cluster of three nodes on this machine: workers, a node and the driver are killed, and the tables are those of a quiet run."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from test_fleet import fleet_of, run, shipped, tables

import poseshift as ps

pytestmark = pytest.mark.filterwarnings("ignore")
ray = pytest.importorskip("ray")

ROBOTS = 16
PATIENCE_S = 600.0


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """A head that computes nothing and two nodes of one processor, with a place for poison."""
    from ray.cluster_utils import Cluster

    (tmp_path / "poison").mkdir()
    monkeypatch.setenv("POISON", str(tmp_path / "poison"))
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent / "poison"))
    monkeypatch.setenv("RAY_DISABLE_IMPORT_WARNING", "1")
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False})
    try:
        yield cluster
    finally:
        cluster.shutdown()


def until(what: Callable[[], bool], driver: subprocess.Popen[bytes]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not what():
        assert driver.poll() is None, f"the driver ended with {driver.returncode}"
        assert time.monotonic() < end, "nothing came of it"
        time.sleep(0.05)


def test_what_dies_changes_no_byte(cluster: Any, root: Path, profile: ps.Profile, tmp_path: Path) -> None:
    backups = fleet_of(ROBOTS, tmp_path, shipped(root, profile))
    # this robot ends every worker that touches it, quiet run or not
    (tmp_path / "poison" / "r7").touch()
    status, quiet = run(backups, store="quiet")
    assert status == 2
    wanted = tables(quiet)

    nodes = [cluster.add_node(num_cpus=1) for _ in range(2)]
    cluster.wait_for_nodes()
    (tmp_path / "poison" / "r5.once").touch()
    store = tmp_path / "disturbed"
    words = ["run", str(backups / "fleet.yaml"), "--store", str(store), "--date", "2026-01-31"]
    command = [sys.executable, "-m", "poseshift.fleet", *words, "--executor", "ray", "--address", cluster.address]

    def driver() -> subprocess.Popen[bytes]:
        return subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def results() -> int:
        return len(list(store.glob("results/*/*.json")))

    first = driver()
    try:
        until(lambda: results() >= ROBOTS * 2 // 4, first)
        cluster.remove_node(nodes[0], allow_graceful=False)
        until(lambda: results() >= ROBOTS, first)
    finally:
        first.send_signal(signal.SIGKILL)
        first.wait()
    made = {path: path.stat().st_mtime_ns for path in store.glob("results/*/*.json")}
    assert ROBOTS <= len(made) < 2 * ROBOTS
    second = driver()
    try:
        assert second.wait(PATIENCE_S) == 2
    finally:
        second.kill()
    assert tables(store) == wanted
    # what the first driver had is not made again
    assert {path: path.stat().st_mtime_ns for path in made} == made
    assert not (tmp_path / "poison" / "r5.once").exists()
    assert not list(store.rglob(".new-*"))
    assert os.path.isdir(store / "out" / "r5")
