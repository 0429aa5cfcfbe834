//! Solving by levels: light goes between tiles of any size, large ones where that is right enough.
//!
//! ```text
//! rounds        rounds: link, solve, refine where the budget of a patch is exceeded
//! refinement    links in parts where their errors are too large
//! run           what the steps of a run share: its links, its light, who watches it
//! in_view       which patches a camera sees
//! importance    how much more wrong the others may be
//! allowance     how large the errors of the links of every patch may be
//! asked         which patches are to be right
//! stand         where a run stands, and how its light is shown
//! output        the light of the leaves on a mesh
//! parting       the mesh of plates, cut along the borders of their patches
//! pieces        leaves in pieces that are small enough to be shown
//! cutting       whether the light of these is linear enough, and their halves
//! evenness      how far from linear light is
//! corners       what corners and middles of pieces receive
//! borders       the borders of shadows, along which pieces are cut
//! vertices      what points receive, from every linked tile
//! links         all links of a run, by all threads, and what the state knows of them
//! closed_rooms  which tiles see nothing but the room that they are in
//! totals        what whole tiles exchange, which the links of their parts add up to
//! estimate      what every patch may be off by, and which links that comes of
//! reflections   how errors are reflected
//! errors        what every tile is wrong by before that
//! tally         how many links of each kind there are
//! direct        what lights without surfaces bring to the leaves
//! cluster_budget the errors of links of clusters, and which of these are too large
//! budget        the same of tiles
//! curvatures    how far what tiles receive is from linear
//! gradients     the light of all leaves at once, by conjugate gradients
//! equilibrium   what all leaves exchange, made to close
//! firm          which links that leaves as they are
//! roots         what ΣF of every leaf is to be
//! flow          light up the tree, across the links, and down
//! hidden        what may be wrong between clusters of what points do not see
//! cluster_links light between tiles that are far from each other
//! seen          what each of these tiles is seen of
//! cluster_views what clusters see of each other
//! clusters      the tree of whole tiles, and of their parts where these are linked with clusters
//! cluster       one of these
//! link          pairs of tiles
//! measure       what two tiles exchange, by exact form factors of points
//! nearby        the mean over tiles that touch
//! parabola      how light climbs and bends along an axis of a tile
//! look          what points see of tiles
//! transfer      the numbers of that
//! screen        what hides all of one from the other
//! shadow        what one polygon hides from a point
//! shaft         what can stand between two tiles
//! tiling        the tree
//! base          the lines along which it is cut
//! ways          six ways that tiles face
//! line_tree     lines on a patch, in a tree
//! boxes         a tree of the boxes around polygons
//! tile          a convex polygon, its linear functions and its points
//! members       the patches that plates are made of, on the tiles of these
//! plates        patches that are alike and continue each other, as one
//! ```
//!
//! Light is linear on every tile, and not continuous. A link is a matrix of 3 × 3 numbers that serves both directions, found by exact form
//! factors from five points of each end to all of the other (Hanrahan, Salzman and Aupperle 1991, for constant light and sampled
//! visibility).
mod allowance;
mod asked;
mod base;
mod borders;
mod boxes;
mod budget;
mod closed_rooms;
mod cluster;
mod cluster_budget;
mod cluster_links;
mod cluster_views;
mod clusters;
mod corners;
mod curvatures;
mod cutting;
mod direct;
mod equilibrium;
mod errors;
mod estimate;
mod evenness;
mod firm;
mod flow;
mod gradients;
mod hidden;
mod importance;
mod in_view;
mod line_tree;
mod link;
mod links;
mod look;
mod measure;
mod members;
mod nearby;
mod output;
mod parabola;
mod parting;
mod pieces;
pub(super) mod plates;
mod refinement;
mod reflections;
mod roots;
pub(super) mod rounds;
mod run;
mod screen;
mod seen;
mod shadow;
mod shaft;
mod stand;
mod tally;
mod tile;
mod tiling;
mod totals;
pub(super) mod transfer;
mod vertices;
mod ways;
