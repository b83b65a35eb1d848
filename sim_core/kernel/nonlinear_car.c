/* The half-car where it is not linear: dampers that resist rebound more than compression or are semi-active, bump stops,
   tyres that lift off. Runge-Kutta steps of fourth order, which end where the slope of one of these forces changes
   (docs/physics.md, "Dampers, stops and lift-off"). The model and its source: sim_core/vehicle/nonlinear.py. */

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { STATE = 8, INPUTS = 10, DISTURBANCES = 3 };
enum { MOST_EVENTS = 4 };          /* that a step ends at; both axles' dampers may turn again and again around rest */
enum { PARTS = 8 };                /* of a fine step in which a tyre lifts off or lands */
static const double NEAR = 1e-3;   /* of a step: an event nearer to one of its ends does not divide it */
static const double TINY = 1e-300; /* squared speed that is no speed [m^2/s^2] */

/* Kept out of the functions that call it, so that these stay short and fast; or within them although they are many. */
#define RARE __attribute__((noinline))
#define INLINE inline __attribute__((always_inline))

/* Front and rear in one register; in memory as two numbers of an array. */
typedef double pair __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double))));
typedef long long choice __attribute__((vector_size(2 * sizeof(long long))));

struct car {
    double brake_moment, corner;
    double turns;                   /* 1 where the slope of the dampers' force depends on its direction, else 0 */
    double semi_active, most_force; /* whether they are; what control changes of the passive damper's force at most [N] */
    pair front_share, rear_share;   /* of a force of the suspension in the body's two accelerations */
    pair arm, per_wheel_mass, spring, rebound, compression, clearance, stop, tyre, lift_off, link;
    pair least_damping, most_damping; /* of semi-active dampers */
};

/* Of the half-car, then a lagging actuator's forces, or what it adds to semi-active dampers' coefficients; `body` is the
   body's vertical and pitch velocity. */
struct state {
    pair travel, tyre, body, wheel, force;
};

struct road; /* of road.c */
double ridelab_road_height(const struct road *road, double position);
double ridelab_above_chord(const struct road *road, double begin, double end, double *moment);

/* What a drive meets, fine step after fine step. */
struct input {
    const struct road *road;              /* NULL: straight within a fine step */
    const double *position;               /* of both axles at every fine instant, 2 x (fine_steps + 1) [m] */
    const double *within;                 /* 4 a fine step: both roads' means above their chords, then moments [m] */
    const double *disturbance;            /* 3 a fine step: both road velocities [m/s], braking [m/s^2] */
    int fine_steps, fine, substeps;       /* of all, in a control step; steps of Runge-Kutta in a fine one */
    double time, cell;                    /* of a fine step [s]; distance between the road's samples [m] */
};

/* A fine step or a part of one: the road's velocity as a polynomial of the time from its beginning. */
struct piece {
    pair velocity[3];
    double braking, time; /* [m/s^2], [s] */
    pair beside;          /* about how far the true road leaves this polynomial [m] */
};

static pair choose(choice which, pair yes, pair no)
{
    return (pair)((which & (choice)yes) | (~which & (choice)no));
}

static pair between(pair low, pair value, pair high)
{
    return choose(value < low, low, choose(value > high, high, value));
}

/* The suspension's force but the damper's. */
static pair spring_force(const struct car *car, pair travel)
{
    pair stopped = between(-car->clearance, travel, car->clearance);
    return car->spring * travel + car->stop * (travel - stopped);
}

static pair tyre_load(const struct car *car, pair tyre)
{
    pair load = -car->tyre * tyre;
    return choose(load < car->lift_off, car->lift_off, load);
}

static pair travel_speed(const struct car *car, struct state x)
{
    return (x.body[0] - x.wheel) + car->arm * x.body[1];
}

static pair passive_damping(const struct car *car, pair speed)
{
    return choose(speed > 0, car->rebound, car->compression);
}

/* The force of actuators whose state is `control`, at that speed. Semi-active dampers give the nearest that leaves them
   between their least and their most damping. */
static pair control_force(const struct car *car, pair speed, pair passive, pair control)
{
    if (!car->semi_active)
        return control;
    pair most = {car->most_force, car->most_force};
    pair soft = (passive - car->least_damping) * speed, hard = (passive - car->most_damping) * speed;
    return between(choose(speed > 0, hard, soft), car->corner ? between(-most, -control * speed, most) : control,
                   choose(speed > 0, soft, hard));
}

/* How fast a lagging actuator's state follows the command: its force, or the coefficient that would give this force. */
static pair control_rate(const struct car *car, pair speed, pair command, pair control)
{
    if (car->semi_active) {
        pair passive = passive_damping(car, speed);
        command = between(car->least_damping - passive, -command * speed / (speed * speed + TINY),
                          car->most_damping - passive);
    }
    return car->corner * (command - control);
}

/* At a time from the beginning of a piece [s]. What does not wait for the speed of travel goes first: the operations
   that follow it are what a step takes. */
static INLINE struct state derivative(const struct car *car, struct state x, pair command, const struct piece *w, double time)
{
    pair speed = travel_speed(car, x), road = w->velocity[0] + time * (w->velocity[1] + time * w->velocity[2]);
    pair force = spring_force(car, x.travel) - car->link * w->braking;
    pair passive = passive_damping(car, speed);
    force += passive * speed - control_force(car, speed, passive, x.force);
    pair brake = {0, car->brake_moment * w->braking};
    pair body = brake - force[0] * car->front_share - force[1] * car->rear_share;
    return (struct state){speed, x.wheel - road, body, (tyre_load(car, x.tyre) + force) * car->per_wheel_mass,
                          car->corner ? control_rate(car, speed, command, x.force) : (pair){0, 0}};
}

static struct state moved(struct state x, double time, struct state rate)
{
    return (struct state){x.travel + time * rate.travel, x.tyre + time * rate.tyre, x.body + time * rate.body,
                          x.wheel + time * rate.wheel, x.force + time * rate.force};
}

/* One step h of the classical Runge-Kutta method; `first` is the derivative at its beginning. */
static INLINE struct state advance(const struct car *car, double h, pair command, const struct piece *w, double time,
                            struct state first, struct state x)
{
    struct state second = derivative(car, moved(x, h / 2, first), command, w, time + h / 2);
    struct state third = derivative(car, moved(x, h / 2, second), command, w, time + h / 2);
    struct state fourth = derivative(car, moved(x, h, third), command, w, time + h);
    return moved(moved(moved(moved(x, h / 6, first), h / 3, second), h / 3, third), h / 6, fourth);
}

/* On which side of its events each axle is: of its damper's turning, of meeting a stop, of its tyre's lifting off. */
static choice side(const struct car *car, struct state x)
{
    return ((x.travel > car->clearance) & 1) | ((x.travel < -car->clearance) & 2) |
           ((-car->tyre * x.tyre < car->lift_off) & 4) | ((car->turns * travel_speed(car, x) > 0) & 8);
}

/* The share of a step at which the first of two numbers crosses zero, if that is before `share`. */
static double crossing(pair before, pair after, double share)
{
    for (int axle = 0; axle < 2; axle++)
        if ((before[axle] > 0) != (after[axle] > 0)) {
            double at = before[axle] / (before[axle] - after[axle]);
            if (at > NEAR && at < share)
                share = at;
        }
    return share;
}

/* The share of a step from x to `next` after which the slope of a force changes; 1 where that is near its end only. */
static double first_event(const struct car *car, struct state x, struct state next)
{
    double share = crossing(x.travel - car->clearance, next.travel - car->clearance, 1 - NEAR);
    share = crossing(-x.travel - car->clearance, -next.travel - car->clearance, share);
    share = crossing(car->tyre * x.tyre + car->lift_off, car->tyre * next.tyre + car->lift_off, share);
    share = crossing(car->turns * travel_speed(car, x), car->turns * travel_speed(car, next), share);
    return share < 1 - NEAR ? share : 1;
}

/* The same where the step meets events: by steps that end there. */
RARE static struct state advance_by_events(const struct car *car, double h, pair command, const struct piece *w,
                                           double time, struct state first, struct state x)
{
    for (int events = 0;; events++) {
        struct state next = advance(car, h, command, w, time, first, x);
        double share = events < MOST_EVENTS ? first_event(car, x, next) : 1;
        if (share == 1)
            return next;
        x = advance(car, share * h, command, w, time, first, x);
        time += share * h;
        h -= share * h;
        first = derivative(car, x, command, w, time);
    }
}

static void sample(const struct car *car, struct state x, struct state rate, double *table, size_t signal)
{
    pair control = control_force(car, rate.travel, passive_damping(car, rate.travel), x.force);
    const pair signals[] = {rate.travel, rate.body, tyre_load(car, x.tyre), x.travel, control};
    for (int i = 0; i < 5; i++)
        for (int axle = 0; axle < 2; axle++, table += signal)
            *table = signals[i][axle];
}

/* Its road is the chord and the polynomial of third degree 6 mean s (1 - s) - 60 moment s (1 - s) (1 - 2 s) above it, s
   from 0 to 1. */
static struct piece piece(pair chord, pair mean, pair moment, double braking, double time)
{
    double per = 1 / time;
    pair bow = mean * (6 * per), bend = moment * (60 * per);
    pair beside = 3 * choose(mean > 0, mean, -mean) + 12 * choose(moment > 0, moment, -moment);
    return (struct piece){{chord + bow - bend, (6 * bend - 2 * bow) * per, bend * (-6 * per * per)},
                          braking, time, beside};
}

static struct piece fine_step(const struct input *input, int step)
{
    const double *w = input->disturbance + (size_t)DISTURBANCES * (size_t)step;
    pair chord = {w[0], w[1]}, mean = {0, 0}, moment = {0, 0};
    if (input->road) {
        const double *within = input->within + 4 * (size_t)step;
        mean = (pair){within[0], within[1]};
        moment = (pair){within[2], within[3]};
    }
    return piece(chord, mean, moment, w[2], input->time);
}

static pair heights(const struct input *input, const double *place)
{
    return (pair){ridelab_road_height(input->road, place[0]), ridelab_road_height(input->road, place[1])};
}

/* Over a piece; `rate` is the derivative at its beginning. */
static struct state cross(const struct car *car, int steps, pair command, const struct piece *w, struct state rate,
                          struct state x)
{
    double h = w->time / steps;
    choice where = side(car, x);
    for (int step = 0; step < steps; step++) {
        if (step)
            rate = derivative(car, x, command, w, step * h);
        struct state next = advance(car, h, command, w, step * h, rate, x);
        choice there = side(car, next), crossed = there ^ where;
        if (crossed[0] | crossed[1]) {
            next = advance_by_events(car, h, command, w, step * h, rate, x);
            there = side(car, next);
        }
        x = next;
        where = there;
    }
    return x;
}

/* Whether a tyre may have lifted off or landed within a piece. */
static int may_lift(const struct car *car, const struct piece *w, struct state x, struct state next)
{
    pair margin = car->tyre * w->beside;
    pair before = -car->tyre * x.tyre - car->lift_off, after = -car->tyre * next.tyre - car->lift_off;
    choice stays = ((before > margin) & (after > margin)) | ((before < -margin) & (after < -margin));
    return !(stays[0] && stays[1]);
}

/* A fine step in so many parts, each with a polynomial of its own. */
RARE static struct state cross_parts(const struct car *car, const struct input *input, int step, int parts, pair command,
                                     struct state x)
{
    int substeps = (input->substeps + parts - 1) / parts;
    const double *front = input->position + step, *rear = front + input->fine_steps + 1;
    double share = 1.0 / parts, time = input->time * share, length = (front[1] - front[0]) * share;
    double begin[2] = {front[0], rear[0]}, end[2], bends[2];
    double braking = input->disturbance[(size_t)DISTURBANCES * (size_t)step + 2];
    pair low = heights(input, begin);
    for (int part = 0; part < parts; part++) {
        for (int axle = 0; axle < 2; axle++)
            end[axle] = begin[axle] + length;
        pair high = heights(input, end), mean;
        for (int axle = 0; axle < 2; axle++)
            mean[axle] = ridelab_above_chord(input->road, begin[axle], end[axle], bends + axle);
        struct piece w = piece((high - low) / time, mean, (pair){bends[0], bends[1]}, braking, time);
        x = cross(car, substeps, command, &w, derivative(car, x, command, &w, 0), x);
        memcpy(begin, end, sizeof end);
        low = high;
    }
    return x;
}

/* Into how many parts a fine step goes, so that none is longer than a cell of the road's grid: no polynomial follows two
   of its kinks. */
static int cells(const struct input *input, int step)
{
    double length = input->position[step + 1] - input->position[step];
    return length <= input->cell ? 1 : (int)ceil(length / input->cell);
}

/* One control step from x, whose first fine step is given; its samples in a column of the table unless that is NULL. */
static struct state hold(const struct car *car, const struct input *input, int first, pair command, struct state x,
                         double *column, size_t columns)
{
    size_t signal = columns * (size_t)(input->fine + 1);
    struct piece w;
    for (int j = 0; j < input->fine; j++) {
        w = fine_step(input, first + j);
        struct state next, rate = derivative(car, x, command, &w, 0);
        if (column)
            sample(car, x, rate, column + (size_t)j * columns, signal);
        int parts = input->road ? cells(input, first + j) : 1;
        if (parts > 1)
            next = cross_parts(car, input, first + j, parts, command, x);
        else
            next = cross(car, input->substeps, command, &w, rate, x);
        if (input->road && may_lift(car, &w, x, next))
            next = cross_parts(car, input, first + j, PARTS, command, x);
        x = next;
    }
    if (column)
        sample(car, x, derivative(car, x, command, &w, w.time), column + (size_t)input->fine * columns, signal);
    return x;
}

struct estimator {
    double state[8][8], command[8][2], measurement[8][4];
};

/* What the car's own sensors give: both deflections, the body's acceleration, the pitch rate. */
static void measure(const struct car *car, struct state x, pair command, double braking, double *measured)
{
    struct piece level = {.braking = braking};
    measured[0] = x.travel[0];
    measured[1] = x.travel[1];
    measured[2] = derivative(car, x, command, &level, 0).body[0];
    measured[3] = x.body[1];
}

/* The same of a car's state: 8 numbers, or 10 with a lagging actuator's. */
void ridelab_measure(const struct car *car, int states, const double *state, const double *command, double braking,
                     double *measured)
{
    struct state x = {.force = {command[0], command[1]}};
    memcpy(&x, state, (size_t)states * sizeof(double));
    measure(car, x, (pair){command[0], command[1]}, braking, measured);
}

/* The estimated state at the end of a control step from the one at its beginning. */
static void estimate(const struct estimator *estimator, const struct car *car, struct state x, pair command,
                     double braking, const double *input, const double *before, double *next)
{
    double y[4];
    measure(car, x, command, braking, y);
    for (int i = 0; i < 8; i++) {
        next[i] = input[i];
        for (int j = 0; j < 8; j++)
            next[i] += estimator->state[i][j] * before[j];
        for (int j = 0; j < 2; j++)
            next[i] += estimator->command[i][j] * command[j];
        for (int j = 0; j < 4; j++)
            next[i] += estimator->measurement[i][j] * y[j];
    }
}

/* `count` control steps from step `first` on, in which u = gain [state; previous command] + feed, within the limit. Arrays
   are C-contiguous:

   estimator        of the state, or NULL; its input, 8 numbers a step of the whole drive
   states           8, or 10 with a lagging actuator's
   gain             2 x 10; feed: 2 a step [N]
   loop             a row before each step and after the last, [estimated state; state; previous command]; the first row
                    is an input
   table            10 x (fine + 1) x columns samples; its first column is of step `before` */
void ridelab_drive(const struct car *car, const struct estimator *estimator, const double *known,
                   const struct input *input, int states, int first, int count, const double *gain, double limit,
                   const double *feed, double *loop, double *table, int before, int columns)
{
    int estimated = estimator ? 8 : 0, size = estimated + states, width = size + 2;
    for (int i = 0; i < count; i++) {
        double *now = loop + (size_t)i * width, *next = now + width;
        int step = first + i, fine_step = step * input->fine;
        pair command;
        for (int axle = 0; axle < 2; axle++) {
            double force = feed[2 * i + axle];
            for (int j = 0; j < INPUTS; j++)
                force += gain[INPUTS * axle + j] * now[j < STATE ? j : size + j - STATE];
            command[axle] = force > limit ? limit : force < -limit ? -limit : force;
        }
        struct state x = {.force = command};
        memcpy(&x, now + estimated, (size_t)states * sizeof(double));
        double *column = step < before ? NULL : table + (step - before);
        x = hold(car, input, fine_step, command, x, column, (size_t)columns);
        memcpy(next + estimated, &x, (size_t)states * sizeof(double));
        memcpy(next + size, &command, sizeof command);
        if (estimator) {
            double braking = input->disturbance[(size_t)DISTURBANCES * (size_t)(fine_step + input->fine) - 1];
            estimate(estimator, car, x, command, braking, known + 8 * (size_t)step, now, next);
        }
    }
}
