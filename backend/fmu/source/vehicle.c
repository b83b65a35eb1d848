/* The half-car of kernel/car.c on a road that is straight within each communication step. */
#include <math.h>
#include <string.h>

#include "loop.h"
#include "model.h"
#include "record.h"
#include "ridelab_curves.h"
#include "road.h"

/* As kernel/car.c has them. */
struct vehicle;
struct estimator;
enum { LAGGING = STATE + FORCES };
void ridelab_prepare_car(struct car *me, const struct vehicle *vehicle, int states, int linear,
                         const double (*effects)[LAGGING], int estimates, const struct estimator *estimator,
                         const double *estimator_input, const double *height, const double *braking, int steps, int fine,
                         int substeps, double time, struct recorder *recorder);
void ridelab_sample(struct car *me, const double *loop, int first, int steps, double (*one)[SIGNALS], double *samples);

static const double MOST_SUBSTEPS = 1e6;

struct memory {
    double height[AXLES];                 /* of the road at the end of the last step [m] */
    double now[LAGGING], command[FORCES]; /* the state then, and the command until then */
    double vehicle[VEHICLE_NUMBERS];
    double car[RIDELAB_PREPARED / sizeof(double)];
};
const size_t model_memory_bytes = sizeof(struct memory);

/* `struct vehicle` of kernel/car.c, as sim_core/vehicle/nonlinear.py fills it. */
static void fill_vehicle(const double *value, double *to)
{
    static const double PI = 3.14159265358979323846, GRAVITY = 9.80665;
    double mass = value[V_BODY_MASS], inertia = value[V_PITCH_INERTIA], height = value[V_CG_HEIGHT];
    double front = value[V_CG_TO_FRONT], rear = value[V_CG_TO_REAR], wheelbase = front + rear;
    double ratio = value[V_REBOUND_RATIO], compression = 2 / (1 + ratio), rebound = compression * ratio;
    double clearance = value[V_BUMP_STOP_CLEARANCE] > 0 ? value[V_BUMP_STOP_CLEARANCE] : INFINITY;
    double stop = value[V_BUMP_STOP_STIFFNESS], transfer = mass * height / wheelbase, body = mass * GRAVITY / wheelbase;
    double lifts = value[V_TYRE_LIFT_OFF], share = value[V_FRONT_BRAKE_SHARE];
    double front_load = body * rear + value[V_FRONT_WHEEL_MASS] * GRAVITY;
    double rear_load = body * front + value[V_REAR_WHEEL_MASS] * GRAVITY;
    const double numbers[VEHICLE_NUMBERS] = {
        mass * height / inertia, 2 * PI * value[V_ACTUATOR_BANDWIDTH], ratio != 1 || curves[0] > 0, 0, 0, /* no semi-active dampers */
        1 / mass, 1 / mass, -front / inertia, rear / inertia, -front, rear,
        1 / value[V_FRONT_WHEEL_MASS], 1 / value[V_REAR_WHEEL_MASS], value[V_FRONT_SPRING], value[V_REAR_SPRING],
        rebound * value[V_FRONT_DAMPING], rebound * value[V_REAR_DAMPING],
        compression * value[V_FRONT_DAMPING], compression * value[V_REAR_DAMPING],
        clearance - lowered[0], clearance - lowered[1], clearance + lowered[0], clearance + lowered[1], stop, stop,
        value[V_FRONT_TYRE_STIFFNESS], value[V_REAR_TYRE_STIFFNESS],
        lifts > 0 ? -front_load : -INFINITY, lifts > 0 ? -rear_load : -INFINITY,
        share * value[V_ANTI_DIVE] * transfer, -(1 - share) * value[V_ANTI_LIFT] * transfer, 0, 0, 0, 0,
    };
    memcpy(to, numbers, sizeof numbers);
    memcpy(to + VEHICLE_NUMBERS - sizeof curves / sizeof *curves, curves, sizeof curves);
}

/* Drive from the last state to the next one in a step [s]; the signals before and after it. */
static void drive(const double *value, struct memory *me, const double *height, double step, double substeps,
                  double *next, double (*samples)[SIGNALS])
{
    int states = value[V_ACTUATOR_BANDWIDTH] > 0 ? LAGGING : STATE, width = states + FORCES;
    const double heights[2 * AXLES] = {me->height[0], height[0], me->height[1], height[1]};
    double rows[2 * (LAGGING + FORCES)] = {0}, *second = rows + width, by_signal[2 * SIGNALS];
    struct car *car = (struct car *)me->car;
    memcpy(rows, me->now, (size_t)states * sizeof(double));
    memcpy(rows + states, me->command, sizeof me->command);
    memcpy(second + states, value + V_FORCE_FRONT, FORCES * sizeof(double));
    ridelab_prepare_car(car, (const struct vehicle *)me->vehicle, states, 0, NULL, 0, NULL, NULL, heights,
                        value + V_BRAKING, 1, 1, (int)substeps, step, NULL);
    ridelab_drive(car, 0, rows, second + states, second);
    ridelab_sample(car, rows, 0, 1, samples, by_signal);
    memcpy(next, second, (size_t)states * sizeof(double));
}

static void show(double *value, const double *state, const double *sample)
{
    memcpy(value + V_STATE, state, STATE * sizeof(double));
    memcpy(value + V_BODY_ACCELERATION, sample + ACCELERATION, 2 * sizeof(double));
    memcpy(value + V_TYRE_LOAD_FRONT, sample + LOAD, 2 * sizeof(double));
    memcpy(value + V_DEFLECTION_FRONT, sample + TRAVEL_SIGNAL, 2 * sizeof(double));
    memcpy(value + V_ACTUATOR_FORCE_FRONT, sample + FORCE_SIGNAL, 2 * sizeof(double));
    value[V_PITCH_RATE] = state[5];
}

void model_begin(double *value, void *memory)
{
    struct memory *me = memory;
    double next[LAGGING], samples[2][SIGNALS];
    memset(me, 0, sizeof *me);
    fill_vehicle(value, me->vehicle);
    memcpy(me->height, value + V_ROAD_FRONT, sizeof me->height);
    drive(value, me, me->height, value[V_INTERNAL_STEP], 1, next, samples);
    show(value, me->now, samples[0]);
}

const char *model_step(double *value, void *memory, double time, double step)
{
    struct memory *me = memory;
    double next[LAGGING] = {0}, samples[2][SIGNALS], substeps = ceil(step / value[V_INTERNAL_STEP] * (1 - 1e-9));
    (void)time;
    if (!(substeps >= 1 && substeps <= MOST_SUBSTEPS))
        return "internal_step is no part of the step, or of a step that is too long";
    drive(value, me, value + V_ROAD_FRONT, step, substeps, next, samples);
    for (int i = 0; i < LAGGING; i++)
        if (!isfinite(next[i]))
            return "The vehicle's state is not finite";
    memcpy(me->now, next, sizeof next);
    memcpy(me->command, value + V_FORCE_FRONT, sizeof me->command);
    memcpy(me->height, value + V_ROAD_FRONT, sizeof me->height);
    show(value, next, samples[1]);
    return NULL;
}
