"""What a worker does before its first task. It imports the core itself, so it can be spawned before the service is."""


def warm_up() -> None:
    """Run the paper's scenario with every strategy once: the first request finds filled caches."""
    from backend.runs.compute_run import compute
    from sim_core.scenario import Scenario
    from sim_core.strategies import STRATEGIES

    for strategy in STRATEGIES:
        compute(Scenario(), strategy, "")
