/* The half-car where it is not linear: dampers that resist rebound more than compression, bump stops, tyres that lift
   off. Runge-Kutta steps of third order (docs/physics.md, "Dampers, stops and lift-off"). The
   model and its source: sim_core/car/nonlinear.py. */

#include <stddef.h>

enum { D = 0, TYRE = 2, BODY = 4, PITCH = 5, WHEEL = 6, FORCE = 8, STATE = 10 };
enum { ROAD = 0, BRAKING = 2, DISTURBANCES = 3 };

struct car {
    double per_body_mass, per_pitch_inertia, brake_moment, corner;
    double arm[2], per_wheel_mass[2], spring[2], rebound[2], compression[2];
    double clearance[2], stop[2], tyre[2], lift_off[2], link[2];
};

static double travel_force(const struct car *car, int axle, double deflection, double speed)
{
    double force = car->spring[axle] * deflection;
    force += (speed > 0 ? car->rebound[axle] : car->compression[axle]) * speed;
    if (deflection > car->clearance[axle])
        force += car->stop[axle] * (deflection - car->clearance[axle]);
    else if (deflection < -car->clearance[axle])
        force += car->stop[axle] * (deflection + car->clearance[axle]);
    return force;
}

static double tyre_load(const struct car *car, int axle, double deflection)
{
    double load = -car->tyre[axle] * deflection;
    return load < car->lift_off[axle] ? car->lift_off[axle] : load;
}

static double travel_speed(const struct car *car, int axle, const double *x)
{
    return x[BODY] + car->arm[axle] * x[PITCH] - x[WHEEL + axle];
}

static void derivative(const struct car *car, const double *x, const double *command, const double *w, double *dx)
{
    double body = 0, pitch = 0;
    for (int axle = 0; axle < 2; axle++) {
        double speed = travel_speed(car, axle, x);
        double force = travel_force(car, axle, x[D + axle], speed) - x[FORCE + axle] - car->link[axle] * w[BRAKING];
        dx[D + axle] = speed;
        dx[TYRE + axle] = x[WHEEL + axle] - w[ROAD + axle];
        dx[WHEEL + axle] = (tyre_load(car, axle, x[TYRE + axle]) + force) * car->per_wheel_mass[axle];
        dx[FORCE + axle] = car->corner * (command[axle] - x[FORCE + axle]);
        body -= force;
        pitch -= car->arm[axle] * force;
    }
    dx[BODY] = body * car->per_body_mass;
    dx[PITCH] = pitch * car->per_pitch_inertia + car->brake_moment * w[BRAKING];
}

/* One step h of Ralston's third-order method; k[0] is the derivative at its beginning. */
static void advance(const struct car *car, double h, const double *command, const double *w, double k[3][STATE],
                    double *x)
{
    double between[STATE];
    const double share[2] = {h / 2, 3 * h / 4};
    for (int stage = 0; stage < 2; stage++) {
        for (int i = 0; i < STATE; i++)
            between[i] = x[i] + share[stage] * k[stage][i];
        derivative(car, between, command, w, k[stage + 1]);
    }
    for (int i = 0; i < STATE; i++)
        x[i] += h / 9 * (2 * k[0][i] + 3 * k[1][i] + 4 * k[2][i]);
}

static void sample(const struct car *car, const double *x, const double *dx, double *table, size_t signal)
{
    table[2 * signal] = dx[BODY];
    table[3 * signal] = dx[PITCH];
    for (int axle = 0; axle < 2; axle++) {
        table[axle * signal] = dx[D + axle];
        table[(4 + axle) * signal] = tyre_load(car, axle, x[TYRE + axle]);
        table[(6 + axle) * signal] = x[D + axle];
        table[(8 + axle) * signal] = x[FORCE + axle];
    }
}

/* One control step from x, its samples in a column of the table unless that is NULL. */
static void hold(const struct car *car, int fine, int substeps, double h, const double *command, const double *w,
                 double *x, double *column, size_t columns)
{
    double k[3][STATE];
    size_t signal = columns * (size_t)(fine + 1);
    for (int j = 0; j < fine; j++, w += DISTURBANCES)
        for (int step = 0; step < substeps; step++) {
            derivative(car, x, command, w, k[0]);
            if (column && step == 0)
                sample(car, x, k[0], column + (size_t)j * columns, signal);
            advance(car, h, command, w, k, x);
        }
    if (column) {
        derivative(car, x, command, w - DISTURBANCES, k[0]);
        sample(car, x, k[0], column + (size_t)fine * columns, signal);
    }
}

struct estimator {
    double state[8][8], command[8][2], measurement[8][4];
};

/* The estimated state at the end of a control step from the one at its beginning. */
static void estimate(const struct estimator *estimator, const struct car *car, const double *x, const double *command,
                     const double *w, const double *input, const double *before, double *next)
{
    double dx[STATE];
    derivative(car, x, command, w, dx);
    const double y[4] = {x[D], x[D + 1], dx[BODY], x[PITCH]};
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
    for (int step = 0; step < steps; step++, column++) {
        double *now = loop + (size_t)step * width, *next = now + width, *command = next + size, x[STATE];
        for (int axle = 0; axle < 2; axle++) {
            command[axle] = feed[2 * step + axle];
            for (int i = 0; i < STATE; i++)
                command[axle] += gain[STATE * axle + i] * now[i < FORCE ? i : size + i - FORCE];
            if (dissipative && command[axle] * travel_speed(car, axle, now) > 0)
                command[axle] = 0;
            command[axle] = command[axle] > limit ? limit : command[axle] < -limit ? -limit : command[axle];
        }
        for (int i = 0; i < STATE; i++)
            x[i] = i < states ? now[estimated + i] : command[i - FORCE];
        hold(car, fine, substeps, h, command, disturbance + (size_t)step * DISTURBANCES * fine, x,
             column < 0 ? NULL : table + column, (size_t)columns);
        for (int i = 0; i < states; i++)
            next[estimated + i] = x[i];
        if (estimator)
            estimate(estimator, car, x, command, disturbance + (size_t)(step + 1) * DISTURBANCES * fine - DISTURBANCES,
                     input + 8 * step, now, next);
    }
}
