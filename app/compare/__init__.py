"""Compare: 2 to 20 runs or recordings, their plans, measures and signals."""
