//! The way of a mesh, without the solver: `cargo run --example mesh_tour -- OUT` makes three meshes, their problem folders,
//! solids of a made-up sizing and pictures; `cargo run --release --example mesh_tour -- million` reads and traces 10⁶ quads.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use ribopt::mesh::commands::{Source, new_file, ribs_folder, solids};
use ribopt::mesh::network::read_geometry;
use ribopt::mesh::solids::SizedRib;
use ribopt::mesh::{QuadMesh, formats, generate, ribs, trace};
use ribopt::report::About;
use ribopt::report::pictures::{Load, network};

fn main() -> Result<(), Box<dyn Error>> {
    match std::env::args().nth(1).as_deref() {
        Some("million") => million(),
        Some(folder) => ["vault", "dome", "shell"].into_iter().try_for_each(|name| tour(name, Path::new(folder))),
        None => Err("say where to write, or 'million'".into()),
    }
}

fn tour(name: &str, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mesh = folder.join(format!("{name}.obj"));
    new_file(name, &mesh)?;
    let problem = folder.join(name);
    let report = ribs_folder(&Source { path: mesh, ..Source::default() }, 10.0, &ribs::Options::default(), &problem)?;
    println!("{name}: {} lines, {} ribs, {} sections", report.trace.lines, report.problem.ribs, report.problem.sections);
    let geometry = read_geometry(std::fs::File::open(problem.join("geometry.csv"))?)?;
    let ring = |h: f64| vec![vec![[-0.06, -h / 2.0], [0.06, -h / 2.0], [0.06, h / 2.0], [-0.06, h / 2.0]]];
    let sized = geometry.into_iter().map(|geometry| {
        let [from, to] = geometry.ends.map(|p| 0.1 + 0.04 * p.z.abs());
        SizedRib {
            rings: [ring(from), ring(to)],
            tags: vec![0.12, to],
            utilisation: Some((to - 0.1) * 5.0),
            model_volume: None,
            geometry,
        }
    });
    let sized: Vec<SizedRib> = sized.collect();
    for ending in ["obj", "stl", "vtu"] {
        let report = solids(&sized, &["b".into(), "h".into()], &folder.join(format!("{name}_solids.{ending}")))?;
        println!("  {ending}: volume {}, {} overlapping joints", report.volume, report.overlapping_joints);
    }
    let loads: Vec<Load> = sized.iter().map(|rib| Load { share: rib.utilisation, limit: "made up".into() }).collect();
    let about = About { title: name.into(), ..About::default() };
    Ok(std::fs::write(folder.join(format!("{name}.svg")), network(&sized, &loads, &about))?)
}

fn million() -> Result<(), Box<dyn Error>> {
    let path = std::env::temp_dir().join("million.obj");
    formats::write(&path, &generate::grid(1000, 1000, 1.0), &[])?;
    let begin = Instant::now();
    let mesh = QuadMesh::new(formats::read(&path)?)?;
    let read = begin.elapsed();
    let lines = trace::trace(&mesh);
    println!("read and checked in {read:?}, traced {} lines in {:?}", lines.len(), begin.elapsed() - read);
    Ok(std::fs::remove_file(path)?)
}
