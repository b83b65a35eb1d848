/* The Karush-Kuhn-Tucker conditions of a QP (sim_core/control/qp.py). */

#include <math.h>
#include <stddef.h>

/* NaN, once met, stays. */
static void raise_to(double *worst, double violation)
{
    if (violation > *worst || isnan(violation))
        *worst = violation;
}

/* Largest violation at y of min 1/2 y'Hy + f'y, lower <= y <= upper, A y <= b; each as `residual` says.

   H            n x n, symmetric
   columns      those of A, n x rows
   upper        n of the box, then b; lower likewise, of which the box is read
   work         n + rows numbers: the gradient, then what each row leaves of b
   multipliers  n of the box, then one for each row */
double ridelab_residual(int n, int rows, const double *restrict H, const double *restrict columns, const double *lower,
                        const double *restrict upper, const double *f, double *restrict work, const double *restrict y,
                        const double *multipliers)
{
    const double *of_row = multipliers + n;
    double *restrict slack = work + n, worst = 0, force = 1;
    for (int i = 0; i < n + rows; i++)
        raise_to(&force, 1 + fabs(multipliers[i]));
    for (int row = 0; row < rows; row++)
        slack[row] = upper[n + row];
    for (int i = 0; i < n; i++)
        work[i] = f[i] + multipliers[i];
    for (int j = 0; j < n; j++) {
        const double *column = columns + (size_t)rows * (size_t)j;
        for (int i = 0; i < n; i++)
            work[i] += H[(size_t)n * (size_t)j + (size_t)i] * y[j];
        for (int row = 0; row < rows; row++)
            slack[row] -= column[row] * y[j];
    }
    for (int row = 0; row < rows; row++) {
        raise_to(&worst, -slack[row]);
        if (of_row[row] == 0)
            continue;
        for (int i = 0; i < n; i++)
            work[i] += columns[(size_t)rows * (size_t)i + (size_t)row] * of_row[row];
        raise_to(&worst, -of_row[row] / force);
        raise_to(&worst, fabs(of_row[row] * slack[row]) / force);
    }
    for (int i = 0; i < n; i++) {
        const double limit = multipliers[i] < 0 ? lower[i] : upper[i];
        raise_to(&worst, fabs(work[i]) / (1 + fabs(f[i])));
        raise_to(&worst, lower[i] - y[i]);
        raise_to(&worst, y[i] - upper[i]);
        raise_to(&worst, fabs(multipliers[i] * (y[i] - limit)) / force);
    }
    return worst;
}
