/* Active suspension controller: one call a control step. No dynamic memory, no recursion, every loop bounded. */
#ifndef RIDELAB_CONTROLLER_H
#define RIDELAB_CONTROLLER_H

#include "ridelab_dual.h"
#include "ridelab_tables.h"

/* Codes that tell of so many intervals; numbers that the controller of such tables works in. */
#define RIDELAB_CODES(previewed) (RIDELAB_STATES + RIDELAB_PREVIEWED * (previewed))
#define RIDELAB_COLUMNS(intervals) (RIDELAB_STATES + RIDELAB_FORCES + RIDELAB_PREVIEWED * (intervals))
#define RIDELAB_WORK(intervals, rows, active) (RIDELAB_COLUMNS(intervals) + (rows) + RIDELAB_DUAL_WORK(active))

#define RIDELAB_MISUSE (-1)    /* the stage is none */
#define RIDELAB_LIMITED 1      /* flag: a limit shaped the commands */
#define RIDELAB_UNFINISHED 2   /* flag: the solver's iterations ran out; the commands are clipped */

typedef struct {
    int32_t stage; /* 0 cruise, 1 brake, 2 bump */
    /* What the converters measured: deflections of suspension and tyre, body velocity, pitch rate, wheel velocities;
       then for each interval ahead the front road's velocity, the rear's, and the deceleration, one after the other. */
    const int32_t *codes;
} ridelab_input;

typedef struct {
    int32_t commands[RIDELAB_FORCES]; /* codes, front and rear */
    int32_t iterations;
    float slack; /* largest predicted deflection beyond the limit [cm] */
} ridelab_output;

typedef struct {
    const ridelab_tables *tables;
    float previous[RIDELAB_FORCES]; /* last command [kN] */
    float *given;                   /* (columns) */
    float *values;                  /* (rows) */
    ridelab_dual dual;
} ridelab_controller;

/* Give it its tables and its memory: `active` limits, RIDELAB_WORK(intervals, rows, active) numbers. */
void ridelab_init(ridelab_controller *me, const ridelab_tables *tables, ridelab_limit *limits, float *work);

/* Returns RIDELAB_MISUSE, or flags. */
int32_t ridelab_step(ridelab_controller *me, const ridelab_input *input, ridelab_output *output);

#endif
