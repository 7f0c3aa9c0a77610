"""What P 1 and 2 say of packings and of the methods."""
