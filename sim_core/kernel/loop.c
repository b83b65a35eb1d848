/* Controller and car over many control steps (sim_core/loop/closed_loop.py), and the linear car's step. */

#include "loop.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { STATE = 8, FORCES = 2, INPUTS = 10, DISTURBANCES = 3, MEAN = 10, TOGETHER = 4 };
static const double WITHIN = 1 - 1e-9;    /* of a limit: so that rounding does not pass it */
static const double SAME_FORCE = 1e-6;    /* [N]: rounding */

static double clipped(double value, double limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

/* Some sums beside each other: one alone would wait for each addition. */
static double dot(const double *a, const double *b, int count)
{
    double sum[TOGETHER] = {0};
    int i = 0;
    for (; i + TOGETHER <= count; i += TOGETHER)
        for (int part = 0; part < TOGETHER; part++)
            sum[part] += a[i + part] * b[i + part];
    for (; i < count; i++)
        sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* A row on state and previous force `z`, then on what is previewed in a control step. */
static double on_preview(const struct law *law, const double *row, const double *preview)
{
    int horizon = (int)law->at->horizon;
    double sum = 0;
    for (int kind = 0; kind < DISTURBANCES; kind++)
        sum += dot(row + kind * horizon, preview + (ptrdiff_t)law->at->kind * kind, horizon);
    return sum;
}

/* Add five columns, each times its number. */
static void add_five(int rows, const double *restrict columns, const double *z, double *restrict sums)
{
    size_t next = (size_t)rows;
    for (size_t i = 0; i < next; i++)
        sums[i] += columns[i] * z[0] + columns[next + i] * z[1] + columns[2 * next + i] * z[2] +
                   columns[3 * next + i] * z[3] + columns[4 * next + i] * z[4];
}

/* Whether every row is within its limit. A bound rules most rows out: by Cauchy and Schwarz a row comes, on what is
   previewed, to no more than its norm times the preview's. */
static int holds(const struct law *law, int step, const double *z, const double *preview)
{
    int rows = (int)law->at->rows, steps = (int)law->at->steps;
    const double *screen = law->screen, *sums = law->sums + step;
    double *restrict work = law->work;
    double mean = sums[0], front = sums[steps], rear = sums[2 * steps], braking = sums[3 * steps];
    size_t next = (size_t)rows;
    for (size_t i = 0; i < next; i++)
        work[i] = 0;
    add_five(rows, screen, z, work);
    add_five(rows, screen + 5 * next, z + 5, work);
    const double *restrict norms = screen + MEAN * next;
    for (size_t i = 0; i < next; i++)
        work[i] = fabs(work[i] + norms[i] * mean) + norms[next + i] * front + norms[2 * next + i] * rear +
                  norms[3 * next + i] * braking;
    for (int i = 0; i < rows; i++) {
        const double *row = law->limits + (size_t)i * (size_t)(INPUTS + DISTURBANCES * (int)law->at->horizon);
        if (!(work[i] <= WITHIN) && !(fabs(dot(row, z, INPUTS) + on_preview(law, row + INPUTS, preview)) <= WITHIN))
            return 0;
    }
    return 1;
}

int ridelab_follow(const struct law *law, advance_function *advance, const void *car, int size, int first, int last,
                   double *loop, int *limited)
{
    const struct law_numbers *at = law->at;
    int width = size + FORCES;
    for (int step = first; step < last; step++) {
        double *now = loop + (size_t)step * (size_t)width, *next = now + width, z[INPUTS], command[FORCES];
        const double *previous = now + size, *preview = law->preview + (ptrdiff_t)at->apart * step;
        int shaped = 0, beyond = 0, lost = 0;
        memcpy(z, now, STATE * sizeof(double));
        memcpy(z + STATE, previous, FORCES * sizeof(double));
        for (int axle = 0; axle < FORCES; axle++) {
            double wanted = dot(law->gain + INPUTS * axle, z, INPUTS) +
                            on_preview(law, law->preview_gain + DISTURBANCES * (int)at->horizon * axle, preview);
            double force = clipped(wanted, at->force_limit), change = force - previous[axle];
            if (fabs(change) > at->most_change)
                force = previous[axle] + clipped(change, at->most_change);
            command[axle] = clipped(force, at->most_force);
            beyond |= !(fabs(wanted) <= at->force_limit * WITHIN);
            lost |= isnan(wanted);
            shaped |= !(fabs(command[axle] - wanted) <= SAME_FORCE);
        }
        if (lost || (beyond && !at->clips) || !holds(law, step, z, preview))
            return step;
        advance(car, step, now, command, next);
        memcpy(next + size, command, sizeof command);
        *limited += shaped;
    }
    return last;
}

struct linear {
    int size;
    const double *A, *B, *forcing;
};

static void advance_linear(const void *given, int step, const double *now, const double *command, double *next)
{
    const struct linear *car = given;
    for (int i = 0; i < car->size; i++)
        next[i] = dot(car->A + car->size * i, now, car->size) + dot(car->B + FORCES * i, command, FORCES) +
                  car->forcing[(size_t)step * (size_t)car->size + (size_t)i];
}

/* A linear car: p' = A p + B u + forcing; A is size x size, B size x 2, forcing steps x size. The others as
   `ridelab_follow` and `struct law` have them. */
int ridelab_drive_linear(int size, const double *A, const double *B, const double *forcing, const struct law_numbers *at,
                         const double *gain, const double *preview_gain, const double *limits, const double *screen,
                         const double *preview, const double *sums, double *work, double *loop, int *limited, int first,
                         int last)
{
    const struct law law = {at, gain, preview_gain, limits, screen, preview, sums, work};
    const struct linear car = {size, A, B, forcing};
    return ridelab_follow(&law, advance_linear, &car, size, first, last, loop, limited);
}
