/* What a stage's QP is at one control step (sim_core/control/mpc.py). */

#include <math.h>
#include <stddef.h>

enum { INPUTS = 10, DISTURBANCES = 3, TOGETHER = 4 };

/* values += columns x, four columns at a time: each value is read and written once for them. */
static void add_product(int rows, int count, const double *restrict columns, const double *x, double *restrict values)
{
    size_t next = (size_t)rows;
    for (; count >= TOGETHER; count -= TOGETHER, x += TOGETHER, columns += TOGETHER * next)
        for (int i = 0; i < rows; i++)
            values[i] = values[i] + columns[i] * x[0] + columns[next + i] * x[1] + columns[2 * next + i] * x[2] +
                        columns[3 * next + i] * x[3];
    for (; count > 0; count--, x++, columns += next)
        for (int i = 0; i < rows; i++)
            values[i] += columns[i] * x[0];
}

/* Fills values, f and b, and returns the largest magnitude among the checks, or NaN if there is one.

   columns      of `MpcDesign.affine`, a row for each check, each number of f and each deflection (`travel`)
   limit        of the deflections
   parameters   state and previous command, then room for the window
   window       3 rows of `horizon` numbers, each `apart` after the one before
   f, b         of the QP: as many numbers as `linear`, and twice as many as `travel` */
double ridelab_qp_at(int checks, int linear, int travel, int horizon, ptrdiff_t apart, double limit,
                     const double *columns, double *parameters, double *values, double *f, double *b,
                     const double *window)
{
    int rows = checks + linear + travel;
    double largest = 0;
    for (int i = 0; i < DISTURBANCES; i++)
        for (int j = 0; j < horizon; j++)
            parameters[INPUTS + i * horizon + j] = window[i * apart + j];
    for (int i = 0; i < rows; i++)
        values[i] = 0;
    add_product(rows, INPUTS + DISTURBANCES * horizon, columns, parameters, values);
    for (int i = 0; i < checks; i++)
        if (!(fabs(values[i]) <= largest))
            largest = isnan(largest) ? largest : fabs(values[i]);
    for (int i = 0; i < linear; i++)
        f[i] = values[checks + i];
    for (int i = 0; i < travel; i++) {
        b[i] = limit - values[checks + linear + i];
        b[travel + i] = limit + values[checks + linear + i];
    }
    return largest;
}
