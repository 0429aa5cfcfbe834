//! All functions, and how a session comes by them.
use crate::aggregate::evaluate::GroupLimits;
use crate::aggregate::function::AggregateFunction;
use crate::aggregate::group::Aggregate;
use crate::page::Page;
use crate::scalar::function::{Function, Operation};
use crate::scalar::measure::Measure;
use crate::scalar::pairs::{Overlay, Relation};
use datafusion_common::Result;
use datafusion_expr::registry::FunctionRegistry;
use datafusion_expr::{AggregateUDF, ScalarUDF};
use std::sync::Arc;

const ONE: &[(&str, &str)] = &[("geom", "A geometry as WKB or GeoArrow.")];
const TWO: &[(&str, &str)] =
    &[("a", "A geometry as WKB or GeoArrow."), ("b", "Another one; it may be encoded otherwise.")];

macro_rules! page {
    ($name:literal, $arguments:ident) => {
        Page::new($name, $arguments, include_str!(concat!("../docs/", $name, ".md")))
    };
}

/// The functions, with what they may take.
///
/// Functions travel by name between the parts of a cluster: client, scheduler and every executor register them.
///
/// ```
/// use datafusion::prelude::SessionContext;
/// use polycsg_datafusion::Functions;
/// let mut context = SessionContext::new();
/// Functions::default().contacts(1_000_000).register(&mut context)?;
/// assert!(context.state().aggregate_functions().contains_key("st_union_agg"));
/// # Ok::<(), datafusion::error::DataFusionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Functions {
    contacts: usize,
    bytes: usize,
}

impl Default for Functions {
    /// At most 2^25 contacts, about 10 GB, and groups of any size.
    fn default() -> Functions {
        Functions { contacts: 1 << 25, bytes: usize::MAX }
    }
}

impl Functions {
    /// How often the edges of one row, or of one group, may meet: n edges can meet n² times, and each time takes about 300 bytes. What
    /// meets more often ends in an [`Error`](crate::Error), before memory runs out.
    #[must_use]
    pub fn contacts(self, most: usize) -> Functions {
        Functions { contacts: most, ..self }
    }

    /// What evaluating one connected part of a group may take, in bytes. A group is evaluated in parts whose boxes do not touch, and a part
    /// that takes more ends in an [`Error`](crate::Error) that names the group.
    ///
    /// Without it a group reports 80 bytes for each byte of its state, as if it were one part, and an engine with less memory refuses it and
    /// names itself. With it a group reports no more than this and 20 bytes for each byte of its state, for sorting it.
    #[must_use]
    pub fn bytes(self, most: usize) -> Functions {
        Functions { bytes: most, ..self }
    }

    /// Registers all functions with a session.
    ///
    /// # Errors
    /// Those of the registry.
    pub fn register(self, registry: &mut dyn FunctionRegistry) -> Result<()> {
        for function in self.scalars() {
            registry.register_udf(Arc::new(function))?;
        }
        for function in self.aggregates() {
            registry.register_udaf(Arc::new(function))?;
        }
        Ok(())
    }

    /// The functions of rows.
    #[must_use]
    pub fn scalars(self) -> Vec<ScalarUDF> {
        let functions = [
            (page!("st_intersection", TWO), Operation::Overlay(Overlay::Intersection)),
            (page!("st_union", TWO), Operation::Overlay(Overlay::Union)),
            (page!("st_difference", TWO), Operation::Overlay(Overlay::Difference)),
            (page!("st_symdifference", TWO), Operation::Overlay(Overlay::SymmetricDifference)),
            (page!("st_makevalid", ONE), Operation::MakeValid),
            (page!("st_isvalid", ONE), Operation::Measure(Measure::IsValid)),
            (page!("st_isvalidreason", ONE), Operation::Measure(Measure::IsValidReason)),
            (page!("st_area", ONE), Operation::Measure(Measure::Area)),
            (page!("st_contains", TWO), Operation::Relate(Relation::Contains)),
            (page!("st_intersects", TWO), Operation::Relate(Relation::Intersects)),
        ];
        let new = |(page, operation)| ScalarUDF::from(Function::new(page, operation, self.contacts));
        functions.into_iter().map(new).collect()
    }

    /// The functions of groups.
    #[must_use]
    pub fn aggregates(self) -> Vec<AggregateUDF> {
        let functions = [
            (page!("st_union_agg", ONE), Aggregate::Union),
            (page!("st_intersection_agg", ONE), Aggregate::Intersection),
        ];
        let new = |(page, aggregate)| {
            let limits = GroupLimits { contacts: self.contacts, bytes: self.bytes };
            AggregateUDF::from(AggregateFunction::new(page, aggregate, limits))
        };
        functions.into_iter().map(new).collect()
    }
}
