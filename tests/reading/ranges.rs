//! Rows and sums over whole numbers, beside the same problems written out.

use ribopt::input::read_text;
use ribopt::run::Subject;
use ribopt::run::solve::outcome;

/// A hanging chain of N links of equal length: its nodes' mean height is least.
const CHAIN: &str = r#"
minimize = "sum(i in 1..N: y[i] + y[i+1])"
[parameters]
N = 12
link = "2.5/N"
[variables]
x = { size = "N + 1", lower = 0, upper = 2, start = 1 }
y = { size = "N + 1", lower = -2, upper = 0, start = -0.5 }
[[constraints]]
name = "link"
for = "i in 1..N"
require = "(x[i+1] - x[i])^2 + (y[i+1] - y[i])^2 <= link^2"
[[constraints]]
name = "left"
require = "x[1] - y[1] == 0"
[[constraints]]
name = "right"
require = "x[N+1] - y[N+1] == 2"
[[constraints]]
name = "even"
for = "i in 2..N"
require = "x[i+1] >= x[i]"
"#;

/// The same with every row and every term.
fn written_out() -> String {
    let sum: Vec<String> = (1..=12).map(|i| format!("y[{i}] + y[{}]", i + 1)).collect();
    let rows = |from: i32, row: &dyn Fn(i32) -> String| -> String {
        (from..=12).map(|i| format!("[[constraints]]\nname = \"{}\"\n{}\n", format_args!("r{from}_{i}"), row(i))).collect()
    };
    let links = rows(1, &|i| format!("require = \"(x[{k}] - x[{i}])^2 + (y[{k}] - y[{i}])^2 <= link^2\"", k = i + 1));
    let even = rows(2, &|i| format!("require = \"x[{}] >= x[{i}]\"", i + 1));
    let head = CHAIN.split("[[constraints]]").next().unwrap().replace("sum(i in 1..N: y[i] + y[i+1])", &sum.join(" + "));
    format!(
        "{head}{links}[[constraints]]\nname = \"left\"\nrequire = \"x[1] - y[1] == 0\"\n\
         [[constraints]]\nname = \"right\"\nrequire = \"x[N+1] - y[N+1] == 2\"\n{even}"
    )
}

fn optimum(text: &str) -> f64 {
    let subject = Subject::of_text("chain.toml", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let outcome = outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.status.as_str(), "certified", "{}", outcome.message);
    outcome.objective.unwrap()
}

#[test]
fn ten_lines_are_the_problem_written_out() {
    let (short, long) = (optimum(CHAIN), optimum(&written_out()));
    assert!((short - long).abs() <= 1e-9 * long.abs(), "{short} for {long}");
}

#[test]
fn rows_are_called_by_their_number() {
    let problem = read_text("chain.toml", CHAIN).unwrap_or_else(|mistakes| panic!("{mistakes}")).problem;
    let names: Vec<String> = (0..problem.constraints.len()).map(|at| problem.row_name(at, 0)).collect();
    assert_eq!(names[..2], ["link[1]", "link[2]"]);
    assert_eq!((names.len(), names[14].as_str()), (25, "even[2]"));
}

#[test]
fn folds_run_over_numbers_of_parameters_and_may_be_nested() {
    let value = |expression: &str| {
        let text =
            format!("minimize = \"x\"\n[parameters]\nN = 4\na = [1, 2, 3, 4]\n[variables]\nx = {{ lower = \"{expression}\" }}\n");
        read_text("ranges.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")).problem.variables.lower[0]
    };
    assert_eq!(value("sum(i in 1..N: i*a[i])"), 30.0);
    assert_eq!(value("max(k in 2..N: a[k] - a[k-1])"), 1.0);
    assert_eq!(value("sum(i in 1..N: sum(j in i..N: 1))"), 10.0);
    assert_eq!(value("sum(i in 1..0: a[i])"), 0.0);
    assert_eq!(value("sum(i in 1..2*N - 4: a[i])"), 10.0);
}
