//! Contact forces of all candidates: the inner loop.

use fearless_simd::Simd;

use crate::contact::{ContactLaws, NormalForce};
use crate::engine::dem::lanes::{LaneWork, Lanes, MOST_LANES, in_lanes};

use super::contact_kinds::{AtWalls, BetweenDisks, DiskArrays, ForceArrays, Geometry, Kind, MovingWalls};
use super::contact_laws::{Approach, ContactForces, LaneLaws, Sliding, Surfaces};
use super::eights::{BLOCK, Eight, Eights};
use super::force_sums::{ForceSums, LaneSums, PartialSums};

/// Adds the forces of all contacts; gives their sums.
pub struct AddForces<'a, N, const SPRING: bool> {
    /// Contact laws.
    pub laws: &'a ContactLaws<N>,
    /// Length of the step at whose end the forces are evaluated \[s\].
    pub step: f64,
    /// Disks.
    pub disks: DiskArrays<'a>,
    /// Walls.
    pub walls: MovingWalls<'a>,
    /// Candidates among disks.
    pub pairs: Eights<'a>,
    /// Candidates at walls.
    pub wall_contacts: Eights<'a>,
    /// Contacts with springs that were closed before.
    pub closed: u32,
    /// Sums over pairs that are not among these.
    pub before: PartialSums,
    /// Where the forces are added.
    pub forces: ForceArrays<'a>,
    /// Scratch memory.
    pub workspace: &'a mut Workspace,
}

/// The same. Compiled once, whatever else the engine is composed of.
#[inline(never)]
pub fn add<N: NormalForce, const SPRING: bool>(forces: AddForces<'_, N, SPRING>) -> ForceSums {
    in_lanes(forces)
}

impl<N: NormalForce, const SPRING: bool> LaneWork for AddForces<'_, N, SPRING> {
    type Output = ForceSums;

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> ForceSums {
        let Self {
            disks,
            walls,
            mut forces,
            workspace,
            mut pairs,
            mut wall_contacts,
            mut before,
            ..
        } = self;
        let laws = LaneLaws::<S, V, N>::new(simd, self.laws, self.step);
        // Once more, since the compiler does not see from farther away that the lengths are one.
        let disks = disks.again();
        forces.on_disks = &mut forces.on_disks[..disks.count()];
        let Workspace { geometries, found } = workspace;
        for n in 0..pairs.groups() {
            let (kind, mut group) = (BetweenDisks { disks }, pairs.group(n));
            let mut sums = LaneSums::new(simd);
            for n in 0..group.blocks() {
                let mut block = group.block(n);
                compute_geometry::<S, V, _, SPRING>(simd, kind, &block, geometries);
                compute_forces::<S, V, N, _, SPRING>(&laws, kind, &mut block, geometries, found, &mut sums);
                add_forces::<S, BetweenDisks<'_>, SPRING>(simd, &block, found, &mut forces);
            }
            before.add(&sums.partial());
        }
        let mut sums = LaneSums::after(simd, before);
        for n in 0..wall_contacts.blocks() {
            let (kind, mut block) = (AtWalls { disks, walls }, wall_contacts.block(n));
            compute_geometry::<S, V, _, SPRING>(simd, kind, &block, geometries);
            compute_forces::<S, V, N, _, SPRING>(&laws, kind, &mut block, geometries, found, &mut sums);
            add_forces::<S, AtWalls<'_>, SPRING>(simd, &block, found, &mut forces);
        }
        sums.partial().total::<SPRING>(self.closed)
    }
}

/// Scratch memory: what one part of the loop over contacts hands to the next.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    geometries: [Geometry; BLOCK],
    found: [Found; BLOCK],
}

/// Forces on the first bodies of eight contacts \[N\], and their parts along the surfaces.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub struct Found {
    /// x and y.
    pub forces: [[f64; 2]; MOST_LANES],
    /// Along the surfaces, where there are tangential springs.
    pub tangential: [f64; MOST_LANES],
}

/// The surfaces of eight contacts.
struct SurfacesOf<'a, K> {
    kind: K,
    bodies: &'a [[u32; 2]; MOST_LANES],
}

impl<K: Kind> Sliding for SurfacesOf<'_, K> {
    fn velocity(&self, k: usize, normal: [f64; 2], lever: f64) -> f64 {
        self.kind.sliding(self.bodies[k], normal, lever)
    }
}

/// The first part for a block of contacts: how they lie and move.
///
/// The three parts are loops of their own, so that the roots and quotients of several registers proceed at once, and so do
/// the laws, where those of one would be waited for.
#[inline(always)]
pub fn compute_geometry<S: Simd, V: Lanes<S>, K: Kind, const SPRING: bool>(
    simd: S,
    kind: K,
    block: &Eights<'_>,
    geometries: &mut [Geometry; BLOCK],
) {
    for (n, (eight, geometry)) in block.eights.iter().zip(geometries).enumerate() {
        for at in (0..block.in_eight(n)).step_by(V::LEN) {
            kind.geometry::<S, V, SPRING>(simd, eight, at, geometry);
        }
    }
}

/// The second part: their forces.
#[inline(always)]
pub fn compute_forces<S: Simd, V: Lanes<S>, N: NormalForce, K: Kind, const SPRING: bool>(
    laws: &LaneLaws<S, V, N>,
    kind: K,
    block: &mut Eights<'_>,
    geometries: &[Geometry; BLOCK],
    found: &mut [Found],
    sums: &mut LaneSums<V>,
) {
    for (n, (geometry, found)) in geometries.iter().zip(found).enumerate().take(block.eights.len()) {
        for at in (0..block.in_eight(n)).step_by(V::LEN) {
            let here = (&mut block.eights[n], at);
            forces_of_register::<S, V, N, K, SPRING>(laws, kind, here, geometry, sums, found);
        }
    }
}

/// The third part: adds them up, contact by contact.
#[inline(always)]
fn add_forces<S: Simd, K: Kind, const SPRING: bool>(
    simd: S,
    block: &Eights<'_>,
    found: &[Found; BLOCK],
    forces: &mut ForceArrays<'_>,
) {
    for (n, (eight, found)) in block.eights.iter().zip(found).enumerate() {
        let found = found.forces.iter().zip(&found.tangential);
        for (bodies, (force, tangential)) in eight.bodies.iter().zip(found).take(block.in_eight(n)) {
            K::add::<S, SPRING>(simd, *bodies, *force, *tangential, forces);
        }
    }
}

/// Computes the forces of as many contacts as a register holds.
#[inline(always)]
fn forces_of_register<S: Simd, V: Lanes<S>, N: NormalForce, K: Kind, const SPRING: bool>(
    laws: &LaneLaws<S, V, N>,
    kind: K,
    (eight, at): (&mut Eight, usize),
    geometry: &Geometry,
    sums: &mut LaneSums<V>,
    found: &mut Found,
) {
    let (simd, here) = (laws.simd(), at..at + V::LEN);
    let nx = V::from_slice(simd, &geometry.normal_x[here.clone()]);
    let ny = V::from_slice(simd, &geometry.normal_y[here.clone()]);
    let lever = V::from_slice(simd, &geometry.lever[here.clone()]);
    let approach = Approach {
        normal: [nx, ny],
        overlap: V::from_slice(simd, &geometry.overlap[here.clone()]),
        velocity: V::from_slice(simd, &geometry.velocity[here.clone()]),
    };
    let surfaces = Surfaces {
        tangential_displacement: V::from_slice(simd, &geometry.tangential_displacement[here.clone()]),
        radius_sum: K::radius_sum(simd, eight, at),
        lever,
    };
    let Eight { bodies, springs, .. } = eight;
    let sliding = SurfacesOf { kind, bodies };
    let ContactForces { normal, tangential } = laws.forces::<SPRING>(approach, surfaces, (springs, at), sums, sliding);

    let (mut fx, mut fy) = (normal * nx, normal * ny);
    if SPRING {
        let sideways = tangential * lever;
        fx += sideways * ny;
        fy -= sideways * nx;
        tangential.store_slice(&mut found.tangential[here.clone()]);
    }
    V::vectors([fx, fy], &mut found.forces[here]);
}
