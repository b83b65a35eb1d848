/* The half-car of kernel/car.c on a road that is straight within each communication step. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "loop.h"
#include "model.h"
#include "record.h"
#include "road.h"

/* As kernel/car.c has them. */
struct vehicle;
struct estimator;
enum { LAGGING = STATE + FORCES };
void ridelab_prepare_car(struct car *me, const struct vehicle *vehicle, int states, int linear,
                         const double (*effects)[LAGGING], int estimates, const struct estimator *estimator,
                         const double *estimator_input, const double *height, const double *braking,
                         const double *above_chord, int steps, int fine, int substeps, double time,
                         struct recorder *recorder);
int ridelab_size_of_vehicle(void);
int ridelab_size_of_curve_points(void);
void ridelab_sample(struct car *me, const double *loop, int first, int steps, double (*one)[SIGNALS], double *samples);

static const double STRAIGHT[2 * AXLES] = {0}; /* above its chord */
static const double MOST_SUBSTEPS = 1e6;

/* The value references that it wants, by the variables' names: of each the first of so many. */
#define VARIABLES(X)                                                                                                  \
    X(road_front, AXLES) X(force_front, FORCES) X(braking, 1) X(body_acceleration, 2) X(tyre_load_front, AXLES)       \
    X(deflection_front, AXLES) X(actuator_force_front, FORCES) X(pitch_rate, 1) X(body_mass, 1) X(pitch_inertia, 1)   \
    X(front_wheel_mass, 1) X(rear_wheel_mass, 1) X(cg_to_front, 1) X(cg_to_rear, 1) X(cg_height, 1)                   \
    X(front_spring, 1) X(rear_spring, 1) X(front_damping, 1) X(rear_damping, 1) X(front_tyre_stiffness, 1)            \
    X(rear_tyre_stiffness, 1) X(rebound_ratio, 1) X(bump_stop_clearance, 1) X(bump_stop_stiffness, 1)                 \
    X(tyre_lift_off, 1) X(anti_dive, 1) X(anti_lift, 1) X(front_brake_share, 1) X(actuator_bandwidth, 1)              \
    X(internal_step, 1)
#define PLACE(name, count) size_t name;
#define FIND(name, count) me->at.name = ridelab_place(from, #name, count);
#define V(name) value[me->at.name]

struct memory {
    double height[AXLES];                 /* of the road at the end of the last step [m] */
    double now[LAGGING], command[FORCES]; /* the state then, and the command until then */
    double car[RIDELAB_PREPARED / sizeof(double)];
    struct {
        size_t state;
        VARIABLES(PLACE)
    } at;
    const double *lowered; /* how much further than the believed car's its body's weight compresses front and rear [m] */
    const double *curves;  /* of each damper: how many points its curve has, 0 for none; velocities [m/s]; forces [N] */
    double vehicle[];      /* struct vehicle: its own numbers, then the curves */
};
enum { OWN_NUMBERS = 35 };

void *model_prepare(struct resources *from)
{
    int numbers = ridelab_size_of_vehicle(), most = ridelab_size_of_curve_points(), curve = 1 + 2 * most;
    struct memory *me = calloc(1, sizeof *me + (size_t)numbers * sizeof(double));
    if (!me)
        return NULL;
    me->at.state = ridelab_place(from, "state[1]", STATE);
    VARIABLES(FIND)
    me->lowered = ridelab_take(from, AXLES);
    me->curves = ridelab_take(from, (size_t)(AXLES * curve));
    from->damaged |= numbers != OWN_NUMBERS + AXLES * curve;
    for (int axle = 0; me->curves && axle < AXLES; axle++)
        from->damaged |= !(me->curves[axle * curve] >= 0 && me->curves[axle * curve] <= most);
    return me;
}

/* `struct vehicle` of kernel/car.c, as sim_core/vehicle/make.py fills it. */
static void fill_vehicle(struct memory *me, const double *value)
{
    static const double PI = 3.14159265358979323846, GRAVITY = 9.80665;
    double mass = V(body_mass), inertia = V(pitch_inertia), height = V(cg_height);
    double front = V(cg_to_front), rear = V(cg_to_rear), wheelbase = front + rear;
    double ratio = V(rebound_ratio), compression = 2 / (1 + ratio), rebound = compression * ratio;
    double clearance = V(bump_stop_clearance) > 0 ? V(bump_stop_clearance) : INFINITY;
    double stop = V(bump_stop_stiffness), transfer = mass * height / wheelbase, body = mass * GRAVITY / wheelbase;
    double lifts = V(tyre_lift_off), share = V(front_brake_share);
    double front_load = body * rear + V(front_wheel_mass) * GRAVITY;
    double rear_load = body * front + V(rear_wheel_mass) * GRAVITY;
    const double *lowered = me->lowered, numbers[OWN_NUMBERS] = {
        mass * height / inertia, 2 * PI * V(actuator_bandwidth), ratio != 1 || me->curves[0] > 0, 0, 0, /* no semi-active dampers */
        1 / mass, 1 / mass, -front / inertia, rear / inertia, -front, rear,
        1 / V(front_wheel_mass), 1 / V(rear_wheel_mass), V(front_spring), V(rear_spring),
        rebound * V(front_damping), rebound * V(rear_damping),
        compression * V(front_damping), compression * V(rear_damping),
        clearance - lowered[0], clearance - lowered[1], clearance + lowered[0], clearance + lowered[1], stop, stop,
        V(front_tyre_stiffness), V(rear_tyre_stiffness),
        lifts > 0 ? -front_load : -INFINITY, lifts > 0 ? -rear_load : -INFINITY,
        share * V(anti_dive) * transfer, -(1 - share) * V(anti_lift) * transfer, 0, 0, 0, 0,
    };
    memcpy(me->vehicle, numbers, sizeof numbers);
    memcpy(me->vehicle + OWN_NUMBERS, me->curves, sizeof(double) * (size_t)(ridelab_size_of_vehicle() - OWN_NUMBERS));
}

/* Drive from the last state to the next one in a step [s]; the signals before and after it. */
static void drive(const double *value, struct memory *me, const double *height, double step, double substeps,
                  double *next, double (*samples)[SIGNALS])
{
    int states = V(actuator_bandwidth) > 0 ? LAGGING : STATE, width = states + FORCES;
    const double heights[2 * AXLES] = {me->height[0], height[0], me->height[1], height[1]};
    double rows[2 * (LAGGING + FORCES)] = {0}, *second = rows + width, by_signal[2 * SIGNALS];
    struct car *car = (struct car *)me->car;
    memcpy(rows, me->now, (size_t)states * sizeof(double));
    memcpy(rows + states, me->command, sizeof me->command);
    memcpy(second + states, value + me->at.force_front, FORCES * sizeof(double));
    ridelab_prepare_car(car, (const struct vehicle *)me->vehicle, states, 0, NULL, 0, NULL, NULL, heights,
                        value + me->at.braking, STRAIGHT, 1, 1, (int)substeps, step, NULL);
    ridelab_drive(car, 0, rows, second + states, second);
    ridelab_sample(car, rows, 0, 1, samples, by_signal);
    memcpy(next, second, (size_t)states * sizeof(double));
}

static void show(const struct memory *me, double *value, const double *state, const double *sample)
{
    memcpy(value + me->at.state, state, STATE * sizeof(double));
    memcpy(value + me->at.body_acceleration, sample + ACCELERATION, 2 * sizeof(double));
    memcpy(value + me->at.tyre_load_front, sample + LOAD, 2 * sizeof(double));
    memcpy(value + me->at.deflection_front, sample + TRAVEL_SIGNAL, 2 * sizeof(double));
    memcpy(value + me->at.actuator_force_front, sample + FORCE_SIGNAL, 2 * sizeof(double));
    V(pitch_rate) = state[5];
}

void model_begin(double *value, void *memory)
{
    struct memory *me = memory;
    double next[LAGGING], samples[2][SIGNALS];
    memset(me->now, 0, sizeof me->now);
    memset(me->command, 0, sizeof me->command);
    fill_vehicle(me, value);
    memcpy(me->height, value + me->at.road_front, sizeof me->height);
    drive(value, me, me->height, V(internal_step), 1, next, samples);
    show(me, value, me->now, samples[0]);
}

const char *model_step(double *value, void *memory, double time, double step)
{
    struct memory *me = memory;
    double next[LAGGING] = {0}, samples[2][SIGNALS], substeps = ceil(step / V(internal_step) * (1 - 1e-9));
    (void)time;
    if (!(substeps >= 1 && substeps <= MOST_SUBSTEPS))
        return "internal_step is no part of the step, or of a step that is too long";
    drive(value, me, value + me->at.road_front, step, substeps, next, samples);
    for (int i = 0; i < LAGGING; i++)
        if (!isfinite(next[i]))
            return "The vehicle's state is not finite";
    memcpy(me->now, next, sizeof next);
    memcpy(me->command, value + me->at.force_front, sizeof me->command);
    memcpy(me->height, value + me->at.road_front, sizeof me->height);
    show(me, value, next, samples[1]);
    return NULL;
}
