# SPDX-License-Identifier: GPL-3.0-or-later
"""Stress grid of the physics: grid_test.py FRETWORK [--cells N] [--seed S] [--keep FOLDER]

Studies drawn at random over the extremes of every parameter: masses, stiffnesses, dampers, friction, gaps and overlaps, contacts on
restrained nodes and several on a node, modes, steps, schemes. A cell is
- right: status 0, no warning, every number finite, the energy balanced, no energy made by dampers and friction, no tension in a contact,
  friction within its bound;
- told: a refusal (status 1 or 2 with a message), or status 0 with a warning, and all that must hold at any step holds;
- wrong: anything else, a crash or a hang.
"""

import argparse
import json
import math
import random
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy

LONGEST = 120  # s: a command that takes longer hangs; max_hours ends the transient after some seconds
WARNED = 0.01  # residual of the energy where the program must warn: the accuracy that the automatic step aims at
DISSIPATES = 1e-6  # of the energy scale: round-off of the sums
BOUND = 1e-9  # relative, of the largest force: round-off of a force's two components
TOLERANCE = 1e-6  # of runge_kutta_54 (transient.tolerance): of a step, in forces and in the sums of the energy
ENERGY_WARNINGS = ("energy", "step", "tolerance")  # of these a warning speaks that explains energy out of balance
SCHEMES = ["auto"] * 5 + ["splitting", "collocation", "euler", "devogelaere", "runge_kutta_54", "energy_conserving"]


def logarithmic(draw, low, high):
    return 10.0 ** draw.uniform(math.log10(low), math.log10(high))


def point_mesh():
    return '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n0 1 "mass"\n$EndPhysicalNames\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 15 2 1 1 1\n$EndElements\n'


def line_mesh(elements, contacts, length, first):
    """A line along x; `ends` its ends, `held` nodes evenly spread, with first = 0 from its restrained end on."""
    held = sorted({round((i + first) * elements / (contacts + first)) + 1 for i in range(contacts)})
    points = [(1, 1), (1, elements + 1)] + [(2, node) for node in held]
    text = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n0 1 "ends"\n0 2 "held"\n1 3 "beam"\n$EndPhysicalNames\n$Nodes\n'
    text += f"{elements + 1}\n" + "".join(f"{i + 1} {length * i / elements!r} 0 0\n" for i in range(elements + 1)) + "$EndNodes\n$Elements\n"
    text += f"{elements + len(points)}\n" + "".join(f"{i + 1} 15 2 {tag} {tag} {node}\n" for i, (tag, node) in enumerate(points))
    text += "".join(f"{len(points) + i} 1 2 3 1 {i} {i + 1}\n" for i in range(1, elements + 1))
    return text + "$EndElements\n"


def contact(draw, name, group, mass):
    """A contact and its frequency on the mass, rad/s."""
    stiffness = logarithmic(draw, 1e-3, 1e15)
    ratio = draw.choice([0.0, 0.01, 0.5, 1.0, 10.0, 100.0])
    lines = [
        "[[contacts]]",
        f'name = "{name}"',
        f'group = "{group}"',
        f"normal_stiffness = {stiffness!r}",
        f"normal_damping = {2.0 * ratio * math.sqrt(stiffness * mass)!r}",
        f"friction = {draw.choice([0.0, 0.0, 0.1, 0.5, 3.0, 100.0])!r}",
        f"tangential_stiffness = {stiffness * draw.choice([1e-3, 1.0, 1.0, 1e3])!r}",
        f"gap = {draw.choice([0.0, 1e-7, 1e-4, 1e-4, 1e-2, 10.0])!r}",
        "axis = [1.0, 0.0, 0.0]",
        f'obstacle = "{draw.choice(["circle", "circle", "stop_y", "plane_y"])}"',
    ]
    if draw.random() < 0.15:
        lines.append("offset = [1.0e-4, 0.0]")  # beyond a small gap: an overlap
    if draw.random() < 0.6:
        lines.append(f"tangential_damping = {draw.choice([0.0, 0.1, 1.0, 100.0]) * math.sqrt(stiffness * mass)!r}")
    return "\n".join(lines) + "\n", math.sqrt(stiffness / mass)


def oscillator(draw):
    mass, omega = logarithmic(draw, 1e-9, 1e9), logarithmic(draw, 0.1, 1e5)
    damping = draw.choice([0.0, 0.0, 0.01, 0.5])
    fixed = draw.choice([["ux"]] * 15 + [["ux", "uz"]] * 4 + [["ux", "uy", "uz"]])
    amplitude = mass * omega**2 * logarithmic(draw, 1e-9, 1e-2)
    text = f'[mesh]\nfile = "mesh.msh"\n[[masses]]\ngroup = "mass"\nmass = {mass!r}\n[[springs]]\ngroup = "mass"\n'
    text += f"stiffness = [0.0, {mass * omega**2!r}, {1.7 * mass * omega**2!r}, 0.0, 0.0, 0.0]\n"
    text += f'[[restraints]]\ngroup = "mass"\nfixed = {json.dumps([*fixed, "rx", "ry", "rz"])}\n[modes]\ndamping = {damping!r}\n'
    text += f'[[loads]]\ngroup = "mass"\ndirection = [0.0, 1.0, 0.3]\nharmonic = {{ amplitude = {amplitude!r}, frequency = {omega * draw.uniform(0.02, 0.3)!r} }}\n'
    if len(fixed) == 1 and draw.random() < 0.5:
        text += f'[[initial]]\ngroup = "mass"\nvelocity = [0.0, {logarithmic(draw, 1e-6, 1.0)!r}, 0.0]\n'
    stiffest = omega
    for i in range(draw.choice([1, 1, 1, 2, 5])):
        lines, frequency = contact(draw, f"c{i}", "mass", mass)
        text, stiffest = text + lines, max(stiffest, frequency)
    return point_mesh(), text, 100.0 / omega, omega, stiffest


def beam(draw):
    modes = round(logarithmic(draw, 1, 1000))
    elements = max(4, modes // 5 + 2, draw.choice([10, 50]))
    contacts = min(draw.choice([1, 2, 10, 300]), elements)
    density = logarithmic(draw, 1e-3, 1e6)
    length = draw.choice([0.5, 2.0, 10.0])
    omega = math.pi**2 / length**2 * math.sqrt(2e11 / density) * 0.005
    mass = density * 3.1e-4 * length
    text = f'[mesh]\nfile = "mesh.msh"\n[materials.m]\nyoung_modulus = 2.0e11\npoisson_ratio = 0.3\ndensity = {density!r}\n[sections.s]\nshape = "circle"\ndiameter = 0.02\n'
    text += f'[[beams]]\ngroup = "beam"\nmaterial = "m"\nsection = "s"\n[[restraints]]\ngroup = "ends"\nfixed = {draw.choice([json.dumps("all"), json.dumps(["ux", "uy", "uz", "rx"])])}\n'
    text += f'[modes]\ncount = {modes}\ndamping = {draw.choice([0.0, 0.001, 0.1])!r}\nstatic_modes = "{draw.choice(["none", "all"])}"\n'
    text += f'[[loads]]\ngroup = "beam"\ndirection = [0.0, 1.0, 0.2]\nharmonic = {{ amplitude = {logarithmic(draw, 1e-3, 1e4)!r}, frequency = {omega / 5!r} }}\n'
    lines, stiffest = contact(draw, "c", "held", mass / modes)
    text += lines
    return line_mesh(elements, contacts, length, 0 if draw.random() < 0.05 else 1), text, 20.0 / omega, omega, stiffest


def study_of(seed, cell):
    """Mesh and study of a cell: of the seed and its number alone."""
    draw = random.Random(f"{seed} {cell}")
    mesh, text, duration, omega, stiffest = (oscillator if draw.random() < 0.7 else beam)(draw)
    if draw.random() < 0.7:  # impacts of stiff contacts, which the vibration would take too long for
        duration = min(duration, 2000.0 / stiffest)
    text += f'[transient]\nduration = {max(duration, 1e-8)!r}\nscheme = "{draw.choice(SCHEMES)}"\nmax_hours = 0.001\n'
    if draw.random() < 0.3:
        text += f"step = {min(duration, draw.choice([0.001, 0.01, 0.1, 1.0]) / omega)!r}\n"
    text += f'start = "{draw.choice(["rest"] * 9 + ["static"])}"\n' if "[[initial]]" not in text else ""
    return mesh, text + f"[output]\nevery = {max(duration, 1e-8) / 500!r}\nmodal = false\n"


def problems(folder):
    """What must hold whatever the step, and what must hold without a warning."""
    summary = json.loads((folder / "summary.json").read_text())
    energy = summary["energy"]
    always, unwarned = [], []
    if any(value is None or not math.isfinite(value) for value in energy.values()):
        return ["the energy is not finite"], []
    scale = sum(abs(energy[key]) for key in ("input_J", "initial_J", "stored_J", "modal_damping_J", "contact_damping_J", "friction_J"))
    adaptive = summary["transient"]["scheme"] == "runge_kutta_54"
    gained = max(DISSIPATES, TOLERANCE * summary["transient"]["steps"] * adaptive) * scale
    for key in ("modal_damping_J", "contact_damping_J", "friction_J"):
        if energy[key] < -gained:
            unwarned.append(f"{key} = {energy[key]!r} of {scale!r} J: energy is made")
    if energy["residual_relative"] > WARNED:
        unwarned.append(f"energy balanced to {energy['residual_relative']!r} only")
    with h5py.File(folder / "results.h5") as file:
        for name, group in file["contacts"].items():
            normal, tangential = group["normal_force"][...], group["tangential_force"][...]
            for key in ("displacement", "velocity", "gap", "normal_force", "tangential_force"):
                if not numpy.all(numpy.isfinite(group[key][...])):
                    always.append(f"{name}: {key} is not finite")
            if numpy.any(normal < 0.0):
                always.append(f"{name}: tension, {normal.min()!r} N")
            limit = group.attrs["friction_static"] * normal
            excess = numpy.hypot(*tangential.T) - limit
            if numpy.any(excess > (TOLERANCE if adaptive else BOUND) * max(limit.max(), 1e-300)):
                always.append(f"{name}: friction beyond its bound by {excess.max()!r} N of {limit.max()!r} N")
    return always, unwarned


def judge(fretwork, seed, cell, keep):
    mesh, text = study_of(seed, cell)
    with tempfile.TemporaryDirectory(prefix="fretwork_grid_") as name:
        folder = Path(name)
        (folder / "mesh.msh").write_text(mesh)
        (folder / "study.toml").write_text(text)
        try:
            done = subprocess.run([fretwork, "run", folder / "study.toml", "--no-report", "-o", folder / "results"],
                                  capture_output=True, text=True, timeout=LONGEST, check=False)  # fmt: skip
            outcome = judge_run(done, folder / "results")
        except subprocess.TimeoutExpired:
            outcome = "wrong: it hangs"
        if outcome.startswith("wrong") and keep:
            place = Path(keep) / f"cell_{seed}_{cell}"
            place.mkdir(parents=True, exist_ok=True)
            (place / "mesh.msh").write_text(mesh)
            (place / "study.toml").write_text(f"# {outcome[:300]!r}\n" + text)
        return outcome


def judge_run(done, results):
    if done.returncode in (1, 2) and "fretwork: " in done.stderr:
        return "told: " + done.stderr[done.stderr.index("fretwork: ") :][:200]
    if done.returncode != 0:
        return f"wrong: status {done.returncode}: {done.stderr[-300:]}"
    always, unwarned = problems(results)
    warnings = json.loads((results / "summary.json").read_text())["warnings"]
    warnings = [text for text in warnings if not text.startswith("units:")]  # that a value is unusual tells of no error
    explained = any(word in text for text in warnings for word in ENERGY_WARNINGS)
    if always or (unwarned and not explained):
        return "wrong: " + "; ".join(always + unwarned)
    return "told: " + warnings[0] if warnings else "right"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fretwork")
    parser.add_argument("--cells", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="one cell, its outcome in full")
    parser.add_argument("--keep", help="a folder for the studies of the cells that are wrong")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    cells = range(options.cells) if options.only is None else [options.only]
    with ThreadPoolExecutor(2) as pool:
        outcomes = list(pool.map(lambda cell: judge(options.fretwork, options.seed, cell, options.keep), cells))
    counts = Counter(outcome.split(":")[0] for outcome in outcomes)
    print("| stress grid | cells | right | told | wrong |\n| --- | --- | --- | --- | --- |")
    print(f"| seed {options.seed} | {len(outcomes)} | {counts['right']} | {counts['told']} | {counts['wrong']} |")
    for cell, outcome in zip(cells, outcomes):
        if outcome.startswith("wrong") or options.verbose:
            print(f"cell {cell}: {outcome}")
    return 1 if counts["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
