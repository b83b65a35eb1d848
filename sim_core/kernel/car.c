/* The half-car on its road. Where it is linear its fine steps are exact, and given. Where it is not - dampers that resist
   rebound more than compression or are semi-active, bump stops, tyres that lift off - they are Runge-Kutta steps of fourth
   order, which end where the slope of one of these forces changes (docs/explanation/half-car.md). The models and their
   source: sim_core/vehicle. */

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
enum { PARTS = 8 };                /* of a fine step in which a tyre lifts off or lands */
static const double NEAR = 1e-3;   /* of a step: an event nearer to one of its ends does not divide it */
static const double ROUNDING = 1e-9; /* of a length */
static const double SLOW = 1e-3;     /* [m/s]: within a step a damper that is faster does not turn and turn back */
static const double TINY = 1e-300; /* squared speed that is no speed [m^2/s^2] */

/* All numbers, as they come from outside; arrays of two are of the front and the rear axle. */
struct vehicle {
    double brake_moment, corner;
    double turns;                   /* 1 where the slope of the dampers' force depends on its direction, else 0 */
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

/* The forces where no slope changes: of an axle's damper and spring, what a stop adds, of its tyre, and of one lifted. */
struct mode {
    double damping[AXLES], spring[AXLES], stop[AXLES], tyre[AXLES], lifted[AXLES];
};

/* What a step depends on in a mode, where it is linear: the road's velocity as a polynomial, first its constants, braking,
   the state, 1, and the command, which counts where actuators lag. */
enum { ROAD, BRAKING = ROAD + AXLES, NOW, CURVE = NOW + NUMBERS, ONE = CURVE + 2 * AXLES, COMMAND, CAUSES = COMMAND + FORCES };

/* Such a step, in the mode of `sides`. */
struct linear_step {
    double sides, time; /* of which mode; that it takes [s], 0 for none */
    double effects[CAUSES][NUMBERS];
};
enum { LINEAR_STEPS = 16, LINEAR_STEP_NUMBERS = 2 + CAUSES * NUMBERS }; /* that are kept; of each */

/* A car on its road over a whole drive. */
struct car {
    int size, states; /* numbers of its state, with an estimate; without: 8, or 10 with a lagging actuator's */
    int linear;
    const struct vehicle *vehicle;
    const struct estimator *estimator; /* NULL: none */
    const double *estimator_input;     /* 8 numbers a control step */
    struct road road;                  /* without samples: straight within a fine step */
    const double *position;            /* of both axles at every fine instant, 2 x (steps fine + 1) [m] */
    const double *within;              /* 4 a fine step: both roads' means above their chords, then moments [m] */
    const double *height, *braking;    /* of the road there, 2 x (steps fine + 1) [m]; in each fine step [m/s^2] */
    int steps, fine, substeps;         /* of all; fine ones in a control step; steps of Runge-Kutta in a fine one */
    double time, per_time;             /* of a fine step [s], and its inverse */
    struct recorder *recorder;         /* NULL: none */
    int where;                         /* `side` of the present state */
    struct mode mode;                  /* of that side */
    const struct linear_step *present; /* the step in that mode, NULL where it has to be looked up */
    double held[NUMBERS];              /* what command and stops make of rest in it */
    double signals[NUMBERS + 1][SIGNALS]; /* what each number of a linear car's state, and braking, make of a sample */
    int linear_steps;                  /* that were made */
    struct linear_step *kept;          /* LINEAR_STEPS; a linear car's, which is never another */
};

/* A fine step or a part of one: the road's velocity as a polynomial of the time from its beginning. */
struct piece {
    double velocity[3][AXLES];
    double braking, time;  /* [m/s^2], [s] */
    double beside[AXLES];  /* about how far the true road leaves this polynomial [m] */
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

enum { EXTENDED = 1, COMPRESSED = 2, LIFTED = 4, REBOUNDS = 8, OF_AXLE = 4 }; /* bits of an axle; how many */
enum { MAY_TURN = 1 << AXLES * OF_AXLE };

/* On which side of its events each axle is: of meeting a stop, of its tyre's lifting off, of its damper's turning. And
   whether a damper is so slow that it may turn, and turn back, within a step; a semi-active one is no mode's. */
static inline int side(const struct vehicle *vehicle, const struct state *x)
{
    double slow = vehicle->semi_active || vehicle->curve[0].points > 0 ? INFINITY : SLOW * vehicle->turns;
    int sides = 0;
    for (int axle = 0; axle < AXLES; axle++) {
        double travel = x->at[TRAVEL + axle], speed = vehicle->turns * travel_speed(vehicle, axle, x);
        int own = EXTENDED * (travel > vehicle->clearance_up[axle]) |
                  COMPRESSED * (travel < -vehicle->clearance_down[axle]) |
                  LIFTED * (-vehicle->tyre[axle] * x->at[TYRE + axle] < vehicle->lift_off[axle]) | REBOUNDS * (speed > 0);
        sides |= own << OF_AXLE * axle | MAY_TURN * (fabs(speed) < slow);
    }
    return sides;
}

static inline struct mode mode_of(const struct vehicle *vehicle, int sides)
{
    struct mode mode;
    for (int axle = 0; axle < AXLES; axle++) {
        int own = sides >> OF_AXLE * axle, stopped = own & (EXTENDED | COMPRESSED);
        double down = vehicle->stop[axle] * vehicle->clearance_down[axle];
        double up = vehicle->stop[axle] * vehicle->clearance_up[axle];
        double at_rest = down < 0 ? down : up < 0 ? -up : 0; /* of a stop that bears part of the weight */
        mode.damping[axle] = own & REBOUNDS ? vehicle->rebound[axle] : vehicle->compression[axle];
        mode.spring[axle] = vehicle->spring[axle] + (stopped ? vehicle->stop[axle] : 0);
        mode.stop[axle] = (!stopped ? 0 : own & EXTENDED ? -up : down) - at_rest;
        mode.tyre[axle] = own & LIFTED ? 0 : vehicle->tyre[axle];
        mode.lifted[axle] = own & LIFTED ? vehicle->lift_off[axle] : 0;
    }
    return mode;
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

/* That of a state: a damper with a curve is one that is linear at each speed, with its force there. */
static inline struct mode mode_at(const struct vehicle *vehicle, const struct state *x)
{
    struct mode mode = mode_of(vehicle, side(vehicle, x));
    for (int axle = 0; axle < AXLES && vehicle->curve[0].points > 0; axle++)
        mode.damping[axle] = secant(vehicle->curve + axle, travel_speed(vehicle, axle, x));
    return mode;
}

static inline double tyre_load(const struct mode *mode, int axle, const struct state *x)
{
    return mode->lifted[axle] - mode->tyre[axle] * x->at[TYRE + axle];
}

/* Of an axle's damper, spring, stop and actuator, the last as `control`, and what braking lets its links bear [N]. */
static inline double suspension_force(const struct mode *mode, const struct vehicle *vehicle, int axle,
                                      const struct state *x, double speed, double control, double braking)
{
    return mode->spring[axle] * x->at[TRAVEL + axle] + mode->stop[axle] - vehicle->link[axle] * braking +
           (mode->damping[axle] * speed - control);
}

/* Both accelerations of the body from its suspension's forces. */
static inline void body_accelerations(const struct vehicle *vehicle, const double *force, double braking, double *rate)
{
    rate[0] = -force[0] * vehicle->body_share[0] - force[1] * vehicle->body_share[1];
    rate[1] = vehicle->brake_moment * braking - force[0] * vehicle->pitch_share[0] - force[1] * vehicle->pitch_share[1];
}

/* At a time from the beginning of a piece [s]. */
static inline struct state derivative_in(const struct mode *mode, const struct vehicle *vehicle, const struct state *x,
                                         const double *command, const struct piece *w, double time)
{
    struct state rate;
    double force[AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = travel_speed(vehicle, axle, x), passive = mode->damping[axle], state = x->at[FORCE + axle];
        double road = w->velocity[0][axle] + time * (w->velocity[1][axle] + time * w->velocity[2][axle]);
        double control = control_force(vehicle, axle, speed, passive, state);
        force[axle] = suspension_force(mode, vehicle, axle, x, speed, control, w->braking);
        rate.at[TRAVEL + axle] = speed;
        rate.at[TYRE + axle] = x->at[WHEEL + axle] - road;
        rate.at[WHEEL + axle] = (tyre_load(mode, axle, x) + force[axle]) * vehicle->per_wheel_mass[axle];
        rate.at[FORCE + axle] = vehicle->corner ? control_rate(vehicle, axle, speed, passive, command[axle], state) : 0;
    }
    body_accelerations(vehicle, force, w->braking, rate.at + BODY);
    return rate;
}

static inline struct state derivative(const struct vehicle *vehicle, const struct state *x, const double *command,
                                      const struct piece *w, double time)
{
    struct mode mode = mode_at(vehicle, x);
    return derivative_in(&mode, vehicle, x, command, w, time);
}

static inline struct state moved(const struct state *x, double time, const struct state *rate)
{
    struct state next;
    for (int i = 0; i < NUMBERS; i++)
        next.at[i] = x->at[i] + time * rate->at[i];
    return next;
}

/* One step h of the classical Runge-Kutta method; `first` is the derivative at its beginning. In a mode, or in that of
   each state where it is NULL. */
static inline struct state advance_in(const struct mode *mode, const struct vehicle *vehicle, double h,
                                      const double *command, const struct piece *w, double time,
                                      const struct state *first, const struct state *x)
{
    static const double share[3] = {0.5, 0.5, 1}, weight[3] = {1.0 / 3, 1.0 / 3, 1.0 / 6};
    struct state next = moved(x, h / 6, first), rate = *first;
    for (int stage = 0; stage < 3; stage++) {
        struct state at_stage = moved(x, share[stage] * h, &rate);
        double then = time + share[stage] * h;
        rate = mode ? derivative_in(mode, vehicle, &at_stage, command, w, then)
                    : derivative(vehicle, &at_stage, command, w, then);
        next = moved(&next, weight[stage] * h, &rate);
    }
    return next;
}

/* The step in the mode of `sides`: what each cause alone makes of rest. */
static const struct linear_step *linear_step(struct car *me, int sides, double h)
{
    for (int i = 0; i < LINEAR_STEPS; i++)
        if (me->kept[i].sides == sides && me->kept[i].time == h)
            return me->kept + i;
    struct linear_step *step = me->kept + me->linear_steps++ % LINEAR_STEPS;
    step->sides = sides;
    step->time = h;
    for (int cause = 0; cause < CAUSES; cause++) {
        struct mode mode = mode_of(me->vehicle, sides);
        struct state x = {{0}}, first;
        struct piece w = {.braking = cause == BRAKING};
        double command[FORCES] = {cause == COMMAND, cause == COMMAND + 1};
        for (int axle = 0; axle < AXLES && cause != ONE; axle++)
            mode.stop[axle] = mode.lifted[axle] = 0;
        if (cause >= NOW && cause < CURVE)
            x.at[cause - NOW] = 1;
        else if (cause >= CURVE && cause < ONE)
            w.velocity[1 + (cause - CURVE) / AXLES][(cause - CURVE) % AXLES] = 1;
        else if (cause < BRAKING)
            w.velocity[0][cause - ROAD] = 1;
        first = derivative_in(&mode, me->vehicle, &x, command, &w, 0);
        x = advance_in(&mode, me->vehicle, h, command, &w, 0, &first, &x);
        memcpy(step->effects[cause], x.at, sizeof x);
    }
    return step;
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

/* A linear step of so many numbers: what is held makes, road and braking `met`, the state, and the road's `curve`, of
   which so many numbers count. All three counts have to be constants. */
static inline void add_causes(const struct car *me, const struct linear_step *step, const double *restrict met,
                              const double *restrict x, const double *restrict curve, int curves, double *restrict next,
                              int states)
{
    for (int i = 0; i < states; i++) {
        double all = me->held[i];
        for (int cause = 0; cause < DISTURBANCES; cause++)
            all += step->effects[cause][i] * met[cause];
        for (int cause = 0; cause < states; cause++)
            all += step->effects[NOW + cause][i] * x[cause];
        for (int cause = 0; cause < curves; cause++)
            all += step->effects[CURVE + cause][i] * curve[cause];
        next[i] = all;
    }
}

/* The step in the present mode. */
static const struct linear_step *present_step(struct car *me, double h, const double *command)
{
    if (me->present && me->present->time == h)
        return me->present;
    me->present = me->linear ? me->kept : linear_step(me, me->where, h);
    int lagging = me->states == NUMBERS;
    memcpy(me->held, me->present->effects[ONE], sizeof me->held);
    add_columns(me->present->effects + (lagging ? COMMAND : NOW + FORCE), command, FORCES, me->held, NUMBERS);
    return me->present;
}

static inline void advance_linearly(struct car *me, double h, const double *command, const struct piece *w, double time,
                                    const struct state *x, struct state *next)
{
    const struct linear_step *step = present_step(me, h, command);
    double met[DISTURBANCES] = {[BRAKING] = w->braking}, curve[2 * AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double v0 = w->velocity[0][axle], v1 = w->velocity[1][axle], v2 = w->velocity[2][axle];
        met[ROAD + axle] = v0 + time * (v1 + time * v2);
        curve[axle] = v1 + 2 * time * v2;
        curve[AXLES + axle] = v2;
    }
    memcpy(next->at + FORCE, me->held + FORCE, FORCES * sizeof(double));
    if (me->states == STATE)
        add_causes(me, step, met, x->at, curve, 2 * AXLES, next->at, STATE);
    else
        add_causes(me, step, met, x->at, curve, 2 * AXLES, next->at, NUMBERS);
}

/* The share of a step at which a number crosses zero, if that is before `share`. */
static double crossing(double before, double after, double share)
{
    if ((before > 0) == (after > 0))
        return share;
    double at = before / (before - after);
    return at > NEAR && at < share ? at : share;
}

/* The share of a step from x to `next` after which the slope of a force changes; 1 where that is near its end only. */
static double first_event(const struct vehicle *vehicle, const struct state *x, const struct state *next)
{
    double share = 1 - NEAR;
    for (int axle = 0; axle < AXLES; axle++) {
        double tyre = vehicle->tyre[axle], lift_off = vehicle->lift_off[axle];
        double travel = x->at[TRAVEL + axle], later = next->at[TRAVEL + axle];
        share = crossing(travel - vehicle->clearance_up[axle], later - vehicle->clearance_up[axle], share);
        share = crossing(-travel - vehicle->clearance_down[axle], -later - vehicle->clearance_down[axle], share);
        share = crossing(tyre * x->at[TYRE + axle] + lift_off, tyre * next->at[TYRE + axle] + lift_off, share);
        double speed = travel_speed(vehicle, axle, x), then = travel_speed(vehicle, axle, next);
        share = crossing(vehicle->turns * speed, vehicle->turns * then, share);
        for (int i = 1; i < (int)vehicle->curve[axle].points - 1; i++)
            share = crossing(speed - vehicle->curve[axle].speed[i], then - vehicle->curve[axle].speed[i], share);
    }
    return share < 1 - NEAR ? share : 1;
}

/* The step by steps that end at the events it meets. */
static void advance_by_events(const struct vehicle *vehicle, double h, const double *command, const struct piece *w,
                              double time, struct state *x)
{
    for (int events = 0;; events++) {
        struct state first = derivative(vehicle, x, command, w, time);
        struct state next = advance_in(NULL, vehicle, h, command, w, time, &first, x);
        double share = events < MOST_EVENTS ? first_event(vehicle, x, &next) : 1;
        if (share < 1)
            next = advance_in(NULL, vehicle, share * h, command, w, time, &first, x);
        *x = next;
        if (share == 1)
            return;
        time += share * h;
        h -= share * h;
    }
}

static void sample(struct car *me, const struct state *x, double braking, double *signals)
{
    struct mode there, *mode = &me->mode;
    if (me->vehicle->curve[0].points > 0) {
        there = mode_at(me->vehicle, x);
        mode = &there;
    }
    double force[AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = travel_speed(me->vehicle, axle, x);
        double control = control_force(me->vehicle, axle, speed, mode->damping[axle], x->at[FORCE + axle]);
        force[axle] = suspension_force(mode, me->vehicle, axle, x, speed, control, braking);
        signals[SPEED + axle] = speed;
        signals[LOAD + axle] = tyre_load(mode, axle, x);
        signals[TRAVEL_SIGNAL + axle] = x->at[TRAVEL + axle];
        signals[FORCE_SIGNAL + axle] = control;
    }
    body_accelerations(me->vehicle, force, braking, signals + ACCELERATION);
}

/* Its road is the chord and the polynomial of third degree 6 mean s (1 - s) - 60 moment s (1 - s) (1 - 2 s) above it, s
   from 0 to 1. */
static inline void shape(struct piece *w, const double *chord, const double *mean, const double *moment, double per)
{
    for (int axle = 0; axle < AXLES; axle++) {
        double bow = mean[axle] * (6 * per), bend = moment[axle] * (60 * per);
        w->velocity[0][axle] = chord[axle] + bow - bend;
        w->velocity[1][axle] = (6 * bend - 2 * bow) * per;
        w->velocity[2][axle] = bend * (-6 * per * per);
        w->beside[axle] = 3 * fabs(mean[axle]) + 12 * fabs(moment[axle]);
    }
}

/* What the car meets in a fine step, where the road is straight within it. */
static inline void meet(const struct car *me, int step, double *met)
{
    const double *front = me->height + step, *rear = front + me->steps * me->fine + 1;
    met[ROAD] = (front[1] - front[0]) * me->per_time;
    met[ROAD + 1] = (rear[1] - rear[0]) * me->per_time;
    met[BRAKING] = me->braking[step];
}

static inline void fine_step(const struct car *me, int step, struct piece *w)
{
    static const double straight[2 * AXLES] = {0};
    const double *within = me->road.samples ? me->within + (ptrdiff_t)2 * AXLES * step : straight;
    double met[DISTURBANCES];
    meet(me, step, met);
    w->braking = met[BRAKING];
    w->time = me->time;
    shape(w, met + ROAD, within, within + AXLES, me->per_time);
}

static void enter(struct car *me, int where)
{
    me->where = where;
    me->mode = mode_of(me->vehicle, where);
    me->present = NULL;
}

/* Over a piece. */
static void cross(struct car *me, int steps, const double *command, const struct piece *w, struct state *x)
{
    const struct vehicle *vehicle = me->vehicle;
    double h = steps == 1 ? w->time : w->time / steps;
    for (int step = 0; step < steps; step++) {
        struct state next;
        int there = MAY_TURN;
        if (!(me->where & MAY_TURN)) {
            advance_linearly(me, h, command, w, step * h, x, &next);
            there = side(vehicle, &next);
        }
        if (there & MAY_TURN || there != me->where) {
            next = *x;
            advance_by_events(vehicle, h, command, w, step * h, &next);
            there = side(vehicle, &next);
        }
        *x = next;
        if (there != me->where)
            enter(me, there);
    }
}

/* Whether a tyre may have lifted off or landed within a piece. */
static int may_lift(const struct vehicle *vehicle, const struct piece *w, const struct state *x, const struct state *next)
{
    for (int axle = 0; axle < AXLES; axle++) {
        double tyre = vehicle->tyre[axle], lift_off = vehicle->lift_off[axle], margin = tyre * w->beside[axle];
        double before = -tyre * x->at[TYRE + axle] - lift_off, after = -tyre * next->at[TYRE + axle] - lift_off;
        if (!((before > margin && after > margin) || (before < -margin && after < -margin)))
            return 1;
    }
    return 0;
}

/* A fine step in so many parts, each with a polynomial of its own. */
static void cross_parts(struct car *me, int step, int parts, const double *command, struct state *x)
{
    int substeps = (me->substeps + parts - 1) / parts;
    const double *front = me->position + step, *rear = front + me->steps * me->fine + 1;
    double share = 1.0 / parts, time = me->time * share, length = (front[1] - front[0]) * share;
    double braking = me->braking[step];
    double begin[AXLES] = {front[0], rear[0]}, low[AXLES], chord[AXLES], mean[AXLES], moment[AXLES];
    for (int axle = 0; axle < AXLES; axle++)
        low[axle] = ridelab_road_height(&me->road, begin[axle]);
    for (int part = 0; part < parts; part++) {
        for (int axle = 0; axle < AXLES; axle++) {
            double end = begin[axle] + length, high = ridelab_road_height(&me->road, end);
            chord[axle] = (high - low[axle]) / time;
            mean[axle] = ridelab_above_chord(&me->road, begin[axle], end, &moment[axle]);
            begin[axle] = end;
            low[axle] = high;
        }
        struct piece w = {.braking = braking, .time = time};
        shape(&w, chord, mean, moment, 1 / time);
        cross(me, substeps, command, &w, x);
    }
}

/* Into how many parts a fine step goes, so that none is longer than a cell of the road's grid: no polynomial follows two
   of its kinks. */
static int cells(const struct car *me, int step)
{
    double length = me->position[step + 1] - me->position[step], cell = me->road.at.grid * (1 + ROUNDING);
    return length <= cell ? 1 : (int)ceil(length / cell);
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

/* One control step of the linear car of so many numbers, whose first fine step is given; its samples, those at the ends
   of its fine steps, unless they are NULL. */
static inline void hold_linear(struct car *me, int first, const double *command, double *x, double (*samples)[SIGNALS],
                               int states)
{
    enter(me, 0);
    const struct car *const car = me;
    const struct linear_step *step = present_step(me, me->time, command);
    double at[2][NUMBERS], held[SIGNALS] = {0}; /* at both ends of a fine step; what forces that do not lag make of a sample */
    memcpy(at[0], x, sizeof at[0]);
    memcpy(at[1], x, sizeof at[1]);
    add_columns(car->signals + FORCE, x + FORCE, NUMBERS - states, held, SIGNALS);
    for (int j = 0; j < me->fine; j++) {
        const double *now = at[j % 2];
        double met[DISTURBANCES];
        meet(me, first + j, met);
        if (samples)
            sample_linearly(me, held, now, met[BRAKING], samples[j], states);
        add_causes(me, step, met, now, NULL, 0, at[(j + 1) % 2], states);
    }
    if (samples)
        sample_linearly(me, held, at[me->fine % 2], me->braking[first + me->fine - 1], samples[me->fine], states);
    memcpy(x, at[me->fine % 2], sizeof at[0]);
}

/* The same of another car. */
static void hold(struct car *me, int first, const double *command, struct state *x, double (*samples)[SIGNALS])
{
    struct piece w;
    enter(me, side(me->vehicle, x));
    for (int j = 0; j < me->fine; j++) {
        fine_step(me, first + j, &w);
        if (samples)
            sample(me, x, w.braking, samples[j]);
        if (!me->road.samples) {
            cross(me, me->substeps, command, &w, x);
            continue;
        }
        struct state before = *x;
        int where = me->where, parts = cells(me, first + j);
        if (parts > 1)
            cross_parts(me, first + j, parts, command, x);
        else
            cross(me, me->substeps, command, &w, x);
        if (may_lift(me->vehicle, &w, &before, x)) {
            *x = before;
            enter(me, where);
            cross_parts(me, first + j, PARTS, command, x);
        }
    }
    if (samples)
        sample(me, x, me->braking[first + me->fine - 1], samples[me->fine]);
}

struct estimator {
    double state[STATE][STATE], command[STATE][FORCES], measurement[STATE][MEASURED];
};

/* What the car's own sensors give: both deflections, the body's acceleration, the pitch rate. */
static void measure(const struct vehicle *vehicle, const struct state *x, const double *command, double braking, double *y)
{
    struct piece level = {.braking = braking};
    struct state rate = derivative(vehicle, x, command, &level, 0);
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
    else
        hold(me, first, command, &x, samples);
    memcpy(next + me->size - me->states, x.at, (size_t)me->states * sizeof(double));
    if (me->estimator) {
        double y[MEASURED];
        measure(me->vehicle, &x, command, me->braking[first + me->fine - 1], y);
        estimate(me->estimator, y, command, me->estimator_input + (ptrdiff_t)STATE * step, now, next);
    }
}

RIDELAB_NUMBERS_OF(vehicle)
RIDELAB_NUMBERS_OF(estimator)
RIDELAB_NUMBERS_OF(linear_step)

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

/* The state is an estimator's where it `estimates`, then the car's. A linear car's fine step is the first of those kept;
   those of another are made. The road has no samples where it is straight within a fine step. The others as the struct
   has them. */
void ridelab_prepare_car(struct car *me, const struct vehicle *vehicle, int states, int linear, struct linear_step *kept,
                         int estimates, const struct estimator *estimator, const double *estimator_input, int samples,
                         const double *roughness, const struct layout *layout, const double *position,
                         const double *within, const double *height, const double *braking, int steps, int fine,
                         int substeps, double time, struct recorder *recorder)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a car is prepared in memory of that size");
    *me = (struct car){.size = states + (estimates ? STATE : 0), .states = states, .linear = linear, .kept = kept,
                       .vehicle = vehicle, .estimator = estimates ? estimator : NULL,
                       .estimator_input = estimator_input, .road = ridelab_road(roughness, samples, layout),
                       .position = position, .within = within, .height = height, .braking = braking, .steps = steps,
                       .fine = fine, .substeps = substeps, .time = time, .per_time = 1 / time, .recorder = recorder};
    enter(me, 0);
    for (int cause = 0; linear && cause <= NUMBERS; cause++) {
        struct state x = {{0}};
        if (cause < NUMBERS)
            x.at[cause] = 1;
        sample(me, &x, cause == NUMBERS, me->signals[cause]);
    }
}
