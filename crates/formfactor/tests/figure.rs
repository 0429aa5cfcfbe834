//! The figure of the docs is the one that the example draws today.

#[path = "../examples/factor_stages.rs"]
mod stages;

#[test]
fn the_committed_figure_is_fresh() {
    let drawn = stages::svg().expect("a scene that can be drawn");
    assert!(
        drawn == include_str!("../docs/stages.svg"),
        "draw docs/stages.svg anew: see examples/factor_stages.rs"
    );
}
