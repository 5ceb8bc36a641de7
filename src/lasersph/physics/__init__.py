"""Physics: one phenomenon a file, as pure functions that tests call and loops compile."""
