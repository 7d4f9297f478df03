"""The data of docs/measuring.md: a cell with known truth and noise of 0.03 to 0.05 mm. Only the standard library."""

import math
import pathlib
import random

HERE = pathlib.Path(__file__).parent
random.seed(7)


def turn(axis, a):
    c, s = math.cos(a), math.sin(a)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    m = [[float(r == k) for k in range(3)] for r in range(3)]
    m[i][i] = m[j][j] = c
    m[i][j], m[j][i] = -s, s
    return m


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def place(r, t, p, noise=0.0):
    return [sum(r[i][k] * p[k] for k in range(3)) + t[i] + random.gauss(0, noise) for i in range(3)]


def write(name, header, rows):
    text = header + "\n" + "".join(",".join(v if isinstance(v, str) else f"{v:.4f}" for v in row) + "\n" for row in rows)
    (HERE / name).write_text(text)


R = times(times(turn(0, 0.010), turn(1, -0.015)), turn(2, 0.030))
T = [8.0, -5.0, 4.0]
corners = [(250, -100, 200), (450, -100, 200), (450, 150, 200), (250, 150, 200), (350, 0, 300), (300, 100, 260), (420, 30, 250), (270, -50, 240)]
write("nominal.csv", "id,x_mm,y_mm,z_mm", [[f"p{i + 1}", *p] for i, p in enumerate(corners)])
probed = [place(R, T, p, 0.05) for p in corners]
write("probed.csv", "id,x_mm,y_mm,z_mm", [[f"p{i + 1}", *p] for i, p in enumerate(probed)])
probed[5][2] += 1.2
write("touched.csv", "id,x_mm,y_mm,z_mm", [[f"p{i + 1}", *p] for i, p in enumerate(probed)])

# two spheres and a plane, touched with a ball of 2 mm radius
spheres = [("s1", (260, -80, 215), 15.0), ("s2", (440, 140, 215), 15.0)]
rows, touches = [], []
for name, c, radius in spheres:
    rows.append([name, "sphere", *map(float, c), "", "", "", radius])
    for k in range(7):
        a, b = 0.9 * k, 0.2 + 0.19 * k
        d = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b))
        touches.append([name, *place(R, T, [c[i] + (radius + 2.0) * d[i] for i in range(3)], 0.03)])
rows.append(["top", "plane", 350.0, 0.0, 200.0, 0.0, 0.0, 1.0, ""])
for x, y in [(300, -60), (420, -40), (330, 120), (410, 90), (360, 20)]:
    touches.append(["top", *place(R, T, [x, y, 202.0], 0.03)])
write("features.csv", "id,feature,x_mm,y_mm,z_mm,nx,ny,nz,radius_mm", rows)
write("touches.csv", "id,x_mm,y_mm,z_mm", touches)

# 3-2-1 with the same ball: above z, before y, left of x
datum = [(1, (50, 40, 2)), (1, (250, 50, 2)), (1, (150, 160, 2)), (2, (40, -2, -20)), (2, (260, -2, -20)), (3, (-2, 90, -20))]
write("datums.csv", "datum,x_mm,y_mm,z_mm", [[str(d), *place(times(R, turn(2, 0.5)), [400, -100, 200], p, 0.02)] for d, p in datum])


def height(u, v):
    return 40 * math.sin(u / 90) * math.cos(v / 70) + 0.1 * u


def cloud(count, move):
    for _ in range(count):
        u, v = random.uniform(0, 400), random.uniform(0, 250)
        p = [u, v, height(u, v)]
        yield place(R, T, p, 0.05) if move else [c + random.gauss(0, 0.05) for c in p]


write("drawing.csv", "x_mm,y_mm,z_mm", cloud(2500, False))
write("scan.csv", "x_mm,y_mm,z_mm", cloud(2500, True))

B, L = [300.01, 299.98, 300.02], [150.01, 149.99, 150.0]
names = "design,b12_mm,b23_mm,b31_mm,t12_mm,t23_mm,t31_mm,r11_mm,r21_mm,r31_mm,r12_mm,r22_mm,r23_mm,mode"
rows = []
for design, mode in [("123/123", "1"), ("123/123", "3"), ("231/123", "2")]:
    rows.append([design, *B, *L, *[300 + random.uniform(-0.8, 0.8) for _ in range(6)], mode])
write("lengths.csv", names, rows)
x = (B[0] ** 2 + B[2] ** 2 - B[1] ** 2) / (2 * B[0])
balls = [(0, 0, 0), (B[0], 0, 0), (x, math.sqrt(B[2] ** 2 - x * x), 0)]
write("taught.csv", "x_mm,y_mm,z_mm", [place(turn(2, 0.4), [220, -180, 60], p, 0.2) for p in balls])
(HERE / "program.mod").write_text(
    "MODULE Part\n"
    "  PERS tooldata artifact:=[TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n"
    "  PROC main()\n"
    "    MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n"
    "    MoveL [[300.00,0.00,260.00],[0.0,1.0,0.0,0.0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n"
    "    MoveL [[380.00,50.00,260.00],[0.0,1.0,0.0,0.0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n"
    "  ENDPROC\nENDMODULE\n"
)
