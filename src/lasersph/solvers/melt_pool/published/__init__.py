"""The paper's own variant of the pressure equation, for comparison."""
