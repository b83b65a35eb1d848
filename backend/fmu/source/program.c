/* The ECU's program behind its converters: in every control step the inputs become codes, and codes the forces. */
#include <math.h>

#include "ridelab_calibration.h"
#include "ridelab_controller.h"
#include "ridelab_converters.h" /* generated: full_scale, of the states and of what is previewed */
#include "sampled.h"

struct memory {
    struct control_steps steps;
    ridelab_tables tables;
    ridelab_controller controller;
};
const size_t model_memory_bytes = sizeof(struct memory);

static int32_t code(double value, double full_scale)
{
    double highest = ridelab_calibration.highest, steps = rint(value / full_scale * highest);
    return (int32_t)(steps > highest ? highest : steps < -highest ? -highest : steps);
}

void model_begin(double *value, void *memory)
{
    struct memory *me = memory;
    me->tables = ridelab_calibration;
    me->tables.iterations = (int32_t)value[V_ITERATIONS];
    ridelab_init(&me->controller, &me->tables);
}

const char *model_step(double *value, void *memory, double time, double step)
{
    struct memory *me = memory;
    ridelab_input input = {.stage = (int32_t)value[V_STAGE]};
    ridelab_output output;
    double disturbances[RIDELAB_PREVIEWED * PREVIEWED];
    if (step > MOST_CONTROL_STEPS * SAMPLE_TIME)
        return "The step is longer than 100000 control steps";
    for (int i = 0; i < RIDELAB_STATES; i++)
        input.codes[i] = code(value[V_STATE + i], full_scale[i]);
    expected(value, disturbances);
    for (int i = 0; i < RIDELAB_PREVIEWED * PREVIEWED; i++)
        input.codes[RIDELAB_STATES + i] = code(disturbances[i], full_scale[RIDELAB_STATES + i / PREVIEWED]);
    while (next_control_step(&me->steps, time, step)) {
        if (ridelab_step(&me->controller, &input, &output) < 0)
            return "The stage is 0 (cruise), 1 (brake) or 2 (bump)";
        for (int axle = 0; axle < RIDELAB_FORCES; axle++)
            value[V_FORCE_FRONT + axle] = output.commands[axle] * FORCE_OF_CODE;
    }
    return NULL;
}
