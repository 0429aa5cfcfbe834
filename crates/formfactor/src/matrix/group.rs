//! Groups of polygons as one: the two sides of a plate, the pieces of a wall.
use super::sparse::{Factor, FactorMatrix};
use std::collections::BTreeMap;

impl FactorMatrix {
    /// The matrix of groups of polygons: `group[i]` is the group of polygon i, counted from 0 without a gap. A group's area is
    /// the sum of its polygons' areas, what leaves it the sum of what leaves them.
    ///
    /// The two sides of a thin plate are one surface when they are one group; a wall and the windows in it stay several when they
    /// are several. What a group exchanges within itself stands in the diagonal. Space, where the matrix has it, stays.
    ///
    /// # Panics
    /// Unless there is a group for each row.
    #[must_use]
    pub fn grouped(&self, group: &[usize]) -> FactorMatrix {
        assert_eq!(group.len(), self.len(), "a group for each row");
        let count = group.iter().max().map_or(0, |last| last + 1);
        let mut members = vec![Vec::new(); count];
        group.iter().enumerate().for_each(|(polygon, group)| members[*group].push(polygon));
        let area = |members: &Vec<usize>| members.iter().map(|member| self.areas[*member]).sum();
        let areas: Vec<f64> = members.iter().map(area).collect();
        self.by_rows(areas.clone(), |from| {
            let mut sums: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
            for &member in &members[from] {
                let share = self.areas[member] / areas[from];
                for Factor { to, value, error } in self.row(member) {
                    let sum = sums.entry(group.get(to).copied().unwrap_or(count)).or_default();
                    *sum = [sum[0] + share * value, sum[1] + share * error];
                }
            }
            sums.into_iter().map(|(to, [value, error])| Factor { to, value, error }).collect()
        })
    }
}
