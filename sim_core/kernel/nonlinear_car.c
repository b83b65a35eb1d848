/* The half-car where it is not linear: dampers that resist rebound more than compression or are semi-active, bump stops,
   tyres that lift off. Runge-Kutta steps of fourth order, which end where the slope of one of these forces changes
   (docs/physics.md, "Dampers, stops and lift-off"). The model and its source: sim_core/vehicle/nonlinear.py. */

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "loop.h"
#include "road.h"

enum { AXLES = 2, SIGNALS = 5, MEASURED = 4 };
enum { TRAVEL = 0, TYRE = 2, BODY = 4, WHEEL = 6, FORCE = 8, NUMBERS = 10 }; /* places in a state, two numbers each */
enum { MOST_EVENTS = 4 };          /* that a step ends at; both axles' dampers may turn again and again around rest */
enum { PARTS = 8 };                /* of a fine step in which a tyre lifts off or lands */
static const double NEAR = 1e-3;   /* of a step: an event nearer to one of its ends does not divide it */
static const double ROUNDING = 1e-9; /* of a length */
static const double TINY = 1e-300; /* squared speed that is no speed [m^2/s^2] */

/* All numbers, as they come from outside; arrays of two are of the front and the rear axle. */
struct vehicle {
    double brake_moment, corner;
    double turns;                   /* 1 where the slope of the dampers' force depends on its direction, else 0 */
    double semi_active, most_force; /* whether they are; what control changes of the passive damper's force at most [N] */
    double body_share[AXLES], pitch_share[AXLES]; /* of a force of the suspension in the body's two accelerations */
    double arm[AXLES], per_wheel_mass[AXLES], spring[AXLES], rebound[AXLES], compression[AXLES], clearance[AXLES];
    double stop[AXLES], tyre[AXLES], lift_off[AXLES], link[AXLES];
    double least_damping[AXLES], most_damping[AXLES]; /* of semi-active dampers */
};

/* Travel and tyre deflection of both axles, vertical and pitch velocity of the body, both wheels' velocities; then a
   lagging actuator's forces, or what it adds to semi-active dampers' coefficients. */
struct state {
    double at[NUMBERS];
};

/* A nonlinear car on its road over a whole drive. */
struct nonlinear_car {
    struct car car;
    int states; /* 8, or 10 with a lagging actuator's */
    const struct vehicle *vehicle;
    const struct estimator *estimator; /* NULL: none */
    const double *known;               /* its input, 8 numbers a control step */
    struct road road;                  /* without samples: straight within a fine step */
    const double *position;            /* of both axles at every fine instant, 2 x (steps fine + 1) [m] */
    const double *within;              /* 4 a fine step: both roads' means above their chords, then moments [m] */
    const double *disturbance;         /* 3 a fine step: both road velocities [m/s], braking [m/s^2] */
    int steps, fine, substeps;         /* of all; fine ones in a control step; steps of Runge-Kutta in a fine one */
    double time;                       /* of a fine step [s] */
    double *table;                     /* 10 x (fine + 1) x columns samples, of the last control steps */
    int columns;
};

/* A fine step or a part of one: the road's velocity as a polynomial of the time from its beginning. */
struct piece {
    double velocity[3][AXLES];
    double braking, time;  /* [m/s^2], [s] */
    double beside[AXLES];  /* about how far the true road leaves this polynomial [m] */
};

static inline double between(double low, double value, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* The suspension's force but the damper's. */
static inline double spring_force(const struct vehicle *vehicle, int axle, double travel)
{
    double stopped = between(-vehicle->clearance[axle], travel, vehicle->clearance[axle]);
    return vehicle->spring[axle] * travel + vehicle->stop[axle] * (travel - stopped);
}

static inline double tyre_load(const struct vehicle *vehicle, int axle, double tyre)
{
    double load = -vehicle->tyre[axle] * tyre;
    return load < vehicle->lift_off[axle] ? vehicle->lift_off[axle] : load;
}

static inline double travel_speed(const struct vehicle *vehicle, int axle, const struct state *x)
{
    return (x->at[BODY] - x->at[WHEEL + axle]) + vehicle->arm[axle] * x->at[BODY + 1];
}

static inline double passive_damping(const struct vehicle *vehicle, int axle, double speed)
{
    return speed > 0 ? vehicle->rebound[axle] : vehicle->compression[axle];
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
static inline double control_rate(const struct vehicle *vehicle, int axle, double speed, double command, double control)
{
    if (vehicle->semi_active) {
        double passive = passive_damping(vehicle, axle, speed);
        command = between(vehicle->least_damping[axle] - passive, -command * speed / (speed * speed + TINY),
                          vehicle->most_damping[axle] - passive);
    }
    return vehicle->corner * (command - control);
}

/* At a time from the beginning of a piece [s]. */
static inline struct state derivative(const struct vehicle *vehicle, const struct state *x, const double *command,
                                      const struct piece *w, double time)
{
    struct state rate;
    double force[AXLES];
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = travel_speed(vehicle, axle, x), passive = passive_damping(vehicle, axle, speed);
        double control = x->at[FORCE + axle];
        double road = w->velocity[0][axle] + time * (w->velocity[1][axle] + time * w->velocity[2][axle]);
        force[axle] = spring_force(vehicle, axle, x->at[TRAVEL + axle]) - vehicle->link[axle] * w->braking +
                      (passive * speed - control_force(vehicle, axle, speed, passive, control));
        rate.at[TRAVEL + axle] = speed;
        rate.at[TYRE + axle] = x->at[WHEEL + axle] - road;
        rate.at[WHEEL + axle] = (tyre_load(vehicle, axle, x->at[TYRE + axle]) + force[axle]) * vehicle->per_wheel_mass[axle];
        rate.at[FORCE + axle] = vehicle->corner ? control_rate(vehicle, axle, speed, command[axle], control) : 0;
    }
    rate.at[BODY] = -force[0] * vehicle->body_share[0] - force[1] * vehicle->body_share[1];
    rate.at[BODY + 1] = vehicle->brake_moment * w->braking - force[0] * vehicle->pitch_share[0] - force[1] * vehicle->pitch_share[1];
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
static inline struct state advance(const struct vehicle *vehicle, double h, const double *command, const struct piece *w,
                                   double time, const struct state *first, const struct state *x)
{
    struct state at_second = moved(x, h / 2, first), second = derivative(vehicle, &at_second, command, w, time + h / 2);
    struct state at_third = moved(x, h / 2, &second), third = derivative(vehicle, &at_third, command, w, time + h / 2);
    struct state at_fourth = moved(x, h, &third), fourth = derivative(vehicle, &at_fourth, command, w, time + h);
    struct state next;
    for (int i = 0; i < NUMBERS; i++)
        next.at[i] = x->at[i] + h / 6 * first->at[i] + h / 3 * second.at[i] + h / 3 * third.at[i] + h / 6 * fourth.at[i];
    return next;
}

/* On which side of its events each axle is: of meeting a stop, of its tyre's lifting off, of its damper's turning. */
static inline int side(const struct vehicle *vehicle, const struct state *x)
{
    int sides = 0;
    for (int axle = 0; axle < AXLES; axle++) {
        double travel = x->at[TRAVEL + axle];
        int stops = (travel > vehicle->clearance[axle]) | (travel < -vehicle->clearance[axle]) << 1;
        int lifted = -vehicle->tyre[axle] * x->at[TYRE + axle] < vehicle->lift_off[axle];
        int rebounds = vehicle->turns * travel_speed(vehicle, axle, x) > 0;
        sides = sides << 4 | stops | lifted << 2 | rebounds << 3;
    }
    return sides;
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
        double clearance = vehicle->clearance[axle], tyre = vehicle->tyre[axle], lift_off = vehicle->lift_off[axle];
        double travel = x->at[TRAVEL + axle], later = next->at[TRAVEL + axle];
        share = crossing(travel - clearance, later - clearance, share);
        share = crossing(-travel - clearance, -later - clearance, share);
        share = crossing(tyre * x->at[TYRE + axle] + lift_off, tyre * next->at[TYRE + axle] + lift_off, share);
        share = crossing(vehicle->turns * travel_speed(vehicle, axle, x), vehicle->turns * travel_speed(vehicle, axle, next), share);
    }
    return share < 1 - NEAR ? share : 1;
}

/* The same where the step meets events: by steps that end there. */
static struct state advance_by_events(const struct vehicle *vehicle, double h, const double *command, const struct piece *w,
                                      double time, struct state first, struct state x)
{
    for (int events = 0;; events++) {
        struct state next = advance(vehicle, h, command, w, time, &first, &x);
        double share = events < MOST_EVENTS ? first_event(vehicle, &x, &next) : 1;
        if (share == 1)
            return next;
        x = advance(vehicle, share * h, command, w, time, &first, &x);
        time += share * h;
        h -= share * h;
        first = derivative(vehicle, &x, command, w, time);
    }
}

static void sample(const struct vehicle *vehicle, const struct state *x, const struct state *rate, double *table, size_t signal)
{
    for (int axle = 0; axle < AXLES; axle++) {
        double speed = rate->at[TRAVEL + axle], passive = passive_damping(vehicle, axle, speed);
        const double signals[SIGNALS] = {speed, rate->at[BODY + axle], tyre_load(vehicle, axle, x->at[TYRE + axle]),
                                         x->at[TRAVEL + axle],
                                         control_force(vehicle, axle, speed, passive, x->at[FORCE + axle])};
        for (size_t i = 0; i < SIGNALS; i++)
            table[(AXLES * i + (size_t)axle) * signal] = signals[i];
    }
}

/* Its road is the chord and the polynomial of third degree 6 mean s (1 - s) - 60 moment s (1 - s) (1 - 2 s) above it, s
   from 0 to 1. */
static struct piece piece(const double *chord, const double *mean, const double *moment, double braking, double time)
{
    struct piece w = {.braking = braking, .time = time};
    double per = 1 / time;
    for (int axle = 0; axle < AXLES; axle++) {
        double bow = mean[axle] * (6 * per), bend = moment[axle] * (60 * per);
        w.velocity[0][axle] = chord[axle] + bow - bend;
        w.velocity[1][axle] = (6 * bend - 2 * bow) * per;
        w.velocity[2][axle] = bend * (-6 * per * per);
        w.beside[axle] = 3 * fabs(mean[axle]) + 12 * fabs(moment[axle]);
    }
    return w;
}

static struct piece fine_step(const struct nonlinear_car *me, int step)
{
    static const double none[2 * AXLES];
    const double *w = me->disturbance + (ptrdiff_t)DISTURBANCES * step;
    const double *within = me->road.samples ? me->within + (ptrdiff_t)2 * AXLES * step : none;
    return piece(w, within, within + AXLES, w[2], me->time);
}

/* Over a piece; `rate` is the derivative at its beginning. */
static struct state cross(const struct vehicle *vehicle, int steps, const double *command, const struct piece *w,
                          struct state rate, struct state x)
{
    double h = w->time / steps;
    int where = side(vehicle, &x);
    for (int step = 0; step < steps; step++) {
        if (step)
            rate = derivative(vehicle, &x, command, w, step * h);
        struct state next = advance(vehicle, h, command, w, step * h, &rate, &x);
        int there = side(vehicle, &next);
        if (there != where) {
            next = advance_by_events(vehicle, h, command, w, step * h, rate, x);
            there = side(vehicle, &next);
        }
        x = next;
        where = there;
    }
    return x;
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
static struct state cross_parts(const struct nonlinear_car *me, int step, int parts, const double *command,
                                struct state x)
{
    int substeps = (me->substeps + parts - 1) / parts;
    const double *front = me->position + step, *rear = front + me->steps * me->fine + 1;
    double share = 1.0 / parts, time = me->time * share, length = (front[1] - front[0]) * share;
    double braking = me->disturbance[(ptrdiff_t)DISTURBANCES * step + 2];
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
        struct piece w = piece(chord, mean, moment, braking, time);
        x = cross(me->vehicle, substeps, command, &w, derivative(me->vehicle, &x, command, &w, 0), x);
    }
    return x;
}

/* Into how many parts a fine step goes, so that none is longer than a cell of the road's grid: no polynomial follows two
   of its kinks. */
static int cells(const struct nonlinear_car *me, int step)
{
    double length = me->position[step + 1] - me->position[step], cell = me->road.at.grid * (1 + ROUNDING);
    return length <= cell ? 1 : (int)ceil(length / cell);
}

/* One control step from x, whose first fine step is given; its samples in a column of the table unless that is NULL. */
static struct state hold(const struct nonlinear_car *me, int first, const double *command, struct state x, double *column)
{
    const struct vehicle *vehicle = me->vehicle;
    size_t columns = (size_t)me->columns, signal = columns * (size_t)(me->fine + 1);
    struct piece w = {.time = 0};
    for (int j = 0; j < me->fine; j++) {
        w = fine_step(me, first + j);
        struct state next, rate = derivative(vehicle, &x, command, &w, 0);
        if (column)
            sample(vehicle, &x, &rate, column + (size_t)j * columns, signal);
        int parts = me->road.samples ? cells(me, first + j) : 1;
        if (parts > 1)
            next = cross_parts(me, first + j, parts, command, x);
        else
            next = cross(vehicle, me->substeps, command, &w, rate, x);
        if (me->road.samples && may_lift(vehicle, &w, &x, &next))
            next = cross_parts(me, first + j, PARTS, command, x);
        x = next;
    }
    if (column) {
        struct state rate = derivative(vehicle, &x, command, &w, w.time);
        sample(vehicle, &x, &rate, column + (size_t)me->fine * columns, signal);
    }
    return x;
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
static struct state state_of(const struct nonlinear_car *me, const double *now, const double *command)
{
    struct state x = {.at[FORCE] = command[0], .at[FORCE + 1] = command[1]};
    memcpy(x.at, now + me->car.size - me->states, (size_t)me->states * sizeof(double));
    return x;
}

static void advance_nonlinear(const struct car *car, int step, const double *now, const double *command, double *next)
{
    const struct nonlinear_car *me = (const struct nonlinear_car *)car;
    int column = step - (me->steps - me->columns), first = step * me->fine;
    struct state x = state_of(me, now, command);
    x = hold(me, first, command, x, column < 0 ? NULL : me->table + column);
    memcpy(next + car->size - me->states, x.at, (size_t)me->states * sizeof(double));
    if (me->estimator) {
        double y[MEASURED], braking = me->disturbance[(ptrdiff_t)DISTURBANCES * (first + me->fine) - 1];
        measure(me->vehicle, &x, command, braking, y);
        estimate(me->estimator, y, command, me->known + (ptrdiff_t)STATE * step, now, next);
    }
}

/* What its own sensors give, from its state and its command [N] and the braking [m/s^2]. */
void ridelab_measure(const struct nonlinear_car *me, const double *now, const double *command, double braking, double *y)
{
    struct state x = state_of(me, now, command);
    measure(me->vehicle, &x, command, braking, y);
}

/* The state is an estimator's where it `estimates`, then the car's; the road has no samples where it is straight within
   a fine step. The others as the struct has them. */
void ridelab_prepare_nonlinear_car(struct nonlinear_car *me, const struct vehicle *vehicle, int states, int estimates,
                                   const struct estimator *estimator, const double *known, int samples,
                                   const double *roughness, const struct layout *layout, const double *position,
                                   const double *within, const double *disturbance, int steps, int fine, int substeps,
                                   double time, double *table, int columns)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a car is prepared in memory of that size");
    *me = (struct nonlinear_car){
        {advance_nonlinear, states + (estimates ? STATE : 0)}, states, vehicle, estimates ? estimator : NULL, known,
        {roughness, samples, *layout}, position, within, disturbance, steps, fine, substeps, time, table, columns};
}
