/* The Karush-Kuhn-Tucker conditions of a QP (sim_core/control/qp.py). */

#include <math.h>
#include <stddef.h>

/* NaN, once met, stays. */
static void raise_to(double *worst, double violation)
{
    if (violation > *worst || isnan(violation))
        *worst = violation;
}

/* Largest violation at y of min 1/2 y'Hy + f'y, low <= y <= high, A y <= b; each as `residual` says.

   H            n x n, symmetric
   A            rows x n
   multipliers  n of the box, then one for each row
   work         n numbers: the gradient */
double ridelab_residual(int n, int rows, const double *restrict H, const double *restrict A, const double *low,
                        const double *high, const double *f, const double *b, const double *y,
                        const double *multipliers, double *restrict work)
{
    const double *box = multipliers, *of_row = multipliers + n;
    double worst = 0, force = 1;
    for (int i = 0; i < n + rows; i++)
        raise_to(&force, 1 + fabs(multipliers[i]));
    for (int i = 0; i < n; i++)
        work[i] = f[i] + box[i];
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            work[i] += H[(size_t)n * (size_t)j + (size_t)i] * y[j];
    for (int row = 0; row < rows; row++, A += n) {
        double slack = b[row];
        for (int i = 0; i < n; i++)
            slack -= A[i] * y[i];
        if (of_row[row] != 0)
            for (int i = 0; i < n; i++)
                work[i] += A[i] * of_row[row];
        raise_to(&worst, -slack);
        raise_to(&worst, -of_row[row] / force);
        raise_to(&worst, fabs(of_row[row] * slack) / force);
    }
    for (int i = 0; i < n; i++) {
        raise_to(&worst, fabs(work[i]) / (1 + fabs(f[i])));
        raise_to(&worst, low[i] - y[i]);
        raise_to(&worst, y[i] - high[i]);
        raise_to(&worst, fabs(box[i] * (box[i] < 0 ? y[i] - low[i] : high[i] - y[i])) / force);
    }
    return worst;
}
