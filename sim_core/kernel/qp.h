/* The QP of a step in which a limit of the law binds (qp.c). */
#ifndef RIDELAB_QP_H
#define RIDELAB_QP_H

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

#endif
