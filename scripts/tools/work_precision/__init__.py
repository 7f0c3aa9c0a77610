"""Error against CPU time: points measured, diagrams and the page drawn from them."""
