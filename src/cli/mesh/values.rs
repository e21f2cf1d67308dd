//! Arguments that are more than one number.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use ribopt::mesh::Vector;
use ribopt::mesh::graph::Rule;
use ribopt::mesh::ribs::structure::{Held, Sharing};
use ribopt::mesh::ribs::{Bounds, SectionKind, Unit};
use ribopt::mesh::section::Plane;
use ribopt::ribs::law::VolumeLaw;

/// A volume law by its name.
pub fn volume_law() -> impl TypedValueParser<Value = VolumeLaw> {
    let laws = [
        PossibleValue::new(VolumeLaw::Prismatoid.name()).help("Dimensions vary linearly: the volume of the solids"),
        PossibleValue::new(VolumeLaw::Frustum.name()).help("The note's law"),
    ];
    PossibleValuesParser::new(laws).try_map(|name| VolumeLaw::named(&name).ok_or("no volume law"))
}

/// Degrees.
pub fn angle(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "an angle in degrees is expected".to_string())?;
    if value > 0.0 && value < 180.0 { Ok(value) } else { Err("an angle lies between 0 and 180 degrees".into()) }
}

/// `z=0.5`, or `0,0,1:0,0,1`: a point and a normal.
pub fn plane(text: &str) -> Result<Plane, String> {
    let (point, normal) = match text.split_once('=') {
        Some((axis, at)) => {
            let normal = match axis.trim() {
                "x" => Vector::x(),
                "y" => Vector::y(),
                "z" => Vector::z(),
                other => return Err(format!("'{other}' is no axis; write x=, y= or z=")),
            };
            (normal * number(at)?, normal)
        }
        None => {
            let form = "a plane is written z=0.5, or as a point and a normal: 0,0,1:0,0,1";
            let (point, normal) = text.split_once(':').ok_or(form)?;
            (vector(point)?, vector(normal)?)
        }
    };
    Plane::facing(point, normal).ok_or_else(|| format!("the normal of {text} has no direction"))
}

fn vector(text: &str) -> Result<Vector, String> {
    let numbers = text.split(',').map(number).collect::<Result<Vec<f64>, _>>()?;
    match numbers[..] {
        [x, y, z] => Ok(Vector::new(x, y, z)),
        _ => Err(format!("'{text}' has {} coordinates instead of three", numbers.len())),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| format!("'{}' is no number", text.trim()))
}

/// `h=0.1:0.8` or `h=0.1:0.8:0.3`.
pub fn bounds(text: &str) -> Result<Bounds, String> {
    let form = "bounds are written DIM=LOWER:UPPER or DIM=LOWER:UPPER:START, such as h=0.1:0.8";
    let (dimension, range) = text.split_once('=').ok_or(form)?;
    let numbers = range.split(':').map(number).collect::<Result<Vec<f64>, _>>()?;
    let (lower, upper, start) = match numbers[..] {
        [lower, upper] => (lower, upper, (lower * upper).abs().sqrt()),
        [lower, upper, start] => (lower, upper, start),
        _ => return Err(form.into()),
    };
    Ok(Bounds { dimension: dimension.trim().into(), lower, upper, start })
}

/// A kind of section that problem folders can be made for.
pub fn kind(text: &str) -> Result<SectionKind, String> {
    SectionKind::parse(text).ok_or_else(|| {
        let known = SectionKind::all().map(SectionKind::name).collect::<Vec<_>>().join(", ");
        format!("ribs can be made of: {known}; for others write their points into sections.csv")
    })
}

/// A unit of length.
pub fn unit(text: &str) -> Result<Unit, String> {
    Unit::parse(text).ok_or_else(|| format!("a unit is one of {}", Unit::ALL.map(Unit::name).join(", ")))
}

/// What holds a structure.
pub fn held(text: &str) -> Result<Held, String> {
    match text.trim() {
        "boundary" => Ok(Held::Boundary),
        "lowest" => Ok(Held::Lowest),
        "" => Err("say boundary, lowest, or the names of nodes, as in v1,v7".into()),
        names => Ok(Held::Named(names.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect())),
    }
}

/// Which sections are one.
pub fn sharing(text: &str) -> Result<Sharing, String> {
    let known = || Sharing::NAMED.map(|(name, _)| name).join(", ");
    let found = Sharing::NAMED.into_iter().find(|(name, _)| *name == text);
    found.map(|(_, sharing)| sharing).ok_or_else(|| format!("sections are shared by one of {}", known()))
}

/// How edges become lines.
pub fn rule(text: &str) -> Result<Rule, String> {
    match text {
        "auto" => Ok(Rule::Auto),
        "topology" => Ok(Rule::Topology),
        "straight" => Ok(Rule::Straight),
        "given" => Ok(Rule::Given),
        "edges" => Ok(Rule::Edges),
        _ => Err("edges are joined by one of auto, topology, straight, given, edges".into()),
    }
}

/// A file for rib lines.
pub fn lines_file(text: &str) -> Result<PathBuf, String> {
    with_ending(text, &["obj", "csv", "dxf"])
}

/// A file for stations or sections.
pub fn section_file(text: &str) -> Result<PathBuf, String> {
    with_ending(text, &["csv", "svg"])
}

fn with_ending(text: &str, known: &[&str]) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.is_some_and(|ending| known.contains(&ending.as_str())) {
        true => Ok(path),
        false => Err(format!("the file's ending must be .{}", known.join(" or ."))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_by_axis_and_by_normal_agree() {
        let (by_axis, by_normal) = (plane("z=0.5").unwrap(), plane("0,0,0.5:0,0,2").unwrap());
        let point = Vector::new(3.0, 4.0, 1.5);
        assert_eq!((by_axis.distance(&point), by_normal.distance(&point)), (1.0, 1.0));
        for bad in ["", "w=1", "z=", "z=nan", "0,0,0", "0,0:0,0,1", "0,0,0:0,0,0", "0,0,0:0,0,x"] {
            assert!(plane(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bounds_begin_at_their_geometric_mean_unless_told() {
        assert_eq!(bounds("h=0.1:0.4").unwrap().start, 0.2);
        assert_eq!(bounds("h=0.1:0.4:0.3").unwrap().start, 0.3);
        for bad in ["h", "h=", "h=1", "h=1:2:3:4", "h=1:inf"] {
            assert!(bounds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn endings_are_checked_before_anything_is_read() {
        assert!(lines_file("lines.OBJ").is_ok() && lines_file("lines.txt").is_err() && section_file("s").is_err());
    }
}
