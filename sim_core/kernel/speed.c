/* The fuzzy speed controller's inference (sim_core/speed/fuzzy.py): Mamdani, minimum and maximum, centroid. */

#include <stddef.h>

enum { MOST_SETS = 20 }; /* of the torque; sim_core/scenario/fuzzy.py has no more */

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a < b ? b : a;
}

/* Centroid of what is concluded, by trapezoids over an even universe from 0 to 1; memberships sets x (steps + 1). 0 where
   nothing is. */
static double centroid(const double *fired, int sets, const double *memberships, int steps)
{
    const double *rows[MOST_SETS];
    double levels[MOST_SETS], moment = 0, area = 0;
    int count = 0;
    for (int set = 0; set < sets; set++)
        if (fired[set] > 0) {
            levels[count] = fired[set];
            rows[count++] = memberships + (size_t)set * (size_t)(steps + 1);
        }
    for (int i = 0; i <= steps; i++) {
        double concluded = 0;
        for (int set = 0; set < count; set++)
            concluded = larger(concluded, smaller(levels[set], rows[set][i]));
        concluded *= i == 0 || i == steps ? 0.5 : 1;
        moment += concluded * i;
        area += concluded;
    }
    return area > 0 ? moment / area / steps : 0;
}

/* The torque as a share of its universe, at one distance and many speed errors.

   distance     membership in each of its sets
   errors       the same of each error: sets x count
   rules        rule_count rows: the set of the distance and of the error, -1 for any, and that of the torque
   memberships  of the torque's sets, MOST_SETS at most: sets x (steps + 1)
   shares       count */
void ridelab_torque_shares(const double *distance, const double *errors, int count, const int *rules, int rule_count,
                           const double *memberships, int sets, int steps, double *shares)
{
    for (int i = 0; i < count; i++) {
        double fired[MOST_SETS] = {0};
        for (const int *rule = rules; rule < rules + 3 * rule_count; rule += 3) {
            double near = rule[0] < 0 ? 1 : distance[rule[0]];
            double fast = rule[1] < 0 ? 1 : errors[(size_t)rule[1] * (size_t)count + (size_t)i];
            fired[rule[2]] = larger(fired[rule[2]], smaller(near, fast));
        }
        shares[i] = centroid(fired, sets, memberships, steps);
    }
}
