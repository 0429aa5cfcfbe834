//! The page of a function: what a person reads about it, in the engine and in this crate's documentation.
use datafusion_expr::{DocSection, Documentation};

const SECTION: DocSection =
    DocSection { include: true, label: "Geometry Functions", description: Some("Exact overlay of polygons") };

/// A function's name and its documentation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Page {
    pub(crate) name: &'static str,
    documentation: Documentation,
}

impl Page {
    /// From a text whose example, the last thing on it, is SQL.
    pub(crate) fn new(name: &'static str, arguments: &[(&str, &str)], text: &str) -> Page {
        let (description, example) = text.split_once("```sql").unwrap_or((text, ""));
        let names: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
        let syntax = format!("{name}({})", names.join(", "));
        let mut documentation = Documentation::builder(SECTION, description.trim(), syntax)
            .with_sql_example(format!("```sql{example}"));
        for (name, text) in arguments {
            documentation = documentation.with_argument(*name, *text);
        }
        Page { name, documentation: documentation.build() }
    }

    pub(crate) fn documentation(&self) -> &Documentation {
        &self.documentation
    }
}
