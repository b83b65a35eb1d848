/* The fuzzy speed controller's inference (sim_core/speed/fuzzy.py): Mamdani, minimum and maximum, centroid. */

#include <stddef.h>

enum { SETS = 5 };

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a < b ? b : a;
}

/* Centroid of what is concluded, by trapezoids over an even universe from 0 to 1; memberships SETS x (steps + 1) of even
   triangles, of which only two are above zero between neighbouring peaks. */
static double centroid(const double *fired, const double *memberships, int steps)
{
    double moment = 0, area = 0;
    for (int set = 0; set < SETS - 1; set++, memberships += steps + 1) {
        int first = steps / (SETS - 1) * set, last = steps / (SETS - 1) * (set + 1);
        if (fired[set] == 0 && fired[set + 1] == 0)
            continue;
        for (int i = first; i <= last; i++) {
            double weight = i == first || i == last ? 0.5 : 1;
            double concluded = larger(smaller(fired[set], memberships[i]),
                                      smaller(fired[set + 1], memberships[steps + 1 + i]));
            moment += weight * concluded * i;
            area += weight * concluded;
        }
    }
    return moment / area / steps;
}

/* The torque as a share of its universe, at one distance and many speed errors.

   distance     of its sets (SETS)
   errors       SETS x count
   rules        the torque's set for each of the distance's and each of the error's, SETS x SETS
   memberships  of the torque's sets, SETS x (steps + 1); steps is a multiple of SETS - 1
   shares       count */
void ridelab_torque_shares(const double *distance, const double *errors, int count, const int *rules,
                           const double *memberships, int steps, double *shares)
{
    for (int i = 0; i < count; i++) {
        double fired[SETS] = {0};
        for (int row = 0; row < SETS; row++)
            for (int column = 0; column < SETS; column++) {
                double *concluded = &fired[rules[SETS * row + column]];
                *concluded = larger(*concluded, smaller(distance[row], errors[(size_t)column * (size_t)count + (size_t)i]));
            }
        shares[i] = centroid(fired, memberships, steps);
    }
}
