"""A PI controller that holds the angular velocity of a disk through stick and slip."""
