/* A linear law of control and its greatest force. */
#include "sampled.h"
#include "ridelab_gains.h" /* generated: on what is previewed */

enum { STATES = 8, FORCES = 2, ON_STATE = STATES + FORCES, GAINS = V_FORCE_LIMIT + 1 };

const size_t model_memory_bytes = sizeof(struct control_steps);

static void control(double *value)
{
    double force[FORCES], limit = value[V_FORCE_LIMIT];
#if LAWS > 1
    int law = (int)value[V_STAGE];
#else
    int law = 0;
#endif
#if PREVIEWED > 0
    double disturbances[3 * PREVIEWED];
    expected(value, disturbances);
#endif
    for (int axle = 0; axle < FORCES; axle++) {
        const double *gain = value + GAINS + ON_STATE * (FORCES * law + axle);
        force[axle] = 0;
        for (int i = 0; i < STATES; i++)
            force[axle] += gain[i] * value[V_STATE + i];
        for (int i = 0; i < FORCES; i++)
            force[axle] += gain[STATES + i] * value[V_FORCE_FRONT + i];
#if PREVIEWED > 0
        for (int i = 0; i < 3 * PREVIEWED; i++)
            force[axle] += preview_gain[law][axle][i] * disturbances[i];
#endif
    }
    for (int axle = 0; axle < FORCES; axle++)
        value[V_FORCE_FRONT + axle] = force[axle] > limit ? limit : force[axle] < -limit ? -limit : force[axle];
}

void model_begin(double *value, void *memory)
{
    (void)value;
    (void)memory;
}

const char *model_step(double *value, void *memory, double time, double step)
{
#if LAWS > 1
    if (!(value[V_STAGE] >= 0 && value[V_STAGE] < LAWS))
        return "The stage is 0 (cruise), 1 (brake) or 2 (bump)";
#endif
    if (step > MOST_CONTROL_STEPS * SAMPLE_TIME)
        return "The step is longer than 100000 control steps";
    while (next_control_step(memory, time, step))
        control(value);
    return NULL;
}
