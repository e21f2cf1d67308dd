//! Sizes from lists: the best choice against all choices one by one, and what is said of it.

mod support;

use rayon::prelude::*;
use ribopt::certificate::Extent;
use ribopt::crosscheck::{Outcome, Status};
use ribopt::math::split_mix::SplitMix;
use ribopt::run::Subject;
use ribopt::run::solve::outcome;

fn subject(text: &str) -> Subject {
    Subject::of_text("lists.toml", text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn solved(text: &str) -> Outcome {
    outcome(&subject(text)).unwrap_or_else(|error| panic!("{error}"))
}

/// Two lists, numbers of a problem, and the least objective over all pairs; the text of the problem.
struct Random {
    text: String,
    best: Option<f64>,
}

/// `count` values between 0.5 and 3, ascending.
fn values(random: &mut SplitMix, count: usize) -> Vec<f64> {
    let mut list: Vec<f64> = (0..count).map(|_| 0.5 + 2.5 * random.uniform()).collect();
    list.sort_by(f64::total_cmp);
    list
}

fn least(x: &[f64], y: &[f64], objective: impl Fn(f64, f64) -> Option<f64>) -> Option<f64> {
    x.iter().flat_map(|&x| y.iter().map(move |&y| (x, y))).filter_map(|(x, y)| objective(x, y)).reduce(f64::min)
}

fn random(seed: u64) -> Random {
    let mut random = SplitMix::new(seed);
    let counts = [2, 3].map(|least| least + (random.uniform() * 4.0) as usize);
    let [x, y] = counts.map(|count| values(&mut random, count));
    let [a, b, c, d] = [(); 4].map(|()| 0.3 + 2.0 * random.uniform());
    let variables =
        format!("[variables]\nx = {{ values = {x:?} }}\ny = {{ values = {y:?} }}\nz = {{ lower = 0.1, upper = 20 }}\n");
    let rows = |rows: &[String]| rows.iter().map(|row| format!("[[constraints]]\nrequire = \"{row}\"\n")).collect::<String>();
    let (objective, rows, best) = match seed % 3 {
        // A geometric program: z is what is left to be solved for.
        0 => (
            format!("{a}*x*y + z"),
            rows(&[format!("{c}/(x*y^2) <= 1"), format!("{d}/(y*z) <= 1")]),
            least(&x, &y, |x, y| (c / (x * y * y) <= 1.0).then(|| a * x * y + (d / y).max(0.1))),
        ),
        // A linear program.
        1 => (
            format!("{a}*x + {b}*y + z"),
            rows(&[format!("x + {c}*y + z >= 4"), format!("z <= {d}")]),
            least(&x, &y, |x, y| {
                let z = (4.0 - x - c * y).max(0.1);
                (z <= d).then_some(a * x + b * y + z)
            }),
        ),
        // A convex program.
        _ => (
            format!("(x - {a})^2 + (y - {b})^2 + exp(z - 1)"),
            rows(&[format!("x^2 + y^2 <= {}", 2.0 + 3.0 * c), format!("x + y + z >= {}", 2.0 + d)]),
            least(&x, &y, |x, y| {
                let z = (2.0 + d - x - y).max(0.1);
                (x * x + y * y <= 2.0 + 3.0 * c).then(|| (x - a).powi(2) + (y - b).powi(2) + (z - 1.0).exp())
            }),
        ),
    };
    Random { text: format!("minimize = \"{objective}\"\n{variables}{rows}"), best }
}

#[test]
fn the_best_choice_of_random_lists_is_that_of_all_choices_one_by_one() {
    let failures: Vec<String> = (0..200_u64)
        .into_par_iter()
        .filter_map(|seed| {
            let Random { text, best } = random(seed);
            let outcome = solved(&text);
            let right = match best {
                Some(best) => {
                    let near = outcome.objective.is_some_and(|found| (found - best).abs() <= 1e-6 * best.abs());
                    near && (outcome.status, outcome.scope) == (Status::Certified, Extent::Global)
                }
                None => (outcome.status, outcome.scope) == (Status::Infeasible, Extent::Global),
            };
            let (found, message) = (outcome.objective, &outcome.message);
            (!right).then(|| format!("seed {seed}: {found:?} for {best:?}, {:?}: {message}\n{text}", outcome.status))
        })
        .collect();
    assert!(failures.is_empty(), "{} of 200:\n{}", failures.len(), failures.join("\n"));
    let infeasible = (0..200).filter(|&seed| random(seed).best.is_none()).count();
    assert!((5..150).contains(&infeasible), "{infeasible} have no choice");
}

#[test]
fn whole_numbers_and_steps_are_lists() {
    let text = "maximize = \"3*n + 2*m\"\n[variables]\nn = { integer = true, lower = 0, upper = 10 }\n\
                m = { step = 0.5, lower = 0, upper = 10 }\n[[constraints]]\nrequire = \"2*n + m <= 9.3\"\n\
                [[constraints]]\nrequire = \"n + 3*m <= 14.2\"\n";
    let outcome = solved(text);
    // n = 2 and m = 4: 14; n = 3 and m = 3 is 15; n = 3, m = 3.5 needs 9.5.
    assert_eq!((outcome.status, outcome.scope), (Status::Certified, Extent::Global), "{}", outcome.message);
    assert_eq!(outcome.x, [3.0, 3.0]);
    assert!(outcome.message.starts_with("Proved best of the list"), "{}", outcome.message);
}

#[test]
fn a_list_whose_choices_meet_no_limit_is_infeasible_though_sizes_between_would_do() {
    let text = "minimize = \"x\"\n[variables]\nx = { values = [1, 2, 4, 8] }\n[[constraints]]\nrequire = \"2.5 <= x <= 3.5\"\n";
    let outcome = solved(text);
    assert_eq!((outcome.status, outcome.scope), (Status::Infeasible, Extent::Global));
    assert!(outcome.message.contains("No choice of sizes"), "{}", outcome.message);
}

#[test]
fn what_is_not_convex_is_never_called_proved() {
    let text = "minimize = \"x*y + sin(3*x)\"\n[variables]\nx = { values = [0.5, 1, 1.5, 2] }\ny = { step = 0.25, lower = 0.5, upper = 3 }\n\
                [[constraints]]\nrequire = \"x*y^2 >= 2\"\n";
    let outcome = solved(text);
    assert_eq!((outcome.status, outcome.scope), (Status::Uncertified, Extent::Local), "{}", outcome.message);
    assert!(outcome.message.contains("nothing is proved"), "{}", outcome.message);
    let best = [0.5, 1.0, 1.5, 2.0].iter().flat_map(|&x: &f64| (2..=12).map(move |k| (x, 0.25 * f64::from(k))));
    let best = best.filter(|(x, y)| x * y * y >= 2.0).map(|(x, y)| x * y + (3.0 * x).sin()).reduce(f64::min).unwrap();
    assert!((outcome.objective.unwrap() - best).abs() < 1e-9, "{:?} for {best}", outcome.objective);
}

#[test]
fn a_truss_of_listed_bars_is_as_light_as_the_best_that_was_published() {
    // Rajeev and Krishnamoorthy (1992), J. Struct. Eng. 118:1233-1250, gave the list; 5490.74 lb is the lightest published design of case 1.
    let list = "1.62, 1.80, 1.99, 2.13, 2.38, 2.62, 2.63, 2.88, 2.93, 3.09, 3.13, 3.38, 3.47, 3.55, 3.63, 3.84, 3.87, 3.88, 4.18, 4.22, 4.49, \
                4.59, 4.80, 4.97, 5.12, 5.74, 7.22, 7.97, 11.5, 13.5, 13.9, 14.2, 15.5, 16.0, 16.9, 18.8, 19.9, 22.0, 22.9, 26.5, 30.0, 33.5";
    let ten_bars = std::fs::read_to_string("problems/ten-bar-truss.toml").unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("ten-bar-truss")).unwrap();
    std::fs::copy("problems/ten-bar-truss/ribs.csv", folder.path().join("ten-bar-truss/ribs.csv")).unwrap();
    let without_table: String =
        ten_bars.lines().filter(|line| !line.starts_with("sections =")).map(|line| format!("{line}\n")).collect();
    let sections: String =
        (1..=10).map(|k| format!("[sections.s{k}]\nkind = \"general\"\nA = {{ values = [{list}] }}\n")).collect();
    let file = folder.path().join("listed.toml");
    std::fs::write(&file, without_table + &sections).unwrap();
    let outcome = outcome(&support::read(&file)).unwrap_or_else(|error| panic!("{error}"));
    let objective = outcome.objective.expect("a design");
    assert!(objective < 5490.74, "{objective}");
    assert_eq!(outcome.status, Status::Uncertified, "{}", outcome.message);
    assert!(outcome.lower_bound.is_none_or(|bound| bound <= objective), "{:?}", outcome.lower_bound);
}

#[test]
fn a_search_that_has_no_time_keeps_the_best_so_far_and_says_how_far_it_is() {
    let mut subject = support::read(std::path::Path::new("problems/vanderplaats-grid.toml"));
    subject.settings.max_seconds = 0.5;
    let outcome = outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
    let objective = outcome.objective.expect("a point");
    // Sizes between rows are below; they are never called an answer.
    assert!(objective >= 69_250.0 - 1e-6 || outcome.message.contains("between rows"), "{objective}: {}", outcome.message);
    match outcome.status {
        // Half a second may do on a fast machine.
        Status::Certified => assert!((objective - 69_250.0).abs() < 1e-3),
        Status::LimitReached => assert!(outcome.lower_bound.is_none_or(|bound| bound <= 69_250.0 + 1e-3), "{}", outcome.message),
        other => panic!("{}: {}", other.as_str(), outcome.message),
    }
}

#[test]
fn rolled_profiles_have_the_properties_of_their_tables() {
    // A in cm² of all eighteen, and Ix in cm⁴ of five, as manufacturers and EN 10365 (former Euronorm 19-57) print them.
    #[rustfmt::skip]
    let areas = [
        (80, 7.64), (100, 10.32), (120, 13.21), (140, 16.43), (160, 20.09), (180, 23.95), (200, 28.48), (220, 33.37), (240, 39.12),
        (270, 45.95), (300, 53.81), (330, 62.61), (360, 72.73), (400, 84.46), (450, 98.82), (500, 115.5), (550, 134.4), (600, 156.0),
    ];
    let moments = [(80, 80.1), (200, 1943.0), (300, 8356.0), (400, 23_130.0), (600, 92_080.0)];
    let subject = support::read(std::path::Path::new("problems/floor-beams-ipe.toml"));
    let catalogue = &subject.problem().listed[0];
    assert_eq!(catalogue.rows.len(), 18);
    let of = |height: i32, column: usize| {
        let name = format!("IPE {height}");
        catalogue.rows[catalogue.names.iter().position(|known| *known == name).unwrap()][column]
    };
    for (height, area) in areas {
        assert!((of(height, 0) * 1e4 / area - 1.0).abs() < 5e-4, "IPE {height}: A {}", of(height, 0) * 1e4);
    }
    for (height, moment) in moments {
        // Printed to three or four digits.
        assert!((of(height, 1) * 1e8 / moment - 1.0).abs() < 1e-3, "IPE {height}: Ix {}", of(height, 1) * 1e8);
    }
}

#[test]
fn a_frame_of_ten_rolled_members_gets_a_design_that_is_called_good_and_not_proved() {
    let outcome = outcome(&support::read(std::path::Path::new("examples/lists/ten-member-frame.toml"))).unwrap();
    assert_ne!(outcome.status, Status::Certified, "{}", outcome.message);
    // IPE 300 below and above, 330 under the floor, 270 under the roof.
    let mass = outcome.objective.unwrap();
    assert!(mass <= 1.9097 && outcome.message.contains("nothing is proved"), "{mass}: {}", outcome.message);
}
