//! A run, step by step.
use crate::build::{cube, room, scene};
use radiosity::{
    Method, Moment, Options, Record, Recorder, Recording, Scene, Solution, StepKind, scenes, solve,
};
use std::ops::ControlFlow;

/// A room whose floor shines.
fn lit() -> Scene {
    let mut patches = room([0.0; 3], [3.0, 2.0, 2.0], 1, 0.6, 0.0);
    patches[4].emission = vec![1.0];
    scene(patches)
}

fn recorded(scene: &Scene, options: &Options) -> (Solution, Recording) {
    let mut recorder = Recorder::new(scene);
    let follow = |progress: &radiosity::Progress<'_>| {
        recorder.note(progress);
        ControlFlow::Continue(())
    };
    let solution = solve(scene, &Options { record: true, ..options.clone() }, follow).expect("light");
    let recording = recorder.end(&solution);
    (solution, recording)
}

const METHODS: [Method; 5] = [Method::Shoot, Method::Matrix, Method::Cg, Method::Gmres, Method::Hierarchical];

fn options(method: Method) -> Options {
    Options { method, elements: 150, passes: 1, error: 0.02, ..Options::default() }
}

#[test]
fn a_recorded_run_ends_with_the_same_bits() {
    let scene = lit();
    for method in METHODS {
        let plain = solve(&scene, &options(method), |_| ControlFlow::Continue(())).expect("light");
        let (solution, _) = recorded(&scene, &options(method));
        assert_eq!((&plain.radiosity, &plain.irradiance), (&solution.radiosity, &solution.irradiance));
        assert_eq!((&plain.ledger, &plain.bound), (&solution.ledger, &solution.bound), "{method:?}");
        assert_eq!((&plain.estimate, plain.closure), (&solution.estimate, solution.closure));
        assert_eq!((plain.shots, plain.products), (solution.shots, solution.products), "{method:?}");
    }
}

#[test]
fn every_step_accounts_for_all_power_and_the_last_is_the_solution() {
    let scene = lit();
    for method in METHODS {
        let (solution, recording) = recorded(&scene, &options(method));
        for step in &recording.steps {
            let spent = step.absorbed[0] + step.escaped[0] + step.unshot[0];
            assert!((spent / recording.emitted[0] - 1.0).abs() < 1e-9, "{method:?} {step:?}");
        }
        let last = recording.steps.last().expect("a step");
        assert_eq!(
            (last.kind, last.mesh, &last.absorbed),
            (StepKind::Solution, None, &solution.ledger.absorbed)
        );
        let record = Record::new("lit", &scene, &solution);
        let peak = solution.radiosity.iter().copied().fold(0.0, f64::max);
        for (reflected, (element, b)) in
            last.reflected().iter().zip(record.elements.iter().zip(&record.radiosity))
        {
            let emitted = std::f64::consts::PI * scene.patches[element[0]].emission[0];
            assert!((reflected[0] - (b - emitted)).abs() < 1e-4 * peak, "{method:?}");
        }
        let first = &recording.steps[0];
        assert!(
            first.reflected().iter().all(|light| light[0] == 0.0) && first.absorbed[0] == 0.0,
            "{method:?}"
        );
    }
}

#[test]
fn light_only_grows_while_whole_pieces_shoot_or_all_light_is_reflected() {
    for method in [Method::Shoot, Method::Matrix, Method::Cg, Method::Gmres] {
        // Pieces that are not split only shoot what is new. Without a final gather the last step has the mesh of the others.
        let options = Options { spread: 1e9, passes: 0, gather: false, ..options(method) };
        let (_, recording) = recorded(&lit(), &options);
        assert!(recording.steps.len() > 5, "{method:?}");
        for pair in recording.steps.windows(2) {
            let [before, after] = [&pair[0], &pair[1]].map(|step| step.reflected());
            let slack = 1e-4 * after.iter().map(|light| light[0]).fold(0.0, f64::max);
            assert!(
                before.iter().zip(&after).all(|(before, after)| before[0] <= after[0] + slack),
                "{method:?}"
            );
            assert!(pair[1].unshot[0] <= pair[0].unshot[0] * (1.0 + 1e-12), "{method:?}");
        }
    }
}

#[test]
fn who_shoots_is_what_changes_next() {
    let options = Options { spread: 1e9, passes: 0, ..options(Method::Shoot) };
    let (_, recording) = recorded(&lit(), &options);
    let [start, end] = recording.steps[0].shooter.expect("a shooter");
    let mesh = radiosity::Mesh::even(&lit(), options.elements).expect("a mesh");
    assert!(mesh.elements[start..end].iter().all(|element| element.patch == 4), "the lamp shoots first");
    assert_eq!(end - start, mesh.elements.iter().filter(|element| element.patch == 4).count());
    for (number, step) in recording.steps.iter().enumerate().take(recording.steps.len() - 1) {
        assert_eq!((step.kind, step.count), (StepKind::Shots, number));
        assert!(step.shooter.is_some() && step.open.is_some());
    }
}

#[test]
fn links_are_between_tiles_and_grow_finer() {
    let (_, recording) = recorded(&lit(), &options(Method::Hierarchical));
    let counts: Vec<usize> = recording.steps.iter().map(|step| step.link_count).collect();
    assert_eq!(counts[0], 0);
    assert!(
        counts.windows(2).all(|pair| pair[0] <= pair[1]) && counts[counts.len() - 1] > counts[1],
        "{counts:?}"
    );
    assert!(recording.steps.iter().all(|step| step.linked().len() == step.link_count));
    let last = recording.steps.last().expect("a step");
    assert!(last.linked().iter().all(|[one, other]| one != other));
}

#[test]
fn long_runs_are_thinned_evenly_after_their_first_steps() {
    let options = Options { spread: 1e-9, tolerance: 1e-8, elements: 700, ..options(Method::Shoot) };
    let (solution, recording) = recorded(&cube(1, 0.8, 0.2), &Options { passes: 0, ..options });
    assert_eq!(recording.seen, solution.shots, "a step before each shot");
    assert!(recording.every > 1 && recording.steps.len() <= 301, "{}", recording.steps.len());
    let kept: Vec<usize> =
        recording.steps[..recording.steps.len() - 1].iter().map(|step| step.count).collect();
    let wanted = |count: &usize| {
        let number = count + 1;
        number <= recording.first || (number - recording.first) % recording.every == 0
    };
    assert_eq!(kept, (0..recording.seen).filter(|count| wanted(count)).collect::<Vec<_>>());
}

/// Where a finer mesh borders on a coarser one, elements are cut, and the recording is of the same elements.
#[test]
fn a_record_has_no_vertices_in_the_middle_of_sides() {
    let scene = scenes::scene("cornell-box").expect("a built-in scene");
    let (solution, recording) =
        recorded(&scene, &Options { elements: 400, tolerance: 0.1, ..options(Method::Shoot) });
    let record = Record { recording: Some(recording), ..Record::new("cornell-box", &scene, &solution) };
    assert_eq!(record.check(), Ok(()));
    let hanging = |mesh: &radiosity::Mesh| {
        let sides = (0..mesh.elements.len()).flat_map(|element| {
            let [a, b, c] = mesh.triangle(element);
            [[a, b], [b, c], [c, a]]
        });
        let on = |[start, end]: [radiosity::glam::DVec3; 2]| {
            let ends = |place| [start.distance(place), end.distance(place)];
            let is_on =
                |[to, from]: &[f64; 2]| to + from - start.distance(end) < 1e-9 && to.min(*from) > 1e-3;
            mesh.vertices.iter().map(|place| ends(*place)).filter(is_on).count()
        };
        sides.map(on).sum::<usize>()
    };
    assert!(hanging(&solution.mesh) > 0);
    assert_eq!(hanging(&record.mesh()), 0);
}

#[test]
fn a_written_recording_comes_back_and_a_damaged_one_is_refused() {
    let scene = lit();
    let (solution, recording) = recorded(&scene, &options(Method::Hierarchical));
    let record = Record { recording: Some(recording), ..Record::new("lit", &scene, &solution) };
    let text = serde_json::to_string(&record).expect("JSON");
    let again: Record = serde_json::from_str(&text).expect("a record");
    assert_eq!(again.check(), Ok(()));
    let told = |record: &Record| {
        let steps = record.recording.as_ref().expect("steps").steps.iter();
        steps.map(|step| (step.kind, step.count, step.mesh, step.linked())).collect::<Vec<_>>()
    };
    assert!(told(&again) == told(&record), "another run");
    let damaged = |damage: &dyn Fn(&mut Recording)| {
        let mut record = again.clone();
        record.recording.iter_mut().for_each(damage);
        record.check().is_err()
    };
    assert!(damaged(&|recording| recording.steps[1].mesh = Some(99)));
    assert!(damaged(&|recording| recording.steps[1].links.push_str("AAAA")));
    assert!(damaged(
        &|recording| recording.steps[1].light = recording.steps[recording.steps.len() - 1].light.clone()
    ));
    assert!(damaged(&|recording| recording.steps[1].shooter = Some([0, usize::MAX])));
    assert!(damaged(&|recording| recording.tiles.sizes.clear()));
    assert!(damaged(&|recording| recording.meshes[0].elements = "AAAA".to_owned()));
    assert!(damaged(&|recording| recording.emitted.clear()));
    assert!(damaged(&|recording| recording.steps.clear()));
}

#[test]
fn preparation_is_no_step() {
    let scene = scenes::scene("furnace").expect("a scene");
    let mut recorder = Recorder::new(&scene);
    let mut preparing = 0;
    let run =
        solve(&scene, &Options { method: Method::Cg, elements: 60, ..Options::default() }, |progress| {
            preparing += usize::from(progress.moment == Moment::Preparation);
            recorder.note(progress);
            ControlFlow::Continue(())
        });
    assert!(preparing > 6);
    assert_eq!(recorder.end(&run.expect("light")).steps.len(), 1);
}
