"""Each hot loop beside the least time that memory and arithmetic allow."""
