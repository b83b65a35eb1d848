/* Tables loaded at the start, as a calibration is flashed: one program then serves every scenario. */
#include <stdio.h>

#include "ridelab_controller.h"
#include "ridelab_prepare.h"

static ridelab_tables tables;
static float vehicle[11 + 8 * 8 + 8 * 2 + 8 * 3];
static float bounds[RIDELAB_MOST_ROWS];
static int8_t axles[RIDELAB_MOST_ROWS];
static float effects[RIDELAB_STAGES][RIDELAB_MOST_ROWS * RIDELAB_COLUMNS];
static float gram[RIDELAB_STAGES][RIDELAB_MOST_ROWS * RIDELAB_MOST_ROWS];

static int taken(void *place, size_t size, size_t count)
{
    return fread(place, size, count, stdin) == count;
}

static int take_sizes(uint32_t *fingerprint)
{
    int32_t whole[6];
    float real[3];
    if (!taken(fingerprint, sizeof *fingerprint, 1) || !taken(whole, sizeof whole[0], 6)
        || !taken(real, sizeof real[0], 3)) {
        return 0;
    }
    tables.intervals = whole[0];
    tables.previewed = whole[1];
    tables.rows = whole[2];
    tables.predicts = whole[3];
    tables.iterations = whole[4];
    tables.highest = whole[5];
    tables.command_step = real[0];
    tables.slack_price = real[1];
    tables.inverse_slack_weight = real[2];
    return tables.intervals >= 1 && tables.previewed >= tables.intervals && tables.previewed <= RIDELAB_MOST_PREVIEWED
           && tables.rows >= RIDELAB_FORCES && tables.rows <= RIDELAB_MOST_ROWS && tables.iterations >= 0;
}

const ridelab_tables *ridelab_prepare(uint32_t *fingerprint)
{
    size_t rows;
    size_t columns;
    if (!take_sizes(fingerprint)) {
        return NULL;
    }
    rows = (size_t)tables.rows;
    columns = (size_t)(RIDELAB_STATES + RIDELAB_FORCES + RIDELAB_PREVIEWED * tables.intervals);
    if (!taken(vehicle, sizeof vehicle[0], 115) || !taken(bounds, sizeof bounds[0], rows)
        || !taken(axles, sizeof axles[0], rows)) {
        return NULL;
    }
    tables.input_steps = vehicle;
    tables.a = &vehicle[11];
    tables.b = &vehicle[75];
    tables.e = &vehicle[91];
    tables.bounds = bounds;
    tables.axles = axles;
    for (int stage = 0; stage < RIDELAB_STAGES; stage++) {
        if (!taken(effects[stage], sizeof effects[0][0], rows * columns)
            || !taken(gram[stage], sizeof gram[0][0], rows * rows)) {
            return NULL;
        }
        tables.effects[stage] = effects[stage];
        tables.gram[stage] = gram[stage];
    }
    return &tables;
}
