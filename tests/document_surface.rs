//! Surfaces and meshes in files: they come back as they were, and damage is named with its place.

use serde_json::{Value, json};
use spline_lab::core::surface::catmull_clark::BoundaryRule;
use spline_lab::core::surface::{mesh_shapes, samples};
use spline_lab::document::{
    Content, Document, Edit, MeshDisplay, MeshObject, SurfaceColoring, SurfaceDisplay, SurfaceObject, View,
    from_json, to_json,
};

fn document_with(content: Content) -> Document {
    let mut document = Document::new();
    document.apply(&Edit::AddObject { name: "Thing".to_owned(), content }).expect("valid");
    document
}

fn surfaces() -> Vec<Content> {
    let display = SurfaceDisplay {
        color: 3,
        net: false,
        isolines: 4,
        normals: true,
        coloring: SurfaceColoring::LeastPrincipal,
        color_limit: 1.0 / 3.0,
        density: 7,
        ..SurfaceDisplay::default()
    };
    let all = [
        samples::torus().into(),
        samples::helical_staircase().into(),
        samples::partially_closed().into(),
        samples::sphere_octant(),
    ];
    all.map(|surface| Content::Surface(SurfaceObject::new(surface, display.clone()).expect("valid"))).to_vec()
}

fn meshes() -> Vec<Content> {
    let display =
        MeshDisplay { limit: true, valences: true, color_limit: 0.1 + 0.2, ..MeshDisplay::default() };
    let fixed = mesh_shapes::open_sheet(3, 3).expect("small").with_fixed_vertex(5).expect("a vertex");
    let soft = mesh_shapes::cube().with_sharpness([0, 1], 1.0 / 3.0).expect("an edge");
    let cages = mesh_shapes::named_shapes().into_iter().map(|(_, cage)| cage).chain([fixed, soft]);
    let rules = [
        BoundaryRule::Standard { fix_corners: false },
        BoundaryRule::Standard { fix_corners: true },
        BoundaryRule::Discard,
    ];
    let object = |(cage, rule)| MeshObject::new(cage, rule, 2, display.clone()).map(Content::Mesh);
    let pairs = cages.flat_map(|cage| rules.map(|rule| (cage.clone(), rule)));
    // The rule that discards the boundary leaves nothing of the smallest sheets.
    pairs.filter_map(|pair| object(pair).ok()).collect()
}

#[test]
fn everything_comes_back_from_a_file_bit_for_bit() {
    for content in surfaces().into_iter().chain(meshes()) {
        let document = document_with(content);
        let text = to_json(&document, &View::default());
        let saved = from_json(&text).expect("it reads back");
        assert_eq!(saved.document, document, "{text}");
        assert_eq!(to_json(&saved.document, &saved.view), text, "and is written in the same way");
    }
}

/// The error for the file of `content` with the entry at `path` of its record replaced, or added.
fn damaged(content: &Content, kind: &str, path: &str, value: Value) -> String {
    let text = to_json(&document_with(content.clone()), &View::default());
    let mut whole: Value = serde_json::from_str(&text).expect("JSON");
    let (record, entry) = path.rsplit_once('/').expect("a path begins with /");
    let record = whole["objects"][0][kind].pointer_mut(record).expect("the record is there");
    match record.get_mut(entry.parse().unwrap_or(usize::MAX)) {
        Some(place) => *place = value,
        None => record[entry] = value,
    }
    from_json(&whole.to_string()).expect_err(path).to_string()
}

#[test]
fn damage_of_a_surface_is_named_with_its_place() {
    let sphere = SurfaceObject::new(samples::sphere_octant(), SurfaceDisplay::default()).expect("valid");
    let sphere = Content::Surface(sphere);
    for (path, value, said) in [
        ("/more", json!(1), "objects[0].surface"),
        ("/u/more", json!(1), "objects[0].surface.u"),
        ("/u/degree", json!(-1), "objects[0].surface.u.degree"),
        ("/u/degree", json!(26), "objects[0].surface.u.degree"),
        ("/u/degree", json!(3), "objects[0].surface.u"),
        ("/v/knots/2", json!(-7.0), "objects[0].surface.v.knots[2]"),
        ("/v/knots/2", json!("wide"), "objects[0].surface.v.knots[2]"),
        ("/v/knots", json!([]), "objects[0].surface.v.knots"),
        ("/u/period", json!(-4.0), "objects[0].surface.u.period"),
        ("/points", json!([[0.0, 0.0, 0.0]]), "objects[0].surface.points"),
        ("/points/4", json!([0.0, 1.0]), "objects[0].surface.points[4]"),
        ("/weights/5", json!(0.0), "objects[0].surface.weights[5]"),
        ("/weights", json!([1.0, 2.0]), "objects[0].surface.weights"),
        ("/display/density", json!(0), "objects[0].surface.display"),
        ("/display/isolines", json!(21), "objects[0].surface.display"),
        ("/display/color_limit", json!(-1.0), "objects[0].surface.display"),
        ("/display/coloring", json!("rainbow"), "objects[0].surface.display.coloring"),
    ] {
        let error = damaged(&sphere, "surface", path, value);
        assert!(error.contains(said), "{path}: {error}");
    }
}

#[test]
fn damage_of_a_mesh_is_named_with_its_place() {
    let cube = mesh_shapes::creased_cube().with_fixed_vertex(2).expect("a vertex");
    let cube = Content::Mesh(MeshObject::from_cage(cube, MeshDisplay::default()).expect("valid"));
    for (path, value, said) in [
        ("/more", json!(1), "objects[0].mesh"),
        ("/vertices", json!([]), "objects[0].mesh.vertices"),
        ("/vertices/3", json!([1.0]), "objects[0].mesh.vertices[3]"),
        ("/faces", json!([]), "objects[0].mesh.faces"),
        ("/faces/2", json!([0, 1]), "objects[0].mesh.faces[2]"),
        ("/faces/2", json!([0, 1, 1, 4]), "objects[0].mesh.faces[2]"),
        ("/faces/2/1", json!(99), "objects[0].mesh.faces[2]"),
        ("/faces/2/1", json!(-1), "objects[0].mesh.faces[2]"),
        ("/faces/1", json!([7, 6, 5, 4]), "objects[0].mesh.faces"),
        ("/faces/1", json!([0, 3, 2, 1]), "objects[0].mesh.faces[1]"),
        ("/faces", json!([[0, 1, 2, 3]]), "objects[0].mesh.vertices[4]"),
        ("/sharp/0/2", json!(-1.0), "objects[0].mesh.sharp[0]"),
        ("/sharp/1", json!([0, 6, 1.0]), "objects[0].mesh.sharp[1]"),
        ("/fixed", json!([8]), "objects[0].mesh.fixed[0]"),
        ("/boundary", json!("none"), "objects[0].mesh.boundary"),
        ("/level", json!(7), "objects[0].mesh.level"),
        ("/level", json!(1.5), "objects[0].mesh.level"),
        ("/display/color_limit", json!(-0.5), "objects[0].mesh.display"),
        ("/display/shade", json!(true), "objects[0].mesh.display"),
    ] {
        let error = damaged(&cube, "mesh", path, value);
        assert!(error.contains(said), "{path}: {error}");
    }
}

#[test]
fn hostile_sizes_are_refused_before_anything_large_is_made() {
    let sheet = mesh_shapes::open_sheet(200, 200).expect("within limits");
    let sheet = Content::Mesh(MeshObject::from_cage(sheet, MeshDisplay::default()).expect("valid"));
    let error = damaged(&sheet, "mesh", "/level", json!(6));
    assert!(error.contains("objects[0].mesh.level") && error.contains("faces"), "{error}");
    let many: Vec<[f64; 3]> = vec![[0.0; 3]; 600_000];
    for (kind, content, path) in [("surface", &surfaces()[0], "points"), ("mesh", &sheet, "vertices")] {
        let error = damaged(content, kind, &format!("/{path}"), json!(many));
        assert!(error.contains(&format!("objects[0].{kind}.{path}")) && error.contains("limit"), "{error}");
    }
    let knots: Vec<f64> = (0..200_000).map(f64::from).collect();
    let error = damaged(&surfaces()[1], "surface", "/u/knots", json!(knots));
    assert!(error.contains("objects[0].surface"), "{error}");
    let torus = damaged(&surfaces()[0], "surface", "/display/density", json!(usize::MAX));
    assert!(torus.contains("objects[0].surface.display"), "{torus}");
}

#[test]
fn discarding_the_boundary_of_a_single_square_is_refused_at_its_entry() {
    let square = mesh_shapes::open_sheet(1, 1).expect("small");
    let square = Content::Mesh(MeshObject::from_cage(square, MeshDisplay::default()).expect("valid"));
    let error = damaged(&square, "mesh", "/boundary", json!("discard"));
    assert!(error.contains("objects[0].mesh.boundary"), "{error}");
}

#[test]
fn a_byte_replaced_by_any_other_never_panics_and_what_loads_is_valid() {
    for content in [surfaces().swap_remove(2), meshes().swap_remove(1)] {
        let original = to_json(&document_with(content), &View::default());
        for index in (0..original.len()).filter(|index| original.is_char_boundary(*index)) {
            for replacement in [b'9', b'-', b'e', b'"', b']', b','] {
                let mut bytes = original.clone().into_bytes();
                bytes[index] = replacement;
                let Ok(text) = String::from_utf8(bytes) else { continue };
                if let Ok(saved) = from_json(&text) {
                    let again = from_json(&to_json(&saved.document, &saved.view)).expect("it was valid");
                    assert_eq!(again.document, saved.document, "byte {index}");
                }
            }
        }
    }
}
