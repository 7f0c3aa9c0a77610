"""What is done to packings: intervals of shaking, the run of one packing, runs of many, and their results folder."""
