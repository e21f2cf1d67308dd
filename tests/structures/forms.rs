//! A truss in three forms: as a structure, with its displacements as variables, and with its forces as variables, too. What is asked is the
//! same, and so must be what is answered.

use std::fmt::Write as _;

use ribopt::crosscheck::Status;
use ribopt::run::solve::outcome;

use super::*;

const MODULUS: f64 = 1e4;

/// A cantilever of nx × ny square cells with both diagonals before a wall, a load of 1 down at the middle of its free edge.
struct Cantilever {
    nx: usize,
    ny: usize,
    bars: Vec<(usize, usize)>,
}

impl Cantilever {
    fn new(nx: usize, ny: usize) -> Self {
        let at = |i: usize, j: usize| i * (ny + 1) + j;
        let mut bars = Vec::new();
        for i in 0..=nx {
            for j in 0..=ny {
                bars.extend((i < nx).then(|| (at(i, j), at(i + 1, j))));
                bars.extend((j < ny && i > 0).then(|| (at(i, j), at(i, j + 1))));
                bars.extend(
                    (i < nx && j < ny)
                        .then(|| [(at(i, j), at(i + 1, j + 1)), (at(i, j + 1), at(i + 1, j))])
                        .into_iter()
                        .flatten(),
                );
            }
        }
        Cantilever { nx, ny, bars }
    }

    fn nodes(&self) -> usize {
        (self.nx + 1) * (self.ny + 1)
    }

    fn place(&self, node: usize) -> [f64; 2] {
        [(node / (self.ny + 1)) as f64, (node % (self.ny + 1)) as f64]
    }

    /// The node under the load.
    fn loaded(&self) -> usize {
        self.nx * (self.ny + 1) + self.ny / 2
    }

    /// Length and direction of a bar.
    fn line(&self, (a, b): (usize, usize)) -> (f64, [f64; 2]) {
        let ([x, z], [to_x, to_z]) = (self.place(a), self.place(b));
        let length = (to_x - x).hypot(to_z - z);
        (length, [(to_x - x) / length, (to_z - z) / length])
    }

    /// The largest sag.
    fn sag(&self) -> f64 {
        0.02 * self.nx as f64
    }

    fn structure(&self) -> String {
        let mut text = format!(
            "minimize = \"volume\"\n[structure]\nplane = \"xz\"\njoints = \"pinned\"\n[materials.s]\nE = {MODULUS:?}\n[nodes]\n"
        );
        for node in 0..self.nodes() {
            let [x, z] = self.place(node);
            writeln!(text, "n{node} = [{x:?}, {z:?}]").unwrap();
        }
        text += "[supports]\n";
        (0..=self.ny).for_each(|node| writeln!(text, "n{node} = \"pinned\"").unwrap());
        for (at, (a, b)) in self.bars.iter().enumerate() {
            writeln!(
                text,
                "[sections.s{at}]\nkind = \"general\"\nA = {{ lower = 1e-3, upper = 1e3, start = {:?} }}",
                self.nx as f64
            )
            .unwrap();
            writeln!(text, "[[ribs]]\nname = \"r{at}\"\nstart = \"n{a}\"\nend = \"n{b}\"\nsection = \"s{at}\"").unwrap();
        }
        let sag = self.sag();
        text + &format!(
            "[[loads]]\ncase = \"P\"\nnodes = [\"n{}\"]\nforce = [0, -1]\n\
             [[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"-10 <= stress(P, 0.5) <= 10\"\n\
             [[constraints]]\nname = \"sag\"\nfor = \"nodes\"\nrequire = \"-{sag:?} <= disp(P, z) <= {sag:?}\"\n",
            self.loaded()
        )
    }

    /// The number of a displacement among those of the nodes off the wall, counted from 1.
    fn displacement(&self, node: usize, axis: usize) -> Option<usize> {
        node.checked_sub(self.ny + 1).map(|free| 2 * free + axis + 1)
    }

    /// How much longer a bar becomes.
    fn stretch(&self, (a, b): (usize, usize)) -> String {
        let (_, direction) = self.line((a, b));
        let term = |sign: f64, node: usize, axis: usize| {
            let share = sign * direction[axis];
            self.displacement(node, axis).filter(|_| share != 0.0).map(|u| format!("{share:?}*u[{u}]"))
        };
        let terms = [term(-1.0, a, 0), term(-1.0, a, 1), term(1.0, b, 0), term(1.0, b, 1)];
        terms.into_iter().flatten().collect::<Vec<_>>().join(" + ")
    }

    /// Displacements as a computation leaves them: a deflected line, and in its neutral axis what is 0 but for rounding.
    fn starts(&self) -> String {
        let along = |node: usize, axis: usize| {
            let [x, z] = self.place(node);
            let above = z - 0.5 * self.ny as f64;
            match axis {
                0 if above == 0.0 => 1e-20 * (1.0 + x),
                0 => 1e-6 * x * above,
                _ => -1e-6 * x * x,
            }
        };
        let all = (self.ny + 1..self.nodes()).flat_map(|node| [along(node, 0), along(node, 1)]);
        all.map(|u| format!("{u:?}")).collect::<Vec<_>>().join(", ")
    }

    fn by_hand(&self, has_forces: bool) -> String {
        let count = self.bars.len();
        let (mut rows, mut volume) = (String::new(), Vec::new());
        let mut balance = vec![Vec::new(); 2 * (self.nodes() - self.ny - 1)];
        let mut row =
            |name: String, text: String| writeln!(rows, "[[constraints]]\nname = \"{name}\"\nrequire = \"{text}\"").unwrap();
        for (e, &(a, b)) in self.bars.iter().enumerate() {
            let (number, (length, direction), stretch) = (e + 1, self.line((a, b)), self.stretch((a, b)));
            let stiffness = MODULUS / length;
            volume.push(format!("{length:?}*A[{number}]"));
            if has_forces {
                row(format!("bar{number}"), format!("N[{number}]*{:?} - A[{number}]*({stretch}) == 0", 1.0 / stiffness));
                row(format!("tension{number}"), format!("N[{number}] - 10*A[{number}] <= 0"));
                row(format!("compression{number}"), format!("N[{number}] + 10*A[{number}] >= 0"));
            } else {
                row(format!("stress{number}"), format!("-10 <= {stiffness:?}*({stretch}) <= 10"));
            }
            for (sign, node) in [(-1.0, a), (1.0, b)] {
                for (axis, along) in direction.iter().enumerate() {
                    let share = sign * along;
                    if let Some(u) = self.displacement(node, axis).filter(|_| share != 0.0) {
                        balance[u - 1].push(match has_forces {
                            true => format!("{share:?}*N[{number}]"),
                            false => format!("{:?}*A[{number}]*({stretch})", share * stiffness),
                        });
                    }
                }
            }
        }
        for (u, terms) in balance.iter().enumerate() {
            let load = if Some(u + 1) == self.displacement(self.loaded(), 1) { -1.0 } else { 0.0 };
            row(format!("balance{}", u + 1), format!("{} == {load:?}", terms.join(" + ")));
        }
        let limits = |sign: f64| {
            let of = |axis: usize| if axis == 0 { sign * f64::INFINITY } else { sign * self.sag() };
            (0..balance.len()).map(|u| of(u % 2)).map(|limit| format!("{limit:?}")).collect::<Vec<_>>().join(", ")
        };
        let forces = if has_forces { format!("N = {{ size = {count} }}\n") } else { String::new() };
        format!(
            "minimize = \"{}\"\n[variables]\nA = {{ size = {count}, lower = 1e-3, upper = 1e3, start = {:?} }}\n\
             u = {{ size = {}, lower = [{}], upper = [{}], start = [{}] }}\n{forces}{rows}",
            volume.join(" + "),
            self.nx as f64,
            balance.len(),
            limits(-1.0),
            limits(1.0),
            self.starts()
        )
    }
}

#[test]
fn a_truss_written_out_by_hand_is_proved_like_the_structure() {
    for (nx, ny) in [(4, 2), (14, 2)] {
        let cantilever = Cantilever::new(nx, ny);
        let forms = [cantilever.structure(), cantilever.by_hand(false), cantilever.by_hand(true)];
        let objective = |(at, text): (usize, &String)| {
            let name = format!("cantilever-{nx}-{at}");
            let found =
                outcome(&Subject::read(&file("forms", &name, text), &[]).unwrap_or_else(|error| panic!("{name}: {error}")))
                    .unwrap();
            assert_eq!(found.status, Status::Certified, "{name}: {}", found.message);
            found.objective.unwrap()
        };
        let found: Vec<f64> = forms.iter().enumerate().map(objective).collect();
        assert!(found.iter().all(|other| (other / found[0] - 1.0).abs() < 1e-7), "{nx} × {ny}: {found:?}");
    }
}
