"""The paper's own variant of the implicit step, for comparison."""
