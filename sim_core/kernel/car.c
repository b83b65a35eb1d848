/* The half-car on its road. Where the car is linear its fine steps are exact, and given, on a road that is straight within
   each. Where it is not - dampers that resist rebound more than compression or are semi-active, bump stops, tyres that
   lift off - they are Runge-Kutta steps of fourth order, which end where the slope of one of these forces changes, on a
   road with its true mean and first moment (docs/explanation/half-car.md). The models and their source: sim_core/vehicle. */

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "loop.h"
#include "record.h"
#include "road.h"

enum { MEASURED = 4 };
enum { TRAVEL = 0, TYRE = 2, BODY = 4, WHEEL = 6, FORCE = 8, NUMBERS = 10 }; /* places in a state, two numbers each */
enum { MOST_EVENTS = 4 };          /* that a step ends at; both axles' dampers may turn again and again around rest */
enum { MOST_POINTS = 21 };         /* of a damper's curve; 0 m/s is one of them, neither the first nor the last */
static const double EVENT_MARGIN = 1e-3; /* of a step: an event nearer to one of its ends does not divide it */
static const double TINY = 1e-300;       /* squared speed that is no speed [m^2/s^2] */

/* All numbers, as they come from outside; arrays of two are of the front and the rear axle. */
struct vehicle {
    double brake_moment, corner;
    double damper_asymmetric;       /* 1 where the slope of the dampers' force depends on its direction, else 0 */
    double semi_active, most_force; /* whether they are; what control changes of the passive damper's force at most [N] */
    double body_share[AXLES], pitch_share[AXLES]; /* of a force of the suspension in the body's two accelerations */
    double arm[AXLES], per_wheel_mass[AXLES], spring[AXLES], rebound[AXLES], compression[AXLES];
    double clearance_down[AXLES], clearance_up[AXLES]; /* from rest to the stops; below 0 where it rests on one */
    double stop[AXLES], tyre[AXLES], lift_off[AXLES], link[AXLES];
    double least_damping[AXLES], most_damping[AXLES]; /* of semi-active dampers */
    struct curve {
        double points, speed[MOST_POINTS], force[MOST_POINTS]; /* 0 is no curve; one of both axles, or of none */
    } curve[AXLES];
};

/* Travel and tyre deflection of both axles, vertical and pitch velocity of the body, both wheels' velocities; then a
   lagging actuator's forces, or what it adds to semi-active dampers' coefficients. */
struct state {
    double at[NUMBERS];
};

/* What a linear car's fine step depends on: both roads' velocities and braking, the state, and the command, which counts
   where actuators lag. */
enum { BRAKING = AXLES, NOW, COMMAND = NOW + NUMBERS, CAUSES = COMMAND + FORCES };

/* A car on its road over a whole drive. */
struct car {
    int size, states; /* numbers of its state, with an estimate; without: 8, or 10 with a lagging actuator's */
    int linear;
    const struct vehicle *vehicle;
    const struct estimator *estimator; /* NULL: none */
    const double *estimator_input;     /* 8 numbers a control step */
    const double *height, *braking;    /* of the road, 2 x (steps fine + 1) [m]; in each fine step [m/s^2] */
    const double *above_chord;         /* 4 a fine step: both roads' means above their chords, then moments [m]; not read
                                          of a linear car */
    const double (*effects)[NUMBERS];  /* CAUSES of them, what each alone makes of rest in a linear car's fine step */
    int steps, fine, substeps;         /* of all; fine ones in a control step; steps of Runge-Kutta in a fine one */
    double time, per_time;             /* of a fine step [s], and its inverse */
    struct recorder *recorder;         /* NULL: none */
    double signals[NUMBERS + 1][SIGNALS]; /* what each number of a linear car's state, and braking, make of a sample */
};

static inline double travel_speed(const struct vehicle *vehicle, int axle, const struct state *x)
{
    return (x->at[BODY] - x->at[WHEEL + axle]) + vehicle->arm[axle] * x->at[BODY + 1];
}

/* The force of an actuator whose state is `control`, at that speed. A semi-active damper gives the nearest that leaves it
   between its least and its most damping. */
static inline double control_force(const struct vehicle *vehicle, int axle, double speed, double passive, double control)
{
    if (!vehicle->semi_active)
        return control;
    double soft = (passive - vehicle->least_damping[axle]) * speed, hard = (passive - vehicle->most_damping[axle]) * speed;
    double wanted = vehicle->corner ? between(-vehicle->most_force, -control * speed, vehicle->most_force) : control;
    return speed > 0 ? between(hard, wanted, soft) : between(soft, wanted, hard);
}

/* How fast a lagging actuator's state follows the command: its force, or the coefficient that would give this force. */
static inline double control_rate(const struct vehicle *vehicle, int axle, double speed, double passive, double command,
                                  double control)
{
    if (vehicle->semi_active)
        command = between(vehicle->least_damping[axle] - passive, -command * speed / (speed * speed + TINY),
                          vehicle->most_damping[axle] - passive);
    return vehicle->corner * (command - control);
}

/* Force over speed of a curve, straight between its points and beyond them. */
static double secant(const struct curve *curve, double speed)
{
    int i = 1, last = (int)curve->points - 1;
    while (i < last && speed > curve->speed[i])
        i++;
    double slope = (curve->force[i] - curve->force[i - 1]) / (curve->speed[i] - curve->speed[i - 1]);
    int from = speed > 0 ? i - 1 : i; /* the nearer to rest */
    return curve->speed[from] == 0 ? slope : (curve->force[from] + slope * (speed - curve->speed[from])) / speed;
}

/* Whether dampers are neither semi-active nor have a curve, and actuators do not lag. */
static inline int is_plain(const struct vehicle *vehicle)
{
    return !vehicle->semi_active && vehicle->curve[0].points == 0 && vehicle->corner == 0;
}

/* Force over speed of an axle's passive damper at a speed, without a curve. */
static inline double plain_damping(const struct vehicle *vehicle, int axle, double speed)
{
    return vehicle->damper_asymmetric * speed > 0 ? vehicle->rebound[axle] : vehicle->compression[axle];
}

static inline double damping(const struct vehicle *vehicle, int axle, double speed)
{
    return vehicle->curve[0].points > 0 ? secant(vehicle->curve + axle, speed) : plain_damping(vehicle, axle, speed);
}

static inline double stop_force(const struct vehicle *vehicle, int axle, double travel)
{
    double extended = travel - vehicle->clearance_up[axle], compressed = travel + vehicle->clearance_down[axle];
    return vehicle->stop[axle] * ((extended > 0 ? extended : 0) + (compressed < 0 ? compressed : 0));
}

static inline double tyre_load(const struct vehicle *vehicle, int axle, const struct state *x)
{
    double load = -vehicle->tyre[axle] * x->at[TYRE + axle];
    return load < vehicle->lift_off[axle] ? vehicle->lift_off[axle] : load;
}

/* Of an axle's damper, spring, stop - which may bear part of the weight at rest - and actuator, and what braking lets its
   links bear [N]. */
static inline double suspension_force(const struct vehicle *vehicle, int axle, const struct state *x, double speed,
                                      double passive, double control, double braking)
{
    double travel = x->at[TRAVEL + axle], stop = stop_force(vehicle, axle, travel) - stop_force(vehicle, axle, 0);
    return vehicle->spring[axle] * travel + stop - vehicle->link[axle] * braking + (passive * speed - control);
}

/* Both accelerations of the body from its suspension's forces. */
static inline void body_accelerations(const struct vehicle *vehicle, const double *force, double braking, double *rate)
{
    rate[0] = -force[0] * vehicle->body_share[0] - force[1] * vehicle->body_share[1];
    rate[1] = vehicle->brake_moment * braking - force[0] * vehicle->pitch_share[0] - force[1] * vehicle->pitch_share[1];
}

/* What a car that is not linear meets in a fine step: the road's velocity as a polynomial of the time from its beginning
   [m/s], and braking. */
struct road_input {
    double velocity[3][AXLES];
    double braking; /* [m/s^2] */
};

/* The derivative at a time from the beginning of a fine step [s]; `plain`, a constant, where the vehicle `is_plain`. */
static inline struct state derivative(const struct vehicle *vehicle, int plain, const struct state *x, const double *command,
                                      const struct road_input *road, double time)
{
    struct state rate;
    double force[AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = travel_speed(vehicle, axle, x), state = x->at[FORCE + axle];
        double passive = plain ? plain_damping(vehicle, axle, speed) : damping(vehicle, axle, speed);
        double control = plain ? state : control_force(vehicle, axle, speed, passive, state);
        double velocity = road->velocity[0][axle] + time * (road->velocity[1][axle] + time * road->velocity[2][axle]);
        force[axle] = suspension_force(vehicle, axle, x, speed, passive, control, road->braking);
        rate.at[TRAVEL + axle] = speed;
        rate.at[TYRE + axle] = x->at[WHEEL + axle] - velocity;
        rate.at[WHEEL + axle] = (tyre_load(vehicle, axle, x) + force[axle]) * vehicle->per_wheel_mass[axle];
        rate.at[FORCE + axle] = 0;
        if (!plain && vehicle->corner)
            rate.at[FORCE + axle] = control_rate(vehicle, axle, speed, passive, command[axle], state);
    }
    body_accelerations(vehicle, force, road->braking, rate.at + BODY);
    return rate;
}

static inline struct state moved(const struct state *x, double time, const struct state *rate)
{
    struct state next;
    for (int i = 0; i < NUMBERS; i++)
        next.at[i] = x->at[i] + time * rate->at[i];
    return next;
}

/* One step h of the classical Runge-Kutta method; `first` is the derivative at its beginning. */
static inline struct state runge_kutta_step(const struct vehicle *vehicle, int plain, double h, const double *command,
                                            const struct road_input *road, double time, const struct state *first,
                                            const struct state *x)
{
    static const double share[3] = {0.5, 0.5, 1}, weight[3] = {1.0 / 3, 1.0 / 3, 1.0 / 6};
    struct state next = moved(x, h / 6, first), rate = *first;
    for (int stage = 0; stage < 3; stage++) {
        struct state at_stage = moved(x, share[stage] * h, &rate);
        rate = derivative(vehicle, plain, &at_stage, command, road, time + share[stage] * h);
        next = moved(&next, weight[stage] * h, &rate);
    }
    return next;
}

/* What causes make of a state, added to it: columns of so many numbers, each times its factor. Both counts have to be
   constants: then a compiler takes two numbers at once. */
static inline void add_columns(const double (*restrict columns)[NUMBERS], const double *restrict factors, int count,
                               double *restrict sum, int numbers)
{
    for (int i = 0; i < numbers; i++) {
        double all = sum[i];
        for (int column = 0; column < count; column++)
            all += columns[column][i] * factors[column];
        sum[i] = all;
    }
}

/* A linear car's fine step: what is constant over a control step makes, the `road_input` and the state, of so many
   numbers, a constant too. */
static inline void linear_step(const struct car *me, const double *restrict constant_input_term,
                               const double *restrict road_input, const double *restrict x, double *restrict next,
                               int states)
{
    for (int i = 0; i < states; i++) {
        double all = constant_input_term[i];
        for (int cause = 0; cause < DISTURBANCES; cause++)
            all += me->effects[cause][i] * road_input[cause];
        for (int cause = 0; cause < states; cause++)
            all += me->effects[NOW + cause][i] * x[cause];
        next[i] = all;
    }
}

/* The share of a step at which a number crosses zero, if that is before `share`. */
static double crossing(double before, double after, double share)
{
    if ((before > 0) == (after > 0))
        return share;
    double at = before / (before - after);
    return at > EVENT_MARGIN && at < share ? at : share;
}

/* The share of a step from x to `next` after which the slope of a force changes; 1 where that is near its end only. */
static double first_event(const struct vehicle *vehicle, const struct state *x, const struct state *next)
{
    double share = 1 - EVENT_MARGIN;
    for (int axle = 0; axle < AXLES; axle++) {
        double tyre = vehicle->tyre[axle], lift_off = vehicle->lift_off[axle];
        double travel = x->at[TRAVEL + axle], later = next->at[TRAVEL + axle];
        share = crossing(travel - vehicle->clearance_up[axle], later - vehicle->clearance_up[axle], share);
        share = crossing(-travel - vehicle->clearance_down[axle], -later - vehicle->clearance_down[axle], share);
        share = crossing(tyre * x->at[TYRE + axle] + lift_off, tyre * next->at[TYRE + axle] + lift_off, share);
        double speed = travel_speed(vehicle, axle, x), then = travel_speed(vehicle, axle, next);
        share = crossing(vehicle->damper_asymmetric * speed, vehicle->damper_asymmetric * then, share);
        for (int i = 1; i < (int)vehicle->curve[axle].points - 1; i++)
            share = crossing(speed - vehicle->curve[axle].speed[i], then - vehicle->curve[axle].speed[i], share);
    }
    return share < 1 - EVENT_MARGIN ? share : 1;
}

/* A step h in steps that end at the events that it meets. */
static inline void step_to_events(const struct vehicle *vehicle, int plain, double h, const double *command,
                                  const struct road_input *road, double time, struct state *x)
{
    for (int events = 0;; events++) {
        struct state first = derivative(vehicle, plain, x, command, road, time);
        struct state next = runge_kutta_step(vehicle, plain, h, command, road, time, &first, x);
        double share = events < MOST_EVENTS ? first_event(vehicle, x, &next) : 1;
        if (share < 1)
            next = runge_kutta_step(vehicle, plain, share * h, command, road, time, &first, x);
        *x = next;
        if (share == 1)
            return;
        time += share * h;
        h -= share * h;
    }
}

static void sample(const struct vehicle *vehicle, const struct state *x, double braking, double *signals)
{
    double force[AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = travel_speed(vehicle, axle, x), passive = damping(vehicle, axle, speed);
        double control = control_force(vehicle, axle, speed, passive, x->at[FORCE + axle]);
        force[axle] = suspension_force(vehicle, axle, x, speed, passive, control, braking);
        signals[SPEED + axle] = speed;
        signals[LOAD + axle] = tyre_load(vehicle, axle, x);
        signals[TRAVEL_SIGNAL + axle] = x->at[TRAVEL + axle];
        signals[FORCE_SIGNAL + axle] = control;
    }
    body_accelerations(vehicle, force, braking, signals + ACCELERATION);
}

/* What a linear car meets in a fine step. */
static inline void find_road_input(const struct car *me, int step, double *road_input)
{
    const double *front = me->height + step, *rear = front + me->steps * me->fine + 1;
    road_input[0] = (front[1] - front[0]) * me->per_time;
    road_input[1] = (rear[1] - rear[0]) * me->per_time;
    road_input[BRAKING] = me->braking[step];
}

/* What another car meets. Its road is the chord and the polynomial of third degree 6 mean s (1 - s) - 60 moment s (1 - s)
   (1 - 2 s) above it, s from 0 to 1. */
static inline struct road_input shaped_road_input(const struct car *me, int step)
{
    double chord[DISTURBANCES], per = me->per_time;
    find_road_input(me, step, chord);
    struct road_input road = {.braking = chord[BRAKING]};
    const double *mean = me->above_chord + (ptrdiff_t)2 * AXLES * step, *moment = mean + AXLES;
    for (int axle = 0; axle < AXLES; axle++) {
        double bow = mean[axle] * (6 * per), bend = moment[axle] * (60 * per);
        road.velocity[0][axle] = chord[axle] + bow - bend;
        road.velocity[1][axle] = (6 * bend - 2 * bow) * per;
        road.velocity[2][axle] = bend * (-6 * per * per);
    }
    return road;
}

/* A linear car's sample. */
static inline void sample_linearly(const struct car *me, const double *restrict held, const double *restrict x,
                                   double braking, double *restrict signals, int states)
{
    for (int i = 0; i < SIGNALS; i++) {
        double all = held[i] + me->signals[NUMBERS][i] * braking;
        for (int cause = 0; cause < states; cause++)
            all += me->signals[cause][i] * x[cause];
        signals[i] = all;
    }
}

/* One control step of the linear car of so many numbers; its samples, those at the ends of its fine steps, unless they
   are NULL. */
static inline void hold_linear(const struct car *me, int first, const double *command, double *x,
                               double (*samples)[SIGNALS], int states)
{
    double at[2][NUMBERS], term[NUMBERS] = {0}; /* at both ends of a fine step; what the command makes of one */
    double held[SIGNALS] = {0};                 /* what forces that do not lag make of a sample */
    add_columns(me->effects + (states == NUMBERS ? COMMAND : NOW + FORCE), command, FORCES, term, NUMBERS);
    memcpy(at[0], x, sizeof at[0]);
    memcpy(at[1], x, sizeof at[1]);
    add_columns(me->signals + FORCE, x + FORCE, NUMBERS - states, held, SIGNALS);
    for (int j = 0; j < me->fine; j++) {
        const double *now = at[j % 2];
        double road_input[DISTURBANCES];
        find_road_input(me, first + j, road_input);
        if (samples)
            sample_linearly(me, held, now, road_input[BRAKING], samples[j], states);
        linear_step(me, term, road_input, now, at[(j + 1) % 2], states);
    }
    if (samples)
        sample_linearly(me, held, at[me->fine % 2], me->braking[first + me->fine - 1], samples[me->fine], states);
    memcpy(x, at[me->fine % 2], sizeof at[0]);
}

/* The same of another car. */
static inline void hold(const struct car *me, int plain, int first, const double *command, struct state *x,
                        double (*samples)[SIGNALS])
{
    double h = me->time / me->substeps;
    for (int j = 0; j < me->fine; j++) {
        struct road_input road = shaped_road_input(me, first + j);
        if (samples)
            sample(me->vehicle, x, road.braking, samples[j]);
        for (int step = 0; step < me->substeps; step++)
            step_to_events(me->vehicle, plain, h, command, &road, step * h, x);
    }
    if (samples)
        sample(me->vehicle, x, me->braking[first + me->fine - 1], samples[me->fine]);
}

struct estimator {
    double state[STATE][STATE], command[STATE][FORCES], measurement[STATE][MEASURED];
};

/* What the car's own sensors give: both deflections, the body's acceleration, the pitch rate. */
static void measure(const struct vehicle *vehicle, const struct state *x, const double *command, double braking, double *y)
{
    struct road_input level = {.braking = braking};
    struct state rate = derivative(vehicle, 0, x, command, &level, 0);
    y[0] = x->at[TRAVEL];
    y[1] = x->at[TRAVEL + 1];
    y[2] = rate.at[BODY];
    y[3] = x->at[BODY + 1];
}

/* The estimated state at the end of a control step from the one at its beginning. */
static void estimate(const struct estimator *estimator, const double *y, const double *command, const double *input,
                     const double *before, double *next)
{
    for (int i = 0; i < STATE; i++) {
        next[i] = input[i];
        for (int j = 0; j < STATE; j++)
            next[i] += estimator->state[i][j] * before[j];
        for (int j = 0; j < FORCES; j++)
            next[i] += estimator->command[i][j] * command[j];
        for (int j = 0; j < MEASURED; j++)
            next[i] += estimator->measurement[i][j] * y[j];
    }
}

/* The car's own part of what the loop knows of it; without a lag the actuators' forces are the commands. */
static struct state state_of(const struct car *me, const double *now, const double *command)
{
    struct state x = {.at[FORCE] = command[0], .at[FORCE + 1] = command[1]};
    memcpy(x.at, now + me->size - me->states, (size_t)me->states * sizeof(double));
    return x;
}

static void advance(struct car *me, int step, const double *now, const double *command, double *next,
                    double (*samples)[SIGNALS])
{
    int first = step * me->fine;
    struct state x = state_of(me, now, command);
    if (me->linear && me->states == STATE)
        hold_linear(me, first, command, x.at, samples, STATE);
    else if (me->linear)
        hold_linear(me, first, command, x.at, samples, NUMBERS);
    else if (is_plain(me->vehicle))
        hold(me, 1, first, command, &x, samples);
    else
        hold(me, 0, first, command, &x, samples);
    memcpy(next + me->size - me->states, x.at, (size_t)me->states * sizeof(double));
    if (me->estimator) {
        double y[MEASURED];
        measure(me->vehicle, &x, command, me->braking[first + me->fine - 1], y);
        estimate(me->estimator, y, command, me->estimator_input + (ptrdiff_t)STATE * step, now, next);
    }
}

RIDELAB_NUMBERS_OF(vehicle)
RIDELAB_NUMBERS_OF(estimator)
RIDELAB_SIZE(causes, CAUSES)
RIDELAB_SIZE(lagging_state, NUMBERS)
RIDELAB_SIZE(measured, MEASURED)
RIDELAB_SIZE(curve_points, MOST_POINTS)

int ridelab_car_size(const struct car *me)
{
    return me->size;
}

void ridelab_drive(struct car *me, int step, const double *now, const double *command, double *next)
{
    double (*samples)[SIGNALS] = me->recorder ? ridelab_samples(me->recorder, step) : NULL;
    advance(me, step, now, command, next, samples);
    if (samples)
        ridelab_record(me->recorder, step);
}

/* The samples of control steps that were driven, from `first` on, in memory for those of one: signals x steps x (fine + 1);
   from the rows of a loop from the first one's on. */
void ridelab_sample(struct car *me, const double *loop, int first, int steps, double (*one)[SIGNALS], double *samples)
{
    int width = me->size + FORCES, each = me->fine + 1;
    double next[STATE + NUMBERS];
    for (int step = 0; step < steps; step++, loop += width) {
        advance(me, first + step, loop, loop + width + me->size, next, one);
        for (size_t signal = 0; signal < SIGNALS; signal++)
            for (int i = 0; i < each; i++)
                samples[(signal * (size_t)steps + (size_t)step) * (size_t)each + (size_t)i] = one[i][signal];
    }
}

/* What its own sensors give at the beginning of a control step, from its state and the command held until then [N]. */
void ridelab_measure(const struct car *me, int step, const double *now, const double *command, double *y)
{
    struct state x = state_of(me, now, command);
    int last = step > 0 ? step * me->fine - 1 : me->fine - 1;
    measure(me->vehicle, &x, command, me->braking[last], y);
}

/* The state is an estimator's where it `estimates`, then the car's. A linear car's `effects` are its fine step; another's
   are not read. The others as the struct has them. */
void ridelab_prepare_car(struct car *me, const struct vehicle *vehicle, int states, int linear,
                         const double (*effects)[NUMBERS], int estimates, const struct estimator *estimator,
                         const double *estimator_input, const double *height, const double *braking,
                         const double *above_chord, int steps, int fine, int substeps, double time,
                         struct recorder *recorder)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a car is prepared in memory of that size");
    *me = (struct car){.size = states + (estimates ? STATE : 0), .states = states, .linear = linear, .effects = effects,
                       .vehicle = vehicle, .estimator = estimates ? estimator : NULL,
                       .estimator_input = estimator_input, .height = height, .braking = braking,
                       .above_chord = above_chord, .steps = steps, .fine = fine, .substeps = substeps, .time = time,
                       .per_time = 1 / time, .recorder = recorder};
    for (int cause = 0; linear && cause <= NUMBERS; cause++) {
        struct state x = {{0}};
        if (cause < NUMBERS)
            x.at[cause] = 1;
        sample(vehicle, &x, cause == NUMBERS, me->signals[cause]);
    }
}
