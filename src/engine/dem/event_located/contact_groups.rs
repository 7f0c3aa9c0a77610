//! All contacts of one kind in one step: those with a force in lanes, sticking and slipping ones apart, and the others one by
//! one.
//!
//! Which contact is where follows from the phases at the start of the step and the order of the list alone, so that the same
//! state gives the same bits.

use crate::engine::dem::candidates::make_room;

use super::disk_records::DiskRecord;
use super::impulse::OwnImpulse;
use super::lane_contacts::{ContactLanes, LaneSums, in_lanes};
use super::lane_geometry::{LaneGeometry, Receivers};
use super::single_contact::SingleContact;
use super::state::{Contact, LocatedPhase};
use super::step_context::StepContext;

/// Sums over the contacts in the last pass.
#[derive(Debug, Clone, Copy, Default)]
pub struct StepSums {
    /// Of the contacts in lanes.
    pub lanes: LaneSums,
    /// Energy lost by the others \[J\].
    pub lost: f64,
    /// Work of the walls on the others \[J\].
    pub work: f64,
    /// Deepest overlap among the others \[m\].
    pub deepest: f64,
    /// Overlapping ones among them.
    pub contacts: u32,
    /// Contacts whose phase changed.
    pub changes: u32,
}

/// A contact without a force at the start of the step, and what it gave in the last pass.
#[derive(Debug, Clone, Copy)]
struct Other {
    place: u32,
    is_open: bool,
    own: OwnImpulse,
}

/// A lane whose contact changes its phase.
#[derive(Debug, Clone, Copy)]
struct Changing {
    slips: bool,
    lanes: u32,
    lane: u32,
}

/// Scratch memory: nothing outlives the step.
#[derive(Debug, Clone)]
pub struct ContactGroups<G> {
    sticking: Vec<ContactLanes<G>>,
    slipping: Vec<ContactLanes<G>>,
    others: Vec<Other>,
    changing: Vec<Changing>,
    /// Places of the contacts in lanes, sticking and slipping.
    places: [Vec<u32>; 2],
}

impl<G> Default for ContactGroups<G> {
    fn default() -> Self {
        Self {
            sticking: Vec::new(),
            slipping: Vec::new(),
            others: Vec::new(),
            changing: Vec::new(),
            places: [Vec::new(), Vec::new()],
        }
    }
}

/// What a pass reads.
#[derive(Clone, Copy)]
pub struct Pass<'step> {
    /// What does not change in the step.
    pub context: &'step StepContext<'step>,
    /// Disks at the end of the step, as known so far.
    pub disks: &'step [DiskRecord],
}

impl<G: LaneGeometry + SingleContact> ContactGroups<G> {
    /// For so many disks.
    pub fn new(disks: usize) -> Self {
        let mut groups = Self::default();
        make_room(&mut groups.sticking, disks);
        make_room(&mut groups.slipping, disks);
        make_room(&mut groups.others, disks);
        make_room(&mut groups.changing, disks);
        for places in &mut groups.places {
            make_room(places, disks);
        }
        groups
    }

    /// Sorts the contacts into groups, and adds the impulses of forces that continue from the start along their tangents.
    #[inline(never)]
    pub fn predict(&mut self, contacts: &[Contact], context: &StepContext<'_>, to: &mut Receivers<'_>) {
        self.others.clear();
        let [sticking, slipping] = &mut self.places;
        sticking.clear();
        slipping.clear();
        for (place, contact) in (0..).zip(contacts) {
            match in_lanes(contact.phase) {
                Some(false) => sticking.push(place),
                Some(true) => slipping.push(place),
                None => self.others.push(Other {
                    place,
                    is_open: contact.phase == LocatedPhase::Open,
                    own: OwnImpulse::default(),
                }),
            }
        }
        predict::<G, false>(&mut self.sticking, sticking, contacts, context, to);
        predict::<G, true>(&mut self.slipping, slipping, contacts, context, to);
    }

    /// Integrates all contacts along the motion found so far.
    pub fn pass(&mut self, contacts: &[Contact], pass: Pass<'_>, to: &mut Receivers<'_>) {
        self.changing.clear();
        pass_lanes::<G, false>(&mut self.sticking, pass, to, &mut self.changing);
        pass_lanes::<G, true>(&mut self.slipping, pass, to, &mut self.changing);
        self.pass_changing(contacts, pass, to);
        self.pass_others(contacts, pass, to);
    }

    fn pass_changing(&mut self, contacts: &[Contact], Pass { context, disks }: Pass<'_>, to: &mut Receivers<'_>) {
        for changing in &self.changing {
            let group = if changing.slips {
                &mut self.slipping
            } else {
                &mut self.sticking
            };
            let (lanes, k) = (&mut group[changing.lanes as usize], changing.lane as usize);
            let contact = &contacts[lanes.places[k] as usize];
            let integrated = G::integrate(context, disks, contact, lanes.own(k));
            G::add_single(contact, &integrated.given, to);
            lanes.set_own(k, integrated.given.own);
        }
    }

    #[inline(never)]
    fn pass_others(&mut self, contacts: &[Contact], Pass { context, disks }: Pass<'_>, to: &mut Receivers<'_>) {
        for other in &mut self.others {
            let contact = &contacts[other.place as usize];
            if other.is_open && !G::may_touch(context, disks, contact.bodies()) {
                continue;
            }
            let integrated = G::integrate(context, disks, contact, other.own);
            G::add_single(contact, &integrated.given, to);
            other.own = integrated.given.own;
        }
    }

    /// The same, with energies; the contacts are then those at the end of the step.
    pub fn last_pass(&mut self, contacts: &mut [Contact], pass: Pass<'_>, to: &mut Receivers<'_>, sums: &mut StepSums) {
        self.changing.clear();
        last_pass_of_lanes::<G, false>(&self.sticking, contacts, pass, to, &mut sums.lanes, &mut self.changing);
        last_pass_of_lanes::<G, true>(&self.slipping, contacts, pass, to, &mut sums.lanes, &mut self.changing);
        for changing in &self.changing {
            let group = if changing.slips { &self.slipping } else { &self.sticking };
            let (lanes, k) = (&group[changing.lanes as usize], changing.lane as usize);
            finish::<G>(&mut contacts[lanes.places[k] as usize], lanes.own(k), pass, to, sums);
        }
        self.last_pass_of_others(contacts, pass, to, sums);
    }

    #[inline(never)]
    fn last_pass_of_others(
        &self,
        contacts: &mut [Contact],
        pass: Pass<'_>,
        to: &mut Receivers<'_>,
        sums: &mut StepSums,
    ) {
        for other in &self.others {
            let contact = &mut contacts[other.place as usize];
            if !other.is_open || G::may_touch(pass.context, pass.disks, contact.bodies()) {
                finish::<G>(contact, other.own, pass, to, sums);
            }
        }
    }
}

#[inline(never)]
fn pass_lanes<G: LaneGeometry, const SLIPS: bool>(
    group: &mut [ContactLanes<G>],
    Pass { context, disks }: Pass<'_>,
    to: &mut Receivers<'_>,
    changing: &mut Vec<Changing>,
) {
    for (index, lanes) in (0..).zip(group) {
        let changes = lanes.pass::<SLIPS>(context, disks, to);
        note(changing, changes, index, SLIPS);
    }
}

#[inline(never)]
fn last_pass_of_lanes<G: LaneGeometry, const SLIPS: bool>(
    group: &[ContactLanes<G>],
    contacts: &mut [Contact],
    Pass { context, disks }: Pass<'_>,
    to: &mut Receivers<'_>,
    sums: &mut LaneSums,
    changing: &mut Vec<Changing>,
) {
    for (index, lanes) in (0..).zip(group) {
        let changes = lanes.last_pass::<SLIPS>(context, disks, to, contacts, sums);
        note(changing, changes, index, SLIPS);
    }
}

#[inline(never)]
fn predict<G: LaneGeometry, const SLIPS: bool>(
    group: &mut Vec<ContactLanes<G>>,
    places: &[u32],
    contacts: &[Contact],
    context: &StepContext<'_>,
    to: &mut Receivers<'_>,
) {
    group.clear();
    let (twos, rest) = places.as_chunks();
    group.extend(twos.iter().map(|two| ContactLanes::new(contacts, *two, false, context)));
    if let [last] = rest {
        group.push(ContactLanes::new(contacts, [*last; 2], true, context));
    }
    for lanes in group {
        lanes.predict::<SLIPS>(contacts, context, to);
    }
}

#[inline(always)]
fn note(changing: &mut Vec<Changing>, changes: u32, lanes: u32, slips: bool) {
    if changes != 0 {
        let lane = (0..2).filter(|lane| changes & (1 << lane) != 0);
        changing.extend(lane.map(|lane| Changing { slips, lanes, lane }));
    }
}

/// The last pass of one contact.
fn finish<G: SingleContact>(
    contact: &mut Contact,
    own: OwnImpulse,
    pass: Pass<'_>,
    to: &mut Receivers<'_>,
    sums: &mut StepSums,
) {
    let integrated = G::integrate(pass.context, pass.disks, contact, own);
    G::add_single(contact, &integrated.given, to);
    *contact = integrated.after;
    sums.lost += integrated.given.lost;
    sums.work += integrated.given.work;
    sums.changes += u32::from(integrated.changed);
    let overlap = contact.kinematics.overlap;
    if overlap > 0.0 {
        sums.contacts += 1;
        sums.deepest = if overlap > sums.deepest { overlap } else { sums.deepest };
    }
}
