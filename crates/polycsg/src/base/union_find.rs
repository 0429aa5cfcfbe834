//! Classes of ids under union; the smallest id stands for its class.

use super::id::index;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A forest of parents, each smaller than its child; `find` shortens the paths that it walks, on any number of threads, as
/// each of them leaves an ancestor for a parent.
#[derive(Debug, Default)]
pub(crate) struct UnionFind {
    parent: Vec<AtomicU32>,
}

impl UnionFind {
    /// `len` classes of one id each.
    pub(crate) fn reset(&mut self, len: usize) {
        self.parent.clear();
        self.parent.extend((0..index(len)).map(AtomicU32::new));
    }

    /// A new class, by its id.
    pub(crate) fn push(&mut self) -> u32 {
        let id = index(self.parent.len());
        self.parent.push(AtomicU32::new(id));
        id
    }

    #[inline]
    pub(crate) fn find(&self, mut id: u32) -> u32 {
        loop {
            let parent = self.parent[id as usize].load(Relaxed);
            let grandparent = self.parent[parent as usize].load(Relaxed);
            if parent == grandparent {
                return parent;
            }
            self.parent[id as usize].store(grandparent, Relaxed);
            id = grandparent;
        }
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        *self.parent[a.max(b) as usize].get_mut() = a.min(b);
    }
}
