/* Controller and car over many control steps, as long as a linear law of control holds. */
#ifndef RIDELAB_LOOP_H
#define RIDELAB_LOOP_H

enum { STATE = 8, FORCES = 2, INPUTS = STATE + FORCES, DISTURBANCES = 3 };

/* All numbers, as they come from outside. */
struct law_numbers {
    double rows, horizon;            /* of the limits; steps previewed */
    double kind_stride, step_stride; /* in `preview`: from one kind of disturbance, one control step, to the next */
    double steps;                    /* of the run */
    double clips;                    /* 1 where a force beyond the limit is clipped, 0 where the law does not decide it */
    double force_limits[3];          /* of the law, of the actuators' change in a step, of the actuators [N] */
};

/* u = gain [state; previous force] + preview_gain preview, where each of the limits' rows is between -1 and 1. */
struct law {
    const struct law_numbers *numbers;
    const double *gain;         /* 2 x 10 */
    const double *preview_gain; /* 2 x 3 horizon */
    const double *limits;       /* rows x (10 + 3 horizon) */
    const double *scale;        /* 10: of the state and the previous force, where `norms` have them together */
    const double *norms;        /* rows x 5: of a row's parts on what `sizes` measures */
    const double *preview;      /* both road velocities and the deceleration in each coming step */
    const double *sizes;        /* 4 x steps: of the mean deceleration previewed, both velocities, its difference */
    double *known;              /* 10 + 3 horizon numbers: what the law knows in the present step */
};

/* What a car's state is at the end of a control step from what it is now, and the command [N]. */
struct car;
typedef void advance_function(struct car *car, int step, const double *now, const double *command, double *next);

/* Each kind of car begins with it. */
struct car {
    advance_function *advance;
    int size; /* numbers of its state */
};

/* Add columns of ten numbers, each times its factor. */
void ridelab_add_columns(const double (*columns)[10], const double *factors, int count, double *sum);

/* Bytes that are enough for a law or a car of any kind. */
enum { RIDELAB_PREPARED = 32768 };

#endif
