/* A linear law of control and its greatest force. */
#include <stdlib.h>

#include "sampled.h"

enum { STATES = 8, FORCES = 2, ON_STATE = STATES + FORCES, DISTURBANCES = 3, MOST_LAWS = 3 };

struct memory {
    struct control_steps steps;
    struct preview preview;
    int laws;                                 /* one, or of each stage one */
    size_t stage, state, force, limit, gains; /* value references, of each the first; one law has no stage */
    const double *preview_gain;               /* laws x FORCES x (DISTURBANCES preview.steps) */
};

void *model_prepare(struct resources *from)
{
    struct memory *me = calloc(1, sizeof *me);
    if (!me)
        return NULL;
    me->laws = ridelab_take_whole(from, 1, MOST_LAWS);
    me->preview = find_preview(from);
    const double *sample_time = ridelab_take(from, 1);
    me->steps.sample_time = sample_time ? *sample_time : 0;
    me->preview_gain = ridelab_take(from, (size_t)(me->laws * FORCES * DISTURBANCES * me->preview.steps));
    me->stage = me->laws > 1 ? ridelab_place(from, "stage", 1) : 0;
    me->state = ridelab_place(from, "state[1]", STATES);
    me->force = ridelab_place(from, "force_front", FORCES);
    me->limit = ridelab_place(from, "force_limit", (size_t)(1 + me->laws * FORCES * ON_STATE));
    me->gains = me->limit + 1;
    return me;
}

static void control(const struct memory *me, double *value)
{
    double force[FORCES], limit = value[me->limit], disturbances[DISTURBANCES * MOST_PREVIEWED];
    int law = me->laws > 1 ? (int)value[me->stage] : 0, previewed = DISTURBANCES * me->preview.steps;
    expected(&me->preview, value, me->steps.sample_time, disturbances);
    for (int axle = 0; axle < FORCES; axle++) {
        const double *gain = value + me->gains + ON_STATE * (FORCES * law + axle);
        const double *preview_gain = me->preview_gain + previewed * (FORCES * law + axle);
        force[axle] = 0;
        for (int i = 0; i < STATES; i++)
            force[axle] += gain[i] * value[me->state + (size_t)i];
        for (int i = 0; i < FORCES; i++)
            force[axle] += gain[STATES + i] * value[me->force + (size_t)i];
        for (int i = 0; i < previewed; i++)
            force[axle] += preview_gain[i] * disturbances[i];
    }
    for (int axle = 0; axle < FORCES; axle++)
        value[me->force + (size_t)axle] = force[axle] > limit ? limit : force[axle] < -limit ? -limit : force[axle];
}

void model_begin(double *value, void *memory)
{
    struct memory *me = memory;
    (void)value;
    me->steps.count = 0;
}

const char *model_step(double *value, void *memory, double time, double step)
{
    struct memory *me = memory;
    if (me->laws > 1 && !(value[me->stage] >= 0 && value[me->stage] < me->laws))
        return "The stage is 0 (cruise), 1 (brake) or 2 (bump)";
    if (step > MOST_CONTROL_STEPS * me->steps.sample_time)
        return "The step is longer than 100000 control steps";
    while (next_control_step(&me->steps, time, step))
        control(me, value);
    return NULL;
}
