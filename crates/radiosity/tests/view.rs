//! The page in a browser: it draws, and each of its controls changes the picture.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod browser;

use browser::{browser, reported};
use radiosity::{Options, Record, scenes, solve, viewer};
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
  return { hash, lit: 4 * lit / pixels.length };
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
};
window.onload = () => {
  const report = {};
  for (const [name, act] of Object.entries(steps)) {
    act();
    report[name] = look();
  }
  pointer("pointermove", canvas.clientWidth / 2, canvas.clientHeight * 0.8);
  report.probe = $("probe").textContent;
  report.error = gl.getError();
  document.body.innerHTML = "<pre>REPORT" + ":" + JSON.stringify(report) + "</pre>";
};
</script>
</html>"#;

#[test]
fn the_page_draws_and_its_controls_change_the_picture() {
    let Some(browser) = browser() else { return };
    let scene = scenes::scene("chessboard").unwrap();
    let options = Options { elements: 600, max_shots: 100, ..Options::default() };
    let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap();
    let record = Record::new("chessboard", &scene, &solution);
    let folder = tempfile::tempdir().unwrap();
    let text = viewer::page(&record, record.exposure()).replace("</html>", SCRIPT);
    std::fs::write(folder.path().join("page.html"), text).unwrap();
    let flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=600,500"];
    let report = reported(&browser, folder.path(), &[&flags[..], &["--virtual-time-budget=20000"]].concat());

    let hash = |step: &str| report[step]["hash"].as_u64().unwrap_or_else(|| panic!("no step {step}"));
    let lit = |step: &str| report[step]["lit"].as_f64().unwrap_or_else(|| panic!("{step}: {report}"));
    assert!(lit("first") > 0.15, "{report}");
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
    ];
    for step in changes {
        assert_ne!(hash(step), hash("first"), "{step} changes nothing");
    }
    assert_ne!(hash("patches"), hash("elements"));
    assert_ne!(hash("moved"), hash("moved_fast"), "faster is farther");
    let back =
        ["interpolated", "no_wireframe", "lights", "textures", "exposure", "reset_1", "reset_2", "reset_3"];
    for step in back.into_iter().chain(["reset_4", "reset_5", "reset_6"]) {
        assert_eq!(hash(step), hash("first"), "{step} does not lead back");
    }
    assert!(lit("zoomed") < lit("first"), "farther away less is seen");
    let probe = report["probe"].as_str().unwrap();
    for word in ["patch       floor", "element ", "radiosity ", "irradiance ", "bound "] {
        assert!(probe.contains(word), "{word}: {probe}");
    }
    assert_eq!(report["error"], 0);
}
