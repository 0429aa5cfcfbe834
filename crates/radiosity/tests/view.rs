//! The page in a browser: it draws, and each of its controls changes the picture.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod browser;

use browser::{browser, reported};
use radiosity::{Camera, Method, Options, Record, Recorder, scenes, solve, viewer};
use std::ops::ControlFlow;

/// Uses the controls as a person would, one after the other, and notes a hash of the picture after each.
const SCRIPT: &str = r#"<script>
const look = () => {
  // A headless browser may show no frames of its own: draw when the page has asked for one, and only then.
  if (waiting) draw();
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let hash = 7, lit = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    hash = (hash * 31 + pixels[i] * 65536 + pixels[i + 1] * 256 + pixels[i + 2]) % 4294967291;
    lit += pixels[i] + pixels[i + 1] + pixels[i + 2] > 30;
  }
  const legend = $("legend").hidden ? "" : $("legend").getAttribute("aria-label");
  return { hash, lit: 4 * lit / pixels.length, legend };
};
const input = (id, property, value) => {
  $(id)[property] = value;
  $(id).dispatchEvent(new Event("input", { bubbles: true }));
};
const pointer = (kind, x, y, more = {}) => canvas.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: y, bubbles: true, ...more }));
const drag = (buttons, more = {}) => {
  pointer("pointerdown", 300, 300, { buttons });
  pointer("pointermove", 340, 320, { buttons, ...more });
  pointer("pointerup", 340, 320);
};
const pinch = () => {
  pointer("pointerdown", 300, 300, { buttons: 1 });
  pointer("pointerdown", 400, 300, { buttons: 1, pointerId: 2 });
  pointer("pointermove", 500, 300, { buttons: 1, pointerId: 2 });
  pointer("pointerup", 300, 300);
  pointer("pointerup", 500, 300, { pointerId: 2 });
};
const key = name => window.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
const steps = {
  first: () => {},
  patches: () => input("show", "value", "patches"),
  elements: () => input("show", "value", "elements"),
  interpolated: () => input("show", "value", "interpolated"),
  wireframe: () => input("wireframe", "checked", true),
  no_wireframe: () => input("wireframe", "checked", false),
  no_lights: () => input("lights", "checked", false),
  lights: () => input("lights", "checked", true),
  no_textures: () => input("textures", "checked", false),
  textures: () => input("textures", "checked", true),
  dark: () => input("exposure", "value", -2),
  bright: () => input("exposure", "value", 2),
  exposure: () => input("exposure", "value", 0),
  turned: () => drag(1),
  reset_1: () => $("reset").click(),
  shifted: () => drag(2),
  reset_2: () => $("reset").click(),
  zoomed: () => canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 300, cancelable: true })),
  reset_3: () => $("reset").click(),
  pinched: pinch,
  reset_4: () => key("r"),
  moved: () => key("w"),
  reset_5: () => key("r"),
  moved_fast: () => { key("+"); key("+"); key("w"); },
  reset_6: () => key("r"),
  turned_by_key: () => key("ArrowUp"),
  nearer: () => key("PageUp"),
  reset_7: () => key("r"),
  brighter: () => key("]"),
  darker: () => key("["),
  radiosity: () => key("5"),
  irradiance: () => key("6"),
  lux: () => key("y"),
  interpolated_again: () => key("3"),
  other_camera: () => key("c"),
  reset_8: () => key("r"),
  below: () => { turn(0, 1.4); redraw(); },
  backs: () => key("b"),
  fronts: () => { key("b"); key("r"); },
};
window.onload = async () => {
  const report = {};
  for (const [name, act] of Object.entries(steps)) {
    act();
    report[name] = look();
  }
  pointer("pointermove", canvas.clientWidth / 2, canvas.clientHeight * 0.8);
  report.probe = $("probe").textContent;
  pointer("pointerleave", 0, 0);
  report.left = $("probe").textContent;
  key("x");
  draw();
  report.middle = $("probe").textContent;
  report.saved = await new Promise(named => {
    HTMLAnchorElement.prototype.click = function () { named(this.download); };
    key("i");
  });
  // How deep what is seen is, at the least.
  report.least = Infinity;
  for (let y = 5; y < canvas.clientHeight; y += 10) for (let x = 5; x < canvas.clientWidth; x += 10) {
    const { element, point } = hit(x, y), { ahead, eye } = axes();
    if (element >= 0) report.least = Math.min(report.least, dot(sub(point, eye), ahead));
  }
  report.near = nearest();
  report.title = document.title;
  report.wide = document.documentElement.scrollWidth > innerWidth;
  report.error = gl.getError();
  document.body.innerHTML = "<pre>REPORT" + ":" + JSON.stringify(report) + "</pre>";
};
</script>
</html>"#;

/// Walks through a run as a person would, by keys, by the slider and by buttons; notes the picture and the words after each.
const WALK: &str = r#"<script>
const look = () => {
  if (waiting) draw();
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return { hash: pixels.reduce((hash, byte) => (hash * 31 + byte) % 4294967291, 7), story: $("story").textContent,
    shares: $("shares").textContent, wide: document.documentElement.scrollWidth > innerWidth || $("panel").open, step: Number($("step").value) };
};
const key = name => window.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
const slide = value => { $("step").value = value; $("step").dispatchEvent(new Event("input", { bubbles: true })); };
const steps = {
  last: () => {}, home: () => key("Home"), right: () => key("ArrowRight"), dot: () => key("."), left: () => key("ArrowLeft"),
  unshot: () => key("u"), light: () => key("u"), estimate: () => key("4"), no_estimate: () => key("3"), links: () => key("k"), no_links: () => key("k"), link: () => key("k"),
  slid: () => slide(2), on: () => $("on").click(), back: () => $("back").click(), end: () => key("End"), beyond: () => key("."),
};
window.onload = () => {
  const report = {};
  for (const [name, act] of Object.entries(steps)) {
    act();
    report[name] = look();
  }
  report.error = gl.getError();
  document.body.innerHTML = "<pre>REPORT" + ":" + JSON.stringify(report) + "</pre>";
};
</script>
</html>"#;

/// What a browser 400 pixels wide reports of a walk through a run of one method.
fn walked(browser: &str, method: Method) -> serde_json::Value {
    let scene = scenes::scene("cornell-box").unwrap();
    let options = Options { method, elements: 200, error: 0.2, record: true, ..Options::default() };
    let mut recorder = Recorder::new(&scene);
    let follow = |progress: &radiosity::Progress<'_>| {
        recorder.note(progress);
        ControlFlow::Continue(())
    };
    let solution = solve(&scene, &options, follow).unwrap();
    let recording = Some(recorder.end(&solution));
    let record = Record { recording, ..Record::new("cornell-box", &scene, &solution) };
    let folder = tempfile::tempdir().unwrap();
    let text = viewer::page(&record, record.exposure()).replace("</html>", WALK);
    std::fs::write(folder.path().join("page.html"), text).unwrap();
    let flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=400,700"];
    reported(browser, folder.path(), &[&flags[..], &["--virtual-time-budget=20000"]].concat())
}

#[test]
fn a_recorded_run_is_walked_through_by_keys_slider_and_buttons() {
    let Some(browser) = browser() else { return };
    for (method, words) in [
        (Method::Shoot, "next shoots light"),
        (Method::Matrix, "emitted light only"),
        (Method::Hierarchical, "before the first round"),
    ] {
        let report = walked(&browser, method);
        let hash = |step: &str| report[step]["hash"].as_u64().unwrap_or_else(|| panic!("no step {step}"));
        let story = |step: &str| report[step]["story"].as_str().unwrap().to_owned();
        assert!(story("home").contains(words) && story("last").contains("the solution"), "{report}");
        // Where nothing is linked yet, all light escapes.
        let open = if method == Method::Hierarchical { "escaped 100.0 %" } else { "unshot 100.0 %" };
        assert!(report["home"]["shares"].as_str().unwrap().contains(open), "{report}");
        for pair in [["last", "home"], ["home", "right"], ["right", "dot"]] {
            assert_ne!(hash(pair[0]), hash(pair[1]), "{pair:?} {report}");
        }
        for pair in [
            ["left", "right"],
            ["light", "left"],
            ["slid", "dot"],
            ["back", "slid"],
            ["end", "last"],
            ["beyond", "end"],
        ] {
            assert_eq!(hash(pair[0]), hash(pair[1]), "{pair:?} {report}");
        }
        assert_eq!(report["on"]["step"], 3);
        assert_eq!(hash("unshot") != hash("left"), method != Method::Hierarchical);
        assert_eq!(
            hash("estimate") != hash("no_estimate"),
            method == Method::Hierarchical,
            "only levels know their error"
        );
        assert_eq!(hash("links") != hash("no_links"), method == Method::Hierarchical);
        assert!(
            report.as_object().unwrap().values().all(|step| step["wide"] != true),
            "wider than 400 pixels"
        );
        assert_eq!(report["error"], 0);
    }
}

#[test]
fn the_page_draws_and_its_controls_change_the_picture() {
    let Some(browser) = browser() else { return };
    let scene = scenes::scene("chessboard").unwrap();
    let options = Options { max_shots: 100, ..Options::mesh(600) };
    let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap();
    let mut record = Record::new("scenes/chessboard.dae", &scene, &solution);
    let other =
        Camera { name: "other".into(), position: [3.0, -5.0, 3.0].into(), ..record.cameras[0].clone() };
    record.cameras.push(other);
    let folder = tempfile::tempdir().unwrap();
    let text = viewer::page(&record, record.exposure()).replace("</html>", SCRIPT);
    std::fs::write(folder.path().join("page.html"), text).unwrap();
    let flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=600,500"];
    let report = reported(&browser, folder.path(), &[&flags[..], &["--virtual-time-budget=20000"]].concat());

    let hash = |step: &str| report[step]["hash"].as_u64().unwrap_or_else(|| panic!("no step {step}"));
    let lit = |step: &str| report[step]["lit"].as_f64().unwrap_or_else(|| panic!("{step}: {report}"));
    assert!(lit("first") > 0.1, "{report}");
    let changes = [
        "patches",
        "elements",
        "wireframe",
        "no_lights",
        "no_textures",
        "dark",
        "bright",
        "turned",
        "shifted",
        "zoomed",
        "pinched",
        "moved",
        "moved_fast",
        "turned_by_key",
        "nearer",
        "brighter",
        "radiosity",
        "irradiance",
        "other_camera",
    ];
    for step in changes {
        assert_ne!(hash(step), hash("first"), "{step} changes nothing");
    }
    assert_ne!(hash("patches"), hash("elements"));
    assert_ne!(hash("moved"), hash("moved_fast"), "faster is farther");
    let back =
        ["interpolated", "no_wireframe", "lights", "textures", "exposure", "reset_1", "reset_2", "reset_3"];
    let by_keys = ["reset_7", "darker", "interpolated_again", "reset_8", "fronts"];
    for step in back.into_iter().chain(["reset_4", "reset_5", "reset_6"]).chain(by_keys) {
        assert_eq!(hash(step), hash("first"), "{step} does not lead back");
    }
    assert!(lit("zoomed") < lit("first"), "farther away less is seen");
    assert_ne!(hash("backs"), hash("below"), "from below the floor's back is seen");
    assert_ne!(hash("radiosity"), hash("irradiance"));
    let legend = |step: &str| report[step]["legend"].as_str().unwrap().to_owned();
    assert!(
        legend("irradiance").starts_with("irradiance, W/m²: dark violet to yellow is 0 to ≥ "),
        "{report}"
    );
    assert!(legend("lux").starts_with("illuminance, lx: "), "{report}");
    assert_eq!(legend("first"), "");
    assert_eq!(report["left"], "point at a surface", "values go when the pointer does");
    assert!(report["middle"].as_str().unwrap().starts_with("patch       "), "{report}");
    assert_eq!(report["saved"], "chessboard.png");
    assert_eq!((&report["title"], &report["wide"]), (&"chessboard.dae – radiosity".into(), &false.into()));
    let [near, least] = ["near", "least"].map(|depth| report[depth].as_f64().unwrap());
    assert!(
        near <= least && near > 0.3 * least,
        "depths are told apart from {near} on, {least} is the least"
    );
    let probe = report["probe"].as_str().unwrap();
    for word in ["patch       floor", "element ", "radiosity ", "irradiance ", "bound "] {
        assert!(probe.contains(word), "{word}: {probe}");
    }
    assert_eq!(report["error"], 0);
}
