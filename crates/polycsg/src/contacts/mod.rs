//! Stage 3: where edges meet, exactly, sorted along each edge.
//!
//! Four orientation signs tell how two edges meet; everything else follows from them and from comparisons.
//! Each point where something meets is a node. A crossing is a node of its own, known as the pair of edges; an
//! explicit vertex becomes a node when anything touches it. A node has a contact on each edge that it lies inside of,
//! an explicit one also on the edge that starts there. Two crossings at one point always share an edge pairwise, so
//! that equality along each edge is all that is needed to unify them.

mod along;
pub(crate) mod budget;
pub(crate) mod candidates;
pub(crate) mod close_pairs;
mod close_places;
pub(crate) mod contact;
mod find;
mod meeting;
mod pair;

use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, threads::Threads, union_find::UnionFind};
use crate::edges::Edges;
use crate::spatial::slabs::SlabDecomposition;
use along::sort_along;
use budget::WorkBudget;
use candidates::{BroadPhase, Candidates};
use close_pairs::{CloseGroups, ClosePairs};
use contact::Contact;

/// No edge, no node.
const NONE: u32 = u32::MAX;

/// So many contacts are quickly sorted at once.
const FEW: usize = 24;

/// More contacts than that, and buckets of so many bits of edges, are for the caches' sake.
const MANY: usize = if cfg!(any(test, fuzzing)) { 64 } else { 1 << 18 };
const PART: u32 = 8;

/// What a caller asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request<'a> {
    /// The limits of the call.
    pub(crate) meter: &'a Meter<'a>,
    /// Whether rings are built: then close pairs of edges are noted, and what leads on is joined before. Else edges keep
    /// their order.
    pub(crate) rings: bool,
    /// What comparing boxes may cost.
    pub(crate) budget: WorkBudget,
}

/// All contacts, sorted by edge and along it, and the nodes.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    /// In the end sorted by edge and along it.
    found: Vec<Contact>,
    unsorted: Vec<Contact>,
    /// Where each bucket of them starts, and its first place that is free.
    starts: Vec<u32>,
    free: Vec<u32>,
    /// Per node the two edges that cross there, or a vertex and `NONE`.
    nodes: Vec<[u32; 2]>,
    classes: UnionFind,
    /// Per vertex its node; empty as long as no vertex has one.
    node_of_vertex: Vec<u32>,
    rings: UnionFind,
    close_groups: CloseGroups,
    /// Whether any two nodes lie in one point, or any node is a vertex.
    degenerate: bool,
}

impl Contacts {
    /// Finds the contacts of all pairs of edges: of the candidates by boxes, or, where these turn out to be far more than
    /// what meets, of those that [`SlabDecomposition`] finds.
    ///
    /// # Errors
    /// Those of the limits of the request.
    pub(crate) fn find(
        &mut self,
        candidates: Candidates<'_>,
        slabs: &mut SlabDecomposition,
        close_pairs: &mut ClosePairs,
        request: Request<'_>,
    ) -> Result<(), Refusal> {
        let Candidates { edges, chains, phase, .. } = candidates;
        let Request { meter, rings: wanted, .. } = request;
        let most = meter.contacts();
        let size = chains.size();
        self.start(edges);
        let are_single = chains.len() + edges.rings().len() == edges.len();
        close_pairs.start(edges.len(), size, wanted, are_single);
        let is_done = phase != BroadPhase::Slabs && self.find_by_boxes(candidates, close_pairs, meter)?;
        if !is_done && self.found.len() <= most {
            self.start(edges);
            close_pairs.start(edges.len(), size, wanted, false);
            self.find_by_slabs(edges, chains, slabs, close_pairs, meter)?;
        }
        if self.found.len() > most {
            return Err(Refusal::Contacts);
        }
        self.sort(edges, meter)?;
        self.unify(meter)?;
        close_pairs.find_along_all(edges, &self.found, meter)?;
        self.find_at_close_places(edges, close_pairs, meter)?;
        self.prefer_vertices(meter)
    }

    fn start(&mut self, edges: &Edges) {
        self.found.clear();
        self.nodes.clear();
        self.classes.reset(0);
        self.node_of_vertex.clear();
        self.rings.reset(edges.rings().len());
        self.degenerate = false;
        for end in edges.rings().iter().flat_map(|ring| ring.ends()) {
            self.make_node(edges, end);
        }
    }

    /// The contacts by edge and in order along it, each node once on each edge.
    pub(crate) fn sorted(&self) -> &[Contact] {
        &self.found
    }

    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The one node that stands for all at its point.
    #[inline]
    pub(crate) fn node(&self, node: u32) -> u32 {
        self.classes.find(node)
    }

    /// The two edges that cross at a node that stands for all at its point, or a vertex there.
    #[inline]
    pub(crate) fn place(&self, node: u32) -> Place {
        Place::of(self.nodes[node as usize])
    }

    /// What [`place`](Contacts::place) is made of, node by node, for all threads.
    pub(crate) fn nodes(&self) -> &[[u32; 2]] {
        &self.nodes
    }

    /// Whether there are nodes other than crossings of two edges.
    pub(crate) fn degenerate(&self) -> bool {
        self.degenerate
    }

    /// The node at a vertex, if it has one.
    pub(crate) fn node_at(&self, vertex: u32) -> Option<u32> {
        let node = self.node_of_vertex.get(vertex as usize).copied().filter(|&node| node != NONE)?;
        Some(self.node(node))
    }

    /// The connected component of a ring, named by one of its rings.
    pub(crate) fn component(&self, ring: u32) -> u32 {
        self.rings.find(ring)
    }

    /// Sorts the contacts by edge and along it: a counting sort by some leading bits of the edge, then each bucket.
    ///
    /// A few are one bucket; many are moved to the right part of memory first, and the parts are sorted on their own.
    fn sort(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        let Contacts { found, unsorted, starts, free, .. } = self;
        if found.len() <= FEW {
            return sort_along(edges, found, meter);
        }
        let shift = (edges.len() / (found.len() + 1)).max(1).ilog2();
        if found.len() <= MANY {
            starts.clear();
            starts.resize((edges.len() >> shift) + 3, 0);
            unsorted.clone_from(found);
            scatter(unsorted, found, shift, starts);
            meter.spend(found.len())?;
            return buckets(found, starts).try_for_each(|bucket| sort_along(edges, bucket, meter));
        }
        for buffer in [&mut *starts, free] {
            buffer.clear();
            buffer.resize((edges.len() >> (shift + PART)) + 2, 0);
        }
        bucket(found, shift + PART, 0, (starts, free), meter)?;
        Threads::for_edges(edges.len()).try_for_each(buckets(found, starts), |part| {
            let (mut starts, mut free) = ([0; (1 << PART) + 1], [0; (1 << PART) + 1]);
            let first = part[0].edge >> (shift + PART) << PART;
            bucket(part, shift, first, (&mut starts, &mut free), meter)?;
            buckets(part, &starts).try_for_each(|bucket| sort_along(edges, bucket, meter))
        })
    }

    /// Unifies what lies in one place of an edge.
    fn unify(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        if !self.found.iter().any(Contact::is_with_previous) {
            return Ok(());
        }
        self.degenerate = true;
        let mut kept = 0;
        meter.for_each(0..self.found.len(), |i| {
            let contact = self.found[i];
            if contact.is_with_previous() {
                self.classes.join(self.found[kept - 1].node, contact.node);
            } else {
                self.found[kept] = contact;
                kept += 1;
            }
        })?;
        self.found.truncate(kept);
        Ok(())
    }

    /// Lets a vertex, where there is one, tell the place of a node.
    fn prefer_vertices(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        if !self.degenerate {
            return Ok(());
        }
        meter.for_each(0..self.nodes.len(), |node| {
            let representative = self.classes.find(index(node)) as usize;
            if self.nodes[node][1] == NONE && self.nodes[representative][1] != NONE {
                self.nodes[representative] = self.nodes[node];
            }
        })
    }
}

/// Moves contacts to their buckets, by the bits of the edge above some, in place. The buckets' starts are zero before, and one
/// more than there are buckets.
fn bucket(
    contacts: &mut [Contact],
    shift: u32,
    first: u32,
    (starts, free): (&mut [u32], &mut [u32]),
    meter: &Meter<'_>,
) -> Result<(), Refusal> {
    let bucket_of = |contact: &Contact| ((contact.edge >> shift) - first) as usize;
    meter.for_each(&contacts[..], |contact| starts[bucket_of(contact) + 1] += 1)?;
    for bucket in 1..starts.len() {
        starts[bucket] += starts[bucket - 1];
    }
    free.copy_from_slice(starts);
    let mut tally = meter.tally();
    for bucket in 0..starts.len() - 1 {
        while free[bucket] < starts[bucket + 1] {
            tally.add(1)?;
            let at = free[bucket] as usize;
            let other = bucket_of(&contacts[at]);
            contacts.swap(at, free[other] as usize);
            free[other] += 1;
        }
    }
    Ok(())
}

/// Copies contacts to their buckets, which is quicker than to swap them in place. The starts are zero before, and two more than
/// there are buckets; in the end one more.
fn scatter(contacts: &[Contact], to: &mut [Contact], shift: u32, starts: &mut Vec<u32>) {
    let bucket_of = |contact: &Contact| (contact.edge >> shift) as usize;
    for contact in contacts {
        starts[bucket_of(contact) + 2] += 1;
    }
    for bucket in 2..starts.len() {
        starts[bucket] += starts[bucket - 1];
    }
    for contact in contacts {
        let place = &mut starts[bucket_of(contact) + 1];
        to[*place as usize] = *contact;
        *place += 1;
    }
    starts.pop();
}

/// The buckets with more than one contact.
fn buckets<'a>(
    mut contacts: &'a mut [Contact],
    starts: &'a [u32],
) -> impl Iterator<Item = &'a mut [Contact]> {
    let buckets = starts.windows(2).map(move |ends| {
        let (bucket, others) = std::mem::take(&mut contacts).split_at_mut((ends[1] - ends[0]) as usize);
        contacts = others;
        bucket
    });
    buckets.filter(|bucket| bucket.len() > 1)
}

/// Where a node is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    Vertex(u32),
    Crossing(u32, u32),
}

impl Place {
    #[inline]
    pub(crate) fn of(node: [u32; 2]) -> Place {
        match node {
            [vertex, NONE] => Place::Vertex(vertex),
            [e, f] => Place::Crossing(e, f),
        }
    }
}
