"""Made-up factory calibrations of UR arms, and where their flanges are.

A small simulator in 50 digit arithmetic (mpmath) that shares no code with the program. For each case it draws an arm by the
lines of its axes, writes it as calibration.conf (differences of standard Denavit-Hartenberg parameters) and as the
`kinematics:` file of the ROS driver, and prints flange poses at random joints. Both files are read back as text and their
poses computed from the printed numbers, in two ways that must agree.

    python3 oracle.py [--out FOLDER]
"""

import argparse
import pathlib
import random

from mpmath import atan2, cos, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 50
JOINTS = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"]
# the maker's tables: d, a, alpha in quarter turns
TABLES = {
    "ur5": (
        ["0.089159", "0", "0", "0.10915", "0.09465", "0.0823"],
        ["0", "-0.425", "-0.39225", "0", "0", "0"],
    ),
    "ur10": (
        ["0.1273", "0", "0", "0.163941", "0.1157", "0.0922"],
        ["0", "-0.612", "-0.5723", "0", "0", "0"],
    ),
}
ALPHA = [1, 0, 0, 1, -1, 0]


def eye():
    return mp.eye(4)


def rotation(axis, angle):
    c, s = cos(angle), sin(angle)
    out = eye()
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    out[i, i], out[j, j], out[i, j], out[j, i] = c, c, -s, s
    return out


def shift(x, y, z):
    out = eye()
    out[0, 3], out[1, 3], out[2, 3] = x, y, z
    return out


def inverse(t):
    out = eye()
    for i in range(3):
        for j in range(3):
            out[i, j] = t[j, i]
    for i in range(3):
        out[i, 3] = -sum(out[i, j] * t[j, 3] for j in range(3))
    return out


def rpy(x, y, z, roll, pitch, yaw):
    return shift(x, y, z) * rotation(2, yaw) * rotation(1, pitch) * rotation(0, roll)


def rpy_of(t):
    return (
        atan2(t[2, 1], t[2, 2]),
        atan2(-t[2, 0], sqrt(t[0, 0] ** 2 + t[1, 0] ** 2)),
        atan2(t[1, 0], t[0, 0]),
    )


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def column(t, k):
    return [t[i, k] for i in range(3)]


def drawn(table, seed, tilt, length):
    """Steps before each joint of an arm whose lines differ from the table's by normal errors."""
    draw = random.Random(seed)
    d, a = ([mpf(x) for x in row] for row in table)
    error = lambda sigma: mpf(repr(draw.gauss(0, sigma)))
    steps = [rotation(2, error(tilt)) * shift(0, 0, d[0] + error(length))]
    for i in range(5):
        step = shift(a[i], 0, 0) * rotation(0, ALPHA[i] * pi / 2) * shift(0, 0, d[i + 1])
        wrong = rpy(*(error(length) for _ in range(3)), *(error(tilt) for _ in range(3)))
        steps.append(step * wrong)
    return steps


def standard(steps):
    """Theta, d, a, alpha of the arm at zero from the lines of its axes: common normals, one after the other."""
    frames, pose = [], eye()
    for step in steps:
        pose = pose * step
        frames.append(pose)
    lines = [(column(f, 3), column(f, 2)) for f in frames]
    at, x = [mpf(0)] * 3, [mpf(1), mpf(0), mpf(0)]
    rows = []
    for i in range(5):
        (p, u), (q, v) = lines[i], lines[i + 1]
        n = cross(u, v)
        n2 = dot(n, n)
        apart = [b - a for a, b in zip(p, q)]
        foot = [a + dot(cross(apart, v), n) / n2 * b for a, b in zip(p, u)]
        head = [a + dot(cross(apart, u), n) / n2 * b for a, b in zip(q, v)]
        side = sqrt(n2)
        wanted = [b / side for b in n]
        # either sense of the normal is right: the one that the table has at zero
        along = column(frames[i], 0)
        if dot(wanted, along) < 0:
            wanted = [-b for b in wanted]
        theta = atan2(dot(cross(x, wanted), u), dot(x, wanted))
        d = dot([b - a for a, b in zip(at, foot)], u)
        a = dot([b - a for a, b in zip(foot, head)], wanted)
        alpha = atan2(dot(cross(u, v), wanted), dot(u, v))
        rows.append((theta, d, a, alpha))
        at, x = head, wanted
    u, flange = lines[5][1], frames[5]
    last = column(flange, 0)
    theta = atan2(dot(cross(x, last), u), dot(x, last))
    rows.append((theta, dot([b - a for a, b in zip(at, column(flange, 3))], u), mpf(0), mpf(0)))
    return rows


def quaternion(t):
    w = sqrt(max(mpf(0), 1 + t[0, 0] + t[1, 1] + t[2, 2])) / 2
    x = sqrt(max(mpf(0), 1 + t[0, 0] - t[1, 1] - t[2, 2])) / 2
    y = sqrt(max(mpf(0), 1 - t[0, 0] + t[1, 1] - t[2, 2])) / 2
    z = sqrt(max(mpf(0), 1 - t[0, 0] - t[1, 1] + t[2, 2])) / 2
    sign = lambda value, by: -value if by < 0 else value
    return [w, sign(x, t[2, 1] - t[1, 2]), sign(y, t[0, 2] - t[2, 0]), sign(z, t[1, 0] - t[0, 1])]


def conf_forward(table, deltas, q):
    """Each row as one matrix with its sines and cosines written out, as in the maker's article."""
    d, a = ([mpf(x) for x in row] for row in table)
    pose = eye()
    for i in range(6):
        theta = q[i] + deltas["delta_theta"][i]
        alpha = ALPHA[i] * pi / 2 + deltas["delta_alpha"][i]
        r, h = a[i] + deltas["delta_a"][i], d[i] + deltas["delta_d"][i]
        ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
        pose = pose * matrix(
            [
                [ct, -st * ca, st * sa, r * ct],
                [st, ct * ca, -ct * sa, r * st],
                [0, sa, ca, h],
                [0, 0, 0, 1],
            ]
        )
    return pose


def ros_forward(joints, q):
    pose = eye()
    for i, name in enumerate(JOINTS):
        j = joints[name]
        pose = pose * rpy(*(j[k] for k in ("x", "y", "z", "roll", "pitch", "yaw")))
        pose = pose * rotation(2, q[i])
    return pose


def digits(value):
    return nstr(value, 18, min_fixed=-5, max_fixed=5)


def case(folder, name, kind, seed, tilt, length):
    table = TABLES[kind]
    steps = drawn(table, seed, tilt, length)
    rows = standard(steps)
    d, a = ([mpf(x) for x in row] for row in table)
    deltas = {
        "delta_theta": [r[0] for r in rows],
        "delta_a": [r[2] - a[i] for i, r in enumerate(rows)],
        "delta_d": [r[1] - d[i] for i, r in enumerate(rows)],
        "delta_alpha": [r[3] - ALPHA[i] * pi / 2 for i, r in enumerate(rows)],
    }
    text = "[mounting]\n"
    for key, values in deltas.items():
        text += f"{key} = [ {', '.join('0' if v == 0 else digits(v) for v in values)}]\n"
    text += "joint_checksum = [ 0x0, 0x0, 0x0, 0x0, 0x0, 0x0]\n"
    text += "calibration_status = 2 # 0 == notInitialized / 1 == notLinearised / 2 == Linearised\n"
    (folder / f"{name}.calibration.conf").write_text(text)
    # what was printed is the arm
    deltas = {
        key: [mpf(v) for v in line.split("[")[1].rstrip("]").split(",")]
        for key, line in (l.split(" = ") for l in text.splitlines() if l.startswith("delta_"))
    }
    text, joints = "kinematics:\n", {}
    for joint, step in zip(JOINTS, steps):
        values = dict(zip(("x", "y", "z", "roll", "pitch", "yaw"), [*column(step, 3), *rpy_of(step)]))
        values = {key: "0" if v == 0 else digits(v) for key, v in values.items()}
        joints[joint] = {key: mpf(v) for key, v in values.items()}
        text += f"  {joint}:\n" + "".join(f"    {k}: {v}\n" for k, v in values.items())
    text += "  hash: calib_0\n"
    (folder / f"{name}.kinematics.yaml").write_text(text)
    draw = random.Random(seed + 1)
    out = ["id," + ",".join(f"q{i}_deg" for i in range(1, 7)) + ",x_mm,y_mm,z_mm,qw,qx,qy,qz"]
    for row in range(40):
        q_deg = [mpf(repr(round(draw.uniform(-360, 360), 6))) for _ in range(6)]
        if row == 0:
            q_deg = [mpf(0)] * 6
        q = [v * pi / 180 for v in q_deg]
        pose = conf_forward(table, deltas, q)
        gap = inverse(ros_forward(joints, q)) * pose - eye()
        assert max(abs(x) for x in gap) < mpf("1e-13"), (name, row, gap)
        numbers = [*q_deg, *(1000 * v for v in column(pose, 3)), *quaternion(pose)]
        out.append(f"{row + 1}," + ",".join(nstr(v, 17, min_fixed=-30, max_fixed=30) for v in numbers))
    (folder / f"{name}.expected.csv").write_text("\n".join(out) + "\n")
    print(name, "d", [nstr(v, 6) for v in deltas["delta_d"]], "theta", [nstr(v, 4) for v in deltas["delta_theta"]])


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=here)
    out = parser.parse_args().out
    # tilts in radians and lengths in metres, one standard deviation
    case(out, "ur5_usual", "ur5", 11, 1e-3, 3e-4)
    case(out, "ur10_far", "ur10", 5, 1e-4, 3e-4)
    case(out, "ur5_tilted", "ur5", 7, 3e-3, 0)


main()
