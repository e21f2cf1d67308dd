//! Which part of a surface each of its vertices carries.
//!
//! A face gives its area to its corners by the shape functions of its patch: ∫N_i dA. The functions add up to 1, so the parts add up to
//! the area, whatever the face's form. Quads are bilinear patches by three Gauss points each way, as their area is
//! ([`crate::mesh::quality::patch_area`]); triangles give a third to each corner; larger faces are fans about their centre, whose part the
//! corners share.

use crate::mesh::{NONE, PolygonMesh, Vector};

/// The area each vertex carries, and the area of that seen from above.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tributary {
    /// Of the surface itself.
    pub area: Vec<f64>,
    /// On plan; faces that look down have none.
    pub plan: Vec<f64>,
}

/// By vertex of the mesh.
pub fn of_vertices(mesh: &PolygonMesh) -> Tributary {
    let upward = upward(mesh);
    let mut found = Tributary { area: vec![0.0; mesh.vertices.len()], plan: vec![0.0; mesh.vertices.len()] };
    for face in 0..mesh.face_count() {
        let corners = mesh.face(face);
        let points: Vec<Vector> = mesh.points(face).collect();
        let parts = parts(&points);
        let looks_up = upward * parts.iter().map(|(_, plan)| plan).sum::<f64>() > 0.0;
        for (&vertex, (area, plan)) in corners.iter().zip(parts) {
            found.area[vertex as usize] += area;
            if looks_up {
                found.plan[vertex as usize] += upward * plan;
            }
        }
    }
    found
}

/// 1 where the faces' normals point out of the surface or up, −1 where they point in or down: faces are oriented alike, but which
/// way is the file's choice.
fn upward(mesh: &PolygonMesh) -> f64 {
    let area: Vector = (0..mesh.face_count()).map(|face| mesh.vector_area(face)).sum();
    let size: f64 = (0..mesh.face_count()).map(|face| mesh.vector_area(face).norm()).sum();
    // A closed surface has no area on plan: what it encloses tells.
    let sign = if area.norm() > 1e-9 * size { area.z } else { mesh.volume() };
    if sign < 0.0 { -1.0 } else { 1.0 }
}

/// Of every corner: ∫N_i dA, and the part of that on plan by the face's own orientation.
fn parts(points: &[Vector]) -> Vec<(f64, f64)> {
    match *points {
        [a, b, c, d] => patch([a, b, c, d]),
        [a, b, c] => {
            let normal = (b - a).cross(&(c - a)) / 6.0;
            vec![(normal.norm(), normal.z); 3]
        }
        _ => fan(points),
    }
}

/// Points and weights of Gauss's rule on [0, 1] that is exact to degree 5.
const POINTS: [(f64, f64); 3] = [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

fn patch([a, b, c, d]: [Vector; 4]) -> Vec<(f64, f64)> {
    let mut parts = vec![(0.0, 0.0); 4];
    for (u, wu) in POINTS {
        for (v, wv) in POINTS {
            let along_u = (b - a) * (1.0 - v) + (c - d) * v;
            let along_v = (d - a) * (1.0 - u) + (c - b) * u;
            let normal = along_u.cross(&along_v) * (wu * wv);
            let shapes = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
            for (part, shape) in parts.iter_mut().zip(shapes) {
                part.0 += shape * normal.norm();
                part.1 += shape * normal.z;
            }
        }
    }
    parts
}

fn fan(points: &[Vector]) -> Vec<(f64, f64)> {
    let count = points.len().max(1);
    let centre = points.iter().sum::<Vector>() / count as f64;
    let mut parts = vec![(0.0, 0.0); points.len()];
    let mut shared = (0.0, 0.0);
    for k in 0..points.len() {
        let next = (k + 1) % points.len();
        let normal = (points[k] - centre).cross(&(points[next] - centre)) / 6.0;
        for part in [k, next] {
            parts[part].0 += normal.norm();
            parts[part].1 += normal.z;
        }
        shared.0 += normal.norm();
        shared.1 += normal.z;
    }
    for part in &mut parts {
        part.0 += shared.0 / count as f64;
        part.1 += shared.1 / count as f64;
    }
    parts
}

/// The same by joint: what a vertex without ribs carries goes to the joint nearest to it.
pub fn of_joints(mesh: &PolygonMesh, joints: &[(u32, Vector)]) -> Tributary {
    let of_vertices = of_vertices(mesh);
    let mut joint_of = vec![NONE; mesh.vertices.len()];
    for (number, &(vertex, _)) in joints.iter().enumerate().filter(|(_, (vertex, _))| *vertex != NONE) {
        joint_of[vertex as usize] = number as u32;
    }
    let nearest = |place: &Vector| {
        let distance = |(_, at): &(u32, Vector)| (at - place).norm_squared();
        joints.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    };
    let mut found = Tributary { area: vec![0.0; joints.len()], plan: vec![0.0; joints.len()] };
    for (vertex, place) in mesh.vertices.iter().enumerate() {
        let (area, plan) = (of_vertices.area[vertex], of_vertices.plan[vertex]);
        if area == 0.0 && plan == 0.0 {
            continue;
        }
        let own = Some(joint_of[vertex] as usize).filter(|_| joint_of[vertex] != NONE);
        if let Some(joint) = own.or_else(|| nearest(place)) {
            found.area[joint] += area;
            found.plan[joint] += plan;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{QuadMesh, generate, quality};

    #[test]
    fn the_parts_add_up_to_the_area_and_to_the_plan() {
        for mesh in [generate::vault(6, 8, 10.0, 12.0, 3.0), generate::dome(4, 6.0, 4.0), generate::shell(6, 8)] {
            let area = quality::area(&QuadMesh::new(mesh.clone()).unwrap());
            let found = of_vertices(&mesh);
            assert!((found.area.iter().sum::<f64>() / area - 1.0).abs() < 1e-13);
            assert!(found.area.iter().all(|&part| part > 0.0));
        }
        let vault = of_vertices(&generate::vault(6, 8, 10.0, 12.0, 3.0));
        assert!((vault.plan.iter().sum::<f64>() / 120.0 - 1.0).abs() < 1e-13);
    }

    #[test]
    fn it_does_not_matter_which_way_faces_are_oriented() {
        let mesh = generate::dome(4, 6.0, 4.0);
        let mut turned = PolygonMesh::default();
        turned.vertices.clone_from(&mesh.vertices);
        mesh.faces().for_each(|face| turned.push_face(&face.iter().rev().copied().collect::<Vec<_>>()));
        let (a, b) = (of_vertices(&mesh), of_vertices(&turned));
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(same(&a.area, &b.area) && same(&a.plan, &b.plan));
    }

    #[test]
    fn of_a_cube_only_the_top_carries_on_plan() {
        let found = of_vertices(&generate::cube(3));
        let (area, plan) = (found.area.iter().sum::<f64>(), found.plan.iter().sum::<f64>());
        assert!((area / (6.0 * plan) - 1.0).abs() < 1e-12, "{area} {plan}");
    }

    #[test]
    fn triangles_and_larger_faces_share_evenly_and_vertices_without_ribs_give_to_the_nearest_joint() {
        let corner = |k: usize| std::f64::consts::FRAC_PI_3 * k as f64;
        let vertices = (0..6).map(|k| Vector::new(corner(k).cos(), corner(k).sin(), 0.0)).collect();
        let mut mesh = PolygonMesh::from_quads(vertices, &[]);
        mesh.push_face(&[0, 1, 2, 3, 4, 5]);
        let found = of_vertices(&mesh);
        let hexagon = 1.5 * 3f64.sqrt();
        assert!(found.area.iter().all(|&part| (part - hexagon / 6.0).abs() < 1e-14));
        let joints = [(0, mesh.vertices[0]), (3, mesh.vertices[3])];
        let joints = of_joints(&mesh, &joints);
        assert!(joints.area.iter().all(|&part| (part - hexagon / 2.0).abs() < 1e-14), "{joints:?}");
    }
}
