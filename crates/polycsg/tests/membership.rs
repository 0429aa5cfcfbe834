//! Table 3.1 of Barreto (2008), completed: every pair of memberships under every operation.
use polycsg::Membership::{self, In, OnMinus, OnPlus, Out};

const ALL: [Membership; 4] = [In, Out, OnPlus, OnMinus];

/// Rows: membership in A; columns: in B, both in the order of [`ALL`].
type Table = [[Membership; 4]; 4];

const UNION: Table =
    [[In, In, In, In], [In, Out, OnPlus, OnMinus], [In, OnPlus, OnPlus, In], [In, OnMinus, In, OnMinus]];
const INTERSECTION: Table =
    [[In, Out, OnPlus, OnMinus], [Out; 4], [OnPlus, Out, OnPlus, Out], [OnMinus, Out, Out, OnMinus]];
const DIFFERENCE: Table =
    [[Out, In, OnMinus, OnPlus], [Out; 4], [Out, OnPlus, Out, OnPlus], [Out, OnMinus, OnMinus, Out]];
const SYMMETRIC_DIFFERENCE: Table = [
    [Out, In, OnMinus, OnPlus],
    [In, Out, OnPlus, OnMinus],
    [OnMinus, OnPlus, Out, In],
    [OnPlus, OnMinus, In, Out],
];

#[test]
fn all_pairs_are_as_the_table_says() {
    type Operation = fn(Membership, Membership) -> Membership;
    let operations: [(Operation, Table); 4] = [
        (Membership::union, UNION),
        (Membership::intersection, INTERSECTION),
        (Membership::difference, DIFFERENCE),
        (Membership::symmetric_difference, SYMMETRIC_DIFFERENCE),
    ];
    for (operation, table) in operations {
        assert_eq!(ALL.map(|a| ALL.map(|b| operation(a, b))), table);
    }
}

#[test]
fn complement_and_reversal_undo_themselves() {
    assert_eq!(ALL.map(Membership::complement), [Out, In, OnMinus, OnPlus]);
    assert_eq!(ALL.map(Membership::reversed), [In, Out, OnMinus, OnPlus]);
    for a in ALL {
        assert_eq!((!!a, a.reversed().reversed(), !a), (a, a, a.complement()));
        assert_eq!(Membership::from_sides(a.left(), a.right()), a);
        for b in ALL {
            assert_eq!(!a.union(b), (!a).intersection(!b), "De Morgan");
            assert_eq!(a.union(b).reversed(), a.reversed().union(b.reversed()));
        }
    }
}
