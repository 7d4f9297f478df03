"""All answers of the inverse at random poses of arms with an offset wrist, by the method of Raghavan and Roth (ssik)."""

import argparse
import csv
import math
import pathlib

import numpy as np
import ssik

HERE = pathlib.Path(__file__).parent
POSES = 25
SEED = 20261122


def turn_x(angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])


def turn_z(angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def shift(x, z):
    pose = np.eye(4)
    pose[0, 3], pose[2, 3] = x, z
    return pose


def rows_of(line):
    number = lambda key, i, unit: float(line[f"{key}{i}_{unit}"])
    return [
        (
            math.radians(number("alpha", i, "deg")),
            number("a", i, "mm") / 1e3,
            math.radians(number("theta", i, "deg")),
            number("d", i, "mm") / 1e3,
            math.radians(number("min", i, "deg")),
            math.radians(number("max", i, "deg")),
        )
        for i in range(1, 7)
    ]


def forward(rows, q):
    pose = np.eye(4)
    for (alpha, a, theta, d, _, _), angle in zip(rows, q):
        pose = pose @ turn_x(alpha) @ shift(a, 0) @ turn_z(theta + angle) @ shift(0, d)
    return pose


def manipulator(rows):
    before, transforms = np.eye(4), []
    for alpha, a, theta, d, _, _ in rows:
        transforms.append(before @ turn_x(alpha) @ shift(a, 0) @ turn_z(theta))
        before = shift(0, d)
    return ssik.Manipulator.from_transforms(np.array(transforms + [before]))


def unwound(angle):
    return math.degrees(math.remainder(angle, math.tau))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    out = parser.parse_args().out
    random = np.random.default_rng(SEED)
    with open(HERE / "arms.csv") as file:
        arms = list(csv.DictReader(file))
    with open(out / "answers.csv", "w") as file:
        file.write("arm,pose,answer," + ",".join(f"q{i}_deg" for i in range(1, 7)) + "\n")
        for line in arms:
            rows = rows_of(line)
            arm = manipulator(rows)
            for pose in range(POSES):
                made_of = [random.uniform(low, high) for *_, low, high in rows]
                wanted = forward(rows, made_of)
                answers = [made_of]
                for solution in arm.solve(wanted, respect_limits=False):
                    q = np.asarray(solution.q)
                    assert np.abs(forward(rows, q) - wanted).max() < 1e-6, (line["arm"], pose)
                    apart = [max(abs(math.remainder(a - b, math.tau)) for a, b in zip(q, other)) for other in answers]
                    if min(apart) > 1e-4:
                        answers.append(q)
                for number, q in enumerate(answers):
                    angles = ",".join(f"{unwound(angle):.8f}" for angle in q)
                    file.write(f"{line['arm']},{pose},{number},{angles}\n")


main()
