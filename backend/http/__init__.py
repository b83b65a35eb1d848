"""What every request meets: limits, security headers, problem answers, its line in the log. Nothing of any service."""
