/* What a stage's QP is at one control step (sim_core/control/mpc.py). */

#include <math.h>
#include <stddef.h>

enum { TOGETHER = 4 };

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

   columns      of `MpcDesign.affine` (inputs), a row for each check, each number of f and each deflection (`travel`)
   parameters   state, previous command and preview
   limit        of the deflections
   f, b         of the QP: as many numbers as `linear`, and twice as many as `travel` */
double ridelab_qp_at(const double *columns, const double *parameters, int inputs, int checks, int linear, int travel,
                     double limit, double *values, double *f, double *b)
{
    int rows = checks + linear + travel;
    double largest = 0;
    for (int i = 0; i < rows; i++)
        values[i] = 0;
    add_product(rows, inputs, columns, parameters, values);
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
