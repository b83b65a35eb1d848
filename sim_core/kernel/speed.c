/* The fuzzy speed controller (sim_core/speed/fuzzy.py): Mamdani's minimum and maximum, centroid; and the drive that it plans
   towards a bump (sim_core/speed/profile.py). */

#include <math.h>
#include <stddef.h>

#include "numbers.h"

enum { MOST_SETS = 20 }; /* of a variable; sim_core/scenario/fuzzy.py has no more */

/* What a rule asks for, from 0 to `end`: memberships at even samples of its universe, samples x sets. */
struct variable {
    const double *memberships;
    int samples, sets;
    double end;
};

/* Rules: the set of the distance and of the error, -1 for any, and that of the torque. Memberships of the torque's sets over
   an even universe from 0 to 1: sets x (steps + 1). The surface has the share at every sample of the distance and the error,
   NaN where none was asked for yet; NULL where shares are not interpolated. */
struct rules {
    struct variable error, distance;
    const int *rules;
    int count, sets, steps;
    const double *torque;
    double *surface;
};

/* Where a value lies: behind which sample, and how far, 0 to 1. */
struct place {
    int index;
    double share;
};

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a < b ? b : a;
}

/* Centroid of what is concluded, by trapezoids over an even universe from 0 to 1; memberships sets x (steps + 1). 0 where
   nothing is. */
static double centroid(const double *fired, int sets, const double *memberships, int steps)
{
    const double *rows[MOST_SETS];
    double levels[MOST_SETS], moment = 0, area = 0;
    int count = 0;
    for (int set = 0; set < sets; set++)
        if (fired[set] > 0) {
            levels[count] = fired[set];
            rows[count++] = memberships + (size_t)set * (size_t)(steps + 1);
        }
    for (int i = 0; i <= steps; i++) {
        double concluded = 0;
        for (int set = 0; set < count; set++)
            concluded = larger(concluded, smaller(levels[set], rows[set][i]));
        concluded *= i == 0 || i == steps ? 0.5 : 1;
        moment += concluded * i;
        area += concluded;
    }
    return area > 0 ? moment / area / steps : 0;
}

/* The torque as a share of its universe, at the distance's memberships and the error's. */
static double concluded_share(const struct rules *me, const double *distance, const double *error)
{
    double fired[MOST_SETS] = {0};
    for (const int *rule = me->rules; rule < me->rules + 3 * me->count; rule += 3) {
        double near = rule[0] < 0 ? 1 : distance[rule[0]], fast = rule[1] < 0 ? 1 : error[rule[1]];
        fired[rule[2]] = larger(fired[rule[2]], smaller(near, fast));
    }
    return centroid(fired, me->sets, me->torque, me->steps);
}

static struct place place_in(const struct variable *variable, double value)
{
    double at = smaller(larger(value, 0), variable->end) * ((variable->samples - 1) / variable->end);
    int index = (int)smaller(at, variable->samples - 2);
    return (struct place){index, at - index};
}

static const double *memberships_at(const struct variable *variable, int index)
{
    return variable->memberships + (size_t)index * (size_t)variable->sets;
}

static void memberships_between(const struct variable *variable, struct place at, double *memberships)
{
    const double *before = memberships_at(variable, at.index), *after = memberships_at(variable, at.index + 1);
    for (int set = 0; set < variable->sets; set++)
        memberships[set] = before[set] + at.share * (after[set] - before[set]);
}

static double on_surface(const struct rules *me, int distance, int error)
{
    double *share = me->surface + (size_t)distance * (size_t)me->error.samples + (size_t)error;
    if (isnan(*share))
        *share = concluded_share(me, memberships_at(&me->distance, distance), memberships_at(&me->error, error));
    return *share;
}

/* Between two errors at a sample of the distance. */
static double along_surface(const struct rules *me, int distance, struct place error)
{
    double before = on_surface(me, distance, error.index);
    return before + error.share * (on_surface(me, distance, error.index + 1) - before);
}

/* The torque as a share of its universe, at a speed error [km/h] and a distance [m], both clipped to theirs. */
double ridelab_torque_share(const struct rules *me, double error, double distance)
{
    struct place fast = place_in(&me->error, error), near = place_in(&me->distance, distance);
    if (me->surface) {
        double before = along_surface(me, near.index, fast);
        return before + near.share * (along_surface(me, near.index + 1, fast) - before);
    }
    double of_error[MOST_SETS], of_distance[MOST_SETS];
    memberships_between(&me->error, fast, of_error);
    memberships_between(&me->distance, near, of_distance);
    return concluded_share(me, of_distance, of_error);
}

/* The arguments are as `struct rules` has them; the surface has no numbers where shares are not interpolated. */
void ridelab_prepare_rules(struct rules *me, const double *errors, int error_samples, int error_sets, double error_end,
                           const double *distances, int distance_samples, int distance_sets, double distance_end,
                           const int *rules, int count, const double *torque, int sets, int steps, double *surface,
                           int interpolates)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "rules are prepared in memory of that size");
    *me = (struct rules){.error = {errors, error_samples, error_sets, error_end},
                         .distance = {distances, distance_samples, distance_sets, distance_end},
                         .rules = rules,
                         .count = count,
                         .sets = sets,
                         .steps = steps,
                         .torque = torque,
                         .surface = interpolates ? surface : NULL};
}

/* How a car is driven towards a bump and over it; the brake chain's constants come first (sim_core/speed/brake.py). */
struct plan {
    double pressure_per_torque, most_deceleration, most_torque, lag, deceleration_per_pressure, friction_slope, rolling, air;
    double target, band;        /* speed to arrive with, half width around it [m/s] */
    double bump_start, bump_end; /* where the front axle meets it, and where it is when the rear one has left it [m] */
    double reached;             /* so little before a place counts as there [m] */
    double step, keep_half, keep; /* [s]; shares of a pressure error that half a step and a step leave */
    double guarded;             /* whether the distance that is left asks for torque too */
    double kmh;                 /* [m/s] */
    double engine_time, engine_acceleration; /* with which it closes a speed error [s], at most [m/s^2] */
};

static double resistance(const struct plan *me, double speed)
{
    return me->rolling + me->air * speed * speed;
}

/* By the brakes alone [m/s^2], at a line pressure [Pa] (Eq. 4-5). */
static double braking(const struct plan *me, double pressure, double speed)
{
    return me->deceleration_per_pressure * pressure * tanh(me->friction_slope * speed);
}

/* What the engine adds to reach and hold a speed [m/s^2]; it never brakes. */
static double push(const struct plan *me, double speed, double reference)
{
    return smaller(larger(resistance(me, speed) + (reference - speed) / me->engine_time, 0), me->engine_acceleration);
}

/* Line pressure asked for [Pa], so far before the bump [m]. */
static double demanded(const struct plan *me, const struct rules *rules, double speed, double left)
{
    double share = ridelab_torque_share(rules, (speed - me->target) / me->kmh, left);
    if (me->guarded != 0) { /* the share of the greatest deceleration that reaches the target in what the lag leaves */
        double usable = larger(left - me->lag * speed, 0.1);
        double needed = (speed * speed - me->target * me->target) / (2 * usable * me->most_deceleration);
        share = larger(share, smaller(needed, 1));
    }
    return share * me->most_torque * me->pressure_per_torque;
}

RIDELAB_NUMBERS_OF(plan)
RIDELAB_SIZE(fuzzy_sets, MOST_SETS)

/* Position [m], speed [m/s], line pressure [Pa] and deceleration by the brakes [m/s^2] at the beginnings of steps, at most so
   many; how many there are. `now` has the first three, then those after the last step; the position is infinite once the
   plan has ended. */
int ridelab_plan_speed(const struct rules *rules, const struct plan *me, double *now, double (*rows)[4], int most)
{
    double h = me->step;
    for (int count = 0; count < most; count++) {
        double x = now[0], v = now[1], pressure = now[2], deceleration = braking(me, pressure, v);
        int coasts = x >= me->bump_start - me->reached, brakes = !coasts && v - me->target > me->band;
        double demand = brakes ? demanded(me, rules, v, me->bump_start - x) : 0;
        double reference = coasts ? me->target - me->band : me->target;
        rows[count][0] = x, rows[count][1] = v, rows[count][2] = pressure, rows[count][3] = deceleration;
        if (x >= me->bump_end - me->reached) {
            now[0] = INFINITY;
            return count + 1;
        }
        double pushed = brakes ? 0 : push(me, v, reference);
        double middle = v + h / 2 * (pushed - resistance(me, v) - deceleration);
        double middle_pressure = demand + (pressure - demand) * me->keep_half;
        pushed = brakes ? 0 : push(me, middle, reference);
        now[0] = x + h * middle;
        now[1] = v + h * (pushed - resistance(me, middle) - braking(me, middle_pressure, middle));
        now[2] = demand + (pressure - demand) * me->keep;
    }
    return most;
}
