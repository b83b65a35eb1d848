/* Controller and car over many control steps, as long as a linear law of control holds. */
#ifndef RIDELAB_LOOP_H
#define RIDELAB_LOOP_H

/* All numbers, as they come from outside. */
struct law_numbers {
    double rows, horizon;                      /* of the limits; steps previewed */
    double kind, apart;                        /* in `preview`, from one kind to the next, from one control step to the next */
    double steps;                              /* of the run */
    double clips;                              /* whether a force beyond the limit is clipped */
    double force_limit, most_change, most_force; /* of the law, of the actuators [N] */
};

/* u = gain [state; previous force] + preview_gain preview, where each of the limits' rows is between -1 and 1. */
struct law {
    const struct law_numbers *at;
    const double *gain;         /* 2 x 10 */
    const double *preview_gain; /* 2 x 3 horizon */
    const double *limits;       /* rows x (10 + 3 horizon) */
    const double *screen;       /* 14 x rows: gains on the state, the previous force and the mean deceleration, then norms */
    const double *preview;      /* both road velocities and the deceleration in each coming step */
    const double *sums;         /* 4 x steps: mean deceleration previewed; norms of both velocities, and of its difference */
    double *work;               /* rows numbers */
};

/* What a car's state is at the end of a control step from what it is now, and the command [N]. */
typedef void advance_function(const void *car, int step, const double *now, const double *command, double *next);

/* Control steps from `first` to before `last`, in rows of `size` + 2 numbers, [car; previous command], of which the first
   is given. Returns the first step that the law does not decide, or `last`; `limited` counts those in which a limit of
   forces or actuators shaped the command. */
int ridelab_follow(const struct law *law, advance_function *advance, const void *car, int size, int first, int last,
                   double *loop, int *limited);

#endif
