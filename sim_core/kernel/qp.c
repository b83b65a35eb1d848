/* The QPs of a predictive controller (sim_core/control/qp.py): the ECU's dual method, built in double and with memory for
   any of them, and the Karush-Kuhn-Tucker conditions that its answers have to meet. */

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "numbers.h"
#include "qp.h"

#define RIDELAB_REAL double
#define ridelab_dual_init ridelab_dual_init_in_double
#define ridelab_dual_solve ridelab_dual_solve_in_double
#define ridelab_dual_slack ridelab_dual_slack_in_double
#include "../ecu/source/ridelab_dual.c"

enum { MOST_ACTIVE = 204 };                     /* limits that may bind together */
static const double ALLOWED = 1e-6;             /* violation of an answer */
static const double CENTIMETRES = 100, NEWTONS = 1000; /* in a metre, in a kN */

/* min 1/2 y'Hy + f'y over y = [moves in kN; slack front, rear in cm]: |moves| <= force limit, slacks >= 0, and
   |travel| <= limit + slack [cm] at the end of each interval, front ones first. What stays from step to step. */
struct qp {
    int moves, travels, inputs; /* forces to be found, deflections that are limited, numbers that the law multiplies */
    const double *H;            /* n x n, n = moves + 2 */
    const double *columns;      /* of A y <= b, n x 2 travels: travel's upper limits, then its lower ones */
    const double *low, *high;   /* n */
    const double *linear_term_gain; /* (moves + travels) x inputs: f but for the slacks, then travel without forces */
    const double *unconstrained_gain; /* likewise: moves and travel where no limit binds, each over its bound */
    ridelab_tables tables;      /* bounds, axles and gram of `unconstrained_gain` times its bounds */
    double fixed, each;         /* about the time of a QP, and of one iteration [s]; the same on every machine */
};

/* The QPs of a run, one after another. */
struct qp_run {
    struct qp_counts *counts;
    double *f, *b;           /* n, 2 travels */
    double *y, *multipliers; /* n; n of the box, then one for each row of A */
    double *work;            /* n + 2 travels */
    ridelab_dual *dual;
};

RIDELAB_NUMBERS_OF(qp_counts)
struct dual_memory {
    ridelab_dual dual;
    ridelab_limit limits[MOST_ACTIVE];
    double work[RIDELAB_DUAL_WORK(MOST_ACTIVE)];
};

RIDELAB_SIZE(dual, sizeof(struct dual_memory))
RIDELAB_SIZE(moves, MOST_ACTIVE - 2 * AXLES)

/* The arguments as the structs have them. */
void ridelab_prepare_qp(struct qp *me, int moves, int travels, int inputs, const double *H, const double *columns,
                        const double *low, const double *high, const double *linear_term_gain,
                        const double *unconstrained_gain,
                        const double *bounds, const int8_t *axles, const double *gram, double slack_price,
                        double inverse_slack_weight, int iterations)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a QP is prepared in memory of that size");
    *me = (struct qp){moves, travels, inputs, H, columns, low, high, linear_term_gain, unconstrained_gain,
                      {.rows = moves + travels, .iterations = iterations, .slack_price = slack_price,
                       .inverse_slack_weight = inverse_slack_weight, .bounds = bounds, .axles = axles, .gram = {gram}},
                      1.5e-9 * (moves + travels) * inputs, 5e-10 * (moves + travels) * (moves + AXLES)};
}

void ridelab_prepare_qp_run(struct qp_run *me, struct qp_counts *counts, double *f, double *b, double *y,
                            double *multipliers, double *work, struct dual_memory *dual)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a QP is prepared in memory of that size");
    ridelab_dual_init(&dual->dual, MOST_ACTIVE, dual->limits, dual->work);
    *me = (struct qp_run){counts, f, b, y, multipliers, work, &dual->dual};
}

/* NaN, once met, stays. */
static void raise_to(double *worst, double violation)
{
    if (violation > *worst || isnan(violation))
        *worst = violation;
}

/* Largest violation of the conditions at y with its multipliers; in the units that `QpMemory.residual` of qp.py states. */
double ridelab_residual(const struct qp *qp, struct qp_run *me)
{
    int n = qp->moves + AXLES, rows = AXLES * qp->travels;
    const double *of_row = me->multipliers + n, *y = me->y;
    double *restrict gradient = me->work, *restrict slack = gradient + n, worst = 0, force = 1;
    for (int i = 0; i < n + rows; i++)
        raise_to(&force, 1 + fabs(me->multipliers[i]));
    memcpy(slack, me->b, (size_t)rows * sizeof(double));
    for (int i = 0; i < n; i++)
        gradient[i] = me->f[i] + me->multipliers[i];
    for (int j = 0; j < n; j++) {
        const double *column = qp->columns + (ptrdiff_t)rows * j, *of_H = qp->H + (ptrdiff_t)n * j;
        for (int i = 0; i < n; i++)
            gradient[i] += of_H[i] * y[j];
        for (int row = 0; row < rows; row++)
            slack[row] -= column[row] * y[j];
    }
    for (int row = 0; row < rows; row++) {
        raise_to(&worst, -slack[row]);
        if (of_row[row] == 0)
            continue;
        for (int i = 0; i < n; i++)
            gradient[i] += qp->columns[(ptrdiff_t)rows * i + row] * of_row[row];
        raise_to(&worst, -of_row[row] / force);
        raise_to(&worst, fabs(of_row[row] * slack[row]) / force);
    }
    for (int i = 0; i < n; i++) {
        const double limit = me->multipliers[i] < 0 ? qp->low[i] : qp->high[i];
        raise_to(&worst, fabs(gradient[i]) / (1 + fabs(me->f[i])));
        raise_to(&worst, qp->low[i] - y[i]);
        raise_to(&worst, y[i] - qp->high[i]);
        raise_to(&worst, fabs(me->multipliers[i] * (y[i] - limit)) / force);
    }
    return worst;
}

/* Make it the QP of a control step, by what the law multiplies then: f and b. */
void ridelab_pose_qp(const struct qp *qp, struct qp_run *me, const double *inputs)
{
    const double *row = qp->linear_term_gain;
    for (int i = 0; i < qp->moves; i++, row += qp->inputs)
        me->f[i] = dot(row, inputs, qp->inputs);
    for (int axle = 0; axle < AXLES; axle++)
        me->f[qp->moves + axle] = qp->tables.slack_price;
    for (int i = 0; i < qp->travels; i++, row += qp->inputs) {
        double travel = dot(row, inputs, qp->inputs), limit = qp->tables.bounds[qp->moves + i];
        me->b[i] = limit - travel;
        me->b[qp->travels + i] = limit + travel;
    }
}

/* y and multipliers from the values at the unconstrained optimum and the limits that bind there. */
static void read_answer(const struct qp *qp, struct qp_run *me, const double *values)
{
    int n = qp->moves + AXLES;
    memcpy(me->y, values, (size_t)qp->moves * sizeof(double));
    memcpy(me->y + qp->moves, me->dual->slacks, sizeof me->dual->slacks);
    memset(me->multipliers, 0, (size_t)(n + AXLES * qp->travels) * sizeof(double));
    for (int i = 0; i < me->dual->count; i++) {
        const ridelab_limit *limit = me->dual->limits + i;
        double multiplier = me->dual->multipliers[i];
        if (limit->sign == 0)
            me->multipliers[qp->moves + limit->axle] = -multiplier;
        else if (limit->row < qp->moves)
            me->multipliers[limit->row] = limit->sign * multiplier;
        else
            me->multipliers[n + (limit->sign < 0) * qp->travels + limit->row - qp->moves] = multiplier;
    }
}

/* Whether the run's QPs have taken no more than they may. */
int ridelab_may_solve(const struct qp_run *me)
{
    return me->counts->spent <= me->counts->allowed;
}

int ridelab_solve_qp(const struct qp *qp, struct qp_run *me, const double *inputs, double *force)
{
    double *values = me->work;
    for (int i = 0; i < qp->tables.rows; i++)
        values[i] = qp->tables.bounds[i] * dot(qp->unconstrained_gain + (ptrdiff_t)qp->inputs * i, inputs, qp->inputs);
    int32_t flags = ridelab_dual_solve(me->dual, &qp->tables, qp->tables.gram[0], values);
    me->counts->spent += qp->fixed + qp->each * me->dual->iterations;
    if (flags & RIDELAB_UNFINISHED)
        return 0;
    read_answer(qp, me, values);
    ridelab_pose_qp(qp, me, inputs);
    if (!(ridelab_residual(qp, me) <= ALLOWED))
        return 0;
    me->counts->solves++;
    for (int axle = 0; axle < AXLES; axle++) {
        force[axle] = me->y[axle] * NEWTONS;
        raise_to(&me->counts->most_slack, me->y[qp->moves + axle] / CENTIMETRES);
    }
    return 1;
}
