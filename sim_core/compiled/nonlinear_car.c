/* The half-car where it is not linear: dampers that resist rebound more than compression, bump stops, tyres that lift
   off. Runge-Kutta steps of third order (docs/physics.md, "Dampers, stops and lift-off"). The
   model and its source: sim_core/car/nonlinear.py. */

#include <stddef.h>
#include <string.h>

enum { STATE = 8, INPUTS = 10, ROAD = 0, BRAKING = 2, DISTURBANCES = 3 };

/* Front and rear in one register; in memory as two numbers of an array. */
typedef double pair __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double))));
typedef long long choice __attribute__((vector_size(2 * sizeof(long long))));

struct car {
    double brake_moment, corner;
    pair front_share, rear_share; /* of a force of the suspension in the body's two accelerations */
    pair arm, per_wheel_mass, spring, rebound, compression, clearance, stop, tyre, lift_off, link;
};

/* Of the half-car, then a lagging actuator's forces; `body` is the body's vertical and pitch velocity. */
struct state {
    pair travel, tyre, body, wheel, force;
};

static pair choose(choice which, pair yes, pair no)
{
    return (pair)((which & (choice)yes) | (~which & (choice)no));
}

/* The suspension's force but the damper's. */
static pair spring_force(const struct car *car, pair travel)
{
    pair stopped = choose(travel > car->clearance, car->clearance, travel);
    stopped = choose(travel < -car->clearance, -car->clearance, stopped);
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

/* What does not wait for the speed of travel goes first: the operations that follow it are what a step takes. */
static struct state derivative(const struct car *car, struct state x, pair command, const double *w)
{
    pair speed = travel_speed(car, x), road = {w[ROAD], w[ROAD + 1]};
    pair force = spring_force(car, x.travel) - x.force - car->link * w[BRAKING];
    force += choose(speed > 0, car->rebound * speed, car->compression * speed);
    pair brake = {0, car->brake_moment * w[BRAKING]};
    pair body = brake - force[0] * car->front_share - force[1] * car->rear_share;
    return (struct state){speed, x.wheel - road, body, (tyre_load(car, x.tyre) + force) * car->per_wheel_mass,
                          car->corner * (command - x.force)};
}

static struct state moved(struct state x, double time, struct state rate)
{
    return (struct state){x.travel + time * rate.travel, x.tyre + time * rate.tyre, x.body + time * rate.body,
                          x.wheel + time * rate.wheel, x.force + time * rate.force};
}

/* One step h of Ralston's third-order method; `first` is the derivative at its beginning. */
static struct state advance(const struct car *car, double h, pair command, const double *w, struct state first,
                            struct state x)
{
    struct state second = derivative(car, moved(x, h / 2, first), command, w);
    struct state third = derivative(car, moved(x, 3 * h / 4, second), command, w);
    return moved(moved(moved(x, 2 * h / 9, first), h / 3, second), 4 * h / 9, third);
}

static void sample(const struct car *car, struct state x, struct state rate, double *table, size_t signal)
{
    const pair signals[] = {rate.travel, rate.body, tyre_load(car, x.tyre), x.travel, x.force};
    for (int i = 0; i < 5; i++)
        for (int axle = 0; axle < 2; axle++, table += signal)
            *table = signals[i][axle];
}

/* One control step from x, its samples in a column of the table unless that is NULL. */
static struct state hold(const struct car *car, int fine, int substeps, double h, pair command, const double *w,
                         struct state x, double *column, size_t columns)
{
    size_t signal = columns * (size_t)(fine + 1);
    for (int j = 0; j < fine; j++, w += DISTURBANCES)
        for (int step = 0; step < substeps; step++) {
            struct state rate = derivative(car, x, command, w);
            if (column && step == 0)
                sample(car, x, rate, column + (size_t)j * columns, signal);
            x = advance(car, h, command, w, rate, x);
        }
    if (column)
        sample(car, x, derivative(car, x, command, w - DISTURBANCES), column + (size_t)fine * columns, signal);
    return x;
}

struct estimator {
    double state[8][8], command[8][2], measurement[8][4];
};

/* The estimated state at the end of a control step from the one at its beginning. */
static void estimate(const struct estimator *estimator, const struct car *car, struct state x, pair command,
                     const double *w, const double *input, const double *before, double *next)
{
    const double y[4] = {x.travel[0], x.travel[1], derivative(car, x, command, w).body[0], x.body[1]};
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

/* Control steps in which u = gain [state; previous command] + feed, within the limit and, if dissipative, none where it
   would put energy in. Arrays are C-contiguous:

   estimator        of the state, or NULL; its input, 8 numbers a step
   states           8, or 10 with a lagging actuator's forces
   fine, substeps   fine steps in a control step, steps of h [s] in a fine one
   gain             2 x 10; feed: 2 a step [N]
   disturbance      3 a fine step: both road velocities [m/s], braking [m/s^2]
   loop             a row before each step and after the last, [estimated state; state; previous command]; the first row
                    is an input
   table            10 x (fine + 1) x columns samples; step i fills column + i, unless that is negative */
void ridelab_drive(const struct car *car, const struct estimator *estimator, const double *input, int states, int steps,
                   int fine, int substeps, double h, const double *gain, double limit, int dissipative,
                   const double *feed, const double *disturbance, double *loop, double *table, int column, int columns)
{
    int estimated = estimator ? 8 : 0, size = estimated + states, width = size + 2;
    for (int step = 0; step < steps; step++, column++, disturbance += DISTURBANCES * fine) {
        double *now = loop + (size_t)step * width, *next = now + width;
        struct state x;
        memcpy(&x, now, STATE * sizeof(double));
        pair speed = travel_speed(car, x), command = {feed[2 * step], feed[2 * step + 1]};
        for (int axle = 0; axle < 2; axle++) {
            double force = command[axle];
            for (int i = 0; i < INPUTS; i++)
                force += gain[INPUTS * axle + i] * now[i < STATE ? i : size + i - STATE];
            if (dissipative && force * speed[axle] > 0)
                force = 0;
            command[axle] = force > limit ? limit : force < -limit ? -limit : force;
        }
        x.force = command;
        memcpy(&x, now + estimated, (size_t)states * sizeof(double));
        x = hold(car, fine, substeps, h, command, disturbance, x, column < 0 ? NULL : table + column, (size_t)columns);
        memcpy(next + estimated, &x, (size_t)states * sizeof(double));
        memcpy(next + size, &command, sizeof command);
        if (estimator)
            estimate(estimator, car, x, command, disturbance + DISTURBANCES * (fine - 1), input + 8 * step, now, next);
    }
}
