/* Signals of a record in sections of its drive: integrals and largest magnitudes (sim_core/metrics/evaluate.py). */

#include <math.h>
#include <stddef.h>
#include <string.h>

/* What is integrated over a fine step from a to b: the value, its square by trapezoids, or the square of a straight
   line, whose mean is (a^2 + ab + b^2) / 3. */
enum integrand { VALUE, SQUARE, SQUARE_OF_LINE, INTEGRANDS };

/* The number of an integrand by its name; -1 for none. */
int ridelab_integrand_number(const char *name)
{
    static const char *const names[INTEGRANDS] = {
        [VALUE] = "value", [SQUARE] = "square", [SQUARE_OF_LINE] = "square_of_line"};
    for (int integrand = 0; integrand < INTEGRANDS; integrand++)
        if (strcmp(names[integrand], name) == 0)
            return integrand;
    return -1;
}

static inline double larger(double a, double b)
{
    return a < b ? b : a;
}

static inline double integral(enum integrand integrand, double a, double b)
{
    if (integrand == VALUE)
        return 0.5 * (a + b);
    if (integrand == SQUARE)
        return 0.5 * (a * a + b * b);
    return 1.0 / 3 * (a * a + a * b + b * b);
}

/* Both under each command: the columns of a signal (fine + 1) x commands. */
static void by_command(enum integrand integrand, const double *restrict signal, int fine, int commands,
                       double *restrict sums, double *restrict highest)
{
    for (int c = 0; c < commands; c++) {
        sums[c] = 0;
        highest[c] = fabs(signal[c]);
    }
    for (int step = 0; step < fine; step++, signal += commands) {
        const double *next = signal + commands;
        for (int c = 0; c < commands; c++) {
            sums[c] += integral(integrand, signal[c], next[c]);
            highest[c] = larger(highest[c], fabs(next[c]));
        }
    }
}

/* Both under one command, from one of its fine steps to another; between samples a signal is straight. */
static void under_command(enum integrand integrand, const double *column, int commands, double first, double last,
                          double *sum, double *peak)
{
    for (int step = (int)first; step < last; step++) {
        double a = column[(size_t)step * (size_t)commands], b = column[(size_t)(step + 1) * (size_t)commands];
        double low = larger(first - step, 0), high = last - step < 1 ? last - step : 1;
        *sum += (high - low) * integral(integrand, a, b);
        *peak = larger(*peak, larger(fabs((1 - low) * a + low * b), fabs((1 - high) * a + high * b)));
    }
}

/* table       signals x (fine + 1) x commands
   integrands  of the signals
   ends        first and last place of each section, in fine steps from the record's first
   sums        signals x sections, in fine steps
   peaks       sections x signals
   work        commands numbers
   highest     signals x commands: largest magnitude under each */
void ridelab_sections(const double *table, int signals, const int *integrands, int fine, int commands,
                      const double *ends, int sections, double *sums, double *peaks, double *work, double *highest)
{
    for (int signal = 0; signal < signals; signal++, highest += commands, sums += sections) {
        const double *own = table + (size_t)signal * (size_t)(fine + 1) * (size_t)commands;
        enum integrand integrand = (enum integrand)integrands[signal];
        by_command(integrand, own, fine, commands, work, highest);
        for (int section = 0; section < sections; section++) {
            double first = ends[2 * section], last = ends[2 * section + 1], sum = 0, peak = 0;
            int before = (int)(first / fine), begin = before + (first > fine * before), end = (int)(last / fine);
            for (int c = begin; c < end; c++) {
                sum += work[c];
                peak = larger(peak, highest[c]);
            }
            if (end < begin) /* both ends under one command */
                under_command(integrand, own + end, commands, first - fine * end, last - fine * end, &sum, &peak);
            else {
                if (before < begin)
                    under_command(integrand, own + before, commands, first - fine * before, fine, &sum, &peak);
                if (last > fine * end)
                    under_command(integrand, own + end, commands, 0, last - fine * end, &sum, &peak);
            }
            sums[section] = sum;
            peaks[(size_t)section * (size_t)signals + (size_t)signal] = isnan(sum) ? sum : peak;
        }
    }
}

/* Power of both axles' actuators |u d'| + |u d'|, from their forces and the deflections' speeds (2 x samples). */
void ridelab_power(const double *restrict force, const double *restrict speed, int samples, double *restrict power)
{
    for (int i = 0; i < samples; i++)
        power[i] = fabs(force[i] * speed[i]) + fabs(force[samples + i] * speed[samples + i]);
}
