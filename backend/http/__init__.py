"""What every request passes: limits, security headers, problem answers, the log. Nothing of any one service."""
