"""Large structures with sizes of their own for every rib, as ribopt's tables and as CasADi expressions.

Lattice(n): n × n square cells with both diagonals before a wall, every bar its own area, two load cases, limits on stresses and on the
sway of the free edge. Grillage(n): ribs along the inner lines of n × n square cells, every rib its own width and height, a load on every
crossing, limits on stresses, sags and slenderness. Both begin at sizes that satisfy their limits.
"""
import os

import numpy as np

TABLES = """[tables]
nodes = "nodes.csv"
sections = "sections.csv"
ribs = "ribs.csv"
supports = "supports.csv"
loads = "loads.csv"
"""


def write_table(path, header, rows):
    with open(path, "w", encoding="utf-8") as out:
        out.write(header + "\n")
        out.writelines(",".join(str(cell) for cell in row) + "\n" for row in rows)


class Lattice:
    """4n² + n bars, 2n(n + 1) free directions and two cases: 4n(n + 1) states."""

    E, STRESS, LEAST, MOST = 1e4, 10.0, 1e-3, 1e3

    def __init__(self, n):
        self.n, number = n, lambda i, j: i * (n + 1) + j
        self.nodes = np.array([[i, j] for i in range(n + 1) for j in range(n + 1)], float)
        bars = []
        for i in range(n):
            bars += [(number(i, j), number(i + 1, j)) for j in range(n + 1)]
            bars += [(number(i + 1, j), number(i + 1, j + 1)) for j in range(n)]
            for j in range(n):
                bars += [(number(i, j), number(i + 1, j + 1)), (number(i, j + 1), number(i + 1, j))]
        self.bars = np.array(bars)
        span = self.nodes[self.bars[:, 1]] - self.nodes[self.bars[:, 0]]
        self.length = np.linalg.norm(span, axis=1)
        self.direction = span / self.length[:, None]
        self.edge = [number(n, j) for j in range(n + 1)]
        self.loads = [(number(n, n // 2), (0.0, -1.0)), (number(n, n), (1.0, 0.0))]
        self.sway, self.start = 0.02 * n, float(n)

    @property
    def ribs(self):
        return len(self.bars)

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        write_table(f"{folder}/nodes.csv", "name,x,z", ((f"n{k}", x, z) for k, (x, z) in enumerate(self.nodes)))
        write_table(f"{folder}/sections.csv", "name,kind,A.lower,A.upper,A.start",
                    ((f"s{k}", "general", self.LEAST, self.MOST, self.start) for k in range(self.ribs)))
        write_table(f"{folder}/ribs.csv", "name,start,end,section",
                    ((f"r{k}", f"n{a}", f"n{b}", f"s{k}") for k, (a, b) in enumerate(self.bars)))
        write_table(f"{folder}/supports.csv", "node,fix", ((f"n{k}", "pinned") for k in range(self.n + 1)))
        write_table(f"{folder}/loads.csv", "case,node,fx,fz",
                    ((case, f"n{node}", *force) for case, (node, force) in zip("ab", self.loads)))
        only = ", ".join(f'"n{k}"' for k in self.edge)
        with open(f"{folder}/problem.toml", "w", encoding="utf-8") as out:
            out.write(f"""title = "Lattice of {self.ribs} bars"
minimize = "volume"
[structure]
plane = "xz"
joints = "pinned"
[materials]
steel = {{ E = {self.E!r} }}
{TABLES}[[constraints]]
name = "stress"
for = "ribs"
cases = ["a", "b"]
require = "-{self.STRESS!r} <= stress(case, 0.5) <= {self.STRESS!r}"
[[constraints]]
name = "sway"
for = "nodes"
only = [{only}]
cases = ["a", "b"]
require = "-{self.sway!r} <= disp(case, z) <= {self.sway!r}"
""")

    def statement(self):
        """Variables, objective, rows, their limits, start and bounds of the lifted problem, for CasADi."""
        import casadi as ca
        import scipy.sparse as sparse
        from scipy.sparse.linalg import spsolve

        first = 2 * (self.n + 1)
        count = 2 * len(self.nodes) - first
        columns = (2 * self.bars[:, :, None] + np.arange(2)).reshape(self.ribs, 4)
        values = np.hstack([-self.direction, self.direction])
        free = columns >= first
        at = np.repeat(np.arange(self.ribs), 4).reshape(-1, 4)
        b = sparse.csr_matrix((values[free], (at[free], columns[free] - first)), (self.ribs, count))
        area = ca.SX.sym("A", self.ribs)
        x, rows, lower, upper = [area], [], [], []
        start, least, most = [np.full(self.ribs, self.start)], [np.full(self.ribs, self.LEAST)], [np.full(self.ribs, self.MOST)]
        limit = np.full(count, np.inf)
        limit[[2 * k + 1 - first for k in self.edge]] = self.sway
        stiffness = (b.T @ sparse.diags(self.E * self.start / self.length) @ b).tocsc()
        dense = ca.DM(b.tocsc())
        for case, (node, force) in enumerate(self.loads):
            load = np.zeros(count)
            load[2 * node - first:2 * node - first + 2] = force
            u = ca.SX.sym(f"u{case}", count)
            stress = ca.DM(self.E / self.length) * (dense @ u)
            rows += [dense.T @ (area * stress) - load, stress]
            lower += [np.zeros(count), np.full(self.ribs, -self.STRESS)]
            upper += [np.zeros(count), np.full(self.ribs, self.STRESS)]
            x.append(u)
            start.append(spsolve(stiffness, load))
            least.append(-limit)
            most.append(limit)
        joined = [np.concatenate(part) for part in (lower, upper, start, least, most)]
        return (ca.vertcat(*x), ca.dot(ca.DM(self.length), area), ca.vertcat(*rows), *joined)


class Grillage:
    """2n(n − 1) ribs without torsion, three states a crossing and one rotation at every end."""

    E, STRESS, LOAD, SAG, SLENDER = 1e7, 1e4, 1.0, 1 / 300, 5.0
    LOWER, UPPER, START = (0.02, 0.04), (0.3, 1.5), (0.15, 0.6)

    def __init__(self, n):
        self.n = n
        inner = range(1, n)
        self.nodes = [(i, j) for i in range(n + 1) for j in range(n + 1) if i in inner or j in inner]
        self.crossings = [(i, j) for i, j in self.nodes if i in inner and j in inner]
        self.bars = [((i, j), (i + 1, j)) for j in inner for i in range(n)] + [((i, j), (i, j + 1)) for i in inner for j in range(n)]
        self.most = n * self.SAG

    @property
    def ribs(self):
        return len(self.bars)

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        name = lambda node: f"n{node[0]}_{node[1]}"
        write_table(f"{folder}/nodes.csv", "name,x,y,z,crossing",
                    ((name(k), k[0], k[1], 0, "yes" if k in self.crossings else "no") for k in self.nodes))
        sizes = [cell for k in range(2) for cell in (self.LOWER[k], self.UPPER[k], self.START[k])]
        write_table(f"{folder}/sections.csv", "name,kind,b.lower,b.upper,b.start,h.lower,h.upper,h.start",
                    ((f"s{k}", "rectangle", *sizes) for k in range(self.ribs)))
        write_table(f"{folder}/ribs.csv", "name,start,end,section,hinges_end",
                    ((f"r{k}", name(a), name(b), f"s{k}", "T") for k, (a, b) in enumerate(self.bars)))
        held = lambda i, j: "x y rz" if (i, j) in self.crossings else "x y z rx rz" if j in range(1, self.n) else "x y z ry rz"
        write_table(f"{folder}/supports.csv", "node,fix", ((name(k), held(*k)) for k in self.nodes))
        write_table(f"{folder}/loads.csv", "case,node,fz", (("live", name(k), -self.LOAD) for k in self.crossings))
        with open(f"{folder}/problem.toml", "w", encoding="utf-8") as out:
            out.write(f"""title = "Grillage of {self.ribs} ribs"
minimize = "volume"
[structure]
[materials]
steel = {{ E = {self.E!r}, nu = 0.3 }}
{TABLES}[[constraints]]
name = "strength_start"
for = "ribs"
require = "-{self.STRESS!r} <= stress(live, 0, top) <= {self.STRESS!r}"
[[constraints]]
name = "strength_end"
for = "ribs"
require = "-{self.STRESS!r} <= stress(live, 1, top) <= {self.STRESS!r}"
[[constraints]]
name = "slender"
for = "sections"
require = "h <= {self.SLENDER!r}*b"
[[constraints]]
name = "sag"
for = "nodes"
where = 'crossing == "yes"'
require = "disp(live, z) >= -{self.most!r}"
""")

    def statement(self):
        """As Lattice's."""
        import casadi as ca
        import scipy.sparse as sparse
        from scipy.sparse.linalg import spsolve

        crossing, number = set(self.crossings), {}
        for i, j in self.nodes:
            if (i, j) in crossing:
                number[(i, j, "w")] = len(number)
            for slope, runs in (("x", 0 < j < self.n), ("y", 0 < i < self.n)):
                if runs:
                    number[(i, j, slope)] = len(number)
        count = len(number)
        # End slopes less the chord's, e = T·u, of both ends of every rib; M = K·e.
        entries = []
        for k, (a, c) in enumerate(self.bars):
            slope = "x" if a[1] == c[1] else "y"
            for end, node in enumerate((a, c)):
                entries.append((2 * k + end, number[(*node, slope)], 1.0))
                for sign, other in ((1.0, a), (-1.0, c)):
                    if (*other, "w") in number:
                        entries.append((2 * k + end, number[(*other, "w")], sign))
        rows, columns, values = zip(*entries)
        t = sparse.csr_matrix((values, (rows, columns)), (2 * self.ribs, count))
        pair = sparse.kron(sparse.eye(self.ribs), sparse.csr_matrix([[4.0, 2.0], [2.0, 4.0]]))
        load = np.zeros(count)
        load[[number[(*k, "w")] for k in self.crossings]] = -self.LOAD
        bending = self.E * self.START[0] * self.START[1] ** 3 / 12
        u0 = spsolve((t.T @ (bending * pair) @ t).tocsc(), load)
        b, h, u = ca.SX.sym("b", self.ribs), ca.SX.sym("h", self.ribs), ca.SX.sym("u", count)
        twice = lambda value: ca.reshape(ca.horzcat(value, value).T, -1, 1)
        moments = twice(self.E * b * h**3 / 12) * (ca.DM(pair.tocsc()) @ (ca.DM(t.tocsc()) @ u))
        stress = moments / twice(b * h**2 / 6)
        limit = np.full(count, np.inf)
        limit[[number[(*k, "w")] for k in self.crossings]] = self.most
        sizes = lambda values: np.repeat(values, self.ribs)
        return (ca.vertcat(b, h, u), ca.dot(b, h), ca.vertcat(ca.DM(t.tocsc()).T @ moments - load, stress, h - self.SLENDER * b),
                np.concatenate([np.zeros(count), np.full(2 * self.ribs, -self.STRESS), np.full(self.ribs, -np.inf)]),
                np.concatenate([np.zeros(count), np.full(2 * self.ribs, self.STRESS), np.zeros(self.ribs)]),
                np.concatenate([sizes(self.START), u0]), np.concatenate([sizes(self.LOWER), -limit]),
                np.concatenate([sizes(self.UPPER), np.full(count, np.inf)]))


FAMILIES = {"lattice": Lattice, "grillage": Grillage}
