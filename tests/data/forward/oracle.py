"""Reference values for the forward model, the gravity torques and the compensated joints.

A small, slow, plain simulator in 50 digit arithmetic. It writes, next to itself,

    <case>.profile.yaml  <case>.joints.csv  <case>.expected.csv     one triple a case, listed in cases.csv
    inverse_irb120_thesis.csv                                       wanted pose -> joints -> fake target

and checks every row against a second formulation before it writes anything. See ORIGIN.md.

    python oracle.py                          regenerate all files
    python oracle.py --force-at real-tool     the other reading of "external force at the tool" (see ORIGIN.md)
"""

import argparse
import os
import random

from mpmath import mp, mpf, cos, sin, sqrt, pi, expj, nstr, lu_solve, matrix

mp.dps = 50
HERE = os.path.dirname(os.path.abspath(__file__))
FORCE_AT = "nominal-tool"
POSE_KEYS = ["x_mm", "y_mm", "z_mm", "rx_deg", "ry_deg", "rz_deg"]


# ---------------------------------------------------------------- numbers
# A number in a file is the decimal that is printed there, exactly.

def num(x):
    return x if isinstance(x, mpf) else mpf(repr(x))


def mm(x):
    return num(x) / 1000


def deg(x):
    return num(x) * pi / 180


# ---------------------------------------------------------------- 4x4 homogeneous matrices, metres and radians

def mul(*ms):
    out = ms[0]
    for m in ms[1:]:
        out = [[sum(out[r][k] * m[k][c] for k in range(4)) for c in range(4)] for r in range(4)]
    return out


def trans(x, y, z):
    return [[mpf(1), mpf(0), mpf(0), x], [mpf(0), mpf(1), mpf(0), y], [mpf(0), mpf(0), mpf(1), z],
            [mpf(0), mpf(0), mpf(0), mpf(1)]]


def rot_x(t):
    c, s, o, i = cos(t), sin(t), mpf(0), mpf(1)
    return [[i, o, o, o], [o, c, -s, o], [o, s, c, o], [o, o, o, i]]


def rot_y(t):
    c, s, o, i = cos(t), sin(t), mpf(0), mpf(1)
    return [[c, o, s, o], [o, i, o, o], [-s, o, c, o], [o, o, o, i]]


def rot_z(t):
    c, s, o, i = cos(t), sin(t), mpf(0), mpf(1)
    return [[c, -s, o, o], [s, c, o, o], [o, o, i, o], [o, o, o, i]]


def pose(p):
    """{x_mm, y_mm, z_mm, rx_deg, ry_deg, rz_deg} or {x_mm, y_mm, z_mm, quaternion: [w, x, y, z]}"""
    t = trans(mm(p["x_mm"]), mm(p["y_mm"]), mm(p["z_mm"]))
    if "quaternion" in p:
        w, x, y, z = [num(v) for v in p["quaternion"]]
        n = sqrt(w * w + x * x + y * y + z * z)
        w, x, y, z = w / n, x / n, y / n, z / n
        o = mpf(0)
        return mul(t, [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), o],
                       [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), o],
                       [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), o],
                       [o, o, o, mpf(1)]])
    return mul(t, rot_x(deg(p["rx_deg"])), rot_y(deg(p["ry_deg"])), rot_z(deg(p["rz_deg"])))


def inverse(m):
    r = [[m[c][k] for c in range(3)] for k in range(3)]
    t = [-sum(r[k][c] * m[c][3] for c in range(3)) for k in range(3)]
    return [r[0] + [t[0]], r[1] + [t[1]], r[2] + [t[2]], [mpf(0), mpf(0), mpf(0), mpf(1)]]


def apply(m, p):
    return [m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3] for r in range(3)]


def origin(m):
    return [m[0][3], m[1][3], m[2][3]]


def z_axis(m):
    return [m[0][2], m[1][2], m[2][2]]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def quaternion(m):
    """unit quaternion of the rotation, first non-zero component positive"""
    xx, yy, zz = m[0][0], m[1][1], m[2][2]
    four = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz]  # 4 w^2, 4 x^2, 4 y^2, 4 z^2
    k = four.index(max(four))
    a, b, c = m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]                # 4wx, 4wy, 4wz
    d, e, f = m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]                # 4xy, 4xz, 4yz
    q = [[four[0], a, b, c], [a, four[1], d, e], [b, d, four[2], f], [c, e, f, four[3]]][k]
    n = sqrt(dot(q, q))
    q = [v / n for v in q]
    lead = next(v for v in q if abs(v) > mpf("1e-40"))
    return [-v for v in q] if lead < 0 else q


# ---------------------------------------------------------------- the model

def effects(profile, name):
    return [e for e in profile["calibration"]["effects"] if e["effect"] == name]


def commanded(profile, q):
    """u: the commanded angle of each joint, controller's sense, radians; q in radians"""
    u = list(q)
    for c in profile["kinematics"]["coupling"]:
        u[c["joint"] - 1] += num(c["ratio"]) * q[c["on"] - 1]
    return u


def dh_angles(profile, u):
    return [j.get("sign", 1) * u[i] + deg(j.get("offset_deg", 0))
            for i, j in enumerate(profile["kinematics"]["joints"])]


def link_frames(profile, m, calibrated):
    """world_from_frame_i, i = 1..6, for the angles m that enter the chain"""
    t = pose(profile["kinematics"]["base"])
    if calibrated:
        for e in effects(profile, "base_frame"):
            t = mul(t, pose({k: e.get(k, 0) for k in POSE_KEYS}))
    frames = []
    for i, j in enumerate(profile["kinematics"]["joints"]):
        alpha, a, beta = deg(j["alpha_deg"]), mm(j["a_mm"]), mpf(0)
        theta, d = deg(j["theta_deg"]), mm(j["d_mm"])
        if calibrated:
            for e in effects(profile, "link_geometry"):
                if e["link"] == i + 1:
                    alpha += deg(e.get("alpha_deg", 0))
                    a += mm(e.get("a_mm", 0))
                    beta += deg(e.get("beta_deg", 0))
                    theta += deg(e.get("theta_deg", 0))
                    d += mm(e.get("d_mm", 0))
        o = mpf(0)
        t = mul(t, rot_x(alpha), trans(a, o, o), rot_y(beta), rot_z(theta + m[i]), trans(o, o, d))
        frames.append(t)
    return frames


def flange_from_tool(profile, tool, calibrated):
    t = pose(profile["tools"][tool]["frame"])
    if calibrated:
        for e in effects(profile, "tool_frame"):
            if e.get("tool", tool) == tool:
                t = mul(t, pose({k: e.get(k, 0) for k in POSE_KEYS}))
    return t


def controller_forward(profile, tool, q):
    m = dh_angles(profile, commanded(profile, q))
    return mul(link_frames(profile, m, False)[5], pose(profile["kinematics"]["flange"]),
               flange_from_tool(profile, tool, False))


def torques(profile, tool, q, force):
    """torque on each joint in the controller's sense, N m"""
    frames = link_frames(profile, dh_angles(profile, commanded(profile, q)), True)
    flange = mul(frames[5], pose(profile["kinematics"]["flange"]))
    g = [num(v) for v in profile["gravity_m_s2"]]
    loads = []                                                       # link, point in the world, force in the world
    for b in profile["bodies"]:
        c = apply(frames[b["link"] - 1], [mm(v) for v in b["cog_mm"]])
        loads.append((b["link"], c, [num(b["mass_kg"]) * v for v in g]))
    t = profile["tools"][tool]
    c = apply(flange, [mm(v) for v in t["cog_mm"]])
    loads.append((6, c, [num(t["mass_kg"]) * v for v in g]))
    p = origin(mul(flange, flange_from_tool(profile, tool, FORCE_AT == "real-tool")))
    loads.append((6, p, [num(v) for v in force]))
    tau = []
    for i in range(6):
        total = mpf(0)
        for link, point, f in loads:
            if link >= i + 1:
                total += dot(cross(sub(point, origin(frames[i])), f), z_axis(frames[i]))
        tau.append(profile["kinematics"]["joints"][i].get("sign", 1) * total)
    return tau


def joint_deltas(profile, u, tau, direction):
    delta = [mpf(0)] * 6
    for e in effects(profile, "joint_scale"):
        delta[e["joint"] - 1] += num(e["ratio"]) * u[e["joint"] - 1]
    for e in effects(profile, "joint_compliance"):
        delta[e["joint"] - 1] += num(e["rad_per_n_m"]) * tau[e["joint"] - 1]
    for e in effects(profile, "joint_harmonic"):
        a = e["order"] * u[e["joint"] - 1]
        delta[e["joint"] - 1] += deg(e.get("cos_deg", 0)) * cos(a) + deg(e.get("sin_deg", 0)) * sin(a)
    for e in effects(profile, "backlash"):
        delta[e["joint"] - 1] += deg(e["width_deg"]) / 2 * direction[e["joint"] - 1]
    for e in effects(profile, "joint_coupling"):
        delta[e["joint"] - 1] += num(e["ratio"]) * u[e["on"] - 1]
    return delta


def real_forward(profile, tool, q, direction=(0,) * 6, force=(0, 0, 0)):
    """pose of the real tool in the world, torques, joint deltas"""
    u = commanded(profile, q)
    tau = torques(profile, tool, q, force)
    delta = joint_deltas(profile, u, tau, direction)
    m = dh_angles(profile, [a + b for a, b in zip(u, delta)])
    t = mul(link_frames(profile, m, True)[5], pose(profile["kinematics"]["flange"]),
            flange_from_tool(profile, tool, True))
    return t, tau, delta


# ---------------------------------------------------------------- second formulation, used only to check the first
# Rigid motions are (unit quaternion, vector); the arm is a product of screw motions about its axes at m = 0;
# torques are the derivative of the potential energy; joint deltas are a matrix times q plus harmonics as complex numbers.

def qmul(a, b):
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def qturn(q, v):
    w = qmul(qmul(q, (mpf(0), *v)), (q[0], -q[1], -q[2], -q[3]))
    return list(w[1:])


def qaxis(axis, angle):
    h = angle / 2
    return (cos(h), *(sin(h) * v for v in axis))


def then(a, b):
    return qmul(a[0], b[0]), [x + y for x, y in zip(a[1], qturn(a[0], b[1]))]


X, Y, Z, NIL = (1, 0, 0), (0, 1, 0), (0, 0, 1), [mpf(0)] * 3
ONE = (mpf(1), mpf(0), mpf(0), mpf(0))


def motion(p):
    t = [mm(p.get(k, 0)) for k in ("x_mm", "y_mm", "z_mm")]
    if "quaternion" in p:
        w = [num(v) for v in p["quaternion"]]
        return tuple(v / sqrt(dot(w, w)) for v in w), t
    r = [deg(p.get(k, 0)) for k in ("rx_deg", "ry_deg", "rz_deg")]
    return qmul(qmul(qaxis(X, r[0]), qaxis(Y, r[1])), qaxis(Z, r[2])), t


class Screws:
    def __init__(self, profile, tool, calibrated):
        kin = profile["kinematics"]
        cal = profile["calibration"]["effects"] if calibrated else []
        at = motion(kin["base"])
        for e in cal:
            if e["effect"] == "base_frame":
                at = then(at, motion(e))
        self.axes, self.home = [], []
        for i, row in enumerate(kin["joints"], 1):
            extra = [e for e in cal if e["effect"] == "link_geometry" and e["link"] == i]
            v = {k: num(row.get(k, 0)) + sum(num(e.get(k, 0)) for e in extra)
                 for k in ("alpha_deg", "a_mm", "beta_deg", "theta_deg", "d_mm")}
            tilt = qaxis(X, v["alpha_deg"] * pi / 180)
            at = then(at, (tilt, [v["a_mm"] / 1000, mpf(0), mpf(0)]))
            at = then(at, (qaxis(Y, v["beta_deg"] * pi / 180), NIL))
            self.axes.append((qturn(at[0], Z), at[1]))
            at = then(at, (qaxis(Z, v["theta_deg"] * pi / 180), NIL))
            at = then(at, (ONE, [mpf(0), mpf(0), v["d_mm"] / 1000]))
            self.home.append(at)
        self.flange = then(at, motion(kin["flange"]))
        self.tool = then(self.flange, motion(profile["tools"][tool]["frame"]))
        self.force_point = self.tool[1]
        for e in cal:
            if e["effect"] == "tool_frame" and e.get("tool", tool) == tool:
                self.tool = then(self.tool, motion(e))
        if FORCE_AT == "real-tool":
            self.force_point = self.tool[1]

    def move(self, m, link, home):
        for (w, p), angle in reversed(list(zip(self.axes, m))[:link]):
            r = qaxis(w, angle)
            home = then((r, sub(p, qturn(r, p))), home)
        return home


def check_row(profile, tool, q, direction, force, got_controller, got):
    joints = profile["kinematics"]["joints"]
    mix = [[mpf(r == c) for c in range(6)] for r in range(6)]
    for c in profile["kinematics"]["coupling"]:
        mix[c["joint"] - 1][c["on"] - 1] += num(c["ratio"])
    u = [dot(row, q) for row in mix]
    signs = [j.get("sign", 1) for j in joints]
    start = [s * a + deg(j.get("offset_deg", 0)) for s, a, j in zip(signs, u, joints)]

    nominal = Screws(profile, tool, False)
    compare(got_controller, nominal.move(start, 6, nominal.tool))

    arm = Screws(profile, tool, True)
    g = [num(v) for v in profile["gravity_m_s2"]]
    f = [num(v) for v in force]
    t = profile["tools"][tool]

    def energy(m):
        total = mpf(0)
        for b in profile["bodies"]:
            at = then(arm.home[b["link"] - 1], (ONE, [mm(v) for v in b["cog_mm"]]))
            total -= num(b["mass_kg"]) * dot(g, arm.move(m, b["link"], at)[1])
        at = then(arm.flange, (ONE, [mm(v) for v in t["cog_mm"]]))
        total -= num(t["mass_kg"]) * dot(g, arm.move(m, 6, at)[1])
        return total - dot(f, arm.move(m, 6, (ONE, arm.force_point))[1])

    h = mpf("1e-15")
    tau = []
    for i in range(6):
        up, down = list(start), list(start)
        up[i] += signs[i] * h
        down[i] -= signs[i] * h
        tau.append(-(energy(up) - energy(down)) / (2 * h))
    assert max(abs(a - b) for a, b in zip(tau, got[1])) < mpf("1e-25"), "torques disagree"

    gain = [[mpf(0)] * 6 for _ in range(6)]
    rest = [mpf(0)] * 6
    for e in profile["calibration"]["effects"]:
        j = e.get("joint", 0) - 1
        if e["effect"] in ("joint_scale", "joint_coupling"):
            gain[j][e.get("on", e["joint"]) - 1] += num(e["ratio"])
        elif e["effect"] == "joint_compliance":
            rest[j] += num(e["rad_per_n_m"]) * got[1][j]
        elif e["effect"] == "joint_harmonic":
            wave = mp.mpc(num(e.get("cos_deg", 0)), -num(e.get("sin_deg", 0))) * expj(e["order"] * u[j])
            rest[j] += wave.real * pi / 180
        elif e["effect"] == "backlash":
            rest[j] += {-1: -1, 0: 0, 1: 1}[direction[j]] * num(e["width_deg"]) * pi / 360
    delta = [dot(row, u) + r for row, r in zip(gain, rest)]
    assert max(abs(a - b) for a, b in zip(delta, got[2])) < mpf("1e-40"), "joint deltas disagree"

    m = [a + s * b for a, s, b in zip(start, signs, delta)]
    compare(got[0], arm.move(m, 6, arm.tool))


def compare(m, motion_):
    q, t = motion_
    assert max(abs(a - b) for a, b in zip(origin(m), t)) < mpf("1e-40"), "positions disagree"
    p = quaternion(m)
    assert min(max(abs(a - s * b) for a, b in zip(p, q)) for s in (1, -1)) < mpf("1e-40"), "orientations disagree"


# ---------------------------------------------------------------- inverse: Newton on the real model

def residual(wanted, t):
    """position (m) and small rotation (2 x vector part of the quaternion) of wanted * t^-1"""
    e = mul(wanted, inverse(t))
    q = quaternion(e)
    s = 1 if q[0] >= 0 else -1
    return sub(origin(wanted), origin(t)) + [2 * s * v for v in q[1:]]


def solve(profile, tool, wanted, q):
    q = list(q)
    h = mpf("1e-20")
    for _ in range(12):
        t = real_forward(profile, tool, q)[0]
        r = residual(wanted, t)
        if max(abs(v) for v in r) < mpf("1e-35"):
            return q
        jac = matrix(6, 6)
        for c in range(6):
            p = list(q)
            p[c] += h
            s = residual(wanted, real_forward(profile, tool, p)[0])
            for k in range(6):
                jac[k, c] = (s[k] - r[k]) / h
        step = lu_solve(jac, matrix([-v for v in r]))
        q = [a + b for a, b in zip(q, step)]
    raise RuntimeError("no convergence")


# ---------------------------------------------------------------- writing

def text(x):
    if isinstance(x, (str, int)):
        return str(x)
    x = num(x)
    return "0" if abs(x) < mpf("1e-38") else nstr(x, 17)


def flow(v):
    if isinstance(v, dict):
        return "{" + ", ".join(f"{k}: {flow(w)}" for k, w in v.items()) + "}"
    if isinstance(v, list):
        return "[" + ", ".join(flow(w) for w in v) + "]"
    if isinstance(v, float):
        s = repr(v)
        return s if "e" not in s or "." in s else s.replace("e", ".0e")
    return str(v)


def profile_text(p):
    k = p["kinematics"]
    out = ["poseshift: profile/1", f"robot: {flow(p['robot'])}", f"controller: {flow(p['controller'])}",
           "kinematics:", f"  base: {flow(k['base'])}", "  joints:"]
    out += [f"    - {flow(j)}" for j in k["joints"]]
    out += [f"  coupling: {flow(k['coupling'])}", f"  flange: {flow(k['flange'])}", "bodies:"]
    out += [f"  - {flow(b)}" for b in p["bodies"]]
    out += [f"gravity_m_s2: {flow(p['gravity_m_s2'])}", "tools:"]
    out += [f"  {name}: {flow(t)}" for name, t in p["tools"].items()]
    out += ["calibration:", "  effects:"]
    out += [f"    - {flow(e)}" for e in p["calibration"]["effects"]]
    return "\n".join(out) + "\n"


def csv_text(header, rows):
    return "\n".join([",".join(header)] + [",".join(text(v) for v in r) for r in rows]) + "\n"


def pose_cells(m):
    return [1000 * v for v in origin(m)] + quaternion(m)


def names(pattern):
    return [pattern.format(i) for i in range(1, 7)]


def pose_names(prefix):
    return [prefix + n for n in ("x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz")]


def to_deg(v):
    return v * 180 / pi


# ---------------------------------------------------------------- robots

def xyz(x, y, z, rx=0, ry=0, rz=0):
    return dict(zip(POSE_KEYS, (x, y, z, rx, ry, rz)))


def joint_rows(alpha, a, theta, d, limits, extra=None):
    rows = [dict(alpha_deg=alpha[i], a_mm=a[i], theta_deg=theta[i], d_mm=d[i], min_deg=limits[i][0],
                 max_deg=limits[i][1]) for i in range(6)]
    for i, more in (extra or {}).items():
        rows[i - 1].update(more)
    return rows


def make_profile(manufacturer, model, joints, bodies, tools, base=None, coupling=None, flange=None, gravity=None):
    return {"robot": {"manufacturer": manufacturer, "model": model, "serial": '"0"'},
            "controller": {"language": "rapid", "model": "nominal"},
            "kinematics": {"base": base or xyz(0, 0, 0), "joints": joints, "coupling": coupling or [],
                           "flange": flange or xyz(0, 0, 0)},
            "bodies": [dict(link=b[0], mass_kg=b[1], cog_mm=b[2]) for b in bodies],
            "gravity_m_s2": gravity or [0, 0, -9.81], "tools": tools, "calibration": {"effects": []}}


def with_effects(profile, *groups):
    return {**profile, "calibration": {"effects": [e for g in groups for e in g]}}


def each(effect, keys, *rows):
    return [dict([("effect", effect)] + list(zip(keys, r))) for r in rows]


def irb120(base=None):
    return make_profile(
        "ABB", "IRB 120-3/0.6",
        joint_rows([0, -90, 0, -90, 90, -90], [0, 0, 270, 70, 0, 0], [0, -90, 0, 0, 0, 180], [290, 0, 0, 302, 0, 72],
                   [(-165, 165), (-110, 110), (-110, 70), (-160, 160), (-120, 120), (-400, 400)]),
        [(2, 4.2, [140, 0, 0]), (4, 5, [0, 0, -193.6])],
        {"artifact": {"frame": xyz(50, 25, 100), "mass_kg": 2.6, "cog_mm": [-23, 0, 100]}}, base=base)


IRB_BASE = [{"effect": "base_frame", **xyz(-0.075, -0.096, 0.103, 0.003, 0.008, -0.033)}]
IRB_LINKS = each("link_geometry", ["link", "alpha_deg", "a_mm", "theta_deg", "d_mm"],
                 (2, -0.006, 0.134, 0.091, 0),
                 (3, -0.011, 0.236, 0.054, 0.006),
                 (4, -0.009, 0.138, -0.027, 0.246),
                 (5, -0.016, -0.061, 0.067, -0.067),
                 (6, 0.031, 0.022, -0.087, 0.050))
IRB_COMPLIANCE = each("joint_compliance", ["joint", "rad_per_n_m"],
                      (2, 3.2e-5), (3, 1.30e-4), (4, 6.05e-4), (5, 4.19e-4), (6, 6.47e-4))


def lrmate():
    return make_profile(
        "FANUC", "LR Mate 200iC",
        joint_rows([0, -90, 0, -90, 90, -90], [0, 75, 300, 75, 0, 0], [0, -90, 0, 0, 0, 0], [330, 0, 0, 320, 0, 80],
                   [(-170, 170), (-60, 140), (-70, 200), (-190, 190), (-120, 120), (-360, 360)], {3: {"sign": -1}}),
        [(2, 10, [150, 0, 0]), (4, 10, [0, 0, -160])],
        {"artifact": {"frame": xyz(35, -20, 140, 12, -34, 56), "mass_kg": 2.6, "cog_mm": [50, 25, 100]}},
        coupling=[{"joint": 3, "on": 2, "ratio": 1}])


def awkward():
    return make_profile(
        "Nobody", "Awkward-6",
        joint_rows([1.7, -88.3, 2.9, -91.45, 87.6, -93.21], [3.3, 61.7, 311.9, 82.45, 13.7, -9.85],
                   [4.1, -93.7, 8.25, -17.9, 33.3, 171.2], [402.6, -37.9, 24.3, 351.15, -41.3, 88.8],
                   [(-185, 185), (-95, 125), (-150, 80), (-200, 200), (-130, 130), (-350, 350)],
                   {2: {"sign": -1, "offset_deg": 12.5}, 3: {"offset_deg": -3.75}, 4: {"sign": -1},
                    6: {"sign": -1, "offset_deg": -27.3}}),
        [(2, 11.37, [143.1, -21.7, 33.9]), (4, 7.91, [-12.2, 18.6, -141.3])],
        {"gripper": {"frame": xyz(47.3, -28.9, 131.7, 21.4, -63.8, 118.6), "mass_kg": 3.17, "cog_mm": [-14.9, 8.3, 71.2]},
         "probe": {"frame": xyz(-8.1, 6.4, 212.5, -175.2, 11.9, -44.7), "mass_kg": 1.23, "cog_mm": [3.7, -5.1, 96.8]}},
        base=xyz(3120.75, -1877.4, 641.3, 17.3, -28.6, 131.9),
        coupling=[{"joint": 3, "on": 2, "ratio": 1}, {"joint": 5, "on": 4, "ratio": 0.125},
                  {"joint": 6, "on": 5, "ratio": -0.25}],
        flange={"x_mm": 4.6, "y_mm": -7.2, "z_mm": 19.4, "quaternion": [0.8, 0, 0.36, 0.48]},
        gravity=[0.317, -0.5213, -9.7894])


AWKWARD_EFFECTS = (
    [{"effect": "base_frame", **xyz(1.31, -2.17, 0.83, 0.121, -0.087, 0.243)},
     {"effect": "tool_frame", "tool": "gripper", **xyz(0.37, -0.52, 0.29, 0.31, -0.17, 0.44)}]
    + each("link_geometry", ["link", "alpha_deg", "a_mm", "theta_deg", "d_mm", "beta_deg"],
           (1, 0.031, -0.213, 0.047, 0.171, -0.019),
           (2, -0.043, 0.287, 0.116, -0.139, 0.027),
           (3, 0.052, -0.331, -0.083, 0.224, 0.071),
           (4, -0.018, 0.142, 0.094, -0.256, -0.033),
           (5, 0.064, -0.077, -0.121, 0.093, 0.012),
           (6, -0.029, 0.058, 0.137, 0.111, 0.045))
    + each("joint_scale", ["joint", "ratio"], (1, 2.3e-4), (2, -1.7e-4), (4, 3.1e-4), (6, -4.4e-4))
    + each("joint_compliance", ["joint", "rad_per_n_m"],
           (1, 1.1e-5), (2, 2.7e-5), (3, 4.9e-5), (4, 1.63e-4), (5, 2.11e-4), (6, 3.07e-4))
    + each("joint_harmonic", ["joint", "order", "cos_deg", "sin_deg"],
           (1, 1, 0.017, -0.023), (2, 2, -0.011, 0.019), (3, 1, 0.008, 0.013), (6, 1, 0.041, -0.036),
           (6, 2, -0.027, 0.015), (6, 14, 0.006, -0.009))
    + each("backlash", ["joint", "width_deg"],
           (1, 0.013), (2, 0.009), (3, 0.017), (4, 0.031), (5, 0.027), (6, 0.043))
    + each("joint_coupling", ["joint", "on", "ratio"], (5, 4, 1.9e-4), (6, 4, -2.6e-4), (6, 5, 3.3e-4), (4, 3, 1.2e-4)))


def ur5():
    return make_profile(
        "UR", "UR5-like",
        joint_rows([0, 90, 0, 0, 90, -90], [0, 0, -425, -392.25, 0, 0], [0, 0, 0, 0, 0, 0],
                   [89.159, 0, 0, 109.15, 94.65, 82.3], [(-360, 360)] * 6),
        [(2, 8.393, [-212.5, 0, 136]), (3, 2.275, [-272.3, 0, 26.5]), (5, 1.219, [0, 0, 0])],
        {"artifact": {"frame": xyz(12.5, -30, 145, 0, 25, 0), "mass_kg": 1.8, "cog_mm": [5, -4, 60]}})


UR5_LINKS = each("link_geometry", ["link", "alpha_deg", "a_mm", "theta_deg", "d_mm", "beta_deg"],
                 (1, 0.007, -0.05, 0.02, 0.11, 0),
                 (2, 0.01, 0.21, -0.06, 800, 0),
                 (3, 0.01, -0.17, 0.04, -800, 0.013),
                 (4, -0.01, 0.09, 0.03, 0.15, -0.008),
                 (5, 0.021, 0.04, -0.05, -0.07, 0),
                 (6, -0.016, -0.03, 0.08, 0.02, 0))
for link in UR5_LINKS[1:3]:
    link.update(large="true", reason='"parallel axes: the d of links 2 and 3 cancel"')

LRMATE_EFFECTS = {
    "link_geometry": each("link_geometry", ["link", "alpha_deg", "a_mm", "theta_deg", "d_mm", "beta_deg"],
                          (1, 0.011, -0.12, 0.02, 0.21, 0.004), (2, -0.017, 0.15, 0.06, -0.08, -0.009),
                          (3, 0.023, -0.31, -0.04, 0.13, 0.019), (4, -0.013, 0.08, 0.05, -0.27, 0.006),
                          (5, 0.019, -0.06, -0.03, 0.07, -0.011), (6, -0.021, 0.04, 0.08, 0.05, 0.014)),
    "base_frame": [{"effect": "base_frame", **xyz(12.3, -45.6, 7.89, 1.2, -3.4, 56.7), "large": "true",
                    "reason": '"far from the nominal base, for the test"'}],
    "tool_frame": [{"effect": "tool_frame", **xyz(0.9, -0.8, 0.7, 0.6, -0.5, 0.4)}],
    "joint_scale": each("joint_scale", ["joint", "ratio"], (1, 1.5e-4), (2, -2.1e-4), (3, 2.8e-4), (6, -3.3e-4)),
    "joint_compliance": each("joint_compliance", ["joint", "rad_per_n_m"],
                             (1, 9.5e-6), (2, 2.9e-5), (3, 6.1e-5), (4, 2.4e-4), (5, 3.2e-4), (6, 4.3e-4)),
    "joint_harmonic": each("joint_harmonic", ["joint", "order", "cos_deg", "sin_deg"],
                           (3, 1, 0.012, 0.021), (6, 1, 0.05, -0.03), (6, 2, -0.02, 0.04)),
    "backlash": each("backlash", ["joint", "width_deg"], (1, 0.012), (2, 0.008), (3, 0.02), (5, 0.03), (6, 0.045)),
    "joint_coupling": each("joint_coupling", ["joint", "on", "ratio"], (4, 3, 2.2e-4), (5, 4, 5.5e-4), (6, 5, -7.1e-4)),
}


# ---------------------------------------------------------------- cases

def sample(rng, profile, margin=0):
    return [round(rng.uniform(j["min_deg"] + margin, j["max_deg"] - margin), 4) for j in profile["kinematics"]["joints"]]


def make_case(files, index, name, profile, tool, count, seed, directions=False, forces=False, profile_of=None):
    rng = random.Random(seed)
    header = ["id"] + names("q{}_deg") + (names("dir{}") if directions else []) \
        + (["fx_n", "fy_n", "fz_n"] if forces else [])
    inputs, outputs = [], []
    for k in range(1, count + 1):
        q = sample(rng, profile)
        direction = [rng.choice([-1, 0, 1]) for _ in range(6)] if directions else [0] * 6
        force = [round(rng.uniform(-80, 80), 2) for _ in range(3)] if forces else [0, 0, 0]
        if forces and k % 5 == 0:
            force = [0, 0, 0]
        inputs.append([k] + q + (direction if directions else []) + (force if forces else []))
        qr = [deg(v) for v in q]
        controller = controller_forward(profile, tool, qr)
        real = real_forward(profile, tool, qr, direction, force)
        check_row(profile, tool, qr, direction, force, controller, real)
        outputs.append([k] + pose_cells(real[0]) + pose_cells(controller) + real[1] + [to_deg(v) for v in real[2]])
    if profile_of is None:
        files[name + ".profile.yaml"] = profile_text(profile)
    files[name + ".joints.csv"] = csv_text(header, inputs)
    files[name + ".expected.csv"] = csv_text(
        ["id"] + pose_names("") + pose_names("c") + names("tau{}_n_m") + names("delta{}_deg"), outputs)
    index.append([name, (profile_of or name) + ".profile.yaml", name + ".joints.csv", name + ".expected.csv", tool, count])
    shift = [sqrt(sum((r[i] - r[i + 7]) ** 2 for i in (1, 2, 3))) for r in outputs]
    print(f"{name}: {count} rows, real-controller distance mean {nstr(sum(shift) / count, 5)} mm, max {nstr(max(shift), 5)} mm")


def make_inverse(files, profile, tool, count, seed):
    rng = random.Random(seed)
    low = sin(deg(10))
    rows, tried, shifts, moves = [], 0, [], []
    while len(rows) < count:
        qa = sample(rng, profile, margin=3)
        tried += 1
        # elbow: axis 2, axis 3 and the wrist centre in one line when q3 = -atan2(302, 70) or that + 180 deg
        q = [deg(v) for v in qa]
        frames = link_frames(profile, dh_angles(profile, commanded(profile, q)), False)
        wrist = origin(frames[3])
        if abs(qa[4]) <= 10 or abs(sin(q[2] + mp.atan2(302, 70))) <= low or mp.hypot(wrist[0], wrist[1]) < mpf("0.05"):
            continue
        wanted = controller_forward(profile, tool, q)
        found = solve(profile, tool, wanted, q)
        reached, tau, delta = real_forward(profile, tool, found)
        assert max(abs(v) for v in residual(wanted, reached)) < mpf("1e-35")
        fake = controller_forward(profile, tool, found)
        check_row(profile, tool, found, [0] * 6, [0, 0, 0], fake, (reached, tau, delta))
        found = [to_deg(v) for v in found]
        for v, j in zip(found, profile["kinematics"]["joints"]):
            assert j["min_deg"] <= v <= j["max_deg"]
        moves.append(max(abs(a - num(b)) for a, b in zip(found, qa)))
        shifts.append(1000 * sqrt(sum(v * v for v in sub(origin(fake), origin(wanted)))))
        rows.append([len(rows) + 1] + pose_cells(wanted) + qa + found + pose_cells(fake))
    files["inverse_irb120_thesis.csv"] = csv_text(
        ["id"] + pose_names("w") + names("near{}_deg") + names("q{}_deg") + pose_names("f"), rows)
    print(f"inverse_irb120_thesis: {count} rows of {tried} drawn; largest |q - near| {nstr(max(moves), 5)} deg, "
          f"shift of the target mean {nstr(sum(shifts) / count, 5)} mm, max {nstr(max(shifts), 5)} mm")


def main():
    global FORCE_AT
    args = argparse.ArgumentParser(description="write the reference data next to this script")
    args.add_argument("--force-at", choices=["nominal-tool", "real-tool"], default=FORCE_AT)
    args.add_argument("--out", default=HERE, help="folder to write to (default: next to this script)")
    args = args.parse_args()
    FORCE_AT = args.force_at
    files, index = {}, []

    # known by hand: at q = 0 the IRB 120 flange is at (374, 0, 630) mm
    bare = irb120()
    bare["tools"] = {"none": {"frame": xyz(0, 0, 0), "mass_kg": 0, "cog_mm": [0, 0, 0]}}
    home = [1000 * v for v in origin(controller_forward(bare, "none", [mpf(0)] * 6))]
    assert max(abs(a - b) for a, b in zip(home, (374, 0, 630))) < mpf("1e-40")
    # and the arm straight out to the side of joint 2: torque of link 2 alone is m g x about axis 2, positive (downward)
    bare["bodies"] = bare["bodies"][:1]
    tau = torques(bare, "none", [mpf(0), pi / 2] + [mpf(0)] * 4, [0, 0, 0])
    assert abs(tau[1] - mpf("4.2") * mpf("9.81") * mpf("0.14")) < mpf("1e-40")

    thesis = with_effects(irb120(), IRB_BASE, IRB_LINKS, IRB_COMPLIANCE)
    make_case(files, index, "irb120_thesis", thesis, "artifact", 100, 1)
    everything = with_effects(awkward(), AWKWARD_EFFECTS)
    make_case(files, index, "all_effects", everything, "gripper", 100, 2, directions=True, forces=True)
    make_case(files, index, "all_effects_other_tool", everything, "probe", 20, 3, directions=True, forces=True,
              profile_of="all_effects")
    for k, (name, list_) in enumerate(LRMATE_EFFECTS.items()):
        make_case(files, index, "lrmate_" + name, with_effects(lrmate(), list_), "artifact", 20, 10 + k,
                  directions=name == "backlash", forces=name == "joint_compliance")
    hanging = with_effects(irb120(base=xyz(1234.5, -321, 2500, 180, 0, 0)), IRB_COMPLIANCE)
    make_case(files, index, "hanging_compliance", hanging, "artifact", 40, 4)
    make_case(files, index, "ur5_cancelling_d", with_effects(ur5(), UR5_LINKS), "artifact", 50, 5)
    make_inverse(files, thesis, "artifact", 200, 6)

    files["cases.csv"] = csv_text(["case", "profile", "joints", "expected", "tool", "rows"], index)
    for name, content in files.items():
        with open(os.path.join(args.out, name), "w", encoding="utf-8", newline="\n") as f:
            f.write(content)
    print(f"{len(files)} files, {sum(len(c) for c in files.values())} bytes")


if __name__ == "__main__":
    main()
