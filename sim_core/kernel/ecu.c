/* The ECU's program (sim_core/ecu/source) in this process. Its only memory from step to step is the previous command. */

#include <stdint.h>
#include <string.h>

#include "../ecu/source/ridelab_controller.h"

/* One step; RIDELAB_MISUSE where the tables or the stage are none, else 0.

   sizes      intervals, previewed, rows, predicts, iterations, highest
   real       command_step, slack_price, inverse_slack_weight
   vehicle    input_steps (11), a (8, 8), b (8, 2), e (8, 3)
   bounds, axles   (rows)
   effects    (stages, rows, 10 + 3 intervals)
   gram       (stages, rows, rows)
   previous   (2): the last command [kN], before and after
   codes      (8 + 3 previewed)
   answer     two commands, whether a limit shaped them, iterations, whether these ran out
   slack      (1) [cm] */
int ridelab_ecu_step(const int32_t *sizes, const float *real, const float *vehicle, const float *bounds,
                     const int8_t *axles, const float *effects, const float *gram, float *previous, const int32_t *codes,
                     int32_t *answer, float *slack, int stage)
{
    size_t rows = (size_t)sizes[2], columns = (size_t)(RIDELAB_STATES + RIDELAB_FORCES + RIDELAB_PREVIEWED * sizes[0]);
    ridelab_tables tables = {
        .intervals = sizes[0], .previewed = sizes[1], .rows = sizes[2], .predicts = sizes[3], .iterations = sizes[4],
        .highest = sizes[5], .command_step = real[0], .slack_price = real[1], .inverse_slack_weight = real[2],
        .input_steps = vehicle, .a = vehicle + 11, .b = vehicle + 75, .e = vehicle + 91, .bounds = bounds,
        .axles = axles,
    };
    ridelab_controller controller;
    ridelab_input input = {.stage = stage};
    ridelab_output output;
    if (sizes[0] < 1 || sizes[1] < sizes[0] || sizes[1] > RIDELAB_MOST_PREVIEWED || sizes[2] < RIDELAB_FORCES ||
        sizes[2] > RIDELAB_MOST_ROWS || sizes[4] < 0)
        return RIDELAB_MISUSE;
    for (size_t i = 0; i < RIDELAB_STAGES; i++) {
        tables.effects[i] = effects + i * rows * columns;
        tables.gram[i] = gram + i * rows * rows;
    }
    memcpy(input.codes, codes, (size_t)(RIDELAB_STATES + RIDELAB_PREVIEWED * sizes[1]) * sizeof codes[0]);
    ridelab_init(&controller, &tables);
    memcpy(controller.previous, previous, sizeof controller.previous);
    int32_t flags = ridelab_step(&controller, &input, &output);
    if (flags < 0)
        return RIDELAB_MISUSE;
    memcpy(previous, controller.previous, sizeof controller.previous);
    memcpy(answer, output.commands, sizeof output.commands);
    answer[2] = (flags & RIDELAB_LIMITED) != 0;
    answer[3] = output.iterations;
    answer[4] = (flags & RIDELAB_UNFINISHED) != 0;
    *slack = output.slack;
    return 0;
}
