"""Jobs: many runs, or many steps of runs, that outlive the request which submitted them."""
