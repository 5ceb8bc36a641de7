"""Each hot loop on the user's machine, beside the least time that memory and arithmetic allow."""
