"""How large a field may be while a metric keeps a limit."""
