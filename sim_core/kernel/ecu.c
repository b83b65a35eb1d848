/* The ECU's program (sim_core/ecu/source) in this process. Its only memory from step to step is the previous command. */

#include <stdint.h>
#include <string.h>

/* It counts its operations, of each thread by themselves. */
#define RIDELAB_COUNT_H
#define RIDELAB_COUNT(operations) (counted += (operations))
static _Thread_local int32_t counted;

#include "../ecu/source/ridelab_controller.c"
#include "../ecu/source/ridelab_dual.c"

enum { MOST_PREVIEWED = 201, MOST_ROWS = 600, MOST_ACTIVE = 44 };

/* One step; RIDELAB_MISUSE where the tables or the stage are none, else 0.

   sizes      intervals, previewed, rows, predicts, iterations, highest, active
   real       command_step, slack_price, inverse_slack_weight
   vehicle    input_steps (11), a (8, 8), b (8, 2), e (8, 3)
   bounds, axles   (rows)
   effects    (stages, rows, 10 + 3 intervals)
   gram       (stages, rows, rows)
   previous   (2): the last command [kN], before and after
   codes      (8 + 3 previewed)
   answer     two commands, whether a limit shaped them, iterations, whether these ran out, operations
   slack      (1) [cm] */
int ridelab_ecu_step(const int32_t *sizes, const float *real, const float *vehicle, const float *bounds,
                     const int8_t *axles, const float *effects, const float *gram, float *previous, const int32_t *codes,
                     int32_t *answer, float *slack, int stage)
{
    size_t rows = (size_t)sizes[2], columns = (size_t)RIDELAB_COLUMNS(sizes[0]);
    ridelab_tables tables = {
        .intervals = sizes[0], .previewed = sizes[1], .rows = sizes[2], .predicts = sizes[3], .iterations = sizes[4],
        .highest = sizes[5], .active = sizes[6], .command_step = real[0], .slack_price = real[1],
        .inverse_slack_weight = real[2], .input_steps = vehicle, .a = vehicle + 11, .b = vehicle + 75, .e = vehicle + 91,
        .bounds = bounds, .axles = axles,
    };
    ridelab_controller controller;
    ridelab_input input = {.stage = stage, .codes = codes};
    ridelab_output output;
    ridelab_limit limits[MOST_ACTIVE];
    float work[RIDELAB_WORK(MOST_PREVIEWED, MOST_ROWS, MOST_ACTIVE)];
    if (sizes[0] < 1 || sizes[1] < sizes[0] || sizes[1] > MOST_PREVIEWED || sizes[2] < RIDELAB_FORCES ||
        sizes[2] > MOST_ROWS || sizes[4] < 0 || sizes[6] < RIDELAB_AXLES || sizes[6] > MOST_ACTIVE)
        return RIDELAB_MISUSE;
    for (size_t i = 0; i < RIDELAB_STAGES; i++) {
        tables.effects[i] = effects + i * rows * columns;
        tables.gram[i] = gram + i * rows * rows;
    }
    ridelab_init(&controller, &tables, limits, work);
    counted = 0;
    memcpy(controller.previous, previous, sizeof controller.previous);
    int32_t flags = ridelab_step(&controller, &input, &output);
    if (flags < 0)
        return RIDELAB_MISUSE;
    memcpy(previous, controller.previous, sizeof controller.previous);
    memcpy(answer, output.commands, sizeof output.commands);
    answer[2] = (flags & RIDELAB_LIMITED) != 0;
    answer[3] = output.iterations;
    answer[4] = (flags & RIDELAB_UNFINISHED) != 0;
    answer[5] = counted;
    *slack = output.slack;
    return 0;
}
