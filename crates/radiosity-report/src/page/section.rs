//! Chapters of the page: an anchor, a title, and what stands below it.

/// A chapter; without a body it is left out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Section {
    id: &'static str,
    title: &'static str,
    body: String,
}

impl Section {
    /// With this body, which may be empty.
    pub(crate) fn new([id, title]: [&'static str; 2], body: String) -> Section {
        Section { id, title, body }
    }

    /// Of an introduction and plots; nothing where there are no plots.
    pub(crate) fn plots(names: [&'static str; 2], intro: &str, plots: &str) -> Section {
        if plots.is_empty() {
            return Section::new(names, String::new());
        }
        Section::new(names, format!("{intro}<div class=\"plots\">\n{plots}</div>\n"))
    }

    /// With a text before its body, if it has one.
    pub(crate) fn opened_by(self, text: &str) -> Section {
        let body = if self.body.is_empty() { self.body } else { text.to_owned() + &self.body };
        Section { body, ..self }
    }

    /// Nothing where nothing was measured.
    pub(crate) fn html(&self) -> String {
        let Section { id, title, body } = self;
        if body.is_empty() { String::new() } else { format!("<h2 id=\"{id}\">{title}</h2>\n{body}") }
    }

    /// A link to it.
    pub(crate) fn link(&self) -> String {
        let Section { id, title, body } = self;
        if body.is_empty() { String::new() } else { format!("<a href=\"#{id}\">{title}</a>\n") }
    }
}
