//! GLB, the binary form of glTF 2.0: a node per rib with its name and numbers. Written here: a JSON chunk by serde_json and a chunk
//! of positions and indices; the `gltf-json` crate brings fifteen others for the same.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use crate::mesh::{PolygonMesh, Vector};

/// One object of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// A point near it: positions are single precision from there.
    pub origin: Vector,
    /// Its faces.
    pub mesh: PolygonMesh,
    /// Red, green, blue, 0 to 255 as on screens.
    pub colour: [u8; 3],
    /// Numbers that go with it (`extras`); those that are not finite are left out.
    pub numbers: Vec<(String, f64)>,
}

/// glTF's numbers for kinds of components and targets of buffers.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Writes the scene: z upwards outside, a node that turns it to glTF's y upwards, and below that a node per object. Without
/// normals viewers shade flat, as glTF says they must.
///
/// # Errors
/// Those of the writer; more than 4 GiB.
pub fn write_glb(out: &mut impl Write, nodes: &[Node]) -> io::Result<()> {
    let mut scene = Scene::default();
    for node in nodes {
        scene.add(node);
    }
    let (mut json, body) = scene.finish();
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() + 8 + body.len();
    let size = |length: usize| u32::try_from(length).map_err(|_| io::Error::other("more than 4 GiB do not go into a GLB file"));
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&size(total)?.to_le_bytes())?;
    out.write_all(&size(json.len())?.to_le_bytes())?;
    out.write_all(b"JSON")?;
    out.write_all(&json)?;
    out.write_all(&size(body.len())?.to_le_bytes())?;
    out.write_all(b"BIN\0")?;
    out.write_all(&body)
}

#[derive(Default)]
struct Scene {
    positions: Vec<u8>,
    indices: Vec<u8>,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    accessors: Vec<Value>,
    colours: Vec<[u8; 3]>,
}

impl Scene {
    fn add(&mut self, node: &Node) {
        let points: Vec<[f32; 3]> = node.mesh.vertices.iter().map(|p| (p - node.origin).map(|c| c as f32).into()).collect();
        let triangles: Vec<u32> = node.mesh.fans().flat_map(|(_, triangle)| triangle).collect();
        let least = |c: usize| points.iter().map(|p| p[c]).fold(f32::INFINITY, f32::min);
        let most = |c: usize| points.iter().map(|p| p[c]).fold(f32::NEG_INFINITY, f32::max);
        let first = self.accessors.len();
        self.accessors.push(json!({
            "bufferView": 0, "byteOffset": self.positions.len(), "componentType": FLOAT, "count": points.len(), "type": "VEC3",
            "min": [least(0), least(1), least(2)], "max": [most(0), most(1), most(2)],
        }));
        self.accessors.push(json!({
            "bufferView": 1, "byteOffset": self.indices.len(), "componentType": UNSIGNED_INT, "count": triangles.len(),
            "type": "SCALAR",
        }));
        self.positions.extend(points.iter().flatten().flat_map(|c| c.to_le_bytes()));
        self.indices.extend(triangles.iter().flat_map(|v| v.to_le_bytes()));
        let material = self.colours.iter().position(|known| *known == node.colour).unwrap_or_else(|| {
            self.colours.push(node.colour);
            self.colours.len() - 1
        });
        let primitive = json!({ "attributes": { "POSITION": first }, "indices": first + 1, "material": material });
        self.meshes.push(json!({ "name": node.name, "primitives": [primitive] }));
        let finite = node.numbers.iter().filter(|(_, value)| value.is_finite());
        let extras: Map<String, Value> = finite.map(|(name, value)| (name.clone(), json!(value))).collect();
        let origin: [f64; 3] = node.origin.into();
        self.nodes.push(json!({ "name": node.name, "mesh": self.meshes.len() - 1, "translation": origin, "extras": extras }));
    }

    fn finish(self) -> (Vec<u8>, Vec<u8>) {
        let turn = std::f64::consts::FRAC_1_SQRT_2;
        let children: Vec<usize> = (1..=self.nodes.len()).collect();
        let mut root = json!({ "name": "ribs", "rotation": [-turn, 0.0, 0.0, turn] });
        if !children.is_empty() {
            root["children"] = json!(children);
        }
        let materials: Vec<Value> = self.colours.iter().map(material).collect();
        let (positions, indices) = (self.positions.len(), self.indices.len());
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("ribopt ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": std::iter::once(root).chain(self.nodes).collect::<Vec<_>>(),
        });
        // Empty lists are against the format.
        if positions > 0 {
            document["meshes"] = json!(self.meshes);
            document["materials"] = json!(materials);
            document["accessors"] = json!(self.accessors);
            document["bufferViews"] = json!([
                { "buffer": 0, "byteLength": positions, "byteStride": 12, "target": VERTICES },
                { "buffer": 0, "byteOffset": positions, "byteLength": indices, "target": INDICES },
            ]);
            document["buffers"] = json!([{ "byteLength": positions + indices }]);
        }
        let mut body = self.positions;
        body.extend(self.indices);
        (document.to_string().into_bytes(), body)
    }
}

fn material(colour: &[u8; 3]) -> Value {
    let [r, g, b] = colour.map(|c| linear(f64::from(c) / 255.0));
    json!({
        "name": format!("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]),
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8 },
    })
}

/// From sRGB to the linear scale glTF has (IEC 61966-2-1).
fn linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
