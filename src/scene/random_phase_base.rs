//! What scenes on a base of random phase share: the outputs that tell how often a drawn velocity was rejected (P 2.3.3).

/// Names and descriptions of the outputs that count draws, all and rejected.
pub const DRAW_COUNTS: [(&str, &str); 2] = [
    (
        "base.draws",
        "Velocities of the base drawn at random phases so far, those rejected among them",
    ),
    (
        "base.rejected_draws",
        "Draws among them that were rejected and drawn again, since the disk would still have moved into the wall: rare where the \
         approximation holds",
    ),
];
