"""Conditions under which a field affects a result.

`reads` names everything that a result may depend on. Some of it only matters together with other values, such as a
sensor's noise with the filter that uses it: `conditional_reads` says with which.
"""

from dataclasses import dataclass
from functools import cache
from itertools import chain, product
from typing import Any, get_args

from sim_core.control.controller import Controller, option_name
from sim_core.control.declared import ScenarioField
from sim_core.scenario import Speed, dotted
from sim_core.strategies import STRATEGIES, reads, resolve_speed_plan
from sim_core.strategies.reads import PREVIEWS, effective_preview, fields_read_by, is_set_by_field, merge_into_parts

_POLICY = "speed.policy"
_POLICIES = get_args(Speed.model_fields["policy"].annotation)
_PLANS = "constant", "planned"  # policies at which every strategy has the same plan
# What only acts on a car that brakes.
_BRAKING = {"vehicle.cg_height", "vehicle.anti_dive", "vehicle.anti_lift", "vehicle.front_brake_share"}
_EXPECTED = "expected_offset", "expected_noise"
_KNOWS_PREVIEW = "estimation.knows_preview"
_DETECTION = "speed.detection_distance"  # where braking begins, too
HAS_BUMP = "road.has_bump"  # no field: it follows from several, as `Road.has_bump` does
_PLACE = ("start", "width", "count", "spacing")


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldCondition:
    """A condition on one field.

    Attributes:
        field: Its dotted name.
        values: Plain JSON values.
        excluded: Whether it must have none of them instead.
    """

    field: str
    values: tuple[Any, ...]
    excluded: bool = False


Alternatives = tuple[tuple[FieldCondition, ...], ...]  # one of them is enough, with all its conditions

_NEVER: Alternatives = ()
_ALWAYS: Alternatives = ((),)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConditionalReads:
    """Fields that affect a result where all of some conditions are met; a field may be in several of these.

    Attributes:
        fields: Dotted names of fields and of whole parts.
        conditions: Without one, the result always depends on them.
    """

    fields: tuple[str, ...]
    conditions: tuple[FieldCondition, ...]


def conditional_reads(strategy: type[Controller]) -> tuple[ConditionalReads, ...]:
    """Return everything that a strategy's result may depend on, by the conditions under which it does.

    Args:
        strategy: The strategy. What a controller of one's own declares itself has no conditions.

    Raises:
        RidelabError: Its own speed plan is none.
    """
    groups: dict[tuple[FieldCondition, ...], list[str]] = {}
    rules = _rules(strategy)
    for name, driven in _with_policies(strategy).items():
        for conditions in _all(driven, rules.get(name, _ALWAYS)):
            groups.setdefault(conditions, []).append(name)
    return tuple(
        ConditionalReads(fields=merge_into_parts(frozenset(names)), conditions=conditions)
        for conditions, names in sorted(groups.items(), key=lambda group: len(group[0]))
    )


def _with_policies(strategy: type[Controller]) -> dict[str, Alternatives]:
    """Name what the strategy reads, with the speed policies at which it does: at each, or where the car brakes."""
    constant, planned = (list(chain.from_iterable(map(_leaves, reads(strategy, plan)))) for plan in _PLANS)
    # One's own is told the vehicle and may use all of it; an ECU's program is scaled by what braking would do.
    idle = set() if strategy.id not in STRATEGIES or strategy.delayed else _BRAKING
    always, braking = {*constant} - idle, _braking(strategy)
    return {name: _ALWAYS if name in always else braking for name in planned}


def _braking(strategy: type[Controller]) -> Alternatives:
    """Return the conditions under which its car brakes: a speed policy at which it does, and a bump."""
    planned = [policy for policy in _POLICIES if resolve_speed_plan(strategy, policy) == "planned"]
    return _all(_is(_POLICY, *planned), _is(HAS_BUMP, True))


@cache
def _leaves(name: str) -> tuple[str, ...]:
    """Return the fields of a part; a field or an option as it is."""
    below = [each for each in dotted.scenario_fields() if dotted.is_within(each, name)]
    return tuple(each for each in below if not each.rpartition(".")[2].isdigit()) or (name,)


def _rules(strategy: type[Controller]) -> dict[str, Alternatives]:
    """Name the fields that need other values, with what they need."""
    rules = {**_road_rules(strategy), **_preview_rules(strategy)}
    if strategy.id in STRATEGIES:
        return {**rules, **_rules_of_ours(strategy)}
    declared = [each.name for each in strategy.declared.values() if isinstance(each, ScenarioField)]
    # It may ask for what the sensors measure, noise included, whether there is a filter or not.
    return {name: need for name, need in rules.items() if name not in (*declared, "road.seed")}


def _road_rules(strategy: type[Controller]) -> dict[str, Alternatives]:
    """Return the rules for the road: a measured one has neither roughness nor seed, but filters expect them."""
    generated, filtered, ahead = _is("road.profile", None), _filtered(strategy), _previews(strategy, "lookahead")
    trusting = _all(ahead, _any(*(_is_not(f"mpc.{name}", 0) for name in _EXPECTED)))
    noisy, bump = _all(ahead, _is_not("mismatch.preview_noise", 0)), _is(HAS_BUMP, True)
    return {
        **{f"road.bump.{name}": bump for name in _PLACE},
        _POLICY: bump,
        "road.bump.shape": _is_not("road.bump.height", 0),
        "road.bump.spacing": _all(bump, _is_not("road.bump.count", 1)),
        "road.roughness": _any(generated, filtered, trusting),
        "road.seed": _any(_all(generated, _is_not("road.roughness", 0)), filtered, noisy),
    }


def _preview_rules(strategy: type[Controller]) -> dict[str, Alternatives]:
    """Return the rules for what the strategy itself previews."""
    needs = {
        name: _previews(strategy, *(mode for mode in PREVIEWS if name in fields_read_by(mode)))
        for name in fields_read_by("lookahead")
    }
    needs[_DETECTION] = _any(_braking(strategy), needs[_DETECTION])
    return needs | {_KNOWS_PREVIEW: _all(_filtered(strategy), needs[_KNOWS_PREVIEW])}


def _rules_of_ours(strategy: type[Controller]) -> dict[str, Alternatives]:
    """Return the rules for fields of the car and of our own controllers, whose code is known."""
    disturbed = _any(*(_is_not(f"hil.{name}", 0) for name in ("noise", "jitter", "packet_loss")))
    noises = ("acceleration_noise", "deflection_noise", "pitch_rate_noise")
    return {
        **{f"estimation.{name}": _filtered(strategy) for name in noises},
        "lqr.preview_horizon": _previews(strategy, "wheelbase", "lookahead", "obstacle"),
        "hook.min_damping": _is("hook.semi_active", True),
        "hook.max_damping": _is("hook.semi_active", True),
        "hil.seed": disturbed,
        "vehicle.bump_stop_stiffness": _is_not("vehicle.bump_stop_clearance", None),
        "vehicle.front_brake_share": _any(*(_is_not(f"vehicle.anti_{name}", 0) for name in ("dive", "lift"))),
    }


def _filtered(strategy: type[Controller]) -> Alternatives:
    """Return the condition that the state is estimated, which a passive car never needs."""
    return _is("estimation.kind", "kalman") if strategy.actuated else _NEVER


def _previews(strategy: type[Controller], *modes: str) -> Alternatives:
    """Return the condition that the strategy's preview is one of these: by its field or option, or by its class."""
    if not is_set_by_field(strategy, "preview"):
        return _ALWAYS if effective_preview(strategy) in modes else _NEVER
    declared = strategy.declared["preview"]
    return _is(declared.name if isinstance(declared, ScenarioField) else option_name(strategy, "preview"), *modes)


def _is(field: str, *values: Any) -> Alternatives:
    return ((FieldCondition(field=field, values=values),),)


def _is_not(field: str, *values: Any) -> Alternatives:
    return ((FieldCondition(field=field, values=values, excluded=True),),)


def _all(*needs: Alternatives) -> Alternatives:
    """Return all of several needs: each alternative of one with each of the others."""
    return tuple(tuple(dict.fromkeys(chain.from_iterable(parts))) for parts in product(*needs))


def _any(*needs: Alternatives) -> Alternatives:
    """Return one of several needs."""
    alternatives = tuple(each for need in needs for each in need)
    return _ALWAYS if () in alternatives else alternatives
