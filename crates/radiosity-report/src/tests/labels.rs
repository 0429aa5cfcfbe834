//! The page in a browser: no label lies on another one or outside of its plot, in the light and in the dark.
use super::browser::{browser, reported};
use super::glance;
use crate::measure::{booleans, solutions, stress};
use crate::methods;
use crate::plan::Rounds;
use crate::results::Report;
use crate::rows::{Deviation, Row};
use serde_json::Value;

/// Measures the boxes of all labels, and looks for what is cut off: plots that are wider than the page, keys outside of it, tables
/// that scroll and do not show it. `WIDTH` pixels of the page are used.
const SCRIPT: &str = r#"<script>
window.onload = () => {
  const page = document.documentElement;
  page.style.width = "WIDTHpx";
  const found = { plots: 0, labels: 0, outside: [], overlaps: [], cut: [], still: [] };
  for (const plot of document.querySelectorAll("svg.plot")) {
    const frame = plot.getBoundingClientRect();
    const boxes = [...plot.querySelectorAll("text")].filter(text => text.textContent).map(text => [text.textContent, text.getBoundingClientRect()]);
    found.plots += 1;
    found.labels += boxes.length;
    boxes.forEach(([label, a], i) => {
      if (a.left < frame.left || a.right > frame.right || a.top < frame.top || a.bottom > frame.bottom) found.outside.push(label);
      for (const [other, b] of boxes.slice(0, i)) {
        const apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 2 || b.bottom <= a.top + 2;
        if (!apart) found.overlaps.push([label, other]);
      }
    });
  }
  for (const part of document.querySelectorAll("svg.plot, .key li, figcaption, img, .wide, p, nav a")) {
    const box = part.getBoundingClientRect();
    if (box.width > 0 && (box.left < 0 || box.right > WIDTH)) found.cut.push(part.outerHTML.slice(0, 80));
  }
  for (const table of document.querySelectorAll(".wide")) {
    const style = getComputedStyle(table);
    if (style.overflowX !== "auto" || !style.backgroundImage.includes("gradient") || table.tabIndex !== 0) found.still.push(table.textContent.slice(0, 80));
  }
  found.size = Math.min(...[...document.querySelectorAll("svg.plot")].map(plot => 14 * plot.getBoundingClientRect().width / 440));
  found.paper = getComputedStyle(document.body).backgroundColor;
  found.ink = getComputedStyle(document.body).color;
  document.body.innerHTML = "<pre>REPORT" + ":" + JSON.stringify(found) + "</pre>";
};
</script></body>"#;

/// What the script finds on a page of so many pixels across.
fn looked_at(browser: &str, page: &str, width: u32, dark: bool) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let page = page.replace("</body>", &SCRIPT.replace("WIDTH", &width.to_string()));
    std::fs::write(folder.path().join("page.html"), page).unwrap();
    let scheme = format!("--blink-settings=preferredColorScheme={}", if dark { 0 } else { 1 });
    reported(browser, folder.path(), &[&scheme, &format!("--window-size={width},900")])
}

/// A page with plots of three chapters.
fn page() -> String {
    let plan = super::plan(&[]);
    let Report { mut rows, machine, images, .. } = glance(&["obstruction"]);
    let middle = methods::middle(&plan);
    for (_, set) in stress::query_sets(&plan).into_iter().take(3) {
        rows.extend(set.measure(&middle[..1], Rounds::ONCE).into_iter().map(Row::Measured));
    }
    rows.extend(booleans::measure(&plan).into_iter().map(Row::Measured));
    let solved = solutions::series(&plan).into_iter().map(|series| solutions::blank("cornell-box", series));
    rows.extend(solved.map(Row::Measured));
    let noise = vec![("cornell-box".to_owned(), Deviation { max: 1e-3, mean: 1e-4, beyond: 0.0 })];
    Report { rows, machine, images, quick: true, noise }.page(None)
}

#[test]
fn labels_and_plots_are_whole_at_any_width_in_the_light_and_in_the_dark() {
    let Some(browser) = browser() else { return };
    let page = page();
    let looks = [(1500, false), (1500, true), (700, false), (400, false)];
    let looks = looks.map(|(width, dark)| looked_at(&browser, &page, width, dark));
    let nothing = Value::from(Vec::<Value>::new());
    for found in &looks {
        assert!(found["plots"].as_u64() >= Some(10) && found["labels"].as_u64() > Some(90), "{found}");
        for wrong in ["outside", "overlaps", "cut", "still"] {
            assert_eq!(found[wrong], nothing, "{wrong}");
        }
        assert!(found["size"].as_f64() > Some(9.0), "labels of {} pixels", found["size"]);
    }
    let [light, dark, ..] = &looks;
    assert_eq!((&light["paper"], &light["ink"]), (&"rgb(253, 253, 251)".into(), &"rgb(27, 29, 33)".into()));
    assert_eq!((&dark["paper"], &dark["ink"]), (&"rgb(21, 23, 26)".into(), &"rgb(232, 232, 228)".into()));
}
