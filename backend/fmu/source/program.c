/* The ECU's program behind its converters: in every control step the inputs become codes, and codes the forces. */
#include <math.h>
#include <stdlib.h>

#include "ridelab_controller.h"
#include "sampled.h"

enum { MEASURED = RIDELAB_STATES + RIDELAB_PREVIEWED, MOST_ITERATIONS = 1000000, MOST_CODE = 1 << 24 };
enum { MOST_INTERVALS = 200, MOST_ROWS = 600, MOST_ACTIVE = 44 }; /* as kernel/ecu.c has them */

struct memory {
    struct control_steps steps;
    struct preview preview;
    size_t stage, state, force, iterations; /* value references, of each the first */
    double force_of_code;                   /* [N] */
    const double *full_scale;               /* MEASURED: of the states and of what is previewed */
    ridelab_tables tables;
    ridelab_controller controller;
    int8_t axles[MOST_ROWS];
    int32_t codes[RIDELAB_CODES(MOST_INTERVALS + 1)];
    ridelab_limit limits[MOST_ACTIVE];
    float work[RIDELAB_WORK(MOST_INTERVALS, MOST_ROWS, MOST_ACTIVE)];
    float *last, real[]; /* the one behind those that were taken, and all in single precision */
};

/* The next numbers in single precision. */
static const float *take_single(struct memory *me, struct resources *from, size_t count)
{
    const double *number = ridelab_take(from, count);
    float *first = me->last;
    for (size_t i = 0; number && i < count; i++)
        *me->last++ = (float)number[i];
    return first;
}

static void take_tables(struct memory *me, struct resources *from)
{
    ridelab_tables *to = &me->tables;
    to->intervals = ridelab_take_whole(from, 1, MOST_INTERVALS);
    to->rows = ridelab_take_whole(from, RIDELAB_FORCES, MOST_ROWS);
    to->active = ridelab_take_whole(from, RIDELAB_AXLES, MOST_ACTIVE);
    to->predicts = ridelab_take_whole(from, 0, 1);
    to->highest = ridelab_take_whole(from, 1, MOST_CODE);
    to->previewed = me->preview.steps;
    from->damaged |= to->previewed != to->intervals + to->predicts;
    for (int32_t row = 0; row < to->rows; row++)
        me->axles[row] = (int8_t)ridelab_take_whole(from, -1, RIDELAB_AXLES - 1);
    to->axles = me->axles;
    const float *single = take_single(me, from, 3);
    to->command_step = single[0];
    to->slack_price = single[1];
    to->inverse_slack_weight = single[2];
    to->input_steps = take_single(me, from, MEASURED);
    to->a = take_single(me, from, RIDELAB_STATES * RIDELAB_STATES);
    to->b = take_single(me, from, RIDELAB_STATES * RIDELAB_FORCES);
    to->e = take_single(me, from, RIDELAB_STATES * RIDELAB_PREVIEWED);
    to->bounds = take_single(me, from, (size_t)to->rows);
    for (int stage = 0; stage < RIDELAB_STAGES; stage++) {
        to->effects[stage] = take_single(me, from, (size_t)(to->rows * RIDELAB_COLUMNS(to->intervals)));
        to->gram[stage] = take_single(me, from, (size_t)(to->rows * to->rows));
    }
}

void *model_prepare(struct resources *from)
{
    struct memory *me = calloc(1, sizeof *me + (from->count - from->taken + 3) * sizeof(float));
    if (!me)
        return NULL;
    me->last = me->real;
    me->preview = find_preview(from);
    from->damaged |= me->preview.steps > MOST_INTERVALS + 1;
    const double *sample_time = ridelab_take(from, 1), *force_of_code = ridelab_take(from, 1);
    me->steps.sample_time = sample_time ? *sample_time : 0;
    me->force_of_code = force_of_code ? *force_of_code : 0;
    me->full_scale = ridelab_take(from, MEASURED);
    take_tables(me, from);
    me->stage = ridelab_place(from, "stage", 1);
    me->state = ridelab_place(from, "state[1]", RIDELAB_STATES);
    me->force = ridelab_place(from, "force_front", RIDELAB_FORCES);
    me->iterations = ridelab_place(from, "iterations", 1);
    return me;
}

static int32_t code(const struct memory *me, double value, double full_scale)
{
    double highest = me->tables.highest, steps = rint(value / full_scale * highest);
    return (int32_t)(steps > highest ? highest : steps < -highest ? -highest : steps);
}

void model_begin(double *value, void *memory)
{
    struct memory *me = memory;
    double most = value[me->iterations];
    me->tables.iterations = (int32_t)(most < 0 ? 0 : most > MOST_ITERATIONS ? MOST_ITERATIONS : most);
    me->steps.count = 0;
    ridelab_init(&me->controller, &me->tables, me->limits, me->work);
}

const char *model_step(double *value, void *memory, double time, double step)
{
    struct memory *me = memory;
    ridelab_input input = {.stage = (int32_t)value[me->stage], .codes = me->codes};
    ridelab_output output;
    double disturbances[RIDELAB_PREVIEWED * (MOST_INTERVALS + 1)];
    int previewed = me->preview.steps;
    if (step > MOST_CONTROL_STEPS * me->steps.sample_time)
        return "The step is longer than 100000 control steps";
    for (int i = 0; i < RIDELAB_STATES; i++)
        me->codes[i] = code(me, value[me->state + (size_t)i], me->full_scale[i]);
    expected(&me->preview, value, me->steps.sample_time, disturbances);
    for (int i = 0; i < RIDELAB_PREVIEWED * previewed; i++)
        me->codes[RIDELAB_STATES + i] = code(me, disturbances[i], me->full_scale[RIDELAB_STATES + i / previewed]);
    while (next_control_step(&me->steps, time, step)) {
        if (ridelab_step(&me->controller, &input, &output) < 0)
            return "The stage is 0 (cruise), 1 (brake) or 2 (bump)";
        for (int axle = 0; axle < RIDELAB_FORCES; axle++)
            value[me->force + (size_t)axle] = output.commands[axle] * me->force_of_code;
    }
    return NULL;
}
