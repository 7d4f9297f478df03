"""Writes in/pocket.src: 420 targets in a pocket, milled by a KUKA KR 210 R2700-2. Plain Python, the same bytes every time.

The poses are checked with the nominal kinematics of the robot: reachable, elbow up, the wrist away from its singularity; S and
T of the first move come from the joints.
"""
import math
import os

COUNT = 420
LENGTH_MM, WIDTH_MM, DEPTH_MM, LOOPS = 260.0, 140.0, 18.0, 7
TOOL = (0.0, 0.0, 310.0, 0.0, 60.0, 0.0)
BASE = (1650.0, -120.0, 640.0, 8.0, 0.0, 0.0)
# modified DH: alpha, a, theta offset, d; sign limits of the controller's axes, and where it starts
LINKS = [(0, 0, 0, 645), (-90, 330, 0, 0), (0, 1150, -90, 0), (-90, 115, 0, 1220), (90, 0, 0, 0), (-90, 0, 180, 215)]
SIGNS = [-1, 1, 1, -1, 1, -1]
START = [0, -90, 90, 0, 45, 0]
LIMITS = [(-185, 185), (-140, -5), (-120, 168), (-350, 350), (-125, 125), (-350, 350)]


def mul(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inv(t):
    r = [[t[j][i] for j in range(3)] for i in range(3)]
    return [r[i] + [-sum(r[i][k] * t[k][3] for k in range(3))] for i in range(3)] + [[0, 0, 0, 1]]


def turn(axis, degrees, at=(0, 0, 0)):
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    t = [[float(r == k) for k in range(4)] for r in range(4)]
    t[i][i], t[i][j], t[j][i], t[j][j] = c, -s, s, c
    for k in range(3):
        t[k][3] = at[k]
    return t


def frame(numbers):
    """X Y Z A B C."""
    x, y, z, a, b, c = numbers
    return mul(mul(turn(2, a, (x, y, z)), turn(1, b)), turn(0, c))


def numbers_of(t):
    a = math.degrees(math.atan2(t[1][0], t[0][0]))
    b = math.degrees(math.atan2(-t[2][0], math.hypot(t[0][0], t[1][0])))
    c = math.degrees(math.atan2(t[2][1], t[2][2]))
    return [t[0][3], t[1][3], t[2][3], a, b, c]


def links(axes, count=6):
    t = turn(0, 0)
    for (alpha, a, theta, d), q, sign in list(zip(LINKS, axes, SIGNS))[:count]:
        t = mul(mul(t, turn(0, alpha, (a, 0, 0))), turn(2, theta + sign * q, (0, 0, d)))
    return t


def axes_for(t, near):
    """The solution with the arm in front and the elbow up that is nearest to these axes; degrees."""
    wrist = [t[i][3] - 215 * t[i][2] for i in range(3)]
    a1 = -math.atan2(wrist[1], wrist[0])
    r, z = math.hypot(wrist[0], wrist[1]) - 330, wrist[2] - 645
    far, fore = math.hypot(r, z), math.hypot(115, 1220)
    up = math.atan2(z, r) + math.acos((1150**2 + far**2 - fore**2) / (2 * 1150 * far))
    rise = math.atan2(z - 1150 * math.sin(up), r - 1150 * math.cos(up))
    a3 = math.atan2(115, 1220) - rise + up
    arm = [math.degrees(q) for q in (a1, -up, a3)]
    n = mul(mul(mul(inv(links(arm, 3)), t), turn(2, -180)), turn(0, 90))
    wrists = []
    for sign in (1, -1):
        q5 = sign * math.acos(max(-1, min(1, n[1][1])))
        q4 = math.atan2(sign * n[2][1], -sign * n[0][1])
        q6 = math.atan2(sign * n[1][2], sign * n[1][0])
        found = [-math.degrees(q4), math.degrees(q5), -math.degrees(q6)]
        wrists.append([angle + 360 * round((other - angle) / 360) for angle, other in zip(found, near[3:])])
    return arm + min(wrists, key=lambda wrist: max(abs(a - b) for a, b in zip(wrist, near[3:])))


def status(axes):
    # in front of axis 1 and the elbow up: bit 1; bit 2 is the sign of axis 5
    return 2 + 4 * (axes[4] < 0)


def turn_bits(axes):
    return sum(1 << i for i, angle in enumerate(axes) if angle < 0)


def axes_of(base, tool, pose, near, at=""):
    """The axes for a pose of the tool in a base, coming from others."""
    q = axes_for(mul(mul(base, pose), inv(tool)), near)
    again = mul(mul(inv(base), links(q)), tool)
    gap = max(abs(again[i][j] - pose[i][j]) for i in range(3) for j in range(4))
    assert gap < 1e-7, (at, gap)
    assert all(low + 2 < angle < high - 2 for angle, (low, high) in zip(q, LIMITS)), (at, q)
    assert abs(q[4]) > 10, (at, q)
    return q


def pocket(k):
    """The k-th pose in the pocket: loops outward on a slightly hollow floor, the tool across it, leaning in its direction."""
    loop = k * LOOPS / COUNT
    angle = 2 * math.pi * loop
    part = 0.15 + 0.85 * loop / LOOPS
    x, y = 0.5 * LENGTH_MM * part * math.cos(angle), 0.5 * WIDTH_MM * part * math.sin(angle)
    z = -DEPTH_MM * (1 - 0.5 * part**2)
    lean = 6 * part
    pose = mul(mul(turn(2, 12 * math.sin(angle)), turn(1, 180 - lean * math.cos(angle))), turn(0, lean * math.sin(angle)))
    for i, value in enumerate((x, y, z)):
        pose[i][3] = value
    return pose


def aggregate(values, decimals=3):
    return ",".join(f"{key} {value:.{decimals}f}" for key, value in zip("XYZABC", values))


def main():
    tool, base = frame(TOOL), frame(BASE)
    axes = first = axes_of(base, tool, pocket(0), START)
    lines = [
        "&ACCESS RVP",
        "&REL 1",
        "&COMMENT pocket 260 x 140, ball nose 10 mm",
        "DEF pocket ( )",
        "; made from a path of tool positions\r; one bare carriage return stands in this line",
        ";FOLD INI",
        "BAS (#INITMOV,0 )",
        ";ENDFOLD (INI)",
        "$TOOL={FRAME: " + aggregate(TOOL) + "}",
        "$BASE={FRAME: " + aggregate(BASE) + "}",
        "$ADVANCE=5",
        "$APO.CDIS=0.5",
        "$VEL.CP=0.05",
        "PTP {A1 " + ",".join(f"{angle:.4f}" if i == 0 else f"A{i + 1} {angle:.4f}" for i, angle in enumerate(first)) + "}",
    ]
    for k in range(COUNT):
        pose = pocket(k)
        axes = axes_of(base, tool, pose, axes, k)
        target = aggregate(numbers_of(pose))
        if k == 0:
            lines.append(f"PTP {{{target},S {status(axes)},T {turn_bits(axes)}}}")
        else:
            lines.append(f"LIN {{{target}}} C_DIS")
    lines += ["LIN_REL {Z 80.0} #BASE", "END", ""]
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "in", "pocket.src")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="ascii", newline="") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
