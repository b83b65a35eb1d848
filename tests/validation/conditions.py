"""What `conditional_reads` says of one scenario."""

from collections.abc import Sequence

from sim_core.scenario import Scenario, dotted
from sim_core.scenario.dotted import is_within
from sim_core.strategies.effects import HAS_BUMP, ConditionalReads, FieldCondition


def may_affect(groups: Sequence[ConditionalReads], name: str, scenario: Scenario) -> bool:
    """Check whether the conditions are met under which a field is read."""
    covering = [group for group in groups if any(is_within(name, part) for part in group.fields)]
    return any(all(_is_met(each, scenario) for each in group.conditions) for group in covering)


def _is_met(condition: FieldCondition, scenario: Scenario) -> bool:
    if condition.field == HAS_BUMP:
        return scenario.road.has_bump in condition.values
    value = dotted.value(scenario.model_dump(mode="json"), condition.field)
    return (value in condition.values) is not condition.excluded
