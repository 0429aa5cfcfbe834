//! Things that belong together.

/// Disjoint sets: each member points towards the first of its group.
#[derive(Debug)]
pub(crate) struct UnionFind(Vec<usize>);

impl UnionFind {
    /// Each by itself.
    pub(crate) fn new(count: usize) -> UnionFind {
        UnionFind((0..count).collect())
    }

    /// The first member of a group; the path to it is halved.
    pub(crate) fn first(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    /// Makes one group of two.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// Numbers the groups in the order of their first members: the number of every member's group, and the first
    /// member of every group.
    pub(crate) fn number(mut self) -> (Vec<usize>, Vec<usize>) {
        let mut numbers = vec![usize::MAX; self.0.len()];
        let mut firsts = Vec::new();
        for member in 0..numbers.len() {
            let first = self.first(member);
            if first == member {
                numbers[member] = firsts.len();
                firsts.push(member);
            }
            numbers[member] = numbers[first];
        }
        (numbers, firsts)
    }
}
