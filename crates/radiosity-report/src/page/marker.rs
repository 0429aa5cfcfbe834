//! Markers: a shape for each method, and a sign of its own for what was proven and not measured.
use super::escape::escape;

/// What a value is, with the style of its method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    /// Measured: one of twelve shapes.
    Measured(usize),
    /// A proven bound: a bar with an arrow down, as the true value is below.
    Bound(usize),
}

impl Sign {
    pub(crate) fn is_bound(self) -> bool {
        matches!(self, Sign::Bound(_))
    }

    /// The classes that colour it.
    pub(crate) fn class(self) -> String {
        match self {
            Sign::Measured(style) => format!("s{style}"),
            Sign::Bound(style) => format!("s{style} proven"),
        }
    }
}

/// Filled or open.
const SHAPES: [(&str, bool); 12] = [
    ("m-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z", true),
    ("m-4.5-4.5h9v9h-9z", true),
    ("m0-6l5.5 9.5h-11z", true),
    ("m0 6l5.5-9.5h-11z", true),
    ("m0-6l5 6l-5 6l-5-6z", true),
    ("m-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z", false),
    ("m-4.5-4.5h9v9h-9z", false),
    ("m0-6l5.5 9.5h-11z", false),
    ("m0 6l5.5-9.5h-11z", false),
    ("m0-6l5 6l-5 6l-5-6z", false),
    ("m-5-5l10 10m0-10l-10 10", false),
    ("m-6 0h12m-6-6v12", false),
];
/// The bar is the bound; the arrow points at where the value is.
const LIMIT: &str = "m-8 0h16m-8 0v11m-4.5-5l4.5 5l4.5-5";

/// A marker at a place, with what is shown when the pointer rests on it.
pub(crate) fn marker(sign: Sign, [x, y]: [f64; 2], hint: &str) -> String {
    let (shape, class) = match sign {
        Sign::Bound(_) => (LIMIT, "limit"),
        Sign::Measured(style) => match SHAPES[style % SHAPES.len()] {
            (shape, true) => (shape, "mark full"),
            (shape, false) => (shape, "mark"),
        },
    };
    let hint = if hint.is_empty() { String::new() } else { format!("<title>{}</title>", escape(hint)) };
    format!("<path class=\"{class}\" d=\"M{x:.1} {y:.1}{shape}\">{hint}</path>")
}
