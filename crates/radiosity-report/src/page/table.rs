//! Tables, as Markdown and as HTML, and how numbers are written in them.
use super::escape::escape;

/// A header and rows of the same length.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

/// A cell of more characters is a sentence.
const LONG: usize = 32;

impl Table {
    /// An empty table.
    pub(crate) fn new<const N: usize>(header: [&str; N]) -> Table {
        Table { header: header.map(ToOwned::to_owned).to_vec(), rows: Vec::new() }
    }

    /// Adds a row.
    pub(crate) fn push<const N: usize>(&mut self, row: [String; N]) {
        debug_assert_eq!(row.len(), self.header.len());
        self.rows.push(row.to_vec());
    }

    /// Lines with bars between the cells.
    pub(crate) fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let rule: Vec<String> = self.header.iter().map(|_| "---".to_owned()).collect();
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        line(&self.header) + &line(&rule) + &rows
    }

    /// A table element. Sentences take several lines, figures one.
    pub(crate) fn html(&self) -> String {
        let cell = |tag: &str, cell: &String| {
            let class = if cell.chars().count() > LONG { " class=\"long\"" } else { "" };
            format!("<{tag}{class}>{}</{tag}>", escape(cell))
        };
        let cells =
            |tag: &str, cells: &[String]| cells.iter().map(|text| cell(tag, text)).collect::<String>();
        let rows: String = self.rows.iter().map(|row| format!("<tr>{}</tr>\n", cells("td", row))).collect();
        let header = cells("th", &self.header);
        format!(
            "<div class=\"wide\" role=\"region\" aria-label=\"table\" tabindex=\"0\"><table><thead><tr>{header}</tr></thead><tbody>\n{rows}</tbody></table></div>\n"
        )
    }
}

/// Seconds, with the unit that suits.
pub(crate) fn seconds(time: f64) -> String {
    match time {
        time if time >= 1.0 => format!("{} s", short(time)),
        time if time >= 1e-3 => format!("{} ms", short(time * 1e3)),
        time if time >= 1e-6 => format!("{} µs", short(time * 1e6)),
        time => format!("{} ns", short(time * 1e9)),
    }
}

/// Three digits.
pub(crate) fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

/// An error.
pub(crate) fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

/// A share in per cent.
pub(crate) fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_its_rows_in_both_forms() {
        let mut table = Table::new(["a", "b"]);
        table.push(["1 < 2".to_owned(), "x".to_owned()]);
        assert_eq!(table.markdown(), "| a | b |\n| --- | --- |\n| 1 < 2 | x |\n");
        table.push(["many words ".repeat(4), "y".to_owned()]);
        let html = table.html();
        assert!(html.contains("<td>1 &lt; 2</td>") && html.contains("<td class=\"long\">many words"));
    }

    #[test]
    fn numbers_have_units_and_three_digits() {
        let times = [0.0123, 2.5e-6, 3e-9, 150.0].map(seconds);
        assert_eq!(times, ["12.3 ms", "2.50 µs", "3.00 ns", "150 s"]);
        assert_eq!(
            (error(0.0), error(1.26e-7), percent(0.125)),
            ("0".into(), "1.3e-7".into(), "12.5 %".into())
        );
    }
}
