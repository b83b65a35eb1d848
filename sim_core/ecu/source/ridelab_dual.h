/* Dual active-set iterations (Goldfarb and Idnani 1983) on the rows' values alone. */
#ifndef RIDELAB_DUAL_H
#define RIDELAB_DUAL_H

#include "ridelab_tables.h"

/* A limit: |values[row]| <= bounds[row] + slack, at the side `sign`; or (row -1, sign 0) the slack of `axle` itself. */
typedef struct {
    int16_t row;
    int8_t sign;
    int8_t axle;
} ridelab_limit;

typedef struct {
    int32_t most;  /* limits that there is memory for */
    int32_t count; /* limits that bind */
    int32_t iterations;
    ridelab_real slacks[RIDELAB_AXLES]; /* [cm] */
    ridelab_limit *limits;              /* (most), as multipliers, direction, solved */
    ridelab_real *multipliers;
    ridelab_real *direction;
    ridelab_real *solved;
    ridelab_real *factor; /* (most, most): L below the diagonal, D on it */
} ridelab_dual;

/* Real numbers that it works in. */
#define RIDELAB_DUAL_WORK(most) ((most) * ((most) + 3))

/* Give it its memory: `most` limits, RIDELAB_DUAL_WORK(most) numbers. */
void ridelab_dual_init(ridelab_dual *me, int32_t most, ridelab_limit *limits, ridelab_real *work);

/* Moves `values` (rows) from the unconstrained optimum to the constrained one; returns the controller's flags. */
int32_t ridelab_dual_solve(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram,
                           ridelab_real *values);

ridelab_real ridelab_dual_slack(const ridelab_dual *me);

#endif
