//! The form factors found so far: a run that was stopped resumes from them.
use super::levels::transfer::Transfer;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, sync::Arc};
use thiserror::Error;

/// How many factors are kept: 1.5 GB.
pub(super) const KEPT: usize = 1 << 27;
/// What a file starts with; the digit counts the formats.
const MAGIC: &[u8] = b"radiosity state 2\n";

/// The form factors that a run has computed, which are most of its work, so that another run can resume from them.
///
/// Form factors are pure functions of the scene and the mesh. A run that resumes from a state of the same scene therefore ends
/// with the bits of a run that was never stopped, and may use another tolerance or another method.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct State {
    /// By the fingerprint of the mesh: the columns by piece.
    meshes: BTreeMap<u64, BTreeMap<usize, Arc<Column>>>,
    /// By the fingerprint of the shapes: what two tiles exchange, by their names.
    transfers: BTreeMap<u64, BTreeMap<[u64; 2], Arc<Transfer>>>,
    /// How many factors there are.
    count: usize,
    /// A patch whose factors cannot be found.
    #[cfg(test)]
    #[serde(skip)]
    pub(super) trap: Option<usize>,
}

/// Form factors from elements to one piece; those that are 0 are left out.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Column {
    elements: Vec<u32>,
    factors: Vec<f64>,
}

/// Why bytes are not a state.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum StateError {
    /// They were written by something else, or by another version.
    #[error("not a state of this version of radiosity; start the run anew")]
    Format,
    /// They were cut short or changed.
    #[error("the state is damaged; start the run anew")]
    Damaged,
}

impl Column {
    /// Keeps what is not 0 of one factor for each element.
    pub(super) fn new(factors: &[f64]) -> Column {
        let seen = || (0u32..).zip(factors).filter(|(_, factor)| **factor != 0.0);
        Column {
            elements: seen().map(|(element, _)| element).collect(),
            factors: seen().map(|(_, factor)| *factor).collect(),
        }
    }

    fn is_lawful(&self) -> bool {
        let Column { elements, factors } = self;
        elements.len() == factors.len()
            && elements.windows(2).all(|pair| pair[0] < pair[1])
            && factors.iter().all(|factor| factor.is_finite() && *factor != 0.0)
    }

    /// Elements and the factors from them, by ascending element.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, f64)> {
        self.elements.iter().map(|element| *element as usize).zip(self.factors.iter().copied())
    }

    /// How many factors it has.
    pub(super) fn len(&self) -> usize {
        self.factors.len()
    }

    /// The same for elements from `start` on.
    pub(super) fn from(&self, start: usize) -> impl Iterator<Item = (usize, f64)> {
        let first = self.elements.partition_point(|element| (*element as usize) < start);
        let elements = self.elements[first..].iter().map(|element| *element as usize);
        elements.zip(self.factors[first..].iter().copied())
    }
}

impl State {
    /// The state as bytes, for a file: about 12 bytes for each factor that is not 0.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let body = postcard::to_stdvec(self).expect("maps of plain numbers can be written");
        let sum = super::fingerprint::of(&body);
        [MAGIC, &sum.to_le_bytes(), &body].concat()
    }

    /// The state that [`State::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`StateError`] for other bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<State, StateError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(StateError::Format)?;
        let (sum, body) = rest.split_first_chunk().ok_or(StateError::Damaged)?;
        if super::fingerprint::of(body) != u64::from_le_bytes(*sum) {
            return Err(StateError::Damaged);
        }
        postcard::from_bytes(body).ok().filter(State::is_lawful).ok_or(StateError::Format)
    }

    /// Whether all is as [`Column::new`] and [`State::keep`] make it: a checksum may be right by intention.
    fn is_lawful(&self) -> bool {
        let columns = || self.meshes.values().flat_map(BTreeMap::values);
        let transfers = || self.transfers.values().flat_map(BTreeMap::values);
        let numbers = columns().map(|column| column.factors.len()).sum::<usize>()
            + transfers().count() * Transfer::SIZE;
        columns().all(|column| column.is_lawful())
            && transfers().all(|transfer| transfer.is_lawful())
            && numbers == self.count
            && self.count <= KEPT
    }

    /// Whether nothing is known yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.meshes.is_empty() && self.transfers.is_empty()
    }

    /// Whether something is known of a mesh.
    pub(super) fn knows(&self, mesh: u64) -> bool {
        self.meshes.contains_key(&mesh)
    }

    /// Whether something is known of how tiles of these shapes exchange light.
    pub(super) fn knows_shapes(&self, shapes: u64) -> bool {
        self.transfers.contains_key(&shapes)
    }

    /// What two tiles are known to exchange.
    pub(super) fn transfer(&self, shapes: u64, names: [u64; 2]) -> Option<Arc<Transfer>> {
        self.transfers.get(&shapes)?.get(&names).map(Arc::clone)
    }

    /// Keeps what two tiles exchange while memory lasts.
    pub(super) fn keep_transfer(&mut self, shapes: u64, names: [u64; 2], transfer: &Arc<Transfer>) {
        if self.count + Transfer::SIZE <= KEPT
            && !self.transfers.get(&shapes).is_some_and(|all| all.contains_key(&names))
        {
            self.count += Transfer::SIZE;
            self.transfers.entry(shapes).or_default().insert(names, Arc::clone(transfer));
        }
    }

    /// A column that is known, of a mesh of so many elements.
    pub(super) fn column(&self, mesh: u64, node: usize, elements: usize) -> Option<Arc<Column>> {
        let column = self.meshes.get(&mesh)?.get(&node)?;
        let is_within = column.elements.last().is_none_or(|last| (*last as usize) < elements);
        is_within.then(|| Arc::clone(column))
    }

    /// Knows a mesh of which nothing is kept under its own fingerprint.
    pub(super) fn note(&mut self, mesh: u64) {
        self.meshes.entry(mesh).or_default();
    }

    /// Keeps a column while memory lasts.
    pub(super) fn keep(&mut self, mesh: u64, node: usize, column: &Arc<Column>) {
        if self.count + column.factors.len() <= KEPT {
            self.count += column.factors.len();
            self.meshes.entry(mesh).or_default().insert(node, Arc::clone(column));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state() -> State {
        let mut state = State::default();
        let column = Arc::new(Column::new(&[0.0, 0.1 + 0.2, 0.0, f64::MIN_POSITIVE]));
        state.keep(7, 3, &column);
        state.keep(7, 9, &Arc::new(Column::default()));
        state
    }

    #[test]
    fn a_state_comes_back_bit_for_bit() {
        let again = State::from_bytes(&state().to_bytes()).unwrap();
        let column = again.column(7, 3, 4).unwrap();
        assert_eq!(column.iter().collect::<Vec<_>>(), [(1, 0.1 + 0.2), (3, f64::MIN_POSITIVE)]);
        assert_eq!(column.from(2).collect::<Vec<_>>(), [(3, f64::MIN_POSITIVE)]);
        assert!(again.knows(7) && !again.knows(8) && again.column(7, 4, 4).is_none());
        assert_eq!(again.to_bytes(), state().to_bytes());
    }

    #[test]
    fn any_cut_and_any_changed_byte_is_found() {
        let bytes = state().to_bytes();
        for end in 0..bytes.len() {
            assert!(State::from_bytes(&bytes[..end]).is_err(), "cut at {end}");
        }
        for place in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[place] ^= 0x10;
            assert!(State::from_bytes(&bytes).is_err(), "byte {place}");
        }
    }
    /// A right checksum over what no run writes: refused, or not of this mesh.
    #[test]
    fn forged_states_are_refused() {
        let forged = |elements: Vec<u32>, factors: Vec<f64>, count: usize| {
            let columns = BTreeMap::from([(3, Arc::new(Column { elements, factors }))]);
            State::from_bytes(
                &State { meshes: BTreeMap::from([(7, columns)]), count, ..State::default() }.to_bytes(),
            )
        };
        assert!(forged(vec![0, 5], vec![0.5, 0.25], 2).is_ok_and(|state| state.column(7, 3, 5).is_none()));
        for (elements, factors, count) in [
            (vec![0, 5], vec![0.5], 1),
            (vec![5, 0], vec![0.5, 0.25], 2),
            (vec![0], vec![f64::NAN], 1),
            (vec![0], vec![0.5], usize::MAX),
        ] {
            assert_eq!(forged(elements, factors, count).err(), Some(StateError::Format));
        }
    }
}
