"""Writes in/TRIM.JBI: a trimming path of some hundred points on a saddle, for a Yaskawa GP7. Plain Python, the same bytes every
time.

The poses are checked with the nominal kinematics of the robot (../profile.yaml): reachable, elbow up, the wrist away from
its singularity; RCONF and the first joint position come from the joints.
"""
import math
import os

ROUNDS, PER_ROUND = 8, 60
LENGTH_MM, WIDTH_MM, RISE_MM = 110.0, 75.0, 18.0
TOOL_MM, TOOL_TILT_DEG = (35.0, 0.0, 142.5), 35.0
FRAME_MM, FRAME_TURN_DEG = (430.0, -40.0, -120.0), 20.0
# modified DH: alpha, a, theta, d, and the sign of the axis
LINKS = [(0, 0, 0, 0, 1), (-90, 40, -90, 0, 1), (0, 445, 0, 0, -1), (-90, 40, 0, 440, -1), (90, 0, 0, 0, -1), (-90, 0, 0, 80, -1)]
LIMITS = [(-170, 170), (-65, 145), (-70, 190), (-190, 190), (-135, 135), (-360, 360)]
PULSES_PER_DEG = (1365.333, 1517.037, 1240.888, 1137.777, 1013.333, 568.888)


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


def forward(joints, count=6):
    t = turn(0, 0)
    for (alpha, a, theta, d, sign), q in list(zip(LINKS, joints))[:count]:
        t = mul(mul(t, turn(0, alpha, (a, 0, 0))), turn(2, theta + sign * q, (0, 0, d)))
    return t


def joints_for(flange):
    """The solution with the arm in front, the elbow up, and axis R turned least; degrees."""
    wrist = [flange[i][3] - 80 * flange[i][2] for i in range(3)]
    q1 = math.atan2(wrist[1], wrist[0])
    r, z = math.hypot(wrist[0], wrist[1]) - 40, wrist[2]
    far, fore = math.hypot(r, z), math.hypot(40, 440)
    q2 = math.atan2(r, z) - math.acos((445**2 + far**2 - fore**2) / (2 * 445 * far))
    rise = math.atan2(z - 445 * math.cos(q2), r - 445 * math.sin(q2))
    q3 = rise - math.atan2(40, 440) + q2
    arm = [math.degrees(q) for q in (q1, q2, q3)]
    # n = Rz(-R) Ry(B) Rz(-T)
    n = mul(turn(0, 90), mul(inv(forward(arm, 3)), flange))
    best = None
    for sign in (1, -1):
        q5 = sign * math.acos(max(-1, min(1, n[2][2])))
        q4 = -math.atan2(sign * n[1][2], sign * n[0][2])
        q6 = -math.atan2(sign * n[2][1], -sign * n[2][0])
        found = arm + [math.degrees(q) for q in (q4, q5, q6)]
        if best is None or abs(found[3]) < abs(best[3]):
            best = found
    return best


def angles(t):
    """Rx, Ry, Rz in degrees of Rz(Rz) Ry(Ry) Rx(Rx)."""
    ry = math.atan2(-t[2][0], math.hypot(t[0][0], t[1][0]))
    rx = math.atan2(t[2][1], t[2][2])
    rz = math.atan2(t[1][0], t[0][0])
    return [math.degrees(angle) for angle in (rx, ry, rz)]


def rconf(q):
    """Flip, lower arm, rear, and whether R, T, S are at 180 degrees or beyond (NX100 manual)."""
    flip = 0 if -90 < q[3] <= 90 else 1
    return [flip, 0, 0] + [int(abs(angle) >= 180) for angle in (q[3], q[5], q[0])]


def target(frame, tool, pose, at=""):
    """Coordinates and joints of a pose of the tool in a work frame."""
    q = joints_for(mul(mul(frame, pose), inv(tool)))
    again = mul(mul(inv(frame), forward(q)), tool)
    gap = max(abs(again[i][j] - pose[i][j]) for i in range(3) for j in range(4))
    assert gap < 1e-8, (at, gap)
    assert all(low + 3 < angle < high - 3 for angle, (low, high) in zip(q, LIMITS)), (at, q)
    assert abs(q[4]) > 12, (at, q)
    return [pose[i][3] for i in range(3)] + angles(pose), q


def written(values):
    return ",".join(f"{value + 0.0:.{3 if i < 3 else 4}f}" for i, value in enumerate(values))


def saddle(k):
    """The k-th pose: an oval that climbs and falls twice a round, the tool leaning with it."""
    angle = math.radians(360.0 * k / PER_ROUND)
    depth = 6.0 * (k / (ROUNDS * PER_ROUND))
    x, y = LENGTH_MM * math.cos(angle), WIDTH_MM * math.sin(angle)
    z = RISE_MM * math.cos(2 * angle) - depth
    lean = mul(turn(0, 6.0 * math.sin(angle)), turn(1, -8.0 * math.cos(angle)))
    pose = mul(lean, turn(0, 180))
    for i, value in enumerate((x, y, z)):
        pose[i][3] = value
    return pose


def main():
    tool, frame = turn(1, TOOL_TILT_DEG, TOOL_MM), turn(2, FRAME_TURN_DEG, FRAME_MM)
    found = [target(frame, tool, saddle(k), k) for k in range(ROUNDS * PER_ROUND + 1)]
    start = target(frame, tool, mul(turn(0, 0, (0, 0, 60)), saddle(0)), "start")[1]
    pulses = ",".join(str(round(q * p)) for q, p in zip(start, PULSES_PER_DEG))
    lines = [
        "/JOB", "//NAME TRIM", "//POS", f"///NPOS {len(found) + 1},0,0,0,0,0", "///TOOL 1", "///POSTYPE PULSE", "///PULSE",
        f"C00000={pulses}", "///USER 3", "///POSTYPE USER", "///RECTAN",
    ]
    state = None
    for k, (position, q) in enumerate(found):
        if rconf(q) != state:
            state = rconf(q)
            lines.append("///RCONF " + ",".join(map(str, state + [0] * 18)))
        lines.append(f"C{k + 1:05}={written(position)}")
    lines += ["//INST", "///DATE 2024/05/17 14:02", "///COMM saddle, 8 rounds", "///ATTR SC,RW", "///GROUP1 RB1", "NOP"]
    lines += ["MOVJ C00000 VJ=10.00", "MOVL C00001 V=50.0", "DOUT OT#(4) ON"]
    lines += [f"MOVL C{k + 1:05} V=35.0 PL=1" for k in range(1, len(found))]
    lines += ["DOUT OT#(4) OFF", "MOVJ C00000 VJ=10.00", "END"]
    os.makedirs("in", exist_ok=True)
    with open("in/TRIM.JBI", "wb") as file:
        file.write("".join(line + "\r\n" for line in lines).encode("ascii"))


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    main()
