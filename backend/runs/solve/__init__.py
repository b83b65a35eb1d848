"""Search for the largest value of a field while a metric keeps a limit."""
