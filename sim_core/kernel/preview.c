/* What a horizon that slides over a drive holds (sim_core/loop/preview.py). */

#include <math.h>
#include <stddef.h>

/* disturbances  both road velocities and the braking deceleration in every interval to come, 3 x (steps + horizon - 1)
   sizes         of the horizon that begins in each step: magnitude of the mean deceleration; then the norms of both
                 velocities and of the deceleration's difference from its mean (4 x steps) */
void ridelab_horizons(const double *disturbances, int steps, int horizon, double *sizes)
{
    double *braking = sizes, *spread = sizes + steps;
    for (int row = 0; row < 3; row++, disturbances += steps + horizon - 1, spread += steps) {
        double sum = 0, squares = 0;
        for (int i = 0; i < horizon - 1; i++) {
            sum += disturbances[i];
            squares += disturbances[i] * disturbances[i];
        }
        for (int step = 0; step < steps; step++) {
            double first = disturbances[step], last = disturbances[step + horizon - 1], about_mean;
            sum += last;
            squares += last * last;
            about_mean = row < 2 ? squares : squares - sum * sum / horizon;
            spread[step] = about_mean > 0 ? sqrt(about_mean) : 0;
            if (row == 2)
                braking[step] = fabs(sum) / horizon;
            sum -= first;
            squares -= first * first;
        }
    }
}
