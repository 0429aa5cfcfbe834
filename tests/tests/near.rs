//! Point factors near a wall, beside edges, in map coordinates and at every size, against 90 digits. `NEAR_VIEWS` sets their number.
use formfactor::{
    DifferentialArea, Enclosure, FormFactor, PlanarPolygon, by_hierarchy, form_factor, unoccluded,
    unoccluded_complement,
};
use glam::DVec3;
use serde_json::Value;
use tests::near::{NearView, near};
use tests::precise::{self, Precise};
use tests::sweep::Loops;

/// Whether a value is as near to the exact one as is promised, and its bound as small as `most`.
fn judge(found: FormFactor, exact: &Precise, most: f64, what: &str) -> Result<(), String> {
    let (error, FormFactor { value, error_bound }) = (exact.distance(found.value), found);
    let fail =
        |why: &str| Err(format!("{what}: {why}: {value:e} is off by {error:e}, bound {error_bound:e}"));
    if !(0.0..=1.0).contains(&value) || !(0.0..=1.0).contains(&error_bound) {
        fail("out of range")
    } else if error > error_bound {
        fail("beyond the bound")
    } else if error > (1e-13 * value).max(1e-15) {
        fail("not right")
    } else if error_bound > most {
        fail("the bound says too little")
    } else {
        Ok(())
    }
}

fn check(view: &NearView, most: f64) -> Result<(), String> {
    let polygon = |loops: &Loops| PlanarPolygon::new(loops).map_err(|e| format!("refused: {e}"));
    let Ok(from) = DifferentialArea::new(view.position, view.normal) else { return Ok(()) };
    let to = polygon(&view.target)?;
    let Ok(occluders) = view.occluders.iter().map(polygon).collect::<Result<Vec<_>, _>>() else {
        return Ok(());
    };
    let free = precise::form_factor(view.position, view.normal, &view.target, &[]);
    judge(unoccluded(&from, &to), &free, most, "unoccluded")?;
    judge(unoccluded_complement(&from, &to), &free.complement(), most, "complement")?;
    let seen = precise::form_factor(view.position, view.normal, &view.target, &view.occluders);
    judge(form_factor(&from, &to, &occluders), &seen, most, "occluded")?;
    judge(by_hierarchy(&from, &to, &occluders), &seen, most, "by hierarchy")?;
    let all = Enclosure::new(occluders.into_iter().chain([to]).collect());
    judge(all.form_factor(&from, all.polygons().len() - 1), &seen, most, "in an enclosure")
}

fn found() -> Vec<NearView> {
    let data: Value = serde_json::from_str(include_str!("../cases/near.json")).expect("JSON");
    let list = |v: &Value| v.as_array().expect("a list").clone();
    let vector = |v: &Value| DVec3::from([0, 1, 2].map(|i| v[i].as_f64().expect("a number")));
    let loops = |v: &Value| list(v).iter().map(|l| list(l).iter().map(vector).collect()).collect();
    let view = |case: &Value| NearView {
        name: case["name"].as_str().expect("a name").to_owned(),
        position: vector(&case["point"]),
        normal: vector(&case["normal"]),
        target: loops(&case["target"]),
        occluders: list(&case["occluders"]).iter().map(loops).collect(),
    };
    list(&data["cases"]).iter().map(view).collect()
}

#[test]
fn what_was_found_is_right() {
    // Gaps of 5e-18 before walls of 46 leave of the 31 digits of two doubles what bounds the value to 1e-9.
    let most = |view: &NearView| if view.name.starts_with("hair") { 1e-9 } else { 1e-11 };
    let fails = |v: &NearView| check(v, most(v)).err().map(|e| format!("{}: {e}", v.name));
    let failures: Vec<String> = found().iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn views() -> u64 {
    let asked = std::env::var("NEAR_VIEWS").ok();
    asked.map_or(900, |count| count.parse().expect("NEAR_VIEWS is a number"))
}

#[test]
fn near_views_are_right_and_their_bounds_say_so() {
    let count = views();
    let every = |start: u64| {
        let seeds = (start..count).step_by(2);
        let fails = |v: NearView| check(&v, 1e-11).err().map(|e| format!("{}: {e}", v.name));
        seeds.map(near).filter_map(fails).collect::<Vec<_>>()
    };
    let failures: Vec<String> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..2).map(|start| scope.spawn(move || every(start))).collect();
        running.into_iter().flat_map(|t| t.join().expect("the check itself does not panic")).collect()
    });
    assert!(failures.is_empty(), "{} of {count}:\n{}", failures.len(), failures.join("\n"));
}
