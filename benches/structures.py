#!/usr/bin/env python3
"""Turns sizing problems of structures with verified optima into problem folders, solves and scores them.

usage: structures.py FOLDER BINARY [--out DIR] [--only ID …] [--backend NAME …] [--seconds S] [--write]

FOLDER holds files of the format structure-optimum/1. Two shapes are read: trusses with `limits` (stress by member, displacement by nodes)
and structures with `variables` and `rows` (responses and geometric expressions); further columns of equal segments with a buckling factor, and
trusses with `frequency_limits`. A file is right where the objective is within 1e-8 of the optimum (or lower) and certified.
"""
import argparse
import glob
import json
import os
import re
import subprocess
import tempfile
import time

AXES = {"xz": (0, 2), "xy": (0, 1)}
SPIN = {"xz": 4, "xy": 5}
NAMES = ["x", "y", "z", "rx", "ry", "rz"]
POINT = {(0, 1): "top", (0, -1): "bottom", (1, 0): "right", (-1, 0): "left", (1, 1): "top-right", (-1, 1): "top-left",
         (1, -1): "bottom-right", (-1, -1): "bottom-left", (0, 0): "centre"}


def toml(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key(k)} = {toml(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    return json.dumps(value) if isinstance(value, str) else repr(float(value))


def key(name):
    return name if name and all(c.isalnum() or c in "_-" for c in name) else json.dumps(name)


def quoted(name):
    return name if name.isidentifier() else f"'{name}'"


def vector(plane, v):
    return list(v) if plane is None or len(v) == 2 else [v[i] for i in AXES[plane]]


def loads(case, plane):
    for name, kinds in case["cases"].items():
        if "gravity" in kinds:
            yield {"case": name, "self_weight": True}
        for load in kinds.get("nodal", []):
            force, entry = load["F"], {"case": name, "nodes": [load["node"]]}
            if any(force[:3]):
                entry["force"] = vector(plane, force[:3] if len(force) > 2 else force)
            if len(force) == 6 and any(force[3:]):
                entry["moment"] = force[3:] if plane is None else force[SPIN[plane]]
            if len(entry) > 2:
                yield entry
        for load in kinds.get("member", []):
            entry = {"case": name, "ribs": [load["member"]]} | ({"axes": load["axes"]} if "axes" in load else {})
            if load["kind"] == "uniform":
                yield entry | {"force": vector(plane, load["p"])}
            elif load["kind"] == "linear":
                yield entry | {"force": vector(plane, load["p_start"]), "force_end": vector(plane, load["p_end"]),
                               "from": load["from"], "to": load["to"]}
            elif load["kind"] == "point" and "f" in load:
                yield entry | {"force": vector(plane, load["f"]), "at": load["at"]}
            elif load["kind"] == "temperature":
                yield entry | ({"temperature": load["dT"]} if "dT" in load else {"gradient": load["dT_height"]})
            elif load["kind"] == "pretension":
                yield entry | {"pretension": load["N"]}
            else:
                raise ValueError(f"load {load}")


def response(row):
    """A row's left side."""
    name, *rest = row["response"] if isinstance(row["response"], list) else [row["response"]]
    case = row.get("case")
    if case == "geometry":
        return name
    if name in ("disp", "reaction"):
        return f"{name}({case}, {quoted(rest[0])}, {rest[1]})"
    if name in ("force", "deflection"):
        return f"{name}({case}, {quoted(rest[0])}, {rest[1]}, {rest[2]!r})"
    if name == "stress":
        return f"stress({case}, {quoted(rest[0])}, {rest[1]!r}, {POINT[(rest[2], rest[3])]})"
    raise LookupError(name)


class Sections:
    """Sections with their variables: `x1.b` names its dimension, `b1` that of the section whose name ends in 1."""

    def __init__(self, case):
        case.setdefault("cases", {})
        case["supports"] = [s if isinstance(s, dict) else {"node": s[0], "fix": list(s[1])} for s in case["supports"]]
        if "frequency_limits" in case:
            self.of_groups(case)
        if "lower_area" in case:
            self.of_column(case)
        self.own = {name: dict(values) for name, values in case["sections"].items()}
        self.names = {}
        for variable in case.get("variables", []):
            bounds = {k: variable[k] for k in ("lower", "upper", "start")}
            targets = [tuple(pair) for pair in variable["sets"]] or [self.guess(variable["name"])]
            section, dimension = targets[0]
            if dimension == "h" and "hw" in self.own[section]:
                self.own[section].pop("hw")
            self.own[section][dimension] = bounds
            self.names[variable["name"]] = f"{section}.{dimension}"
            for other, dimension in targets[1:]:
                self.own[other][dimension] = self.names[variable["name"]]

    @staticmethod
    def of_groups(case):
        """One section per group of bars; those without a group have the fixed area."""
        case["plane"] = case.get("plane", "xy")
        lower = case["area_lower"]
        case["sections"] = {}
        for member in case["members"]:
            group = member.get("group")
            member["section"] = "fixed" if group is None else f"g{group}"
            area = case["fixed_area"] if group is None else {"lower": lower, "start": 50 * lower}
            case["sections"][member["section"]] = {"kind": "general", "A": area}

    @staticmethod
    def of_column(case):
        """Symmetric columns with EI = A^2: one variable per pair of segments."""
        members = case["members"]
        for at, member in enumerate(members):
            area = f"A{min(at, len(members) - 1 - at) + 1}"
            member["section"] = f"s_{at}"
            inertia = f"{area}^2/{case['materials']['s']['E']!r}"
            case["sections"][f"s_{at}"] = {"kind": "general", "A": area, "Ix": inertia, "Iy": inertia, "J": 1.0}
        case["sections"] = {m["section"]: case["sections"][m["section"]] for m in members}
        case["scalars"] = {f"A{at + 1}": {"lower": case["lower_area"], "start": 1.0} for at in range((len(members) + 1) // 2)}

    def guess(self, name):
        dimension, number = re.fullmatch(r"([a-z]+)(\d+)", name).groups()
        section = next(s for s in self.own if s.endswith(number))
        return section, dimension

    def text(self, expression):
        """An expression in the variables' names as one in the sections' dimensions."""
        known = sorted(self.names, key=len, reverse=True)
        pattern = re.compile(r"(?<![\w.])(" + "|".join(map(re.escape, known)) + r")(?![\w.])")
        return pattern.sub(lambda match: self.names[match.group(1)], expression)


def rows(case, sections):
    """(name, require) of every row."""
    for number, row in enumerate(case.get("rows", [])):
        left = sections.text(response(row)) if row.get("case") == "geometry" else response(row)
        lower, upper = row.get("lower"), row.get("upper")
        if lower is not None and upper is not None:
            yield f"row{number + 1}", f"{lower!r} <= {left} <= {upper!r}"
        elif upper is not None:
            yield f"row{number + 1}", f"{left} <= {upper!r}"
        elif lower is not None:
            yield f"row{number + 1}", f"{left} >= {lower!r}"
    yield from truss_rows(case)
    yield from mode_rows(case)


def truss_rows(case):
    limits = case.get("limits", {})
    stress = limits.get("stress")
    for at, member in enumerate(case["members"]):
        if stress is None:
            break
        low, high = (stress["compression"], stress["tension"]) if isinstance(stress, dict) else stress[at]
        for load in case["cases"]:
            # N/A within limits, written without the quotient: bars whose area vanishes carry nothing.
            force, area = f"force({load}, {quoted(member['name'])}, N, 0.5)", f"{member['section']}.A"
            yield f"tension_{member['name']}_{load}", f"{force} <= {high!r}*{area}"
            yield f"compression_{member['name']}_{load}", f"{force} >= {low!r}*{area}"
    for group in limits.get("displacement", []):
        limit = float(group["limit"])
        for node in group["nodes"]:
            for direction in group["directions"]:
                name = NAMES[AXES[case["plane"]][direction] if case.get("plane") else direction]
                for load in case["cases"]:
                    yield (f"sway_{node}_{name}_{load}",
                           f"{-limit!r} <= disp({load}, {quoted(str(node))}, {name}) <= {limit!r}")


def mode_rows(case):
    required = case["optimum"].get("required")
    if required is not None:
        yield "stable", f"buckling({next(iter(case['cases']))}) >= {float(required)!r}"
    for limit in case.get("frequency_limits", []):
        yield f"f{limit['modes_from']}", f"frequency({limit['modes_from']}) >= {float(limit['hz'])!r}"


def objective(case):
    text = case["minimize"]
    if "bars with variable area" in text:
        return f"sum(ribs where varies == 1: {next(iter(case['materials'].values()))['density']!r}*volume)"
    if "sum(A)/" in text:
        return "volume_prismatoid"
    if "density * sum(A*L)" in text:
        density = next(m.get("density", m.get("rho")) for m in case["materials"].values())
        return f"{density!r}*volume"
    if "integral of A" in text:
        return "volume_prismatoid"
    raise LookupError(text)


def problem(case):
    """The problem file's text. LookupError names a response that is not computed."""
    sections = Sections(case)
    plane = case.get("plane")
    pinned = all(m.get("type") == "truss" for m in case["members"])
    lines = [f"title = {toml(case['title'])}", f"minimize = {toml(objective(case))}", "[structure]"]
    lines += ["buckling_pieces = 1"] if "lower_area" in case else []  # one element per segment is part of their definition
    lines += ([f'plane = "{plane}"'] if plane else []) + (['joints = "pinned"'] if pinned else [])
    gravity = next((c["gravity"] for c in case["cases"].values() if "gravity" in c), None)
    if gravity:
        lines.append(f"gravity = {toml(vector(plane, gravity))}")
    lines.append("[materials]")
    for name, m in case["materials"].items():
        kept = {k: m[k] for k in ("E", "G", "nu", "alpha") if k in m}
        density = m.get("density", m.get("rho"))
        if "G" in kept:
            kept.pop("nu", None)
        lines.append(f"{key(name)} = {toml(kept | ({'density': density} if density else {}))}")
    if case.get("node_masses"):
        lines += ["[masses]"] + [f"{key(str(node))} = {float(mass)!r}" for node, mass in case["node_masses"]]
    if case.get("scalars"):
        lines += ["[variables]"] + [f"{name} = {toml(bounds)}" for name, bounds in case["scalars"].items()]
    lines.append("[nodes]")
    lines += [f"{key(name)} = {toml(at)}" for name, at in case["nodes"].items()]
    lines.append("[supports]")
    for support in case["supports"]:
        table = {"fix": support.get("fix", [])} | ({"springs": support["springs"]} if "springs" in support else {})
        lines.append(f"{key(support['node'])} = {toml(table)}")
    for name, section in sections.own.items():
        lines += [f"[sections.{key(name)}]"] + [f"{k} = {toml(v)}" for k, v in section.items()]
    for m in case["members"]:
        material = m.get("material", next(iter(case["materials"])))
        rib = {"name": m["name"], "start": m["start"], "end": m["end"], "material": material}
        rib |= {k: m[k] for k in ("from", "to", "section", "up", "roll", "shear") if k in m}
        if m.get("type") == "truss" and not pinned:
            rib["joints"] = "pinned"
        if "frequency_limits" in case:
            rib["data"] = {"varies": 0.0 if m.get("group") is None else 1.0}
        hinges = {end: m[f"release_{end}"] for end in ("start", "end") if f"release_{end}" in m}
        offset = {end: vector(plane, m[f"offset_{end}"]) for end in ("start", "end") if f"offset_{end}" in m}
        rib |= ({"hinges": hinges} if hinges else {}) | ({"offset": offset} if offset else {})
        lines += ["[[ribs]]"] + [f"{k} = {toml(v)}" for k, v in rib.items()]
    for load in loads(case, plane):
        lines += ["[[loads]]"] + [f"{k} = {toml(v)}" for k, v in load.items()]
    if case.get("combinations"):
        lines.append("[combinations]")
        lines += [f"{key(name)} = {toml(factors)}" for name, factors in case["combinations"].items()]
    for name, require in rows(case, sections):
        lines += ["[[constraints]]", f"name = {toml(name)}", f"require = {toml(require)}"]
    return "\n".join(lines) + "\n"


def solve(binary, file, options):
    command = [binary, "solve", file, "--json", "--out", os.path.join(os.path.dirname(file), "results")]
    for backend in options.backend or []:
        command += ["--backend", backend]
    if options.seconds:
        command += ["--max-seconds", str(options.seconds)]
    begin = time.time()
    done = subprocess.run(command, capture_output=True, text=True)
    seconds = time.time() - begin
    try:
        return json.loads(done.stdout), seconds
    except ValueError:
        return {"status": f"exit {done.returncode}", "message": (done.stderr or done.stdout)[:400]}, seconds


def score(result, optimum):
    value = result.get("objective")
    if value is None:
        return None
    return (value - optimum) / max(abs(optimum), 1e-300)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder")
    arguments.add_argument("binary")
    arguments.add_argument("--out")
    arguments.add_argument("--only", nargs="*")
    arguments.add_argument("--backend", action="append")
    arguments.add_argument("--seconds", type=float)
    arguments.add_argument("--write", action="store_true", help="only write the problem folders")
    options = arguments.parse_args()
    out = options.out or tempfile.mkdtemp()
    right = total = 0
    for path in sorted(glob.glob(os.path.join(options.folder, "*.json"))):
        with open(path, encoding="utf-8") as file:
            case = json.load(file)
        if case.get("format") != "structure-optimum/1" or (options.only and case["id"] not in options.only):
            continue
        try:
            text = problem(case)
        except (LookupError, ValueError, KeyError) as error:
            print(f"{case['id']}: left out, {error!r}")
            continue
        folder = os.path.join(out, case["id"])
        os.makedirs(folder, exist_ok=True)
        target = os.path.join(folder, "problem.toml")
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
        if options.write:
            continue
        total += 1
        optimum = float(case["optimum"]["f"])
        result, seconds = solve(options.binary, target, options)
        gap = score(result, optimum)
        good = gap is not None and gap <= 1e-8 and result["status"] == "certified"
        right += good
        backends = ", ".join(f"{b['backend']} {b.get('status', b.get('termination'))} {b.get('objective')} in {b.get('iterations')}"
                             for b in result.get("backends", []))
        print(f"{case['id']}: {'right' if good else 'WRONG'} {result['status']} {result.get('scope', '')} {result.get('objective')} "
              f"(optimum {optimum}, off by {gap if gap is None else f'{gap:.1e}'}), {seconds:.2f} s; {backends or result.get('message')}")
    if not options.write:
        print(f"{right}/{total} right")


main()
