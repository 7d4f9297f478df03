"""Fits capsules around the collision meshes of robot description packages, link by link, in the frames of a profile.

Usage: python fit.py FOLDER_OF_GIT_MIRRORS ROBOTS_FOLDER [--write]

Each mesh is sampled on its surface (points at most 8 mm apart), placed by the package's joint origins at zero, and seen from the
frame after the link's row of the profile's chain. One or two capsules are fitted by minimising their volume; the radius is the
largest distance of a sample from the segment, plus 3 mm for what lies between samples, rounded up to 1 mm. For links whose mesh is of a
sibling of another length (`stretch`) the samples beyond the middle of the link are moved by the difference.

Shares no code with the program.
"""
import re, subprocess, sys
import numpy as np
from scipy.optimize import minimize
import xml.etree.ElementTree as ET

MARGIN_MM = 3.0


def git(repo, path):
    return subprocess.run(["git", f"--git-dir={repo}", "show", f"HEAD:{path}"], check=True, capture_output=True).stdout


def stl(data):
    n = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * n:
        a = np.frombuffer(data[84:], dtype=np.dtype([("f", "<f4", 12), ("x", "<u2")]), count=n)
        return a["f"][:, 3:].reshape(-1, 3, 3).astype(float)
    v = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data)
    return np.array(v, dtype=float).reshape(-1, 3, 3)


def surface(triangles, step=0.008):
    out = [triangles.reshape(-1, 3)]
    for a, b, c in triangles:
        n = int(np.ceil(max(np.linalg.norm(b - a), np.linalg.norm(c - a), np.linalg.norm(c - b)) / step))
        if n > 1:
            i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1))
            keep = i + j <= n
            s, t = i[keep] / n, j[keep] / n
            out.append(a + np.outer(s, b - a) + np.outer(t, c - a))
    points = np.concatenate(out)
    return np.unique(np.round(points, 3), axis=0)


def rx(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])


def rz(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def rpy(angles):
    r, p, y = angles
    c, s = np.cos(p), np.sin(p)
    turn_y = np.array([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1.0]])
    return rz(y) @ turn_y @ rx(r)


def tr(x, y, z):
    t = np.eye(4)
    t[:3, 3] = x, y, z
    return t


def frames(text):
    """Frames 0..6 of a profile at zero, mm."""
    rows = re.findall(r"- \{alpha_deg: ([-\d.]+), a_mm: ([-\d.]+), theta_deg: ([-\d.]+), d_mm: ([-\d.]+)", text)
    offset = re.findall(r"offset_deg: ([-\d.]+)", text)
    assert len(rows) == 6 and not offset, rows
    out = [np.eye(4)]
    for al, a, th, d in np.array(rows, float):
        out.append(out[-1] @ rx(np.radians(al)) @ tr(a, 0, 0) @ rz(np.radians(th)) @ tr(0, 0, d))
    return out


def distance(p, a, b):
    u = b - a
    t = np.clip(((p - a) @ u) / max(u @ u, 1e-12), 0, 1)
    return np.linalg.norm(p - a - np.outer(t, u), axis=1)


def one(points):
    """The capsule of least volume found."""
    if len(points) > 4000:
        # the outermost points decide
        from scipy.spatial import ConvexHull
        points = points[ConvexHull(points, qhull_options="QJ").vertices]
    centre = points.mean(0)
    axes = np.linalg.svd(points - centre, full_matrices=False)[2]

    def volume(x):
        a, b = x[:3], x[3:]
        r = distance(points, a, b).max()
        return np.pi * r * r * (4 / 3 * r + np.linalg.norm(b - a))

    best = None
    for axis in axes:
        along = (points - centre) @ axis
        across = np.linalg.norm(points - centre - np.outer(along, axis), axis=1).max()
        lo, hi = along.min() + across, along.max() - across
        if lo > hi:
            lo = hi = (lo + hi) / 2
        x = np.concatenate([centre + lo * axis, centre + hi * axis])
        for _ in range(2):
            x = minimize(volume, x, method="Nelder-Mead", options={"maxiter": 1500, "xatol": 0.05, "fatol": 1}).x
        if best is None or volume(x) < volume(best):
            best = x
    a, b = np.round(best[:3]), np.round(best[3:])
    r = np.ceil(distance(points, a, b).max() + MARGIN_MM)
    return a, b, r, np.pi * r * r * (4 / 3 * r + np.linalg.norm(b - a))


def fit(points):
    whole = one(points)
    axis = np.linalg.svd(points - points.mean(0), full_matrices=False)[2][0]
    along = points @ axis
    best = [whole]
    for part in (0.35, 0.5, 0.65):
        cut = along.min() + part * np.ptp(along)
        low, high = points[along <= cut + 5], points[along >= cut - 5]
        if min(len(low), len(high)) < 8:
            continue
        two = [one(low), one(high)]
        if sum(c[3] for c in two) < 0.75 * sum(c[3] for c in best):
            best = two
    return best


ABB = "ros-industrial+abb_experimental/repo"
FANUC = "ros-industrial+fanuc/repo"
FANUC_EXPERIMENTAL = "ros-industrial+fanuc_experimental/repo"
KUKA = "ros-industrial+kuka_experimental/repo"
KROSHU = "kroshu+kuka_robot_descriptions/repo"
STAUBLI = "ros-industrial+staubli_experimental/repo"
MOTOMAN = "ros-industrial+motoman/repo"
# profile: repository, xacro; a sibling where the arm itself has no package
ROBOTS = {
    "abb_irb120": (ABB, "abb_irb120_support/urdf/irb120_3_58_macro.xacro"),
    "abb_irb120_thesis": (ABB, "abb_irb120_support/urdf/irb120_3_58_macro.xacro"),
    "abb_irb1600_6_145": (ABB, "abb_irb1600_support/urdf/irb1600_8_145_macro.xacro"),
    "abb_irb2600_12_165": (ABB, "abb_irb2600_support/urdf/irb2600_12_165_macro.xacro"),
    "abb_irb2600_20_165": (ABB, "abb_irb2600_support/urdf/irb2600_12_165_macro.xacro"),
    "abb_irb2600_12_185": (ABB, "abb_irb2600_support/urdf/irb2600_12_165_macro.xacro"),
    "fanuc_lrmate200ic": (FANUC, "fanuc_lrmate200ic_support/urdf/lrmate200ic_macro.xacro"),
    "fanuc_r2000ic_165f": (FANUC_EXPERIMENTAL, "fanuc_r2000ic_support/urdf/r2000ic165f_macro.xacro"),
    "kuka_kr6_r900": (KUKA, "kuka_kr6_support/urdf/kr6r900sixx_macro.xacro"),
    "kuka_kr210_r2700": (KROSHU, "kuka_quantec_support/urdf/kr210_r2700_2_macro.xacro"),
    "staubli_tx2_90l": (STAUBLI, "staubli_tx2_90_support/urdf/tx2_90l_macro.xacro"),
    "yaskawa_ma1400": (MOTOMAN, "motoman_ma2010_support/urdf/ma2010_macro.xacro"),
}


def numbers(text):
    text = re.sub(r"\$\{radians\(([-\d.]+)\)\}", lambda m: str(np.radians(float(m[1]))), text or "0 0 0")
    text = re.sub(r"\$\{(-?)pi(?:/([\d.]+))?\}", lambda m: str((-1 if m[1] else 1) * np.pi / float(m[2] or 1)), text)
    return [float(x) for x in text.split()]


def package(mirrors, repo, xacro):
    """Surface samples of links 0..6 in the profile's base frame at zero, mm, and the joints' places."""
    root = ET.fromstring(git(f"{mirrors}/{repo}", xacro))
    links, joints = [], []
    base = np.eye(4)
    for link in root.iter("link"):
        mesh = link.find("collision/geometry/mesh")
        if mesh is not None:
            links.append((link.get("name"), mesh.get("filename")))
    for joint in root.iter("joint"):
        origin = joint.find("origin")
        xyz = numbers(origin.get("xyz")) if origin is not None else [0, 0, 0]
        if joint.get("type") in ("revolute", "continuous"):
            joints.append(tr(*xyz) @ rpy(numbers(origin.get("rpy"))))
        elif joint.get("name").endswith("base_link-base"):
            base = tr(*xyz)
    assert len(joints) == 6, len(joints)
    places = [np.linalg.inv(base)]
    for joint in joints:
        places.append(places[-1] @ joint)
    out = []
    for (name, file), place in zip(links[:7], places):
        path = file.replace("package://", "").replace("${package_name}", xacro.split("/")[0])
        points = surface(stl(git(f"{mirrors}/{repo}", path)))
        out.append(1000 * (points @ place[:3, :3].T + place[:3, 3]))
    return out, 1000 * np.array([place[:3, 3] for place in places])


# the Universal Robots description has the frames of our table; its meshes are turned in them (visual_parameters.yaml)
UR = {
    "universal_robots_ur5": ("ur5", 0.13585, 0.0165, [-0.093, -0.095, -0.0818]),
    "universal_robots_ur10": ("ur10", 0.220941, 0.0494, [-0.1149, -0.1158, -0.0922]),
}


def universal(mirrors, arm, shoulder, elbow, wrist):
    half = np.pi / 2
    places = [
        ("base", tr(0, 0, 0) @ rpy([0, 0, np.pi])),
        ("shoulder", rpy([0, 0, np.pi])),
        ("upperarm", tr(0, 0, shoulder) @ rpy([half, 0, -half])),
        ("forearm", tr(0, 0, elbow) @ rpy([half, 0, -half])),
        ("wrist1", tr(0, 0, wrist[0]) @ rpy([half, 0, 0])),
        ("wrist2", tr(0, 0, wrist[1])),
        ("wrist3", tr(0, 0, wrist[2]) @ rpy([half, 0, 0])),
    ]
    out = []
    for name, place in places:
        data = git(f"{mirrors}/ros-industrial+universal_robot/repo", f"ur_description/meshes/{arm}/collision/{name}.stl")
        points = surface(stl(data))
        out.append(1000 * (points @ place[:3, :3].T + place[:3, 3]))
    return out


def shape_lines(link, local):
    text = lambda v: "[" + ", ".join(f"{x:.0f}" for x in v + 0.0) + "]"
    return [f"  - {{link: {link}, capsule_mm: {{from: {text(a)}, to: {text(b)}, radius: {r:.0f}}}}}" for a, b, r, _ in fit(local)]


def write(robots, name, source, lines):
    block = "\n".join(
        [f"# Shapes: capsules around the collision meshes of {source},",
         "#   fitted by tests/data/shapes/fit.py; each holds all of its link. Cables, hoses and dress packs are not in them.", "shapes:", *lines, ""])
    print(name, block, flush=True)
    if "--write" in sys.argv:
        text = open(f"{robots}/{name}.yaml").read()
        text = re.sub(r"(?s)# Shapes:.*?shapes:\n(?:  - .*\n)*", "", text)
        text = text.replace("gravity_m_s2:", block + "gravity_m_s2:", 1)
        open(f"{robots}/{name}.yaml", "w").write(text)


def main():
    mirrors, robots = sys.argv[1:3]
    only = [a for a in sys.argv[3:] if not a.startswith("--")]
    for name, (arm, *places) in UR.items():
        if not only or name in only:
            lines = []
            for link, local in enumerate(universal(mirrors, arm, *places)):
                lines += shape_lines(link, local)
            write(robots, name, f"ros-industrial/universal_robot, ur_description, {arm}", lines)
    for name, (repo, xacro) in ROBOTS.items():
        if only and name not in only:
            continue
        dh = frames(open(f"{robots}/{name}.yaml").read())
        points, places = package(mirrors, repo, xacro)
        stretched, lines = [], []
        for link in range(7):
            p = points[link]
            if link:
                # the package's joint seen from ours: along the axis it may stand anywhere
                ours = dh[link]
                here = ours[:3, :3].T @ (places[link] - ours[:3, 3])
                gap = ours[:3, :2] @ here[:2] if link < 6 else places[6] - dh[6][:3, 3] - ours[:3, 2] * here[2]
                p = p - gap
                if link < 6:
                    after = dh[link + 1]
                    there = after[:3, :3].T @ (places[link + 1] - gap - after[:3, 3])
                    rest = after[:3, :2] @ there[:2]
                    if np.linalg.norm(rest) > 1:
                        # the link is of another length: its far half goes along, and what is between is filled
                        axis = places[link + 1] - places[link]
                        far = (p - (places[link] - gap)) @ axis > 0.5 * axis @ axis
                        moved = np.where(far[:, None], p - rest, p)
                        between = np.linspace(0, 1, 30)[1:-1]
                        p = np.concatenate([moved, *(p - t * rest for t in between)])
                        stretched.append(link)
            local = (np.linalg.inv(dh[link]) @ np.c_[p, np.ones(len(p))].T).T[:, :3]
            lines += shape_lines(link, local)
        note = f" (links {', '.join(map(str, stretched))} lengthened to this arm)" if stretched else ""
        package_name, model = xacro.split("/")[0], xacro.split("/")[-1].replace("_macro.xacro", "")
        write(robots, name, f"{repo.split('/')[0].replace('+', '/')}, {package_name}, {model}{note}", lines)


main()
