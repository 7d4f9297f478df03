"""Reference values for registration, circle and sphere fits, and hand-eye calibration, by SciPy and OpenCV."""

import csv
import json
import pathlib

import cv2
import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

HERE = pathlib.Path(__file__).parent
RANDOM = np.random.default_rng(20261121)


def write(name, header, rows):
    with open(HERE / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[v if isinstance(v, str) else f"{v:.17g}" for v in row] for row in rows])


def pose(rotation, translation):
    x, y, z, w = rotation.as_quat()
    return [*translation, w, x, y, z]


def registration():
    p = RANDOM.uniform(-300, 500, (12, 3))
    rotation = Rotation.from_rotvec([0.7, -1.1, 0.4])
    q = rotation.apply(p) + [812.5, -33.25, 401.0] + RANDOM.normal(0, 0.05, p.shape)
    w = RANDOM.uniform(0.5, 3.0, 12)
    expected = {}
    for name, weights in [("equal", np.ones(12)), ("weighted", w)]:
        pc, qc = np.average(p, axis=0, weights=weights), np.average(q, axis=0, weights=weights)
        found, _ = Rotation.align_vectors(q - qc, p - pc, weights=weights)
        left = q - (found.apply(p - pc) + qc)
        x, y, z, ww = found.as_quat()
        expected[name] = {
            "matrix": found.as_matrix().tolist(),
            "quaternion_wxyz": [ww, x, y, z],
            "euler_xyz_deg": found.as_euler("xyz", degrees=True).tolist(),
            "translation_mm": (qc - found.apply(pc)).tolist(),
            "rmsd_mm": float(np.sqrt(np.average((left**2).sum(axis=1), weights=weights))),
        }
    # covariance of the six by a generic least-squares solver: rotation vector before the fit, shift, at the centre of TO
    pc, qc = p.mean(axis=0), q.mean(axis=0)
    base = Rotation.from_matrix(expected["equal"]["matrix"])
    def residual(x):
        return ((Rotation.from_rotvec(x[:3]) * base).apply(p - pc) + qc + x[3:] - q).ravel()
    fit = least_squares(residual, np.zeros(6), jac="3-point", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    sigma2 = (fit.fun**2).sum() / (36 - 6)
    expected["covariance"] = (sigma2 * np.linalg.inv(fit.jac.T @ fit.jac)).tolist()
    write("from.csv", ["id", "x_mm", "y_mm", "z_mm"], [[f"p{i}", *row] for i, row in enumerate(p)])
    write("to.csv", ["id", "x_mm", "y_mm", "z_mm", "weight"], [[f"p{i}", *row, w[i]] for i, row in enumerate(q)])
    return expected


def features():
    axis = np.array([0.3, -0.5, 0.81])
    axis /= np.linalg.norm(axis)
    x = np.cross(axis, [1, 0, 0]); x /= np.linalg.norm(x)
    y = np.cross(axis, x)
    t = np.linspace(0.2, 4.1, 9)
    circle = np.array([1200.0, -340.0, 88.0]) + 41.5 * (np.outer(np.cos(t), x) + np.outer(np.sin(t), y))
    circle += RANDOM.normal(0, 0.02, circle.shape)
    v = RANDOM.normal(0, 1, (11, 3)); v /= np.linalg.norm(v, axis=1)[:, None]
    sphere = np.array([-55.0, 410.0, 960.0]) + 15.0 * v + RANDOM.normal(0, 0.02, v.shape)
    fit = least_squares(lambda s: np.linalg.norm(sphere - s[:3], axis=1) - s[3], [-50, 400, 950, 10], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    centre = circle.mean(axis=0)
    _, _, rows = np.linalg.svd(circle - centre)
    flat = (circle - centre) @ rows[:2].T
    ring = least_squares(lambda s: np.linalg.norm(flat - s[:2], axis=1) - s[2], [0, 0, 40], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    write("circle.csv", ["x_mm", "y_mm", "z_mm"], circle.tolist())
    write("sphere.csv", ["x_mm", "y_mm", "z_mm"], sphere.tolist())
    return {
        "sphere": {"centre_mm": fit.x[:3].tolist(), "radius_mm": fit.x[3]},
        "circle": {"centre_mm": (centre + ring.x[:2] @ rows[:2]).tolist(), "radius_mm": ring.x[2], "normal": rows[2].tolist()},
    }


def handeye():
    expected = {}
    camera = (Rotation.from_rotvec([0.2, -2.0, 0.6]), np.array([62.0, -31.0, 115.0]))
    board = (Rotation.from_rotvec([2.6, 0.3, -0.2]), np.array([540.0, 120.0, -60.0]))
    robot, seen = [], []
    for _ in range(14):
        a = (Rotation.from_rotvec(RANDOM.normal(0, 0.6, 3)), RANDOM.uniform(-200, 200, 3) + [400, 0, 500])
        # camera_from_board = camera_from_flange · flange_from_base · base_from_board
        r = camera[0].inv() * a[0].inv() * board[0]
        t = camera[0].inv().apply(a[0].inv().apply(board[1] - a[1]) - camera[1])
        r = r * Rotation.from_rotvec(RANDOM.normal(0, 4e-4, 3))
        t = t + RANDOM.normal(0, 0.15, 3)
        robot.append(a); seen.append((r, t))
    columns = ["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"]
    write("robot.csv", columns, [pose(*a) for a in robot])
    write("board.csv", columns, [pose(*b) for b in seen])
    methods = {"tsai": cv2.CALIB_HAND_EYE_TSAI, "park": cv2.CALIB_HAND_EYE_PARK, "horaud": cv2.CALIB_HAND_EYE_HORAUD, "daniilidis": cv2.CALIB_HAND_EYE_DANIILIDIS}
    for name, method in methods.items():
        # metres, as the program computes
        r, t = cv2.calibrateHandEye([a[0].as_matrix() for a in robot], [a[1] / 1e3 for a in robot],
                                    [b[0].as_matrix() for b in seen], [b[1] / 1e3 for b in seen], method=method)
        x, y, z, w = Rotation.from_matrix(r).as_quat()
        expected[name] = {"translation_mm": (1e3 * t.ravel()).tolist(), "quaternion_wxyz": [w, x, y, z]}
    # joint refinement by a generic solver: rotation and position of Y⁻¹ A X B, each in units of its own noise, repeated
    def split(x):
        return (camera[0] * Rotation.from_rotvec(x[:3]), camera[1] + x[3:6]), (board[0] * Rotation.from_rotvec(x[6:9]), board[1] + x[9:])
    sigma = [1e-3, 1.0]
    def residual(x):
        X, Y = split(x)
        rows = []
        for (ra, ta), (rb, tb) in zip(robot, seen):
            r = Y[0].inv() * ra * X[0] * rb
            t = Y[0].inv().apply(ra.apply(X[0].apply(tb) + X[1]) + ta - Y[1])
            rows += [r.as_rotvec() / sigma[0], t / sigma[1]]
        return np.concatenate(rows)
    x = np.zeros(12)
    for _ in range(30):
        fit = least_squares(residual, x, jac="3-point", x_scale=[1e-3] * 3 + [1] * 3 + [1e-3] * 3 + [1] * 3, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        x = fit.x
        left = fit.fun.reshape(-1, 2, 3) * np.array(sigma)[None, :, None]
        # each kind has the redundancy that the hat matrix leaves it
        q, _ = np.linalg.qr(fit.jac)
        free = (1 - (q ** 2).sum(axis=1)).reshape(-1, 2, 3)
        sigma = [np.sqrt((left[:, k] ** 2).sum() / free[:, k].sum()) for k in (0, 1)]
    X, Y = split(x)
    cov = np.linalg.inv(fit.jac.T @ fit.jac)
    expected["refined"] = {"translation_mm": X[1].tolist(), "quaternion_wxyz": pose(*X)[3:],
                           "board_translation_mm": Y[1].tolist(), "sigma_deg": float(np.degrees(sigma[0])), "sigma_mm": sigma[1],
                           "sigma_translation_mm": np.sqrt(np.diag(cov)[3:6]).tolist()}
    return expected


if __name__ == "__main__":
    everything = {"registration": registration(), "features": features(), "handeye": handeye()}
    (HERE / "expected.json").write_text(json.dumps(everything, indent=1) + "\n")
