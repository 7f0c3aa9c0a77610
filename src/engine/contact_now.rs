//! A contact as an observer sees it, whatever engine it is of.

/// A closed contact at one instant: the disk `first` and what it touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNow {
    /// Index of the disk, counted from 0.
    pub first: u32,
    /// What it touches.
    pub other: Touched,
    /// Middle of the overlap (x, y) \[m\].
    pub point: [f64; 2],
    /// Unit normal, towards the disk.
    pub normal: [f64; 2],
    /// Force along the normal \[N\], not negative.
    pub normal_force: f64,
    /// Force on the disk along the tangent, which is the normal turned clockwise by a right angle \[N\].
    pub tangential_force: f64,
}

/// What a disk touches, by its index, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touched {
    /// Another disk.
    Disk(u32),
    /// A wall or a support.
    Wall(u32),
}
