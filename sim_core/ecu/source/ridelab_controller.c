#include "ridelab_controller.h"

#include "ridelab_count.h"

static float product(const float *left, const float *right, int32_t count)
{
    float sum = 0.0f;
    RIDELAB_COUNT(count);
    for (int32_t i = 0; i < count; i++) {
        sum += left[i] * right[i];
    }
    return sum;
}

/* The state when this step's command takes effect, one step after it was measured. */
static void predict(const ridelab_tables *tables, float *state, const float *force, const float *disturbance)
{
    float next[RIDELAB_STATES];
    for (int32_t i = 0; i < RIDELAB_STATES; i++) {
        next[i] = product(&tables->a[i * RIDELAB_STATES], state, RIDELAB_STATES)
                  + product(&tables->b[i * RIDELAB_FORCES], force, RIDELAB_FORCES)
                  + product(&tables->e[i * RIDELAB_PREVIEWED], disturbance, RIDELAB_PREVIEWED);
    }
    for (int32_t i = 0; i < RIDELAB_STATES; i++) {
        state[i] = next[i];
    }
}

/* Codes into `given`: the state, the previous command, the preview of Np intervals. */
static void read_input(ridelab_controller *me, const ridelab_input *input)
{
    const ridelab_tables *tables = me->tables;
    const int32_t skipped = tables->previewed - tables->intervals;
    float first[RIDELAB_PREVIEWED];
    float *next = &me->given[RIDELAB_STATES + RIDELAB_FORCES];
    for (int32_t i = 0; i < RIDELAB_STATES; i++) {
        me->given[i] = (float)input->codes[i] * tables->input_steps[i];
    }
    for (int32_t i = 0; i < RIDELAB_FORCES; i++) {
        me->given[RIDELAB_STATES + i] = me->previous[i];
    }
    for (int32_t i = 0; i < RIDELAB_PREVIEWED; i++) {
        const int32_t *codes = &input->codes[RIDELAB_STATES + i * tables->previewed];
        const float step = tables->input_steps[RIDELAB_STATES + i];
        first[i] = (float)codes[0] * step;
        for (int32_t j = skipped; j < tables->previewed; j++) {
            *next = (float)codes[j] * step;
            next++;
        }
    }
    RIDELAB_COUNT(RIDELAB_STATES + RIDELAB_PREVIEWED * tables->previewed);
    if (tables->predicts != 0) {
        predict(tables, me->given, me->previous, first);
    }
}

/* A force [kN] to the nearest code within the limit, and what it then stands for. */
static int32_t write_command(const ridelab_tables *tables, float force, float *sent)
{
    float steps = force / tables->command_step;
    const float highest = (float)tables->highest;
    int32_t code;
    if (!(steps > -highest)) { /* a NaN too ends at a limit */
        steps = -highest;
    }
    if (steps > highest) {
        steps = highest;
    }
    code = (int32_t)(steps < 0.0f ? steps - 0.5f : steps + 0.5f);
    *sent = (float)code * tables->command_step;
    return code;
}

void ridelab_init(ridelab_controller *me, const ridelab_tables *tables, ridelab_limit *limits, float *work)
{
    me->tables = tables;
    me->given = work;
    me->values = work + RIDELAB_COLUMNS(tables->intervals);
    ridelab_dual_init(&me->dual, tables->active, limits, me->values + tables->rows);
    for (int32_t i = 0; i < RIDELAB_FORCES; i++) {
        me->previous[i] = 0.0f;
    }
}

int32_t ridelab_step(ridelab_controller *me, const ridelab_input *input, ridelab_output *output)
{
    const ridelab_tables *tables = me->tables;
    const int32_t columns = RIDELAB_COLUMNS(tables->intervals);
    int32_t flags;
    if (input->stage < 0 || input->stage >= RIDELAB_STAGES) {
        return RIDELAB_MISUSE;
    }
    read_input(me, input);
    for (int32_t row = 0; row < tables->rows; row++) {
        me->values[row] = product(&tables->effects[input->stage][row * columns], me->given, columns);
    }
    flags = ridelab_dual_solve(&me->dual, tables, tables->gram[input->stage], me->values);
    for (int32_t i = 0; i < RIDELAB_FORCES; i++) {
        output->commands[i] = write_command(tables, me->values[i], &me->previous[i]);
    }
    output->iterations = me->dual.iterations;
    output->slack = ridelab_dual_slack(&me->dual);
    return flags;
}
