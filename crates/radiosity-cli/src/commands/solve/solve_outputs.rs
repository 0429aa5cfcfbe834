//! Every output of a solution.
use super::options::Solve;
use crate::failure::Failure;
use crate::input::RepairedInput;
use crate::json;
use crate::outputs::{Contents, Output};
use radiosity::{Record, Recording, Solution};

/// What results are written with.
#[derive(Debug)]
pub(super) struct SolveOutputs<'s> {
    pub(super) arguments: &'s Solve,
    pub(super) outputs: &'s [Output],
    pub(super) input: &'s RepairedInput,
}

impl SolveOutputs<'_> {
    /// Writes every output, with the steps of the run where they are known; gives the figures, and how many elements are shown.
    pub(super) fn write(
        &self,
        solution: &Solution,
        recording: Option<Recording>,
    ) -> Result<(String, usize), Failure> {
        let &SolveOutputs { arguments, outputs, input: RepairedInput { scene, source, repairs } } = self;
        let name = arguments.scene.display().to_string();
        let record = &Record { recording, ..Record::new(&name, scene, solution) };
        let figures = json::Figures::new(record, scene, repairs, solution);
        if !outputs.is_empty() {
            let view = &arguments.view;
            let contents = Contents { view, record, source: Some((source, scene)), figures: Some(&figures) };
            // A picture of a stopped run shows what is unshot as if it had spread evenly.
            let is_shown = !solution.converged && outputs.iter().any(Output::is_picture);
            let shown = is_shown.then(|| Record::new(&name, scene, &solution.with_ambient()));
            let picture = Contents { record: shown.as_ref().unwrap_or(record), ..contents };
            let write =
                |output: &Output| output.write(if output.is_picture() { &picture } else { &contents });
            outputs.iter().try_for_each(write)?;
        }
        Ok((json::line(&figures), record.elements.len()))
    }
}
