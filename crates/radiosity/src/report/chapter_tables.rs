//! The chapters of what was left out and of the published tables.
use super::Report;
use super::left_out::LeftOut;
use super::published::Published;
use super::row::Row;
use super::table::{Table, error, percent, seconds, short};

/// What was left out in each scene, and what that saved.
pub(super) fn left_out(report: &Report) -> String {
    let rows = left_out_table(report);
    if rows.rows.is_empty() {
        return String::new();
    }
    format!(
        "<h2 id=\"left-out\">What was left out</h2>\n<p>For each scene what the exact method did not look at, how many per \
         form factor (of elements: in all), what one costs where it is not left out, measured in this run, and what leaving \
         it out saved, in units of the time that the scene's form factors took. The economies overlap: an occluder that was \
         never looked at needs no culling either.</p>\n{}",
        rows.html()
    )
}

pub(super) fn left_out_table(report: &Report) -> Table {
    let mut table =
        Table::new(["scene", "left out", "count", "share", "one costs", "saved × the time taken"]);
    let of = |row: &Row| if let Row::LeftOut(row) = row { Some(row.clone()) } else { None };
    for LeftOut { scene, economy, count, share, unit, saved } in report.rows.iter().filter_map(of) {
        table.push([scene, economy.to_owned(), short(count), percent(share), seconds(unit), short(saved)]);
    }
    table
}

/// The sources' tables with what was measured here beside what was printed.
pub(super) fn published(report: &Report) -> String {
    let rows = published_table(report);
    if rows.rows.is_empty() {
        return String::new();
    }
    format!(
        "<h2 id=\"published\">The sources' tables</h2>\n<p>Barreto (2008), tables 4.1 to 4.5, on an Intel Core Duo of 2.5 GHz; \
         his table 4.5 repeats the row of 4.4. Gomes (2010), tables 5.1 and 5.2, on a Core 2 of 2.4 GHz with a GTX 260. Here \
         the methods that are compared solve the same elements. Errors are of reflected light against the exact solution \
         on these elements: the largest in shares of the largest, the mean in shares of the mean.{}</p>\n{}",
        if report.quick {
            " The quick report has one element in sixteen, and leaves out cornell-3842, whose patches are that many."
        } else {
            ""
        },
        rows.html()
    )
}

pub(super) fn published_table(report: &Report) -> Table {
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
