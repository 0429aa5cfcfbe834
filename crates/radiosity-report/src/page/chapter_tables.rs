//! The chapters of the work saved and of the published tables.
use super::section::Section;
use super::table::{Table, error, percent, seconds, short};
use crate::results::Report;
use crate::rows::{LeftOut, Published, Row};

/// The work that was saved in each scene.
pub(crate) fn left_out(report: &Report) -> Section {
    let names = ["left-out", "Work saved"];
    let rows = left_out_table(report);
    if rows.rows.is_empty() {
        return Section::new(names, String::new());
    }
    let body = format!(
        "<p>The table shows what the exact method did not compute in each \
         scene: how many items per form factor (of elements: in all), the time of one item, measured in this run, and the time \
         saved, in units of the time that the scene's form factors took. Savings overlap: an occluder that was never looked at \
         needs no culling either. What saves nothing in any scene has no place in the code.</p>\n{}\
         <details><summary>every scene</summary>\n{}</details>\n",
        economies(&left_out_rows(report)).html(),
        rows.html()
    );
    Section::new(names, body)
}

/// What was left out, each row.
fn left_out_rows(report: &Report) -> Vec<&LeftOut> {
    let rows = report.rows.iter();
    rows.filter_map(|row| if let Row::LeftOut(row) = row { Some(row) } else { None }).collect()
}

/// What saves so much of the time taken buys something.
const WORTH: f64 = 0.1;

/// For each economy the scenes on which it pays, and where most.
fn economies(rows: &[&LeftOut]) -> Table {
    let mut table =
        Table::new(["left out", "saves a tenth of the time or more in", "most, × the time taken"]);
    let mut known: Vec<&str> = Vec::new();
    for economy in rows.iter().map(|row| row.economy) {
        if known.contains(&economy) {
            continue;
        }
        known.push(economy);
        let mut here: Vec<_> = rows.iter().filter(|row| row.economy == economy).collect();
        here.sort_by(|a, b| b.saved.total_cmp(&a.saved));
        let paid = here.iter().filter(|row| row.saved >= WORTH).map(|row| row.scene.as_str());
        let paid: Vec<&str> = paid.collect();
        let most = here.first().map(|row| format!("{}, {}", short(row.saved), row.scene));
        let all = format!("{} of {} scenes: {}", paid.len(), here.len(), paid.join(", "));
        table.push([economy.to_owned(), all, most.unwrap_or_default()]);
    }
    table
}

pub(crate) fn left_out_table(report: &Report) -> Table {
    let mut table =
        Table::new(["scene", "left out", "count", "share", "one costs", "saved × the time taken"]);
    for LeftOut { scene, economy, count, share, unit, saved } in left_out_rows(report) {
        let figures = [short(*count), percent(*share), seconds(*unit), short(*saved)];
        let [count, share, unit, saved] = figures;
        table.push([scene.clone(), (*economy).to_owned(), count, share, unit, saved]);
    }
    table
}

/// The sources' tables with what was measured here beside what was printed.
pub(crate) fn published(report: &Report) -> Section {
    let names = ["published", "Published tables, measured again"];
    let rows = published_table(report);
    if rows.rows.is_empty() {
        return Section::new(names, String::new());
    }
    let body = format!(
        "<p>Barreto (2008), tables 4.1 to 4.5, on an Intel Core Duo of 2.5 GHz; \
         his table 4.5 repeats the row of 4.4. Gomes (2010), tables 5.1 and 5.2, on a Core 2 of 2.4 GHz with a GTX 260. Here \
         all methods solve the same elements; in cornell-3842 these are its patches, cut where a block stands on them. Errors \
         are those of reflected light, compared with the exact solution on these elements: the largest error over the largest \
         light, the mean error over the mean light.{}</p>\n{}",
        if report.quick {
            " The quick report has one element in sixteen and at most 300, and no cornell-3842, which has too many patches for that."
        } else {
            ""
        },
        rows.html()
    );
    Section::new(names, body)
}

pub(crate) fn published_table(report: &Report) -> Table {
    let mut table = Table::new([
        "table",
        "scene",
        "method",
        "printed",
        "elements",
        "vertices",
        "CPU time",
        "factors kept",
        "largest error",
        "mean error",
    ]);
    let of = |row: &Row| if let Row::Published(row) = row { Some(row.clone()) } else { None };
    for row in report.rows.iter().filter_map(of) {
        let Published { table: number, scene, method, published, elements, vertices, bytes, errors, .. } =
            row;
        table.push([
            number.to_owned(),
            scene.to_owned(),
            method,
            published.to_owned(),
            elements.to_string(),
            vertices.to_string(),
            seconds(row.seconds),
            bytes.map_or_else(|| "none".to_owned(), |bytes| format!("{} MB", short(bytes as f64 / 1e6))),
            error(errors[0]),
            error(errors[1]),
        ]);
    }
    table
}
