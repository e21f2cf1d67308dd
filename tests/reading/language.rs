//! The language of models with an index: each example beside the form it would have without one, and what every addition computes.

use std::fs;
use std::path::Path;

use ribopt::input::{Input, read_text};
use ribopt::run::Subject;
use ribopt::run::solve::outcome;

/// The file with `N` replaced, so that it is solved in a moment.
fn example(name: &str, n: usize) -> String {
    let text = fs::read_to_string(Path::new("examples/language").join(name)).unwrap();
    let at = text.find("N = ").unwrap();
    let end = text[at..].find(',').unwrap() + at;
    format!("{}N = {n}{}", &text[..at], &text[end..])
}

/// The text with a name replaced by a number, where it stands as a word.
fn with(text: &str, name: &str, number: usize) -> String {
    let is_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let mut out = String::new();
    for (at, found) in text.char_indices() {
        let whole = text[at..].starts_with(name)
            && !is_word(text[..at].chars().next_back())
            && !is_word(text[at + name.len()..].chars().next());
        match whole {
            true => out += &number.to_string(),
            false => out.push(found),
        }
    }
    out
}

/// Every `sum(i in 1..N: …)` with each of its terms, and every constraint `for = "i in 1..N"` with each of its rows.
fn written_out(text: &str, n: usize) -> String {
    let mut parts = text.split("[[constraints]]\n");
    let mut out = terms(parts.next().unwrap(), n);
    for part in parts {
        let repeated = part.contains("for = \"i in 1..N\"\n");
        let row = part.replace("for = \"i in 1..N\"\n", "");
        for i in 1..=if repeated { n } else { 1 } {
            let row = if repeated { with(&row, "i", i) } else { row.clone() };
            out += &format!("[[constraints]]\n{}", row.replacen("name = \"", &format!("name = \"r{i}_"), 1));
        }
    }
    out
}

/// The first `sum(i in 1..N: …)` of a text with each of its terms.
fn terms(text: &str, n: usize) -> String {
    let Some(at) = text.find("sum(i in 1..N: ") else { return text.to_owned() };
    let body = &text[at + "sum(i in 1..N: ".len()..];
    let mut depth = 1;
    let end = body.find(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth == 0
    });
    let (body, rest) = body.split_at(end.unwrap());
    let sum: Vec<String> = (1..=n).map(|i| format!("({})", with(body, "i", i))).collect();
    format!("{}({}{rest}", &text[..at], sum.join(" + "))
}

fn optimum(text: &str) -> f64 {
    let subject = Subject::of_text("model.toml", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let outcome = outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.status.as_str(), "certified", "{}", outcome.message);
    outcome.objective.unwrap()
}

fn same(short: &str, long: &str) -> f64 {
    let (short, long) = (optimum(short), optimum(long));
    assert!((short - long).abs() <= 1e-6 * long.abs().max(1.0), "{short} for {long}");
    short
}

#[test]
fn the_beam_is_the_problem_written_out() {
    let text = example("beam.toml", 20);
    let value = same(&text, &written_out(&text, 20));
    // Straight, it costs the whole load.
    assert!(value < 350.0 - 1e-3, "{value}");
}

#[test]
fn the_chain_is_the_problem_written_out() {
    let text = example("chain.toml", 20);
    same(&text, &written_out(&text, 20));
}

#[test]
fn the_rocket_is_the_problem_written_out() {
    let text = example("rocket.toml", 20);
    let rows = |text: &str| {
        // Parts of arrays row by row.
        let mut out = String::new();
        for part in text.split("[[constraints]]\n") {
            let of_parts = part.contains("[2..N+1]");
            let row = part.replace("[2..N+1]", "[i+1]").replace("[1..N]", "[i]");
            let row = if of_parts { row.replacen("require", "for = \"i in 1..N\"\nrequire", 1) } else { row };
            out += &format!("{}{row}", if out.is_empty() { "" } else { "[[constraints]]\n" });
        }
        out
    };
    let value = same(&text, &written_out(&rows(&text), 20));
    // Outcomes are of what is minimised: the height with its sign turned. COPS: 1.01283 with many steps.
    assert!((1.0127..1.01283).contains(&-value), "{value}");
}

#[test]
fn models_of_some_hundred_rows_are_ten_lines() {
    for (name, rows) in [("beam.toml", 200), ("rocket.toml", 153), ("chain.toml", 102)] {
        let text = fs::read_to_string(Path::new("examples/language").join(name)).unwrap();
        let problem = read(&text).problem;
        let count: usize = problem.constraints.iter().map(|constraint| constraint.scope.rows()).sum();
        assert_eq!(count, rows, "{name}");
        let statements =
            text.lines().filter(|line| line.contains(" = \"") && !line.starts_with("name") && !line.starts_with("for"));
        assert!(statements.count() <= 12, "{name}");
    }
}

fn read(text: &str) -> Input {
    read_text("model.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

/// The value of an expression of constants.
fn value(expression: &str) -> f64 {
    let constants = "[parameters]\nN = 4\na = [1, 2, 3, 4]\nQ = [[2, 1], [1, 3]]\nb = [5, 7]\n";
    read(&format!("minimize = \"x\"\n{constants}[variables]\nx = {{ lower = \"{expression}\" }}\n")).problem.variables.lower[0]
}

#[test]
fn parts_products_and_forms_have_their_values() {
    assert_eq!(value("sum(a[2..N] - a[1..N-1])"), 3.0);
    assert_eq!(value("sum(a[3..3])"), 3.0);
    assert_eq!(value("dot(a, a)"), 30.0);
    assert_eq!(value("dot(b, a[1..2])"), 19.0);
    // 2·25 + 2·35 + 3·49
    assert_eq!(value("quadratic(Q, b)"), 267.0);
    assert!((value("erf(1)") - 0.842_700_792_949_714_9).abs() < 1e-15);
    assert_eq!(value("erf(-30)"), -1.0);
}

#[test]
fn quadratic_forms_are_seen_to_be_convex() {
    let file =
        |q: &str| format!("minimize = \"quadratic(Q, x) - sum(x)\"\n[parameters]\nQ = {q}\n[variables]\nx = {{ size = 2 }}\n");
    let class = |q: &str| Subject::of_text("q.toml", &file(q)).unwrap().class().to_string();
    assert_eq!(class("[[2, 1], [1, 3]]"), "convex");
    assert_eq!(class("[[2, 3], [3, 3]]"), "nonlinear");
    // x = Q⁻¹·(1, 1)/2 = (2, 1)/10: −sum(x)/2.
    assert!((optimum(&file("[[2, 1], [1, 3]]")) + 0.15).abs() < 1e-12);
}

/// Elements that follow from those before them, beside the same with variables and equations.
#[test]
fn a_sequence_is_what_equations_between_states_are() {
    let sequences = r#"
        minimize = "sum(a^2)"
        parameters = { N = 8, dt = 0.5 }
        variables.a = { size = "N", lower = -9, upper = 9 }
        [definitions]
        place = { for = "i in 1..N", first = 0, value = "place[i-1] + dt*speed[i-1]" }
        speed = { for = "i in 1..N", first = 1, value = "speed[i-1] + dt*(a[i-1] - 0.1*speed[i-1]^2)" }
        [[constraints]]
        require = "place[N] == 5"
        [[constraints]]
        require = "speed[N] == 0"
    "#;
    let states = r#"
        minimize = "sum(a^2)"
        parameters = { N = 8, dt = 0.5 }
        [variables]
        a = { size = "N", lower = -9, upper = 9 }
        place = { size = "N", start = 1 }
        speed = { size = "N", start = 1 }
        [[constraints]]
        name = "p"
        for = "i in 2..N"
        require = "place[i] == place[i-1] + dt*speed[i-1]"
        [[constraints]]
        name = "s"
        for = "i in 2..N"
        require = "speed[i] == speed[i-1] + dt*(a[i-1] - 0.1*speed[i-1]^2)"
        [[constraints]]
        require = "place[1] == 0"
        [[constraints]]
        require = "speed[1] == 1"
        [[constraints]]
        require = "place[N] == 5"
        [[constraints]]
        require = "speed[N] == 0"
    "#;
    same(sequences, states);
}

#[test]
fn the_first_elements_may_be_several() {
    let text = "minimize = \"x\"\nvariables.x = { lower = 1 }\n[definitions]\nf = { for = \"i in 1..10\", first = [1, 1], value = \"f[i-1] + f[i-2]\" }\n[[constraints]]\nrequire = \"x >= f[10]\"\n";
    assert!((optimum(text) - 55.0).abs() < 1e-9);
}

#[test]
fn long_sequences_need_no_stack_and_longer_ones_are_refused() {
    let text = |n: usize| {
        format!(
            "minimize = \"s[{n}]\"\nvariables.x = {{ lower = 1, upper = 2 }}\n[definitions]\ns = {{ for = \"i in 1..{n}\", first = \"x\", value = \"s[i-1] + x/{n}\" }}\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.toml");
    fs::write(&file, text(5000)).unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_ribopt")).arg("check").arg(&file).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mistakes = read_text("long.toml", &text(5001)).unwrap_err();
    assert_eq!(mistakes.list.len(), 1, "{mistakes}");
}

#[test]
fn equations_need_no_objective() {
    let text = "[variables]\nx = { start = 1 }\ny = { start = 2 }\n[[constraints]]\nrequire = \"x^2 + y^2 == 25\"\n[[constraints]]\nrequire = \"x - y == -1\"\n";
    let subject = Subject::of_text("equations.toml", text).unwrap();
    let outcome = outcome(&subject).unwrap();
    assert_eq!(outcome.status.as_str(), "certified", "{}", outcome.message);
    let without = text.replace("==", "<=");
    let mistakes = read_text("limits.toml", &without).unwrap_err();
    assert_eq!(mistakes.list[0].message, "there is no objective");
}

#[test]
fn one_unknown_function_is_one_mistake() {
    for text in [
        "minimize = \"foo(x)\"\n",
        "minimize = \"foo(x) + 1\"\n[[constraints]]\nfor = \"i in 1..3\"\nrequire = \"x >= i\"\n",
        "minimize = \"x\"\n[[constraints]]\nfor = \"i in 1..3\"\nrequire = \"foo(x) >= i\"\n",
        "minimize = \"sum(i in 1..3: foo(x)*i)\"\n",
        "minimize = \"d\"\n[definitions]\nd = \"foo(x)\"\ne = \"d + 1\"\n",
        "minimize = \"d[3]\"\n[definitions]\nd = { for = \"i in 1..3\", first = 0, value = \"foo(d[i-1]) + x\" }\n",
    ] {
        let mistakes = read_text("foo.toml", &format!("{text}[variables]\nx = {{ lower = 1, upper = 2 }}\n")).unwrap_err();
        assert_eq!(mistakes.list.len(), 1, "{text}\n{mistakes}");
        assert!(mistakes.list[0].message.contains("unknown function `foo`"), "{mistakes}");
    }
}

#[test]
fn a_moved_start_names_the_term_that_has_no_value() {
    let text = "minimize = \"x\"\n[variables]\nx = { lower = -1, upper = 5, start = 0.5 }\n[[constraints]]\nname = \"limit\"\nrequire = \"sqrt(x - 2) >= 1\"\n";
    let subject = Subject::of_text("start.toml", text).unwrap();
    let outcome = outcome(&subject).unwrap();
    let remark = outcome.moved_start.expect("a moved start").remark;
    assert!(remark.contains("limit") && remark.contains("square root of -1.5"), "{remark}");
}

#[test]
fn a_positive_variable_has_no_bound_that_governs() {
    let file = |objective: &str| {
        format!("minimize = \"{objective}\"\n[variables]\nx = {{ positive = true }}\ny = {{ positive = true, upper = 4 }}\n")
    };
    // 2·x + 1/(x·y) at y = 4: geometric, x = 1/√8.
    let subject = Subject::of_text("positive.toml", &file("2*x + 1/(x*y)")).unwrap();
    assert_eq!(subject.class().to_string(), "geometric program");
    assert!((optimum(&file("2*x + 1/(x*y)")) - 2.0_f64.sqrt()).abs() < 1e-9);
    // x may come as near to 0 as one likes, but is not 0.
    let subject = Subject::of_text("positive.toml", &file("x + 1/y")).unwrap();
    let outcome = outcome(&subject).unwrap();
    assert_eq!(outcome.status.as_str(), "not-attained", "{}", outcome.message);
    assert!(
        outcome.message.contains("x tends to 0")
            && !outcome.answers.iter().any(|answer| answer.certificate.as_ref().is_some_and(|certificate| certificate.certified)),
        "{}",
        outcome.message
    );
}
