//! Classes of ids under union; the smallest id stands for its class.

use super::id::index;
use std::cell::Cell;

/// A forest of parents, each smaller than its child; `find` shortens the paths that it walks.
#[derive(Debug, Default)]
pub(crate) struct UnionFind {
    parent: Vec<Cell<u32>>,
}

impl UnionFind {
    /// `len` classes of one id each.
    pub(crate) fn reset(&mut self, len: usize) {
        self.parent.clear();
        self.parent.extend((0..index(len)).map(Cell::new));
    }

    /// A new class, by its id.
    pub(crate) fn push(&mut self) -> u32 {
        let id = index(self.parent.len());
        self.parent.push(Cell::new(id));
        id
    }

    #[inline]
    pub(crate) fn find(&self, mut id: u32) -> u32 {
        loop {
            let parent = self.parent[id as usize].get();
            let grandparent = self.parent[parent as usize].get();
            if parent == grandparent {
                return parent;
            }
            self.parent[id as usize].set(grandparent);
            id = grandparent;
        }
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize].set(a.min(b));
    }
}
