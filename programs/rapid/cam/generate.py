"""Writes in/cam.mod: 5000 targets on a dome, milled in rings by an ABB IRB 120. Plain Python, the same bytes every time.

The poses are checked with the nominal kinematics of the robot: reachable, on one branch, the wrist away from its
singularity; confdata come from the joints.
"""
import math
import os

COUNT = 5000
RADIUS_MM, HEIGHT_MM, RINGS = 80.0, 25.0, 40
TOOL_MM = (-15.0, 0.0, 135.0)
TOOL_TILT_DEG = 15.0
FRAME_MM = (390.0, 0.0, 215.0)
FRAME_TURN_DEG = 90.0
# modified DH: alpha, a, theta offset, d
LINKS = [(0, 0, 0, 290), (-90, 0, -90, 0), (0, 270, 0, 0), (-90, 70, 0, 302), (90, 0, 0, 0), (-90, 0, 180, 72)]
LIMITS = [(-165, 165), (-110, 110), (-110, 70), (-160, 160), (-120, 120), (-400, 400)]


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


def links(joints, count=6):
    t = turn(0, 0)
    for (alpha, a, theta, d), q in list(zip(LINKS, joints))[:count]:
        t = mul(mul(t, turn(0, alpha, (a, 0, 0))), turn(2, theta + q, (0, 0, d)))
    return t


def joints_for(t):
    """The solution with the arm in front, the elbow up, and axis 4 turned least; degrees."""
    wrist = [t[i][3] - 72 * t[i][2] for i in range(3)]
    q1 = math.atan2(wrist[1], wrist[0])
    r, z = math.hypot(wrist[0], wrist[1]), wrist[2] - 290
    far, fore = math.hypot(r, z), math.hypot(70, 302)
    q2 = math.atan2(r, z) - math.acos((270**2 + far**2 - fore**2) / (2 * 270 * far))
    rise = math.atan2(z - 270 * math.cos(q2), r - 270 * math.sin(q2))
    q3 = math.atan2(70, 302) - rise - q2
    arm = [math.degrees(q) for q in (q1, q2, q3)]
    n = mul(mul(mul(inv(links(arm, 3)), t), turn(2, -180)), turn(0, 90))
    best = None
    for sign in (1, -1):
        q5 = sign * math.acos(max(-1, min(1, n[1][1])))
        q4 = math.atan2(sign * n[2][1], -sign * n[0][1])
        q6 = math.atan2(sign * n[1][2], sign * n[1][0])
        found = arm + [math.degrees(q) for q in (q4, q5, q6)]
        if best is None or abs(found[3]) < abs(best[3]):
            best = found
    return best


def confdata(q):
    # in front of axis 1 and of the lower arm: only the sign of axis 5 is left
    return [math.floor(q[0] / 90), math.floor(q[3] / 90), math.floor(q[5] / 90), int(q[4] < 0)]


def quaternion(t):
    m = t
    w = 1 + m[0][0] + m[1][1] + m[2][2]
    x = 1 + m[0][0] - m[1][1] - m[2][2]
    y = 1 - m[0][0] + m[1][1] - m[2][2]
    z = 1 - m[0][0] - m[1][1] + m[2][2]
    k = max(range(4), key=lambda i: (w, x, y, z)[i])
    q = [
        [w, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]],
        [m[2][1] - m[1][2], x, m[1][0] + m[0][1], m[0][2] + m[2][0]],
        [m[0][2] - m[2][0], m[1][0] + m[0][1], y, m[2][1] + m[1][2]],
        [m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], z],
    ][k]
    length = math.sqrt(sum(c * c for c in q))
    return [c / length if q[0] >= 0 else -c / length for c in q]


def target(frame, tool, pose, at=""):
    """Position, quaternion, confdata and joints of a pose of the tool in a work frame."""
    q = joints_for(mul(mul(frame, pose), inv(tool)))
    again = mul(mul(inv(frame), links(q)), tool)
    gap = max(abs(again[i][j] - pose[i][j]) for i in range(3) for j in range(4))
    assert gap < 1e-8, (at, gap)
    assert all(low + 2 < angle < high - 2 for angle, (low, high) in zip(q, LIMITS)), (at, q)
    assert abs(q[4]) > 15, (at, q)
    return [pose[i][3] for i in range(3)], quaternion(pose), confdata(q), q


def dome(k):
    """The k-th pose on the dome: rings outward, the tool leaning with the surface."""
    ring = 1 + k * RINGS // COUNT
    angle = 360.0 * (k * RINGS % COUNT) / COUNT
    radius = RADIUS_MM * ring / RINGS
    z = HEIGHT_MM * (1 - (radius / RADIUS_MM) ** 2)
    slope = math.degrees(math.atan(2 * HEIGHT_MM * radius / RADIUS_MM**2)) * 0.35
    x, y = radius * math.cos(math.radians(angle)), radius * math.sin(math.radians(angle))
    lean = mul(mul(turn(2, angle), turn(1, slope)), turn(2, -angle))
    pose = mul(mul(lean, turn(1, 180)), turn(2, 90))
    for i, value in enumerate((x, y, z)):
        pose[i][3] = value
    return pose


def main():
    tool, frame = turn(1, TOOL_TILT_DEG, TOOL_MM), turn(2, FRAME_TURN_DEG, FRAME_MM)
    numbers = lambda values, decimals: ",".join(f"{value + 0.0:.{decimals}f}" for value in values)
    zero = "[[0,0,0],[1,0,0,0]]"
    lines = [
        "%%%",
        "  VERSION:1",
        "  LANGUAGE:ENGLISH",
        "%%%",
        "",
        "MODULE cam",
        "  ! dome D160, ball nose 6 mm, 40 rings",
        f"  PERS tooldata tSpindle:=[TRUE,[[{numbers(TOOL_MM, 3)}],[{numbers(quaternion(tool), 8)}]],"
        "[1.1,[-5,0,55],[1,0,0,0],0,0,0]];",
        f'  TASK PERS wobjdata wBlock:=[FALSE,TRUE,"",[[{numbers(FRAME_MM, 3)}],[{numbers(quaternion(frame), 8)}]],{zero}];',
        "  CONST speeddata vCut:=[25,50,5000,1000];",
        "",
        "  PROC Dome()",
        "    ConfL \\Off;",
        "    ConfJ \\On;",
    ]
    for k in range(COUNT):
        position, orientation, configuration, _ = target(frame, tool, dome(k), k)
        literal = (
            f"[[{numbers(position, 4)}],[{numbers(orientation, 8)}],"
            f"[{','.join(map(str, configuration))}],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]"
        )
        verb = "MoveJ" if k == 0 else "MoveL"
        lines.append(f"    {verb} {literal},vCut,z0,tSpindle\\WObj:=wBlock;")
    lines += ["  ENDPROC", "ENDMODULE", ""]
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "in", "cam.mod")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
