#!/usr/bin/env python3
"""How many real program files get through `poseshift compensate`, and why the others do not.

usage: measure.py BINARY FOLDER [-o RESULTS.json] [--only LIST.txt] [--robots ROBOTS] [--jobs N]

FOLDER holds one folder a language (rapid, krl, fanuc, urscript, inform, val3, kawasaki), and in it folders of program files as a controller or
an offline system wrote them: files in one folder belong together. LIST.txt names files in it, one a line (default: all).
A file counts where the text has poses with six numbers. docs/languages/real-files.md says what is assumed.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

MAKERS = {"rapid": "abb", "krl": "kuka", "fanuc": "fanuc", "urscript": "universal", "inform": "yaskawa", "val3": "staubli", "kawasaki": "kawasaki"}
ENDINGS = {
    "rapid": (".mod", ".modx", ".prg", ".sys", ".sysx", ".txt"),
    "krl": (".src", ".dat", ".sub"),
    "fanuc": (".ls",),
    "urscript": (".script", ".urscript", ".txt"),
    "inform": (".jbi",),
    "val3": (".dtx", ".pgx", ".pjx"),
    "kawasaki": (".as", ".pg"),
}
# where no arm of the catalogue fits, its links are made longer by these factors
SCALES = (1, 1.35, 1.8, 2.4)
# joints at the start, degrees: an arm ready to work
STARTS = {
    "rapid": "0,0,0,0,30,0",
    "krl": "0,-90,90,0,30,0",
    "fanuc": "0,0,0,0,-60,0",
    "urscript": "0,-90,90,-90,-90,0",
    "inform": "0,0,0,0,-60,0",
    "val3": "0,0,90,0,60,0",
    "kawasaki": "0,0,-90,0,-60,0",
}
# causes that come of the arm, tool or frame that was assumed
FIT = re.compile("out-of-reach|joint-limit|not-converged|configuration-unknown|branch-lost|within reach")
# causes that come of an axis that no profile of the catalogue has
EXTERNAL = re.compile("external-axis-unknown|positioner-unknown|moving-frame|group-without-geometry")
TRACK = "  track: [{{axis: {}, direction: [{}, {}, 0], up: [0, 0, 1], min_mm: -20000, max_mm: 20000}}]\n"
STATION = (
    "  positioners:\n    - name: station\n      follows: always\n      axes:\n"
    "        - {{axis: {}, at: {{x_mm: 900, y_mm: 0, z_mm: 300, rx_deg: 90, ry_deg: 0, rz_deg: 0}}, min_deg: -720, max_deg: 720}}\n"
    "        - {{axis: {}, at: {{x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: -90, ry_deg: 0, rz_deg: 0}}, min_deg: -720, max_deg: 720}}\n"
)
# what may carry the arm or the part, tried where a refusal asks for it: a rail along x or y of the base, a station, or nothing
AXES = {
    "fanuc": [TRACK.format("E1", 1, 0), TRACK.format("E1", 0, 1), "  other: [E1]\n", STATION.format("G2J1", "G2J2")],
    "inform": [STATION.format("EC1", "EC2"), TRACK.format("BC1", 1, 0), TRACK.format("BC1", 0, 1)],
    "rapid": [TRACK.format("eax_a", 1, 0), TRACK.format("eax_a", 0, 1), "  other: [eax_a]\n"],
    "krl": [TRACK.format("E1", 1, 0), TRACK.format("E1", 0, 1), "  other: [E1]\n"],
}
MISSING = re.compile(r"\b(\w+) is not in the files: the numbers of its tool and base are not known")
NUMBER = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def numbers(count):
    return rb"\s*,\s*".join([NUMBER] * count)


POSES = {
    "rapid": re.compile(rb"\[\s*\[\s*" + numbers(3) + rb"\s*\]\s*,\s*\[\s*" + numbers(4) + rb"\s*\]\s*,\s*\[\s*-?\d+\s*,"),
    "krl": re.compile(rb"\{(?:\s*\w+:)?\s*X\s*%s\s*,\s*Y\s*%s\s*,\s*Z\s*%s" % ((NUMBER,) * 3), re.I),
    "fanuc": re.compile(rb"\bX\s*=\s*" + NUMBER + rb"\s*mm"),
    "urscript": re.compile(rb"p\[\s*" + numbers(6) + rb"\s*\]"),
}
COMMENTS = {"rapid": rb"![^\r\n]*", "krl": rb";[^\r\n]*", "urscript": rb"#[^\r\n]*|(?m:^\s*\$[^\r\n]*)"}


def poses(language, text):
    """Poses with numbers, counted from the text alone."""
    if language == "inform":
        count, kind = 0, b"PULSE"
        for line in re.split(rb"[\r\n]+", text):
            if line.startswith(b"///POSTYPE"):
                kind = line.split()[1]
            elif re.match(rb"[CP]\d+\s*=", line):
                count += kind not in (b"PULSE", b"ANGLE")
        return count
    if language == "val3":
        points = re.findall(rb'<Data\b[^>]*"point(?:Rx)?"[^>]*>(.*?)</Data>', text, re.S)
        return sum(len(re.findall(rb'<Value\b[^>]*\s[xyz]="', p)) for p in points) + len(re.findall(rb"<tpValue\b", text))
    if language == "kawasaki":
        sections = re.findall(rb"^\.TRANS(.*?)^\.END", text, re.S | re.M)
        return sum(len(re.findall(rb"^\S+(?:[ \t]+[-+.\d]+){6}", s, re.M)) for s in sections) + len(
            re.findall(rb"MOVE\s+TRANS\(" + numbers(6) + rb"\)", text)
        )
    if language in COMMENTS:
        text = re.sub(COMMENTS[language], b"", text)
    return len(POSES[language].findall(text))


def make_profiles(robots, folder):
    """The arms of the catalogue with a small effect, and longer ones; by maker and scale, with their reach in mm."""
    profiles = collections.defaultdict(list)
    for name in sorted(os.listdir(robots)):
        text = open(os.path.join(robots, name), encoding="utf-8").read() if name.endswith(".yaml") else ""
        if "effects: []" not in text:
            continue
        text = text.replace("effects: []", "effects: [{effect: link_geometry, link: 3, theta_deg: 0.1}]")
        for scale in SCALES:
            reach = 0.0
            lines = text.split("\n")
            for at, line in enumerate(lines):
                if "alpha_deg" in line:
                    reach += sum(abs(float(x)) for x in re.findall(r"\b[ad]_mm: (-?[\d.]+)", line)) * scale
                    longer = lambda found: found[1] + repr(round(float(found[2]) * scale, 6))
                    lines[at] = re.sub(r"(\b[ad]_mm: )(-?[\d.]+)", longer, line)
            path = os.path.join(folder, f"{name[:-5]}_{scale}.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
            profiles[(name.split("_")[0], scale)].append((path, reach))
    return profiles


def places(reach):
    """Where a work frame may stand that the files do not tell: in the base, before the arm, upside down, at its side."""
    x, y, z = 0.4 * reach, 0.2 * reach, 0.2 * reach
    return ("0,0,0,0,0,0", f"{x:.0f},0,{z:.0f},0,0,0", f"{x:.0f},0,{z:.0f},180,0,0", f"{x:.0f},{-y:.0f},{y / 2:.0f},0,0,90")


class Runs:
    """Runs the binary, and gives it what its refusals ask for."""

    def __init__(self, binary):
        self.binary = binary
        self.known = {}
        reported = subprocess.run([binary, "compensate", "--help"], capture_output=True, text=True, check=True)
        self.takes_start = "--start-joints" in reported.stdout

    def with_axes(self, profile, axes):
        """A profile with external axes, made once."""
        path = f"{profile[:-5]}_{abs(hash(axes))}.yaml"
        if not os.path.exists(path):
            text = open(profile, encoding="utf-8").read()
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.rstrip("\n") + "\nexternal_axes:\n" + axes)
        return path

    def run(self, language, files, profile, reach, place, start):
        key = (tuple(files), profile, place, start)
        if key not in self.known:
            self.known[key] = self._run(language, files, profile, places(reach)[place], start)
        return self.known[key]

    def _run(self, language, files, profile, frame, start):
        tool = "0,0,100,0,0,0" if language in ("rapid", "urscript") else "0,0,200,0,0,0"
        given = ["--start-joints=" + start] if start else []
        folder = tempfile.mkdtemp()
        out = os.path.join(folder, "out" if len(files) > 1 else os.path.basename(files[0]))
        command = [self.binary, "compensate", *files, "--profile", profile, "-o", out, "--language", language, "--json"]
        try:
            while True:
                done = subprocess.run([*command, *given], capture_output=True, timeout=600, check=False)
                error = done.stderr.decode("utf-8", "replace")
                report = json.loads(done.stdout) if done.stdout.strip() else None
                more = []
                for what, quoted, plain in re.findall(
                    r"--(tool|frame) (?:'([^'\n]*?)=|([^'\s`]+?)=|)x,y,z,rx,ry,rz", "" if report else error
                ):
                    name, value = quoted or plain, tool if what == "tool" else frame
                    more += ["--" + what, f"{name}={value}" if name else value]
                missing = [f["message"] for f in report["findings"]] if report and language == "krl" else []
                missing = {m[1] for m in map(MISSING.search, missing) if m}
                if missing and "--with" not in given:
                    more += ["--with", declare(folder, missing)]
                if report and "--tool" not in given:
                    alone = [f for f in report["findings"] if f["id"] == "target-unused" and f["severity"] == "error"]
                    more += ["--tool", tool, "--frame", frame] if alone else []
                if not more or all(value in given for value in more):
                    return done.returncode, needed(report), error, given
                given += more
        except subprocess.TimeoutExpired:
            return -1, None, "it takes more than ten minutes", given
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def declare(folder, names):
    """Writes the $config.dat of a robot that has tool 1 and no work frame with this FDAT."""
    made = os.path.join(folder, "with")
    os.makedirs(made)
    lines = [f"DECL FDAT {name}={{TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE}}\n" for name in sorted(names)]
    with open(os.path.join(made, "$config.dat"), "w", encoding="utf-8") as file:
        file.write("DEFDAT $CONFIG\n" + "".join(lines) + "ENDDAT\n")
    return made


def needed(report):
    """What `judge` looks at: whole reports of large files do not fit into the memory."""
    if report is None:
        return None
    keys = ("file", "status", "changed", "findings")
    targets = [t for t in report["targets"] if t["wanted_joints_deg"] is None]
    return {"findings": report["findings"], "targets": [{k: t[k] for k in keys if k in t} for t in targets]}


def judge(run, path, parts=()):
    """What a run says of one file; `parts` hold statements of the same program."""
    status, report, error, given = run
    if report is None:
        line = re.sub(r"`[^`]*`|/\S+|\d[\d.]*", "…", error.strip().split("\n")[0])
        return {"through": False, "targets": 0, "corrected": 0, "good": 0, "causes": {line[:100]: 1}, "given": given}
    errors = [f for f in report["findings"] if f["severity"] == "error"]
    own = [f for f in errors if f.get("file") in (None, path, *parts)]
    wrong = {f["id"] for f in errors}
    # targets that a move goes to: with an answer, or with what speaks against one
    used = good = corrected = 0
    for target in report["targets"]:
        if target.get("file", path) == path:
            refused = any(found in wrong for found in target["findings"])
            used += bool(target["status"] or refused)
            good += bool(target["status"] and not refused)
            corrected += bool(target["changed"])
    causes = dict(collections.Counter(f["id"] for f in own))
    reported = {f["id"]: f"{f['line']}: {f['message']}" for f in reversed(own)}
    return {
        "through": not own and (status == 0 or bool(errors)),
        "targets": used,
        "good": good,
        "corrected": corrected,
        "causes": causes,
        "told": reported,
        "given": given,
    }


def measure(runs, profiles, language, folder, name):
    """The best answer that any arm, place and start gives: the file alone, else with the others of its folder."""
    path = os.path.join(folder, name)
    all_names = sorted(n for n in os.listdir(folder) if n.lower().endswith(ENDINGS[language]))
    own = [path]
    if language == "krl":
        stem = os.path.splitext(name)[0].lower()
        own = [os.path.join(folder, n) for n in all_names if os.path.splitext(n)[0].lower() == stem]
    together = [os.path.join(folder, n) for n in all_names]
    # points of VAL 3 are nothing without the programs given them; each URScript is a whole program
    parts = []
    if language == "val3":
        parts = own = together
    elif language == "krl":
        # the poses stand in the .dat, what is said of the moves in the .src of its name
        parts = own
    sets = [own] if language == "urscript" or len(together) == len(own) else [own, together]
    starts = [None, STARTS[language]] if runs.takes_start else [None]
    best = None
    for scale in SCALES:
        for place in range(4):
            if place and not any(value.startswith("--frame") for value in best["given"]):
                break
            for start in starts:
                for profile, reach in profiles[(MAKERS[language], scale)]:
                    for files in sets:
                        for axes in [None, *AXES.get(language, ())]:
                            if axes and not EXTERNAL.search(" ".join(best["causes"])) and not best["axes"]:
                                break
                            arm = runs.with_axes(profile, axes) if axes else profile
                            found = judge(runs.run(language, files, arm, reach, place, start), path, parts)
                            found.update(arm=os.path.basename(profile)[:-5], axes=axes, scale=scale, files=len(files))
                            rank = (found["through"], found["good"], -sum(found["causes"].values()))
                            if best is None or rank > best["rank"]:
                                best = {**found, "rank": rank}
                            if found["through"]:
                                return best
                if not FIT.search(" ".join(best["causes"])):
                    return best
    return best


def table(results):
    """The tables of docs/languages/real-files.md, and the causes."""
    print("| language | files with poses | through | refused for the assumed arm or place alone | targets | corrected |")
    print("|---|---|---|---|---|---|")
    causes, times = collections.Counter(), collections.Counter()
    for language in MAKERS:
        own = [r for r in results if r["language"] == language and r["poses"]]
        refused = [r for r in own if not r["through"]]
        fit = sum(all(FIT.search(cause) for cause in r["causes"]) for r in refused)
        corrected = sum(r["corrected"] for r in own if r["through"])
        through = len(own) - len(refused)
        print(f"| {language} | {len(own)} | {through} | {fit} | {sum(r['targets'] for r in own)} | {corrected} |")
        for result in refused:
            for cause, count in result["causes"].items():
                causes[(language, cause)] += 1
                times[(language, cause)] += count
    print()
    for (language, cause), files in causes.most_common(24):
        print(f"{files:5} files {times[(language, cause)]:6} times  {language}: {cause}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("binary")
    parser.add_argument("folder")
    parser.add_argument("-o", "--output")
    parser.add_argument("--only")
    parser.add_argument("--robots", default=os.path.join(here, "..", "..", "robots"))
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    only = open(asked.only, encoding="utf-8").read().splitlines() if asked.only else None
    folders = collections.defaultdict(list)
    for language, endings in ENDINGS.items():
        for folder, _, names in os.walk(os.path.join(asked.folder, language)):
            for name in sorted(names):
                path = os.path.relpath(os.path.join(folder, name), asked.folder)
                if name.lower().endswith(endings) and (only is None or path in only):
                    folders[(language, folder)].append(name)
    with tempfile.TemporaryDirectory() as made:
        profiles = make_profiles(asked.robots, made)
        missing = {MAKERS[language] for language, _ in folders} - {maker for maker, _ in profiles}
        if missing:
            sys.exit(f"{asked.robots} has no profile of {', '.join(sorted(missing))}: write some with `poseshift profile new`")

        def one(key):
            language, folder = key
            runs, found = Runs(asked.binary), []
            for name in folders[key]:
                path = os.path.join(folder, name)
                count = poses(language, open(path, "rb").read())
                if count:
                    found.append({**measure(runs, profiles, language, folder, name), "poses": count})
                    found[-1].update(language=language, file=os.path.relpath(path, asked.folder))
            return found

        with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
            results = [result for found in pool.map(one, folders) for result in found]
    if asked.output:
        with open(asked.output, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    table(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
