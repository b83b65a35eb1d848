"""Custom controllers in the service: found, described and driven, each file in a process of its own.

No process of the service or of its workers runs anybody's file. A `ControllerProcess` does: it loads one file,
describes its controllers and drives them. Everywhere else a proxy class with the same fields takes a controller's place
(`description`), so that what is asked of a strategy is asked of it alike. What drives a strategy calls
`registry.run_in_sandbox_process`.
"""
