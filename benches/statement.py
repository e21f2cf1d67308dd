"""Problems as CasADi expressions, read without ribopt: from the JSON collection, or from a problem file.

Of problem files: variables (vectors too), parameters, definitions, rectangles, H beams, ribs, constraints with `for`,
sum(ribs: ...). No tables, no patterns, no groups.
"""
import math
import re
import tomllib
from types import SimpleNamespace

import casadi as ca

INFINITY = float("inf")
FUNCTIONS = {"sqrt": ca.sqrt, "exp": ca.exp, "log": ca.log, "log10": lambda x: ca.log(x) / math.log(10), "sin": ca.sin, "cos": ca.cos,
             "tan": ca.tan, "asin": ca.asin, "acos": ca.acos, "atan": ca.atan, "atan2": ca.atan2, "sinh": ca.sinh, "cosh": ca.cosh,
             "tanh": ca.tanh, "abs": ca.fabs, "pi": math.pi, "sum": lambda x: ca.sum1(x) if hasattr(x, "shape") else x,
             "max": lambda *x: ca.mmax(ca.vertcat(*x)), "min": lambda *x: ca.mmin(ca.vertcat(*x)),
             "at": lambda array, index: array[int(index) - 1]}


def python(text):
    """The expression in Python's words; indices of `at` count from 1."""
    text = re.sub(r"([A-Za-z_]\w*)\[([^\]]+)\]", r"at(\1, \2)", text.replace("^", "**"))
    return re.sub(r"\bfrom\.", "from_.", text)


def evaluate(text, names):
    if not isinstance(text, str):
        return ca.DM(text) if isinstance(text, list) else text
    while (begin := text.find("sum(ribs:")) >= 0:
        end = closing(text, begin + 3)
        inner = text[begin + len("sum(ribs:"):end]
        total = sum(evaluate(inner, {**names, **vars(rib)}) for rib in names["ribs"])
        names = {**names, f"total_{begin}": total}
        text = f"{text[:begin]}total_{begin}{text[end + 1:]}"
    return eval(python(text), {"__builtins__": {}}, {**FUNCTIONS, **names})


def closing(text, opening):
    depth = 0
    for place in range(opening, len(text)):
        depth += {"(": 1, ")": -1}.get(text[place], 0)
        if depth == 0:
            return place
    raise ValueError(text)


class Statement:
    """min f(x), lower <= x <= upper, row_lower <= g(x) <= row_upper, as CasADi functions."""

    def __init__(self, name):
        self.name, self.sign = name, 1.0
        self.x, self.lower, self.upper, self.start = [], [], [], []
        self.rows, self.row_lower, self.row_upper = [], [], []

    def variable(self, name, lower, upper, start):
        symbol = ca.SX.sym(name)
        lower = -INFINITY if lower is None else float(lower)
        upper = INFINITY if upper is None else float(upper)
        if start is None:
            start = middle(lower, upper)
        self.x.append(symbol)
        self.lower.append(lower)
        self.upper.append(upper)
        self.start.append(float(start))
        return symbol

    def row(self, expression, lower, upper):
        self.rows.append(expression)
        self.row_lower.append(-INFINITY if lower is None else float(lower))
        self.row_upper.append(INFINITY if upper is None else float(upper))

    def finish(self, objective):
        x = ca.vertcat(*self.x)
        f, g = self.sign * ca.SX(objective), ca.vertcat(ca.SX(0, 1), *self.rows)
        self.nlp = {"x": x, "f": f, "g": g}
        self.f = ca.Function("f", [x], [f])
        self.gradient = ca.Function("gradient", [x], [ca.gradient(f, x)])
        self.g = ca.Function("g", [x], [g])
        self.jacobian = ca.Function("jacobian", [x], [ca.densify(ca.jacobian(g, x))])
        return self

    def violation(self, x):
        """The largest relative violation: of a row over max(|limit|, largest slope per relative change of a variable), of a
        bound over the size of the variable (docs/certificate.md)."""
        size = [max(abs(v), abs(s)) or 1.0 for v, s in zip(x, self.start)]
        worst = max([0.0] + [max(low - v, v - high) / d for v, low, high, d in zip(x, self.lower, self.upper, size)])
        values, slopes = self.g(x).full().ravel(), self.jacobian(x).full()
        for value, row, low, high in zip(values, slopes, self.row_lower, self.row_upper):
            slope = max(abs(s) * d for s, d in zip(row, size))
            for excess, limit in ((low - value, low), (value - high, high)):
                if excess > 0:
                    worst = max(worst, excess / (max(abs(limit), slope) or 1.0))
                elif math.isnan(excess):
                    return INFINITY
        return worst


def middle(lower, upper):
    """The start of a variable that names none (docs/problem-file.md)."""
    if math.isfinite(lower) and math.isfinite(upper):
        return (lower + upper) / 2
    if math.isfinite(lower):
        return lower + max(1.0, abs(lower))
    return upper - max(1.0, abs(upper)) if math.isfinite(upper) else 0.0


def pairs(items):
    if isinstance(items, dict):
        return list(items.items())
    return [(i["name"], i.get("expr", i.get("value"))) if isinstance(i, dict) else tuple(i) for i in items or []]


def from_json(problem):
    statement, names = Statement(problem["id"]), {}
    for name, text in pairs(problem.get("constants")):
        names[name] = evaluate(str(text), names)
    for variable in problem["variables"]:
        fields = (variable.get(key) for key in ("lower", "upper", "start"))
        names[variable["name"]] = statement.variable(variable["name"], *fields)
    for name, text in pairs(problem.get("definitions")):
        names[name] = evaluate(text, names)
    for row in problem.get("constraints") or []:
        statement.row(evaluate(row["expr"], names), row.get("lower"), row.get("upper"))
    return statement.finish(evaluate(problem["objective"], names))


def from_toml(path):
    with open(path, "rb") as file:
        problem = tomllib.load(file)
    statement, names = Statement(path), {}
    resolve(problem.get("parameters", {}), names)
    for name, fields in problem.get("variables", {}).items():
        names[name] = declared(statement, name, fields, names)
    sections = {name: SimpleNamespace(**section.get("data", {})) for name, section in problem.get("sections", {}).items()}
    names.update(sections)
    definitions = resolve(problem.get("definitions", {}), names)
    for name, section in problem.get("sections", {}).items():
        cross_section(statement, sections[name], name, section, names)
    if unknown := resolve(definitions, names):
        raise NameError(f"{path}: {sorted(unknown)} cannot be resolved")
    names["ribs"] = [rib(fields, sections, names) for fields in problem.get("ribs", [])]
    names["volume"] = sum(rib.volume for rib in names["ribs"])
    for constraint in problem.get("constraints", []):
        items = {"sections": sections.values(), "ribs": names["ribs"]}.get(constraint.get("for"), [SimpleNamespace()])
        for item in items:
            requirement(statement, constraint["require"], {**names, **vars(item)})
    statement.sign = -1.0 if "maximize" in problem else 1.0
    return statement.finish(evaluate(problem.get("maximize", problem.get("minimize", "volume")), names))


def resolve(texts, names):
    """Adds expressions given in any order to the names; returns those that need what is not yet known."""
    waiting, progress = dict(texts), True
    while waiting and progress:
        progress = False
        for name, text in list(waiting.items()):
            try:
                names[name] = evaluate(text, names)
            except (NameError, AttributeError):
                continue
            del waiting[name]
            progress = True
    return waiting


def declared(statement, name, fields, names):
    def value(key, k):
        given = fields.get(key)
        given = given[k] if isinstance(given, list) else given
        return None if given is None else float(evaluate(given, names))
    keys = ("lower", "upper", "start")
    if "size" not in fields:
        return statement.variable(name, *(value(key, 0) for key in keys))
    return ca.vertcat(*(statement.variable(f"{name}[{k + 1}]", *(value(key, k) for key in keys)) for k in range(fields["size"])))


ALIASES = {"b1": "tw", "b2": "b", "h1": "hw", "h2": "h"}


def cross_section(statement, section, name, fields, names):
    dimensions = {key: given for key, given in fields.items() if key not in ("kind", "data")}
    for key, given in dimensions.items():
        if isinstance(given, dict):
            setattr(section, key, declared(statement, f"{name}.{key}", given, names))
    for key, given in dimensions.items():
        if not isinstance(given, dict):
            setattr(section, key, evaluate(given, {**vars(section), **names}))
    section.complete = {"rectangle": rectangle, "h-beam": h_beam}[fields["kind"]]
    section.complete(section)


def rectangle(s):
    s.parts = [s.b * s.h]
    s.A, s.Ix, s.Iy, s.Wx, s.Wy = s.b * s.h, s.b * s.h**3 / 12, s.h * s.b**3 / 12, s.b * s.h**2 / 6, s.h * s.b**2 / 6


def h_beam(s):
    for alias, name in ALIASES.items():
        if hasattr(s, alias):
            setattr(s, name, getattr(s, alias))
    if hasattr(s, "t"):
        s.tf = s.t / 2
    if not hasattr(s, "h"):
        s.h = s.hw + 2 * s.tf
    elif not hasattr(s, "tf"):
        s.tf = (s.h - s.hw) / 2
    else:
        s.hw = s.h - 2 * s.tf
    s.parts = [s.tw * s.hw, 2 * s.b * s.tf]
    s.A = sum(s.parts)
    s.Ix = (s.b * s.h**3 - (s.b - s.tw) * s.hw**3) / 12
    s.Iy = (2 * s.tf * s.b**3 + s.hw * s.tw**3) / 12
    s.Wx, s.Wy = 2 * s.Ix / s.h, 2 * s.Iy / s.b


def rib(fields, sections, names):
    ends = [sections[fields.get("section") or fields[key]] for key in ("from", "to")]
    data = {key: given if isinstance(given, str) else evaluate(given, names) for key, given in fields.get("data", {}).items()}
    length = evaluate(fields["length"], names)
    volume = {"frustum": frustum, "prismatoid": prismatoid}[fields.get("volume", "frustum")](length, *ends)
    return SimpleNamespace(name=fields["name"], length=length, volume=volume, from_=ends[0], to=ends[1], **data)


def frustum(length, start, end):
    return sum(length / 3 * (a + b + ca.sqrt(a * b)) for a, b in zip(start.parts, end.parts))


def prismatoid(length, start, end):
    mean = SimpleNamespace(**{key: (getattr(start, key) + getattr(end, key)) / 2 for key in ("b", "h", "tw", "tf") if hasattr(start, key)})
    start.complete(mean)
    return length / 6 * (start.A + 4 * mean.A + end.A)


def requirement(statement, text, names):
    sides = re.split(r"(<=|>=|==)", text)
    values = [evaluate(side.strip(), names) for side in sides[::2]]
    if len(values) == 3:
        statement.row(values[1], values[0], values[2])
        return
    left, right = values
    if isinstance(right, ca.SX):
        left, right = left - right, 0.0
    elif isinstance(left, (int, float)):
        return
    lower = None if sides[1] == "<=" else right
    upper = None if sides[1] == ">=" else right
    statement.row(left, lower, upper)
