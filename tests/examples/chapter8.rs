//! Chapter 8: surfaces, with their differential geometry and the limits of subdivision.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use spline_lab::core::bspline::Side;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::core::surface::catmull_clark::{
    BoundaryRule, Origin, SubdivisionStep, crease_tangent, local_matrix, quad_vertex_weights,
    subdominant_eigenvalue,
};
use spline_lab::core::surface::{
    Curvatures, NurbsSurface, PointKind, PolygonMesh, SurfaceError, SurfaceJet, mesh_shapes, samples,
};
use spline_lab::core::tensor::{Net, subdivide_net};

use crate::Check;
use crate::example::{Example, Got};

const STANDARD: BoundaryRule = BoundaryRule::Standard { fix_corners: false };

impl From<DVec3> for Got {
    fn from(value: DVec3) -> Self {
        value.to_array().to_vec().into()
    }
}

impl From<[i64; 4]> for Got {
    fn from(counts: [i64; 4]) -> Self {
        counts.map(|count| count as f64).to_vec().into()
    }
}

pub(crate) const CHECKS: &[(&str, Check)] = &[
    ("8.2-a", |example| {
        let stairs: NurbsSurface = samples::helical_staircase().into();
        let places = [
            ("p(1,3)", [1.0, 3.0]),
            ("p(2,3)", [2.0, 3.0]),
            ("p(1.5,7)", [1.5, 7.0]),
            ("p(1,3.5)", [1.0, 3.5]),
            ("p(2,11)", [2.0, 11.0]),
        ];
        points(example, &stairs, &places);
        for (_, at) in places {
            let height = stairs.evaluate(at).unwrap().z;
            assert!((height - (at[1] - 2.0)).abs() < 1e-12, "height {height} at {at:?}");
        }
    }),
    ("8.2-b", |example| {
        let torus: NurbsSurface = samples::torus().into();
        let places = [
            ("p(0,0)", [0.0, 0.0]),
            ("p(2,0)", [2.0, 0.0]),
            ("p(0,2)", [0.0, 2.0]),
            ("p(2,2)", [2.0, 2.0]),
            ("p(1,0)", [1.0, 0.0]),
            ("p(3,0)", [3.0, 0.0]),
            ("p(.5,.5)", [0.5, 0.5]),
            ("p(1.5,1.5)", [1.5, 1.5]),
        ];
        points(example, &torus, &places);
        let at = |u: f64, v: f64| torus.evaluate([u, v]).unwrap();
        example.expect("R", 0.5 * at(2.0, 2.0).distance(at(2.0, 0.0)));
        example.expect("r", 0.5 * at(2.0, 2.0).distance(at(0.0, 2.0)));
    }),
    ("8.2-c", |example| {
        let volume = NurbsSurface::from(samples::torus()).enclosed_volume().unwrap();
        example.expect("volume", volume.abs());
        example.expect("signed_volume_sign(d1xd2)", if volume < 0.0 { "inward" } else { "outward" });
        example.expect("profile_area", closed_area([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]));
        example.expect("ring_area", closed_area([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]));
    }),
    ("8.2-d", |example| {
        let surface: NurbsSurface = samples::partially_closed().into();
        let places = [
            ("p(1,0)", [1.0, 0.0]),
            ("p(3,0)", [3.0, 0.0]),
            ("p(2,1.5)", [2.0, 1.5]),
            ("p(2.5,.25)", [2.5, 0.25]),
            ("p(2,0)", [2.0, 0.0]),
        ];
        points(example, &surface, &places);
        for v in [0.0, 0.7, 2.9] {
            assert!(
                surface.jet([1.0, v], [Side::Right; 2]).unwrap().dv.length() < 1e-14,
                "the tip at v = {v}"
            );
            assert_eq!(surface.normal([1.0, v]).unwrap_err().name(), "SingularPoint", "the tip at v = {v}");
        }
    }),
    ("8.2-e", |example| {
        let torus: NurbsSurface = samples::torus().into();
        let start = example.numbers("cell");
        let patches = torus.bezier_patches().unwrap();
        let here = |patch: &&_| corner(patch) == [start[0], start[1]];
        let patch = patches.iter().find(here).unwrap();
        example.expect("bezier", patch.points.chunks(3).map(<[DVec3]>::to_vec).collect::<Vec<_>>());
        points(example, &torus, &[("p(.3,.7)", [0.3, 0.7])]);
    }),
    ("8.2-f", |example| {
        let torus: NurbsSurface = samples::torus().into();
        let t = example.points("t");
        let jet = torus.jet(t[0].to_array(), [Side::Right; 2]).unwrap();
        example.expect("d1(2,2)", jet.du);
        example.expect("d2(2,2)", jet.dv);
        example.expect("normal(2,2)", jet.normal().unwrap());
        example.expect("normal(3,2)", torus.normal(t[1].to_array()).unwrap());
    }),
    ("8.3-a", |example| {
        for m in example.numbers("m") {
            let (alpha, beta, centre) = quad_vertex_weights(m as usize);
            example.expect(&m.to_string(), vec![alpha, beta, centre]);
            let row = &local_matrix(m as usize)[0];
            example.expect(&m.to_string(), vec![row[1] * m, row[1 + m as usize] * m, row[0]]);
        }
    }),
    ("8.3-b", |example| {
        let (cube, step) = (mesh_shapes::cube(), mesh_shapes::cube().subdivide(STANDARD).unwrap());
        example.expect("counts", step.mesh.counts());
        example.expect("vertex", image(&step, vertex(&cube, [1.0, 1.0, 1.0])));
        example.expect("edge", image(&step, edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])));
        example.expect("face", image(&step, face(&cube, [1.0, 0.0, 0.0])));
    }),
    ("8.3-c", |example| {
        let cube = mesh_shapes::cube();
        let steps = cube.subdivide_levels(2, STANDARD).unwrap();
        let (first, second) = (&steps[0], &steps[1]);
        let again = |origin: Origin| image(second, Origin::Vertex(place(first, origin)));
        example.expect("counts", second.mesh.counts());
        example.expect("vertex", again(vertex(&cube, [1.0, 1.0, 1.0])));
        example.expect("face_image", again(face(&cube, [1.0, 0.0, 0.0])));
        example.expect("edge_image", again(edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])));
        let centre = DVec3::new(5.0 / 9.0 + 0.75 + 1.0 + 0.75, 5.0 / 9.0 + 0.75, 5.0 / 9.0 + 0.75) / 4.0;
        example.expect("new_face_point", image(second, face(&first.mesh, centre.to_array())));
    }),
    ("8.3-d", |example| {
        let cube = mesh_shapes::cube();
        let step = cube.subdivide(STANDARD).unwrap();
        let limit = |origin: Origin| step.mesh.limit(place(&step, origin) as usize, false).unwrap().position;
        example.expect("vertex", cube.limit_positions(false)[6]);
        example.expect("vertex", limit(vertex(&cube, [1.0, 1.0, 1.0])));
        example.expect("edge", limit(edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])));
        example.expect("face", limit(face(&cube, [1.0, 0.0, 0.0])));
    }),
    ("8.3-e", |example| {
        for m in example.numbers("m") {
            let (lambda, a) = subdominant_eigenvalue(TAU / m);
            example.expect(&m.to_string(), vec![lambda, a]);
        }
    }),
    ("8.3-f", |example| {
        let torus = torus_net();
        let step = torus.subdivide(STANDARD).unwrap();
        example.expect("before", torus.counts());
        example.expect("after", step.mesh.counts());
        let net = Net { shape: [4, 4], points: torus.positions().to_vec() };
        let refined = subdivide_net(&net, 3, [true, true]).unwrap();
        for c00 in [image(&step, Origin::Vertex(0)), refined.points[0]] {
            example.expect("c00_image", c00);
        }
        let between =
            torus.topology().faces().position(|corners| [0, 4, 5, 1].iter().all(|v| corners.contains(v)));
        example.expect("facepoint(c00,c10,c11,c01)", image(&step, Origin::Face(between.unwrap() as u32)));
        example.expect("facepoint(c00,c10,c11,c01)", refined.points[8 + 1]);
        for points in [step.mesh.positions(), &refined.points] {
            example.expect("max_x_refined", points.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max));
        }
    }),
    ("8.3-g", |example| {
        let sheet = mesh_shapes::open_sheet(3, 4).unwrap();
        let sheet = sheet.transformed(|p| DVec3::new(p.x, p.y, (p.x * p.y) % 3.0)).unwrap();
        let step = sheet.subdivide(BoundaryRule::Discard).unwrap();
        example.expect("counts", step.mesh.counts());
        example.expect("image_of_(1,1)", image(&step, vertex(&sheet, [1.0, 1.0, 1.0])));
        let net = Net { shape: [4, 5], points: sheet.positions().to_vec() };
        let refined = subdivide_net(&net, 3, [false, false]).unwrap();
        for points in [step.mesh.positions(), &refined.points] {
            example.expect("sum_z", points.iter().map(|p| p.z).sum::<f64>());
        }
    }),
    ("8.3-h", |example| {
        let corners: Vec<DVec3> =
            example.rows("quad").into_iter().map(|row| DVec3::from_slice(&row)).collect();
        let quad = PolygonMesh::new(corners, &[vec![0, 1, 2, 3]]).unwrap();
        let steps = quad.subdivide_levels(3, STANDARD).unwrap();
        let fixed = quad.subdivide(BoundaryRule::Standard { fix_corners: true }).unwrap();
        example.expect("corner", image(&steps[0], Origin::Vertex(0)));
        example.expect("corner_fixed", image(&fixed, Origin::Vertex(0)));
        example.expect("edge", image(&steps[0], edge(&quad, [0.0, 0.0, 0.0], [4.0, 0.0, 0.0])));
        example.expect("face", image(&steps[0], Origin::Face(0)));
        example.expect("counts1", steps[0].mesh.counts());
        example.expect("counts3", steps[2].mesh.counts());
        example.expect("limit_corner", quad.limit(0, false).unwrap().position);
    }),
    ("8.3-i", |example| {
        let cube = mesh_shapes::cube();
        let all_sharp = sharpened(f64::INFINITY);
        let on_cube = |mesh: &PolygonMesh| mesh.positions().iter().all(|p| p.abs().max_element() == 1.0);
        let steps = all_sharp.subdivide_levels(3, STANDARD).unwrap();
        example.expect("all_sharp_on_cube", steps.iter().all(|step| on_cube(&step.mesh)));
        let top = [[4, 5], [5, 6], [6, 7], [7, 4]];
        let top = top
            .into_iter()
            .fold(cube.clone(), |mesh, ends| mesh.with_sharpness(ends, f64::INFINITY).unwrap());
        let one = vertex(&cube, [1.0, 1.0, 1.0]);
        example.expect("top_vertex", image(&top.subdivide(STANDARD).unwrap(), one));
        example.expect("crease_limit", top.limit(6, false).unwrap().position);
        let once = sharpened(1.0);
        assert!(once.subdivide(STANDARD).unwrap().mesh.creases().is_empty(), "no sharp edge is left");
        example.expect("sharp1_limit_corner", once.limit(6, false).unwrap().position);
        let half = sharpened(0.5).subdivide(STANDARD).unwrap();
        example.expect("half_vertex", image(&half, one));
        example.expect("half_edge", image(&half, edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])));
    }),
    ("8.3-j", |example| {
        let tetrahedron = mesh_shapes::tetrahedron();
        let step = tetrahedron.subdivide(STANDARD).unwrap();
        example.expect("counts", step.mesh.counts());
        example.expect("vertex", image(&step, Origin::Vertex(0)));
        let edge = tetrahedron.topology().edge_between(0, 1).unwrap();
        example.expect("edge", image(&step, Origin::Edge(edge as u32)));
        example.expect("face", image(&step, Origin::Face(0)));
        let valences: Vec<usize> = (0..14).map(|v| step.mesh.topology().valence(v)).collect();
        let count = |valence: usize| valences.iter().filter(|&&entry| entry == valence).count();
        let key = "valences of the new vertices (3: tetra vertices and face points, 4: edge points)";
        example.expect(key, vec![count(3), count(4)]);
    }),
    ("8.3-k", |example| {
        let fan = mesh_shapes::fan(example.count("m") as u32).unwrap();
        let steps = fan.subdivide_levels(3, BoundaryRule::Discard).unwrap();
        example.expect("counts", steps[0].mesh.counts());
        assert!(
            steps.iter().all(|step| step.mesh.topology().face_count() == 5),
            "five quadrilaterals remain"
        );
        example.expect("apex", image(&steps[0], Origin::Vertex(0)));
        example.expect("limit", fan.limit(0, false).unwrap().position);
    }),
    ("8.3-l", |example| {
        let cube = mesh_shapes::cube();
        let mut creased = cube.clone();
        for entry in example.input("sharp").as_array().unwrap() {
            let end = |i: usize| match vertex(&cube, [0, 1, 2].map(|axis| entry[i][axis].as_f64().unwrap())) {
                Origin::Vertex(vertex) => vertex,
                other => panic!("{other:?}"),
            };
            creased = creased.with_sharpness([end(0), end(1)], entry[2].as_f64().unwrap()).unwrap();
        }
        let steps = creased.subdivide_levels(3, STANDARD).unwrap();
        for (key, limit, at) in [
            ("A", "limit_A", [1.0, 1.0, 1.0]),
            ("B", "limit_B", [1.0, 1.0, -1.0]),
            ("C", "limit_C", [-1.0, 1.0, 1.0]),
        ] {
            // The image of a vertex keeps its number in every step.
            let origin = vertex(&cube, at);
            example.expect(key, steps.iter().map(|step| image(step, origin)).collect::<Vec<_>>());
            let number = place(&steps[0], origin) as usize;
            example.expect(limit, creased.limit(number, false).unwrap().position);
            example.expect(limit, steps[2].mesh.limit(number, false).unwrap().position);
        }
        example.expect("e", image(&steps[0], edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])));
        example.expect("f", image(&steps[0], edge(&cube, [-1.0, 1.0, 1.0], [1.0, 1.0, 1.0])));
        let sharp = steps[0].mesh.creases();
        assert_eq!(sharp.len(), 8, "the halves of the top edges");
        sharp.iter().for_each(|crease| example.expect("sharpness_top", crease.sharpness));
    }),
    ("B.9-a", |example| {
        let jets = example.points("at").into_iter().map(|at| {
            let (x, y) = (at.x, at.y);
            jet([DVec3::new(1.0, 0.0, y), DVec3::new(0.0, 1.0, x), DVec3::ZERO, DVec3::Z, DVec3::ZERO])
        });
        let jets: Vec<SurfaceJet> = jets.collect();
        let forms: Vec<_> = jets.iter().map(|jet| jet.forms().unwrap()).collect();
        example.expect("I", forms.iter().map(|forms| forms.first.to_vec()).collect::<Vec<_>>());
        example.expect("II", forms.iter().map(|forms| forms.second.to_vec()).collect::<Vec<_>>());
        curvatures(example, &jets);
        let origin = jets[0].curvatures().unwrap();
        example.expect("kappa(0,0)", origin.principal.to_vec());
        for (direction, expected) in
            origin.directions.unwrap().into_iter().zip([DVec2::new(1.0, -1.0), DVec2::ONE])
        {
            assert!(direction.perp_dot(expected).abs() < 1e-12, "{direction} should be along {expected}");
        }
    }),
    ("B.9-b", |example| {
        let (big, small) = (example.number("R"), example.number("r"));
        let jets = example.numbers("v").into_iter().map(|v| {
            // At u = 0.
            let rho = big + small * v.cos();
            let (du, dv) = (DVec3::new(0.0, rho, 0.0), DVec3::new(-small * v.sin(), 0.0, small * v.cos()));
            let (duu, duv) = (DVec3::new(-rho, 0.0, 0.0), DVec3::new(0.0, -small * v.sin(), 0.0));
            jet([du, dv, duu, duv, DVec3::new(-small * v.cos(), 0.0, -small * v.sin())])
        });
        curvatures(example, &jets.collect::<Vec<_>>());
    }),
    ("B.9-c", |example| {
        let octant = samples::sphere_octant();
        let jets: Vec<SurfaceJet> = example
            .points("t")
            .iter()
            .map(|at| octant.jet(at.to_array(), [Side::Right; 2]).unwrap())
            .collect();
        let all = curvatures(example, &jets);
        let umbilic = all.iter().map(|c| c.kind == PointKind::Umbilic && c.directions.is_none());
        example.expect("umbilic", umbilic.collect::<Vec<_>>());
    }),
    ("B.9-d", |example| {
        let radius = example.number("radius");
        let (du, duu) = (DVec3::new(0.0, radius, 0.0), DVec3::new(-radius, 0.0, 0.0));
        let c = jet([du, DVec3::Z, duu, DVec3::ZERO, DVec3::ZERO]).curvatures().unwrap();
        example.expect("K", c.gaussian);
        example.expect("H", c.mean);
        example.expect("kappa", c.principal.to_vec());
        assert_eq!(c.kind, PointKind::Parabolic, "a cylinder");
        assert!(c.directions.unwrap()[0].y.abs() < 1e-15, "the curved direction is u");
    }),
    ("B.9-e", |example| {
        let axes = example.numbers("axes");
        // On the half ellipses y = 0 the principal directions are u and v; umbilics are where their curvatures are equal.
        let gap = |u: f64, v: f64| {
            let forms = ellipsoid(&axes, u, v).forms().unwrap();
            forms.normal_curvature(DVec2::X) - forms.normal_curvature(DVec2::Y)
        };
        let grid: Vec<f64> = (1..100).map(|i| -0.5 * PI + PI * f64::from(i) / 100.0 + 1e-3).collect();
        let mut umbilics = Vec::new();
        for u in [0.0, PI] {
            for pair in grid.windows(2).filter(|pair| gap(u, pair[0]) * gap(u, pair[1]) < 0.0) {
                let (mut a, mut b) = (pair[0], pair[1]);
                while (b - a).abs() > 1e-15 {
                    let middle = 0.5 * (a + b);
                    if middle <= a || middle >= b {
                        break;
                    }
                    if gap(u, a) * gap(u, middle) <= 0.0 { b = middle } else { a = middle }
                }
                umbilics.push(ellipsoid(&axes, u, a));
            }
        }
        example.expect("count", umbilics.len());
        let first = umbilics.iter().find(|jet| jet.point.x > 0.0 && jet.point.z > 0.0).unwrap();
        example.expect("umbilic", first.point);
        let c = first.curvatures().unwrap();
        assert_eq!(c.kind, PointKind::Umbilic, "{c:?}");
        example.expect("kappa", c.mean);
        example.expect("K", c.gaussian);
    }),
    ("B.9-f", |example| {
        let c = jet([DVec3::X, DVec3::Y, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO]).curvatures().unwrap();
        example.expect("K", c.gaussian);
        example.expect("H", c.mean);
        example.expect("kind", c.kind.name());
        assert_eq!(c.directions, None, "no directions");
    }),
    ("B.9-g", |example| {
        let t = example.numbers("t");
        let result = samples::sphere_octant().curvatures([t[0], t[1]]);
        example.expect_error(result.as_ref().map_err(SurfaceError::name));
    }),
    ("B.11-a", |example| {
        let at = example.numbers("vertex");
        let cube = mesh_shapes::cube();
        let number = cube.positions().iter().position(|p| p.to_array() == at[..]).unwrap();
        example.expect("limit", cube.limit(number, false).unwrap().position);
        example.expect("normal", cube.limit_normal(number, None, false).unwrap());
    }),
    ("B.11-b", |example| {
        let half = sharpened(0.5).subdivide(STANDARD).unwrap();
        let cube = mesh_shapes::cube();
        example.expect("vertex_step1(s=1/2)", image(&half, Origin::Vertex(6)).x);
        example.expect("edge_step1(s=1/2)", image(&half, edge(&cube, [1.0, 1.0, -1.0], [1.0, 1.0, 1.0])).x);
        let limit = |s: f64| sharpened(s).limit(6, false).unwrap().position.x;
        example.expect("limit", example.numbers("s").into_iter().map(limit).collect::<Vec<_>>());
    }),
    ("B.11-c", |example| {
        example.expect("limit", mesh_shapes::tetrahedron().limit(0, false).unwrap().position);
    }),
    ("B.11-d", |example| {
        let tangents = example.numbers("k").into_iter().map(|k| crease_tangent(k as usize));
        let tangents: Vec<_> = tangents.collect();
        example.expect("lambda", tangents.iter().map(|t| t.eigenvalue).collect::<Vec<_>>());
        let weights = tangents.iter().map(|t| vec![t.vertex, t.along, t.opposite]);
        example.expect("v_e_b", weights.collect::<Vec<_>>());
    }),
    ("B.11-e", |example| {
        let (lambda, a): (Vec<f64>, Vec<f64>) =
            example.numbers("m").into_iter().map(|m| subdominant_eigenvalue(TAU / m)).unzip();
        example.expect("lambda", lambda);
        example.expect("A", a);
    }),
];

fn points(example: &Example, surface: &NurbsSurface, places: &[(&str, [f64; 2])]) {
    for &(key, at) in places {
        example.expect(key, surface.evaluate(at).unwrap());
    }
}

fn corner(patch: &spline_lab::core::surface::RationalPatch) -> [f64; 2] {
    patch.cell.map(|(start, _)| start)
}

/// Area inside the closed quadratic spline of four points; Simpson's rule is exact for `½ (x y′ − y x′)` on each piece.
fn closed_area(points: [[f64; 2]; 4]) -> f64 {
    let points = points.map(DVec2::from_array).to_vec();
    let curve = Nurbs::closed(points, vec![1.0; 4], 2).unwrap();
    let density = |t: f64, side: Side| {
        let d = curve.derivatives(t, 1, side).unwrap();
        0.5 * d[0].perp_dot(d[1])
    };
    let piece = |k: u32| {
        let a = f64::from(k);
        density(a, Side::Right) + 4.0 * density(a + 0.5, Side::Right) + density(a + 1.0, Side::Left)
    };
    (0..4).map(piece).sum::<f64>() / 6.0
}

fn vertex(mesh: &PolygonMesh, at: [f64; 3]) -> Origin {
    Origin::Vertex(number(mesh, at))
}

fn number(mesh: &PolygonMesh, at: [f64; 3]) -> u32 {
    let near = |p: &DVec3| p.distance(DVec3::from_array(at)) < 1e-12;
    mesh.positions().iter().position(near).unwrap() as u32
}

fn edge(mesh: &PolygonMesh, a: [f64; 3], b: [f64; 3]) -> Origin {
    Origin::Edge(mesh.topology().edge_between(number(mesh, a), number(mesh, b)).unwrap() as u32)
}

/// The face with a given centroid.
fn face(mesh: &PolygonMesh, centre: [f64; 3]) -> Origin {
    let near = |&face: &usize| mesh.centroid(face).distance(DVec3::from_array(centre)) < 1e-12;
    Origin::Face((0..mesh.topology().face_count()).find(near).unwrap() as u32)
}

/// Number of the new vertex with this origin.
fn place(step: &SubdivisionStep, origin: Origin) -> u32 {
    step.origins.iter().position(|&other| other == origin).unwrap() as u32
}

fn image(step: &SubdivisionStep, origin: Origin) -> DVec3 {
    step.mesh.positions()[place(step, origin) as usize]
}

/// The 4 × 4 control net of the torus of 8.2, closed in both directions.
fn torus_net() -> PolygonMesh {
    let positions = samples::torus().coefficients().to_vec();
    let at = |i: u32, j: u32| i % 4 * 4 + j % 4;
    let quad = |i: u32, j: u32| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    let faces: Vec<_> = (0..4).flat_map(|i| (0..4).map(move |j| quad(i, j))).collect();
    PolygonMesh::new(positions, &faces).unwrap()
}

/// The cube with all edges of one sharpness.
fn sharpened(sharpness: f64) -> PolygonMesh {
    let cube = mesh_shapes::cube();
    let edges: Vec<[u32; 2]> = (0..12).map(|edge| cube.topology().edge(edge)).collect();
    edges.into_iter().fold(cube, |mesh, ends| mesh.with_sharpness(ends, sharpness).unwrap())
}

fn jet([du, dv, duu, duv, dvv]: [DVec3; 5]) -> SurfaceJet {
    SurfaceJet { at: [0.0; 2], point: DVec3::ZERO, du, dv, duu, duv, dvv, noise: [0.0; 2], size: 1.0 }
}

fn ellipsoid(axes: &[f64], u: f64, v: f64) -> SurfaceJet {
    let at = |x: f64, y: f64, z: f64| DVec3::new(axes[0] * x, axes[1] * y, axes[2] * z);
    let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
    let derivatives = [
        at(-su * cv, cu * cv, 0.0),
        at(-cu * sv, -su * sv, cv),
        at(-cu * cv, -su * cv, 0.0),
        at(su * sv, -cu * sv, 0.0),
        at(-cu * cv, -su * cv, -sv),
    ];
    SurfaceJet { point: at(cu * cv, su * cv, sv), ..jet(derivatives) }
}

fn curvatures(example: &Example, jets: &[SurfaceJet]) -> Vec<Curvatures> {
    let all: Vec<Curvatures> = jets.iter().map(|jet| jet.curvatures().unwrap()).collect();
    example.expect("K", all.iter().map(|c| c.gaussian).collect::<Vec<_>>());
    example.expect("H", all.iter().map(|c| c.mean).collect::<Vec<_>>());
    all
}
