"""A fleet of a few robots: what is made, what is kept, what is refused."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poseshift as ps

pyarrow = pytest.importorskip("pyarrow")
pytest.importorskip("yaml")

from poseshift.fleet import Store, plan, read  # noqa: E402
from poseshift.fleet.__main__ import main  # noqa: E402

ROBOTS = 4
Backups = Callable[..., Path]


@pytest.fixture(scope="module")
def sources(root: Path, profile: ps.Profile) -> dict[str, bytes]:
    return shipped(root, profile)


def shipped(root: Path, profile: ps.Profile) -> dict[str, bytes]:
    """The files of a robot."""
    rng = np.random.default_rng(2)
    q = rng.uniform([-2, -1, -1, -2, 0.2, -3], [2, 1, 0.8, 2, 1.8, 3], (40, 6))
    return {
        "profile.yaml": (root / "robots/abb_irb120_thesis.yaml").read_bytes(),
        "Deburr.mod": (root / "programs/rapid/olp/in/Deburr.mod").read_bytes(),
        "measured.csv": ps.simulate(profile, q, noise_m=2e-5).to_csv(),
    }


@pytest.fixture
def backups(tmp_path: Path, sources: dict[str, bytes]) -> Path:
    return fleet_of(ROBOTS, tmp_path, sources)


def fleet_of(count: int, tmp_path: Path, sources: dict[str, bytes]) -> Path:
    """Robots whose files differ, and the file that names them."""
    for number in range(count):
        folder = tmp_path / "backups" / f"r{number}"
        folder.mkdir(parents=True)
        for name, data in sources.items():
            comment = f"# robot {number}\n".encode() if name != "Deburr.mod" else b""
            (folder / name).write_bytes(comment + data)
        (folder / "Deburr.mod").write_bytes(sources["Deburr.mod"].replace(b"! ...", f"! {number}".encode(), 1))
    (tmp_path / "backups" / "fleet.yaml").write_text(
        "poseshift: fleet/1\n"
        "defaults: {diagnose: {quick: true}}\n"
        "robots:\n"
        "  - {folders: r*, profile: profile.yaml, programs: '*.mod', measurements: measured.csv}\n"
    )
    return tmp_path / "backups"


def run(backups: Path, *words: str, fleet: str = "fleet.yaml", store: str = "store") -> tuple[int, Path]:
    folder = backups.parent / store
    status = main(["run", str(backups / fleet), "--store", str(folder), "--workers", "2", "--date", "2026-01-31", *words])
    return status, folder


def tables(store: Path) -> dict[str, bytes]:
    """Every byte that a fleet shows, without its caches."""
    tops = ("tables", "out", "pages", "fleet.html", "junit.xml")
    files = [p for top in tops for p in [store / top, *(store / top).rglob("*")] if p.is_file()]
    return {p.relative_to(store).as_posix(): p.read_bytes() for p in files}


def made(capsys: pytest.CaptureFixture[str]) -> int:
    found = re.search(r"(\d+) of \d+ units made", capsys.readouterr().out)
    assert found is not None
    return int(found[1])


def test_a_night_is_kept_and_only_what_changed_is_made(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {p: p.read_bytes() for p in backups.rglob("*") if p.is_file()}
    status, store = run(backups)
    assert (status, made(capsys)) == (0, 2 * ROBOTS)
    first = tables(store)
    robots = _robots(store)
    assert [row["robot_id"] for row in robots] == [f"r{k}" for k in range(ROBOTS)]
    assert all(row["status"] == "done" and row["targets"] > 0 and row["verdict"] for row in robots)
    assert first["out/r0/Deburr.mod"] != before[backups / "r0/Deburr.mod"]
    # again: nothing is made, no byte changes
    assert (run(backups)[0], made(capsys)) == (0, 0)
    assert tables(store) == first
    # a changed byte of one program: that robot's programs, nothing else
    program = backups / "r2/Deburr.mod"
    program.write_bytes(program.read_bytes().replace(b"! 2", b"! x", 1))
    assert (run(backups)[0], made(capsys)) == (0, 1)
    later = tables(store)
    assert {name for name in later if name.startswith("out/") and later[name] != first[name]} == {"out/r2/Deburr.mod"}
    # a changed profile: both jobs of that robot
    path = backups / "r1/profile.yaml"
    path.write_bytes(b"# another remark\n" + path.read_bytes())
    assert (run(backups)[0], made(capsys)) == (0, 2)
    # nothing is written among the backups
    del before[program], before[path]
    assert {p: p.read_bytes() for p in before} == before
    assert len([p for p in backups.rglob("*") if p.is_file()]) == len(before) + 2


def _robots(store: Path) -> list[dict[str, Any]]:
    from pyarrow import parquet

    rows: list[dict[str, Any]] = parquet.read_table(store / "tables/robots.parquet").to_pylist()
    return rows


def test_options_count_and_defaults_do_not(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(backups)
    made(capsys)
    text = (backups / "fleet.yaml").read_text()
    (backups / "fleet.yaml").write_text(text.replace("{diagnose: {quick: true}}", "{diagnose: {quick: true}, compensate: {joint_targets: keep}}"))
    assert (run(backups)[0], made(capsys)) == (0, 0)
    (backups / "fleet.yaml").write_text(text.replace("{diagnose: {quick: true}}", "{diagnose: {quick: true}, compensate: {decimals: 5}}"))
    assert (run(backups)[0], made(capsys)) == (0, ROBOTS)


def test_damaged_results_are_made_again(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, store = run(backups)
    made(capsys)
    first = tables(store)
    results = sorted((store / "results").rglob("*.json"))
    assert len(results) == 2 * ROBOTS
    results[0].write_bytes(results[0].read_bytes()[:100])
    results[1].write_bytes(b"not what it was\n" + results[1].read_bytes())
    data = bytearray(results[2].read_bytes())
    data[len(data) // 2] ^= 1
    results[2].write_bytes(data)
    results[3].unlink()
    assert (run(backups)[0], made(capsys)) == (0, 4)
    assert tables(store) == first
    assert not list(store.rglob(".new-*"))


def test_the_order_of_robots_changes_no_byte(backups: Path) -> None:
    entry = "  - {{id: r{0}, profile: r{0}/profile.yaml, programs: r{0}/*.mod, measurements: r{0}/measured.csv}}\n"
    top = "poseshift: fleet/1\ndefaults: {diagnose: {quick: true}}\nrobots:\n"
    for name, order in (("up.yaml", range(ROBOTS)), ("down.yaml", reversed(range(ROBOTS)))):
        (backups / name).write_text(top + "".join(entry.format(k) for k in order))
    up, down = (tables(run(backups, fleet=f"{name}.yaml", store=name)[1]) for name in ("up", "down"))
    assert "out/r0/r0/Deburr.mod" in up
    assert up == down


def test_refused_and_failing_robots_do_not_stop_the_others(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, store = run(backups)
    assert status == 0
    far = backups / "r1/Deburr.mod"
    far.write_bytes(re.sub(rb"(Move[LJ] \[\[)[-\d.]+", rb"\g<1>99999", far.read_bytes(), count=1))
    status, _ = run(backups)
    assert status == 1
    by_robot = {row["robot_id"]: row for row in _robots(store)}
    assert by_robot["r1"]["status"] == "refused"
    assert by_robot["r1"]["message"]
    assert by_robot["r0"]["status"] == "done"
    # what was written when it was not refused is gone, and its page says why
    assert not (store / "out/r1/Deburr.mod").exists()
    assert (store / "pages/r1/compensation.html").is_file()
    page = (store / "fleet.html").read_text()
    assert page.index(">r1<") < page.index(">r0<")
    (backups / "r3/profile.yaml").write_text("poseshift: profile/1\nrobot: nonsense\n")
    capsys.readouterr()
    status, _ = run(backups)
    assert status == 2
    by_robot = {row["robot_id"]: row for row in _robots(store)}
    assert by_robot["r3"]["status"] == "error"
    assert 'type="error"' in (store / "junit.xml").read_text()
    # an error is an answer: it is not made again
    made(capsys)
    assert run(backups)[0] == 2
    assert made(capsys) == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("poseshift: fleet/9\nrobots: []", "fleet/1"),
        ("poseshift: fleet/1\nrobots: []", "at least one"),
        ("poseshift: fleet/1\nrobots: [{id: a}]", "profile is missing"),
        ("poseshift: fleet/1\nrobots: [{id: a, profil: p}]", "no key is called 'profil'"),
        ("poseshift: fleet/1\nrobots: [{id: ../a, profile: p}]", "must be letters"),
        ("poseshift: fleet/1\nrobots: [{id: a, profile: p, programs: ../x.mod}]", "leaves the folder"),
        ("poseshift: fleet/1\nrobots: [{id: a, profile: p, programs: /x/*.mod}]", "is absolute"),
        ("poseshift: fleet/1\nrobots: [{folders: /x/*, profile: p, programs: a}]", "is absolute"),
        ('poseshift: fleet/1\nrobots: [{id: a, profile: p, programs: ""}]', "is empty"),
        ("poseshift: fleet/1\ndefaults: {check: {max_path_error_mm: .nan}}\nrobots: [{id: a, profile: p}]", "must be a finite number"),
        ("poseshift: fleet/1\ndefaults: {diagnose: {accept: 2026-01-01}}\nrobots: [{id: a, profile: p}]", "must be a finite number, a text"),
        ("poseshift: fleet/1\ndefaults: {check: {tolerence: 1}}\nrobots: [{id: a, profile: p}]", "'tolerence'"),
        ("poseshift: fleet/1\ndefaults: {check: {max_path_error_mm: abc}}\nrobots: [{id: a, profile: p}]", "must be a number or null"),
        ("poseshift: fleet/1\ndefaults: {diagnose: {quick: 1}}\nrobots: [{id: a, profile: p}]", "must be true or false"),
        ("poseshift: [", "fleet.yaml"),
    ],
)
def test_a_wrong_fleet_says_what_is_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, message: str) -> None:
    (tmp_path / "fleet.yaml").write_text(text)
    assert main(["run", str(tmp_path / "fleet.yaml"), "--store", str(tmp_path / "store")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "store").exists()


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("{id: a, profile: none.yaml, programs: x.mod}", "there is no file"),
        ("{id: a, profile: p.yaml, programs: [x.mod, y.mod]}", "there is no file"),
        ("{id: a, profile: p.yaml, programs: x.mod, measurements: night.csv}", "there is no file"),
        ('{id: a, profile: p.yaml, programs: [x.mod, "z*.mod"]}', "no file is called z*.mod"),
        ("{id: a, profile: p.yaml}", "neither programs nor measurements"),
        ("{id: a, profile: m.yaml, programs: x.mod}", "there is no file"),
    ],
)
def test_a_robot_whose_files_are_not_there_has_no_answer_and_the_others_have(
    tmp_path: Path, sources: dict[str, bytes], entry: str, message: str
) -> None:
    top, store = tmp_path / "plant", tmp_path / "store"
    top.mkdir()
    (top / "p.yaml").write_bytes(sources["profile.yaml"])
    (top / "m.yaml").write_bytes(sources["profile.yaml"] + b"shapes: {base: {mesh: none.stl}}\n")
    (top / "x.mod").write_bytes(sources["Deburr.mod"])
    other = "{id: b, profile: p.yaml, programs: x.mod}"
    (top / "fleet.yaml").write_text(f"poseshift: fleet/1\nrobots:\n  - {entry}\n  - {other}\n")
    run = ["run", str(top / "fleet.yaml"), "--store", str(store)]
    assert main(run) == 2
    rows = {row["robot_id"]: row for row in _robots(store)}
    assert rows["a"]["status"] == "error"
    assert message in rows["a"]["message"]
    assert rows["b"]["status"] == "done"
    assert not (store / "out" / "a").exists()
    # what was taken out of the store is put there again
    (made,) = (store / "out" / "b").rglob("*.mod")
    whole = made.read_bytes()
    for damage in (lambda: made.write_bytes(b""), made.unlink):
        damage()
        assert main(run) == 2
        assert made.read_bytes() == whole


@pytest.mark.skipif(sys.platform != "linux", reason="this system has no such names")
def test_a_name_that_is_no_text_is_the_fault_of_its_robot(backups: Path) -> None:
    os.rename(backups / "r1/Deburr.mod", os.fsencode(backups / "r1") + b"/Gr\xfcn.mod")
    fleet = backups / "fleet.yaml"
    fleet.write_text(fleet.read_text().replace("Deburr.mod", "*.mod"))
    status, store = run(backups)
    rows = {row["robot_id"]: row for row in _robots(store)}
    assert status == 2
    assert "no UTF-8" in rows["r1"]["message"]
    assert rows["r0"]["status"] == "done"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--date", "2026-13-45"], "is no day"),
        (["--date", "tomorrow"], "is no day"),
        (["--workers", "-2"], "is not at least 1"),
        (["--robots", "0"], "is not at least 1"),
    ],
)
def test_a_wrong_option_is_said_before_anything_is_made(tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str) -> None:
    step = "demo" if "--robots" in words else "run"
    with pytest.raises(SystemExit) as ended:
        main([step, str(tmp_path / "new"), "--store", str(tmp_path / "store"), *words])
    assert ended.value.code == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_store_among_the_backups_is_refused(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fleet = str(backups / "fleet.yaml")
    assert main(["run", fleet, "--store", str(backups / "r1")]) == 2
    assert "lies among" in capsys.readouterr().err
    assert sorted(p.name for p in (backups / "r1").iterdir()) == ["Deburr.mod", "measured.csv", "profile.yaml"]


def test_a_unit_that_ends_its_process_ends_nobody_else(backups: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent / "poison"))
    monkeypatch.setenv("POISON", str(backups.parent / "poison"))
    (backups.parent / "poison").mkdir()
    (backups.parent / "poison" / "r1").touch()
    (backups.parent / "poison" / "r2.once").touch()
    status, store = run(backups)
    assert status == 2
    by_robot = {row["robot_id"]: row["status"] for row in _robots(store)}
    assert by_robot == {"r0": "done", "r1": "crashed", "r2": "done", "r3": "done"}
    # a crash is an answer, too: the next night does not die of it
    assert not (backups.parent / "poison" / "r2.once").exists()
    monkeypatch.delenv("POISON")
    capsys.readouterr()
    run(backups)
    assert made(capsys) == 0


def test_plan_lists_what_is_missing(backups: Path, capsys: pytest.CaptureFixture[str]) -> None:
    store = backups.parent / "store"
    assert main(["plan", str(backups / "fleet.yaml"), "--store", str(store)]) == 0
    listed = json.loads(capsys.readouterr().out)
    assert len(listed["missing"]) == listed["units"] == 2 * ROBOTS
    units = plan(read(backups / "fleet.yaml"), Store(store))
    assert [unit.key for unit in units] == [entry["key"] for entry in listed["missing"]]
    assert os.fspath(backups) not in "".join(unit.options + str(unit.inputs) for unit in units)


def test_what_changes_is_said_with_the_night(backups: Path, profile: ps.Profile, capsys: pytest.CaptureFixture[str]) -> None:
    """Nightly rows; the gear of one robot goes in the sixth night."""
    q = np.random.default_rng(3).uniform([-2, -1, -1, -2, 0.2, -3], [2, 1, 0.8, 2, 1.8, 3], (60, 6))
    gear = "{effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.05, sin_deg: 0}"
    worn = ps.Profile.from_yaml(profile.to_yaml().replace("effects:\n", f"effects:\n    - {gear}\n", 1))
    for night in range(8):
        for number in range(ROBOTS):
            real = worn if number == 1 and night >= 5 else profile
            measured = ps.simulate(real, q, noise_m=2e-5, seed=100 * night + number)
            (backups / f"r{number}/measured.csv").write_bytes(measured.to_csv())
        status, store = run(backups, "--date", f"2026-03-{night + 1:02}")
        # a night without new rows says nothing new
        run(backups, "--date", f"2026-03-{night + 1:02}")
    by_robot = {row["robot_id"]: row for row in _robots(store)}
    row = by_robot["r1"]
    assert status == 1
    assert row["status"] == "changed"
    assert (row["nights"], row["changed_since"]) == (8, "2026-03-06")
    assert row["changed_noticed"] >= row["changed_since"]
    assert row["changed_before_mm"] < 0.04 < row["changed_after_mm"]
    # programs by the profile that no longer holds are not to be loaded
    assert [path.name for path in (store / "out/r1").rglob("*")] == ["better.yaml"]
    assert "joint_harmonic joint 3" in row["changed_effect"]
    for name in ("r0", "r2", "r3"):
        assert (by_robot[name]["status"], by_robot[name]["changed_since"]) == ("done", None)
    assert (store / "pages/r1/since.html").is_file()
    assert "its error has changed" in (store / "junit.xml").read_text()
    # the next night without new rows: the same answer, nothing is made
    first = tables(store)
    capsys.readouterr()
    run(backups, "--date", "2026-03-20")
    assert made(capsys) == 0
    later = tables(store)
    assert {name: data for name, data in later.items() if "2026-03-20" not in name} == first
    # with the profile that was found the robot begins anew
    (backups / "r1/profile.yaml").write_bytes((store / "out/r1/better.yaml").read_bytes())
    assert run(backups, "--date", "2026-03-21")[0] == 0
    row = {row["robot_id"]: row for row in _robots(store)}["r1"]
    assert (row["status"], row["nights"], row["changed_since"]) == ("done", 1, None)


def test_a_plant_to_try(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The two commands of the README, with fewer robots."""
    plant, store = tmp_path / "plant", tmp_path / "store"
    assert main(["demo", str(plant), "--robots", "20"]) == 0
    assert main(["run", str(plant / "fleet.yaml"), "--store", str(store), "--workers", "2"]) == 0
    rows = _robots(store)
    assert len(rows) == 20
    assert all(row["status"] == "done" and row["compensated"] > 0 for row in rows)
    assert [row["robot_id"] for row in rows if "joint_harmonic joint 3" in row["effect"]] == ["r00019"]
    assert main(["demo", str(plant)]) == 2
    assert "is there already" in capsys.readouterr().err
    again = tmp_path / "again"
    assert main(["demo", str(again), "--robots", "20"]) == 0
    assert {p.relative_to(again): p.read_bytes() for p in again.rglob("*") if p.is_file()} == {
        p.relative_to(plant): p.read_bytes() for p in plant.rglob("*") if p.is_file()
    }
