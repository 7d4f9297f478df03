"""Writes in/dome.script: 480 points on a dome, milled in rings by a UR5. Plain Python, the same bytes every time.

The poses are in the robot's base. The path starts from a joint target above the dome; the nominal kinematics of the robot
tells that pose, and that every point is within reach.
"""
import math
import os

RINGS, POINTS = 12, 40
RADIUS_M, HEIGHT_M = 0.09, 0.02
CENTRE_M = (-0.42, -0.18, 0.08)
TOOL_M = 0.162
START_DEG = (8.0, -87.0, -112.0, -71.0, 90.0, 20.0)
# the maker's table: d, a, alpha in degrees
TABLE = [(0.089159, 0, 90), (0, -0.425, 0), (0, -0.39225, 0), (0.10915, 0, 90), (0.09465, 0, -90), (0.0823, 0, 0)]


def mul(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def tool_at(joints_deg):
    t = [[float(i == j) for j in range(4)] for i in range(4)]
    for q, (d, a, alpha) in zip(joints_deg, TABLE):
        s, c = math.sin(math.radians(q)), math.cos(math.radians(q))
        sa, ca = math.sin(math.radians(alpha)), math.cos(math.radians(alpha))
        t = mul(t, [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])
    return mul(t, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, TOOL_M], [0, 0, 0, 1]])


def rotation_vector(t):
    m = t
    w = math.sqrt(max(0, 1 + m[0][0] + m[1][1] + m[2][2])) / 2
    x = math.copysign(math.sqrt(max(0, 1 + m[0][0] - m[1][1] - m[2][2])) / 2, m[2][1] - m[1][2])
    y = math.copysign(math.sqrt(max(0, 1 - m[0][0] + m[1][1] - m[2][2])) / 2, m[0][2] - m[2][0])
    z = math.copysign(math.sqrt(max(0, 1 - m[0][0] - m[1][1] + m[2][2])) / 2, m[1][0] - m[0][1])
    n = math.sqrt(x * x + y * y + z * z)
    angle = 2 * math.atan2(n, w)
    return [angle * v / n for v in (x, y, z)]


def looking(down, along):
    """Rotation with z along `down` and x near `along`, columns as a pose without place."""
    k = sum(a * d for a, d in zip(along, down))
    x = [a - k * d for a, d in zip(along, down)]
    n = math.sqrt(sum(v * v for v in x))
    x = [v / n for v in x]
    y = [down[(i + 1) % 3] * x[(i + 2) % 3] - down[(i + 2) % 3] * x[(i + 1) % 3] for i in range(3)]
    return [[x[i], y[i], down[i], 0.0] for i in range(3)] + [[0, 0, 0, 1]]


def pose(place, turn):
    numbers = list(place) + rotation_vector(turn)
    return "p[" + ", ".join(f"{v + 0.0:.6f}" for v in numbers) + "]"


def point(k):
    """Spiral out over the dome; the tool leans with the surface."""
    part = (k + 1) / (RINGS * POINTS)
    angle, radius = 2 * math.pi * k / POINTS, RADIUS_M * part
    ball = (RADIUS_M**2 + HEIGHT_M**2) / (2 * HEIGHT_M)
    rise = math.sqrt(ball**2 - radius**2) - ball + HEIGHT_M
    place = (CENTRE_M[0] + radius * math.cos(angle), CENTRE_M[1] + radius * math.sin(angle), CENTRE_M[2] + rise)
    lean = radius / ball
    down = (-lean * math.cos(angle), -lean * math.sin(angle), -math.sqrt(1 - lean**2))
    return place, looking(down, START_X)


START = tool_at(START_DEG)
START_X = [START[i][0] for i in range(3)]


def main():
    lines = [
        "# dome.nc",
        "def dome():",
        f"  set_tcp(p[0.000000, 0.000000, {TOOL_M:.6f}, 0.000000, 0.000000, 0.000000])",
        "  set_payload(0.9, [0, 0, 0.05])",
        "  movej([" + ", ".join(f"{math.radians(q):.6f}" for q in START_DEG) + "], a=1.4, v=1.05)",
    ]
    first, turn = point(0)
    lines.append(f"  movel({pose((first[0], first[1], first[2] + 0.03), turn)}, a=1.2, v=0.25)")
    for k in range(RINGS * POINTS):
        place, turn = point(k)
        reach = math.sqrt(place[0] ** 2 + place[1] ** 2 + (place[2] + TOOL_M + 0.0823 - 0.089) ** 2)
        assert 0.25 < reach < 0.75, place
        lines.append(f"  movep({pose(place, turn)}, a=1.2, v=0.05, r=0.001)")
    last, turn = point(RINGS * POINTS - 1)
    lines += [f"  movel({pose((last[0], last[1], last[2] + 0.05), turn)}, a=1.2, v=0.25)", "end"]
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "in")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "dome.script"), "wb") as file:
        file.write("\n".join(lines).encode())


main()
