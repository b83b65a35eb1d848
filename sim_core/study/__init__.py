"""Studies of many runs: the paper's tables and how they may be read, intervals, attribution."""
