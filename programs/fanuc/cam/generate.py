"""Writes in/DOME.LS and in/FRAME.DG: 420 points on a dome, milled in a spiral by a FANUC R-2000iC/165F. Plain Python, the
same bytes every time.

The tool turns about its own axis on the way, so that joint 6 passes 180 deg and the turn digit changes. The poses are checked
with the nominal kinematics of the robot: reachable, on one branch, the wrist away from its singularity; the configuration
data come from the joints.
"""
import math
import os

COUNT = 420
RADIUS_MM, HEIGHT_MM, RINGS = 220.0, 60.0, 7
TOOL = [120.0, -35.0, 310.0, 0.0, 25.0, 0.0]
FRAME = [1650.0, 200.0, -250.0, 0.0, 0.0, 30.0]
A1, A2, A3, D4, D6 = 312.0, 1075.0, 225.0, 1280.0, 215.0


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


def pose(xyzwpr):
    """Rz(R) Ry(P) Rx(W) at X, Y, Z."""
    x, y, z, w, p, r = xyzwpr
    t = mul(mul(turn(2, r), turn(1, p)), turn(0, w))
    for k, value in enumerate((x, y, z)):
        t[k][3] = value
    return t


def xyzwpr(t):
    p = math.asin(max(-1.0, min(1.0, -t[2][0])))
    w = math.atan2(t[2][1], t[2][2])
    r = math.atan2(t[1][0], t[0][0])
    return [t[0][3], t[1][3], t[2][3]] + [math.degrees(a) for a in (w, p, r)]


def forward(j):
    """The faceplate; J3 counts from the horizontal."""
    rows = [(0, 0, j[0], 0), (-90, A1, j[1] - 90, 0), (0, A2, -j[2] - j[1], 0), (-90, A3, -j[3], D4), (90, 0, -j[4], 0),
            (-90, 0, -j[5], D6)]
    t = turn(0, 0)
    for alpha, a, theta, d in rows:
        t = mul(mul(t, turn(0, alpha, (a, 0, 0))), turn(2, theta, (0, 0, d)))
    return t


def joints(t, flip, near=(0, 0, 0, 0, 0, 0)):
    """The solution in front, elbow up, J5 negative unless `flip`; each joint within half a turn of `near`."""
    x, y, z = (t[i][3] - D6 * t[i][2] for i in range(3))
    j1 = math.atan2(y, x)
    r = math.hypot(x, y) - A1
    far, fore, rise = math.hypot(r, z), math.hypot(D4, A3), math.atan2(A3, D4)
    j2 = math.atan2(r, z) - math.acos((A2**2 + far**2 - fore**2) / (2 * A2 * far))
    j3 = math.atan2(z - A2 * math.cos(j2), r - A2 * math.sin(j2)) - rise
    arm = [math.degrees(q) for q in (j1, j2, j3)]
    third = forward(arm + [0, 0, 0])
    wrist = mul(inv(third), t)
    # at J4 = J5 = J6 = 0 the faceplate is turned by Rx(-90) against link 3: N = Ry(-J4) Rz(-J5) Ry(-J6)
    n = mul(mul(turn(0, -90), wrist), turn(0, 90))
    sign = -1 if flip else 1
    j5 = -sign * math.acos(max(-1.0, min(1.0, n[1][1])))
    j4 = -math.atan2(sign * n[2][1], -sign * n[0][1])
    j6 = -math.atan2(sign * n[1][2], sign * n[1][0])
    found = arm + [math.degrees(q) for q in (j4, j5, j6)]
    found = [q + 360 * round((before - q) / 360) for q, before in zip(found, near)]
    back = forward(found)
    assert all(abs(back[i][k] - t[i][k]) < 1e-6 for i in range(3) for k in range(4)), "forward gives the pose back"
    assert abs(found[4]) > 15 and abs(found[2] + math.degrees(rise) + 90 + found[1]) > 10, "away from singularities"
    return found


def config(j):
    turns = [math.floor((j[i] + 180) / 360) for i in (0, 3, 5)]
    return "%s U T, %d, %d, %d" % ("F" if j[4] >= 0 else "N", *turns)


def number(value, width=10):
    """As controllers print: width 10, three decimals, no zero before the point."""
    text = "%.3f" % value
    text = text.replace("0.", ".", 1) if text.lstrip("-").startswith("0.") and float(text) != 0 else text
    return ("0.000" if float(text) == 0 else text).rjust(width)


def point(index, values, flags, uf, ut, name=None):
    head = "P[%d]{" % index if name is None else 'P[%d:"%s"]{' % (index, name)
    x, y, z, w, p, r = (number(value) for value in values)
    return [head, "   GP1:", "\tUF : %d, UT : %d,\t\tCONFIG : '%s'," % (uf, ut, flags),
            "\tX =%s  mm,\tY =%s  mm,\tZ =%s  mm," % (x, y, z), "\tW =%s deg,\tP =%s deg,\tR =%s deg" % (w, p, r), "};"]


def path():
    """Tool poses in the frame: the tool axis points into the dome, and the tool turns about it."""
    for k in range(COUNT):
        share = k / (COUNT - 1)
        angle = 360.0 * RINGS * share
        radius = RADIUS_MM * (1 - 0.9 * share)
        lean = 18.0 * radius / RADIUS_MM
        z = HEIGHT_MM * (1 - (radius / RADIUS_MM) ** 2)
        x, y = radius * math.cos(math.radians(angle)), radius * math.sin(math.radians(angle))
        t = mul(turn(2, angle), mul(turn(1, lean), turn(2, -angle)))
        t = mul(mul(t, turn(0, 180)), turn(2, -190.0 * share))
        t[0][3], t[1][3], t[2][3] = x, y, z
        yield t


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "in")
    lines, points, near = [], [], (0, 0, 0, 0, -90, 0)
    text = ["UTOOL_NUM=2", "UFRAME_NUM=3"]
    index = 1
    poses = list(path())
    for t in poses:
        near = joints(mul(mul(pose(FRAME), t), inv(pose(TOOL))), False, near)
        points += point(index, xyzwpr(t), config(near), 3, 2)
        index += 1
    rows = ["  %s ;" % line for line in text] + ["J P[1] 20% FINE ;"]
    k = 2
    while k <= COUNT:
        if k % 60 == 0 and k < COUNT:
            rows.append("C P[%d]\n    :  P[%d] 60mm/sec CNT50 ;" % (k, k + 1))
            k += 2
        else:
            rows.append("L P[%d] 60mm/sec %s ;" % (k, "FINE" if k == COUNT else "CNT50"))
            k += 1
    lines = ["/PROG  DOME", "/ATTR", "OWNER\t\t= MNEDITOR;", 'COMMENT\t\t= "DOME";', "PROG_SIZE\t= 0;",
             "LINE_COUNT\t= %d;" % len(rows), "PROTECT\t\t= READ_WRITE;", "DEFAULT_GROUP\t= 1,*,*,*,*;",
             "CONTROL_CODE\t= 00000000 00000000;", "/APPL", "/MN"]
    lines += ["%4d:%s" % (n + 1, row) for n, row in enumerate(rows)]
    lines += ["/POS"] + points + ["/END"]
    with open(os.path.join(folder, "DOME.LS"), "w", newline="\n") as out:
        out.write("\n".join(lines) + "\n")

    def row(values, name):
        return " ".join("%8.1f" % value for value in values) + " " + name
    zero = [0.0] * 6
    table = ["F Number: F000000", "$VERSION: V9.30126", "", "Tool Frame", row(zero, ""), row(TOOL, "SPINDLE"), row(zero, ""), "",
             "Jog Frame", row(zero, ""), "", "User Frame", row(zero, ""), row(zero, ""), row(FRAME, "DOME"), ""]
    with open(os.path.join(folder, "FRAME.DG"), "w", newline="\r\n") as out:
        out.write("\n".join(table))


if __name__ == "__main__":
    main()
