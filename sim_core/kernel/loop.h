/* Controller and car over many control steps, as long as a linear law of control holds. */
#ifndef RIDELAB_LOOP_H
#define RIDELAB_LOOP_H

#include "numbers.h"
#include "qp.h"

/* All numbers, as they come from outside. */
struct law_numbers {
    double kind_stride, step_stride; /* in `preview`: from one kind of disturbance, one control step, to the next */
    double steps;                    /* of the run */
    double clips;                    /* 1 where a force beyond the limit is clipped, 0 where the law does not decide it */
    double force_limits[3];          /* of the law, of the actuators' change in a step, of the actuators [N] */
};

/* What bounds GROUP rows of the limits: of each the gains on state and force, and the norms of its other parts on what
   `preview_norms` measures; then the largest of these rows' norms. */
struct row_bounds {
    double gains[INPUTS][GROUP], norms[NORMS - 1][GROUP], largest[NORMS];
};

/* u = gain [state; previous force; preview], where each of the limits' rows is between -1 and 1. */
struct law_design {
    int rows, horizon, columns; /* of the limits; steps previewed; INPUTS + 3 horizon */
    const double *gain;         /* 2 x columns */
    const double *limits;       /* rows x columns */
    const double *scale;        /* INPUTS: of the state and the previous force, where `bounds` have them together */
    const struct row_bounds *bounds; /* of each GROUP rows */
};

/* What all laws of a run share. */
struct run_inputs {
    const struct law_numbers *numbers;
    const double *preview;       /* both road velocities and the deceleration in each coming step */
    const double *preview_norms; /* 4 x steps: of the mean deceleration previewed, both velocities, its difference */
    double *inputs;              /* that a law multiplies in the present step */
};

/* A half-car on its road (car.c). */
struct car;

/* Numbers of its state. */
int ridelab_car_size(const struct car *car);

/* Its state at the end of a control step from what it is now, and the command [N]; a recorder measures the step. */
void ridelab_drive(struct car *car, int step, const double *now, const double *command, double *next);

#endif
