//! The page in a browser: no label lies on another one or outside of its plot, in the light and in the dark.
use super::browser::{browser, reported};
use super::glance;
use crate::measure::{booleans, stress};
use crate::methods;
use crate::results::Report;
use crate::rows::Row;
use serde_json::Value;
use std::path::Path;

/// Measures the boxes of all labels.
const SCRIPT: &str = r#"<script>
window.onload = () => {
  const found = { plots: 0, labels: 0, outside: [], overlaps: [], wide: document.documentElement.scrollWidth > window.innerWidth };
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
  found.paper = getComputedStyle(document.body).backgroundColor;
  found.ink = getComputedStyle(document.body).color;
  document.body.innerHTML = "<pre>REPORT" + ":" + JSON.stringify(found) + "</pre>";
};
</script></body>"#;

/// What the script finds on a page of so many pixels across.
fn looked_at(browser: &str, folder: &Path, width: u32, dark: bool) -> Value {
    let scheme = format!("--blink-settings=preferredColorScheme={}", if dark { 0 } else { 1 });
    reported(browser, folder, &[&scheme, &format!("--window-size={width},900")])
}

/// A page with plots of three chapters.
fn page() -> String {
    let plan = super::plan(&[]);
    let Report { mut rows, machine, images, .. } = glance(&["obstruction"]);
    let middle = methods::middle(&plan);
    for (_, set) in stress::query_sets(&plan).into_iter().take(3) {
        rows.extend(set.measure(&middle[..1], 1).into_iter().map(Row::Measured));
    }
    rows.extend(booleans::measure(&plan).into_iter().map(Row::Measured));
    Report { rows, machine, images, quick: true }.page(None).replace("</body>", SCRIPT)
}

#[test]
fn no_label_lies_on_another_one_in_the_light_and_in_the_dark() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("page.html"), page()).unwrap();
    let [light, dark, narrow] = [(1500, false), (1500, true), (500, false)]
        .map(|(width, dark)| looked_at(&browser, folder.path(), width, dark));
    for found in [&light, &dark, &narrow] {
        assert!(found["plots"].as_u64() >= Some(10) && found["labels"].as_u64() > Some(150), "{found}");
        assert_eq!(
            (&found["outside"], &found["overlaps"]),
            (&Value::from(Vec::<Value>::new()), &Value::from(Vec::<Value>::new()))
        );
        assert_eq!(found["wide"], false, "the page is wider than its window");
    }
    assert_eq!((&light["paper"], &light["ink"]), (&"rgb(253, 253, 251)".into(), &"rgb(27, 29, 33)".into()));
    assert_eq!((&dark["paper"], &dark["ink"]), (&"rgb(21, 23, 26)".into(), &"rgb(232, 232, 228)".into()));
}
