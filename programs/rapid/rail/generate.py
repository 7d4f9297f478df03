"""Writes the samples with external axes: rapid/rail, rapid/positioner, krl/rail, krl/positioner. Plain Python, the same bytes every time.

A beam is milled along a rail of 3 m, and a seam is welded around a pipe on a positioner that keeps the seam on top.
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))


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


def angles(t):
    """A B C of Rz(A) Ry(B) Rx(C)."""
    b = math.atan2(-t[2][0], math.hypot(t[0][0], t[1][0]))
    return [math.degrees(x) for x in (math.atan2(t[1][0], t[0][0]), b, math.atan2(t[2][1], t[2][2]))]


def quaternion(t):
    a, b, c = [math.radians(x) / 2 for x in angles(t)]
    (sa, ca), (sb, cb), (sc, cc) = [(math.sin(x), math.cos(x)) for x in (a, b, c)]
    q = [ca * cb * cc + sa * sb * sc, ca * cb * sc - sa * sb * cc, ca * sb * cc + sa * cb * sc, sa * cb * cc - ca * sb * sc]
    return q if q[0] >= 0 else [-x for x in q]


def tool_at(x, y, z, tilt, lead):
    """A tool that points down, tilted about x and y of the world."""
    return mul(turn(0, 180 + tilt, (x, y, z)), turn(1, lead))


def beam(reach):
    """Value of the rail, and the pose in the world."""
    for k in range(25):
        e = 150.0 + 110.0 * k
        yield e, tool_at(reach + e, 180.0 * math.sin(0.5 * k), 620.0 + 40.0 * math.cos(0.3 * k), 8.0 * math.sin(0.7 * k), 6.0 * math.cos(0.4 * k))


def seam(axis, radius):
    """Value of the positioner, and the pose on its plate."""
    for k in range(25):
        e = -170.0 + 14.0 * k
        top = tool_at(axis[0][3] + 20.0 * math.sin(0.3 * k), axis[1][3] - 200.0 + 15.0 * k, axis[2][3] + radius, 10.0 * math.cos(0.5 * k), 15.0)
        yield e, mul(inv(mul(axis, turn(2, e))), top)


def rapid(name, data, moves):
    text = "MODULE %s\n    PERS tooldata tMill:=[TRUE,[[0,0,180],[1,0,0,0]],[4.5,[0,0,90],[1,0,0,0],0,0,0]];\n%s\n    PROC main()\n%s    ENDPROC\nENDMODULE\n" % (name, data, moves)
    return text.replace("\n", "\r\n")


def robtarget(pose, eax):
    return "[[%s],[%s],[0,0,0,0],[%s]]" % (",".join("%.3f" % pose[i][3] for i in range(3)), ",".join("%.6f" % x for x in quaternion(pose)), eax)


def e6pos(pose, e):
    a, b, c = angles(pose)
    return "{X %.3f,Y %.3f,Z %.3f,A %.4f,B %.4f,C %.4f%s}" % (pose[0][3], pose[1][3], pose[2][3], a, b, c, e)


def write(path, text):
    path = os.path.join(TOP, path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as out:
        out.write(text)


def main():
    eax = "%.2f,9E9,9E9,9E9,9E9,9E9"
    moves = "        ConfJ\\Off;\n        ConfL\\Off;\n        MoveAbsJ [[0,10,20,0,60,0],[%s]]\\NoEOffs,v500,z50,tMill;\n" % (eax % 150)
    for e, pose in beam(1100.0):
        moves += "        %s %s,v60,z1,tMill\\WObj:=wobj0;\n" % ("MoveL" if "wobj0" in moves else "MoveJ", robtarget(pose, eax % e))
    write("rapid/rail/in/Beam.mod", rapid("Beam", "", moves))
    pipe = turn(0, -90, (1250, 100, 560))
    eax = "9E9,%.2f,9E9,9E9,9E9,9E9"
    data = '    ! the user frame is that of the unit\n    PERS wobjdata wPipe:=[FALSE,FALSE,"STN1",[[1250,100,560],[0.707106781,-0.707106781,0,0]],[[0,0,0],[1,0,0,0]]];'
    moves = "        ConfJ\\Off;\n        ConfL\\Off;\n        ActUnit STN1;\n        MoveAbsJ [[0,10,20,0,60,0],[%s]]\\NoEOffs,v500,z50,tMill;\n" % (eax % -170)
    for e, pose in seam(pipe, 160.0):
        moves += "        %s %s,v20,z1,tMill\\WObj:=wPipe;\n" % ("MoveL" if "wPipe" in moves else "MoveJ", robtarget(pose, eax % e))
    write("rapid/positioner/in/Pipe.mod", rapid("Pipe", data, moves))
    head = "DEF %s ( )\n; written by an offline system\n$TOOL={X 0,Y 0,Z 310,A 0,B 60,C 0}\n"
    lines = head % "beam" + "$BASE=$WORLD\nPTP {A1 0,A2 -80,A3 100,A4 0,A5 40,A6 0,E1 150.0}\n"
    for e, pose in beam(1900.0):
        lines += "%s %s C_DIS\n" % ("LIN" if "C_DIS" in lines else "PTP", e6pos(mul(pose, turn(2, 180)), ",E1 %.2f" % e))
    write("krl/rail/in/beam.src", (lines + "END\n").replace("\n", "\r\n"))
    lines = head % "pipe" + "$BASE=EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,{X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0})\nPTP {A1 0,A2 -80,A3 100,A4 0,A5 40,A6 0,E1 -170.0}\n"
    for e, pose in seam(turn(0, -90, (2000, 100, 700)), 160.0):
        lines += "%s %s C_DIS\n" % ("LIN" if "C_DIS" in lines else "PTP", e6pos(mul(pose, turn(2, 180)), ",E1 %.2f" % e))
    write("krl/positioner/in/pipe.src", (lines + "END\n").replace("\n", "\r\n"))


if __name__ == "__main__":
    main()
