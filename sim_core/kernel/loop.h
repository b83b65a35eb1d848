/* Controller and car over many control steps, as long as a linear law of control holds. */
#ifndef RIDELAB_LOOP_H
#define RIDELAB_LOOP_H

enum { STATE = 8, AXLES = 2, FORCES = 2, INPUTS = STATE + FORCES, DISTURBANCES = 3, NORMS = 5, GROUP = 10 };

/* Before a short loop over numbers that do not depend on each other: gcc would unroll it before it sees that. */
#define TWO_AT_ONCE _Pragma("GCC unroll 1")

/* All numbers, as they come from outside. */
struct law_numbers {
    double kind_stride, step_stride; /* in `preview`: from one kind of disturbance, one control step, to the next */
    double steps;                    /* of the run */
    double clips;                    /* 1 where a force beyond the limit is clipped, 0 where the law does not decide it */
    double force_limits[3];          /* of the law, of the actuators' change in a step, of the actuators [N] */
};

/* What decides the steps in which a limit of a law binds, and its memory in a run. */
struct qp;
struct qp_run;

/* All numbers: QPs solved, about the time of one core that they took and that they may take [s], the largest slack [m]. */
struct qp_counts {
    double solves, spent, allowed, most_slack;
};

/* The optimal forces [N] by what the law multiplies; whether they are proven to be. */
int ridelab_solve_qp(const struct qp *qp, struct qp_run *run, const double *inputs, double *force);
int ridelab_may_solve(const struct qp_run *run);

/* u = gain [state; previous force; preview], where each of the limits' rows is between -1 and 1. */
struct law_design {
    int rows, horizon, columns; /* of the limits; steps previewed; INPUTS + 3 horizon */
    const double *gain;         /* 2 x columns */
    const double *limits;       /* rows x columns */
    const double *scale;        /* INPUTS: of the state and the previous force, where `norms` have them together */
    const double *norms;        /* rows x NORMS: of a row's parts on what `sizes` measures; then each group's largest */
};

/* It in a run. */
struct law {
    const struct law_design *design;
    const struct law_numbers *numbers;
    const double *preview;      /* both road velocities and the deceleration in each coming step */
    const double *sizes;        /* 4 x steps: of the mean deceleration previewed, both velocities, its difference */
    double *inputs;             /* that it multiplies in the present step */
    const struct qp *qp;        /* NULL: C solves none */
    struct qp_run *qp_run;
};

/* A half-car on its road (car.c). */
struct car;

/* Numbers of its state. */
int ridelab_car_size(const struct car *car);

/* Its state at the end of a control step from what it is now, and the command [N]; a recorder measures the step. */
void ridelab_drive(struct car *car, int step, const double *now, const double *command, double *next);

/* Some sums beside each other: one alone would wait for each addition. */
enum { TOGETHER = 8 };

static inline double total(const double *sum)
{
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static inline double dot(const double *a, const double *b, int count)
{
    double sum[TOGETHER] = {0};
    int i = 0;
    for (; i + TOGETHER <= count; i += TOGETHER)
        for (int part = 0; part < TOGETHER; part++)
            sum[part] += a[i + part] * b[i + part];
    for (; i < count; i++)
        sum[0] += a[i] * b[i];
    return total(sum);
}

/* Bytes that are enough for a law or a car of any kind. */
enum { RIDELAB_PREPARED = 1024 };

#endif
