# SPDX-License-Identifier: BSD-3-Clause
"""Mean accelerations and frictions of the runs of a study of `simbenchmark_rolling`.

    accelerations.py RESULTS OUT.csv

Of each run with a motion: the box's mean acceleration over the run (m/s²) and its angle in the plane (rad), the mean one of a
ball, the friction of the floor f1 = |F − M a_box − Σ m a_ball| and that of a ball on the box f2 = m |a_ball| (N).
"""
import csv
import math
import pathlib
import sys

FORCE = (75.0, 129.9038105676658)  # N
BOX, BALL = 10.0, 1.0  # kg


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def accelerations(path):
    """(x, y) of each body, the box first: the velocity at the end over the time, since all start at rest."""
    last = {}
    for row in rows(path):
        last[int(row["body"])] = row
    return [tuple(float(last[b][k]) / float(last[b]["t_s"]) for k in ("vx_m_per_s", "vy_m_per_s")) for b in sorted(last)]


def main():
    results, out = map(pathlib.Path, sys.argv[1:])
    out.parent.mkdir(parents=True, exist_ok=True)
    lines = [["response", "dt_s", "a_box_m_per_s2", "angle_rad", "a_ball_m_per_s2", "f1_N", "f2_N"]]
    for run in rows(results / "runs.csv"):
        box, *balls = accelerations(results / "trajectories" / run["run"] / "trajectory.csv")
        floor = [f - BOX * box[i] - sum(BALL * ball[i] for ball in balls) for i, f in enumerate(FORCE)]
        ball = math.fsum(math.hypot(*b) for b in balls) / len(balls)
        lines.append([run["response"], run["dt_s"], math.hypot(*box), math.atan2(box[1], box[0]), ball, math.hypot(*floor),
                      BALL * ball])
    with open(out, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(lines)


if __name__ == "__main__":
    main()
