/* Integrals and peaks of a run's signals in sections of its drive, the weighted acceleration, the actuators' power and the
   times in the air and on the bump stops, held command after held command (sim_core/metrics/evaluate.py). */

#include "record.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "loop.h"
#include "road.h"

static const double KINK_MARGIN = 1e-3; /* of a fine step: a kink met so near to a section's end is met at it */

/* Wk in modes, pairs of a complex number that a step multiplies by `onward` and to which the samples at its beginning and
   its end add; twice the sum of their real parts is the weighted acceleration. */
enum { MODES = 4 };
struct weighting {
    double onward[2][MODES], begin[2][MODES], end[2][MODES];
};

/* What is summed beside the signals' integrals and peaks, by the names of `Sums` in sim_core/metrics/definition.py; times
   in fine steps. Then the weighting's modes, at present. */
#define TOTALS(TOTAL) \
    TOTAL(power) TOTAL(peak_power) TOTAL(airborne) TOTAL(front_airborne) TOTAL(rear_airborne) TOTAL(on_stops) \
    TOTAL(weighted_squares) TOTAL(weighted_fourths)
#define DECLARED(name) double name;
#define NAMED(name) #name " "
struct totals {
    TOTALS(DECLARED)
    double modes[2][MODES];
};

/* All numbers, as they come from outside; arrays of two are of the front and the rear axle. */
struct record_numbers {
    double fine, first;                /* fine steps in a control step; the first control step on record */
    double sections, weighted_samples; /* how many */
    double instants;                   /* of the drive in fine steps, and one */
    double stiffness[AXLES], least_load[AXLES], airborne_load[AXLES]; /* of the tyres; the last where they are in the air */
    double clearance_down[AXLES], clearance_up[AXLES]; /* from rest to the bump stops [m], infinity without any */
};

struct recorder {
    const struct record_numbers *numbers;
    const double *ends;         /* sections x 2: first and last place, in fine steps from the record's first sample */
    const double *max_chord_deviation; /* how far the road leaves a chord in each section at most [m] */
    double *integrals, *peaks;  /* sections x METRICS, the integrals in fine steps */
    struct totals *totals;
    const struct weighting *weighting;
    double (*samples)[SIGNALS]; /* fine + 1 of the present control step */
    double *work;               /* fine + 1 */
    struct road road;
    const double *position, *height; /* of both axles at every fine instant, 2 x instants; of the road there [m] */
    const double *kinks;             /* of the bumps, ascending [m], then infinity */
};

static inline double larger(double a, double b)
{
    return a < b ? b : a;
}

/* What is integrated over a fine step from a to b: values and squares by trapezoids, and accelerations, which jump with
   the force and are steep lines in between, by the square of a line, whose mean is (a^2 + ab + b^2) / 3. */
#define THIRD (1.0 / 3)
static const double OF_SQUARES[METRICS] = {THIRD, THIRD, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
static const double OF_PRODUCT[METRICS] = {THIRD, THIRD, 0, 0, 0, 0, 0, 0};

/* Integrals and peaks under one command, added to. */
static void under_command(double (*restrict sample)[SIGNALS], int fine, double *restrict integrals, double *restrict peaks)
{
    for (int step = 0; step < fine; step++)
        NO_UNROLL
        for (int i = 0; i < METRICS; i++) {
            double a = sample[step][ACCELERATION + i], b = sample[step + 1][ACCELERATION + i];
            integrals[i] += OF_SQUARES[i] * (a * a + b * b) + OF_PRODUCT[i] * (a * b);
            peaks[i] = larger(peaks[i], larger(fabs(a), fabs(b)));
        }
}

/* Both from one of its fine steps to another; between samples a signal is straight. */
static void under_part(double (*sample)[SIGNALS], double first, double last, double *integrals, double *peaks)
{
    for (int step = (int)first; step < last; step++) {
        double low = larger(first - step, 0), high = last - step < 1 ? last - step : 1;
        for (int i = 0; i < METRICS; i++) {
            double a = sample[step][ACCELERATION + i], b = sample[step + 1][ACCELERATION + i];
            integrals[i] += (high - low) * (OF_SQUARES[i] * (a * a + b * b) + OF_PRODUCT[i] * (a * b));
            peaks[i] = larger(peaks[i], larger(fabs((1 - low) * a + low * b), fabs((1 - high) * a + high * b)));
        }
    }
}

/* The integral of a value by trapezoids up to one of the command's fine steps, and its peak. */
static double trapezoids(const double *value, double last, double *peak)
{
    int whole = (int)last;
    double sum = 0, most = larger(*peak, value[0]), part = last - whole;
    for (int step = 0; step < whole; step++) {
        sum += 0.5 * (value[step] + value[step + 1]);
        most = larger(most, value[step + 1]);
    }
    if (part > 0) {
        double end = (1 - part) * value[whole] + part * value[whole + 1];
        sum += part * (0.5 * (value[whole] + value[whole + 1]));
        most = larger(most, end);
    }
    *peak = most;
    return sum;
}

/* The power of both actuators |u d'| + |u d'|. */
static void add_power(struct recorder *me, double last)
{
    for (int i = 0; i <= (int)me->numbers->fine; i++) {
        const double *sample = me->samples[i];
        me->work[i] = fabs(sample[FORCE_SIGNAL] * sample[SPEED]) + fabs(sample[FORCE_SIGNAL + 1] * sample[SPEED + 1]);
    }
    me->totals->power += trapezoids(me->work, last, &me->totals->peak_power);
}

/* Time with a tyre off the road, or pulling on it where it cannot lift off. */
static void add_airborne(struct recorder *me, double last)
{
    double *times[1 + AXLES] = {&me->totals->airborne, &me->totals->front_airborne, &me->totals->rear_airborne};
    for (int kind = 0; kind <= AXLES; kind++) {
        double most = 0;
        for (int i = 0; i <= (int)me->numbers->fine; i++) {
            const double *load = me->samples[i] + LOAD, *airborne = me->numbers->airborne_load;
            int front = load[0] <= airborne[0], rear = load[1] <= airborne[1];
            me->work[i] = kind == 0 ? front | rear : kind == 1 ? front : rear;
        }
        *times[kind] += trapezoids(me->work, last, &most);
    }
}

static inline int is_on_stop(const struct record_numbers *numbers, int axle, double travel)
{
    return travel < -numbers->clearance_down[axle] || travel > numbers->clearance_up[axle];
}

/* Time with either suspension deflected beyond the clearance of its bump stops. */
static void add_on_stops(struct recorder *me, double last)
{
    double most = 0;
    for (int i = 0; i <= (int)me->numbers->fine; i++) {
        const double *travel = me->samples[i] + TRAVEL_SIGNAL;
        me->work[i] = is_on_stop(me->numbers, 0, travel[0]) || is_on_stop(me->numbers, 1, travel[1]);
    }
    me->totals->on_stops += trapezoids(me->work, last, &most);
}

/* A step of the weighting's modes, real and imaginary parts, from sample a to b. */
static void weigh(const struct weighting *restrict by, double a, double b, double *restrict re, double *restrict im)
{
    NO_UNROLL
    for (int i = 0; i < MODES; i++) {
        double x = re[i], y = im[i];
        re[i] = (by->begin[0][i] * a + by->end[0][i] * b) + (by->onward[0][i] * x - by->onward[1][i] * y);
        im[i] = (by->begin[1][i] * a + by->end[1][i] * b) + (by->onward[0][i] * y + by->onward[1][i] * x);
    }
}

/* So many of its samples through the weighting. */
static void add_weighted(struct recorder *me, int samples)
{
    double *re = me->totals->modes[0], *im = me->totals->modes[1];
    for (int step = 0; step < samples; step++) {
        double weighted = 2 * ((re[0] + re[1]) + (re[2] + re[3])), square = weighted * weighted;
        me->totals->weighted_squares += square;
        me->totals->weighted_fourths += square * square;
        weigh(me->weighting, me->samples[step][ACCELERATION], me->samples[step + 1][ACCELERATION], re, im);
    }
}

/* The largest magnitude of a tyre's load, if that is above `peak`, where the axle meets kinks of the road in a fine step,
   those that lie from one place to another, in fine steps: the roughness' own samples, and where the bumps' slope jumps.
   The load deviates there from the line between both samples a and b by the tyre's stiffness times the kink's height above
   the road's chord. */
static double at_kinks(const struct recorder *me, int axle, int step, double from, double to, double a, double b, double peak)
{
    const struct record_numbers *numbers = me->numbers;
    int begins = (int)(numbers->instants * axle + numbers->fine * numbers->first) + step;
    const double *height = me->height + begins, *kink = me->kinks;
    double begin = me->position[begins], end = me->position[begins + 1], grid = me->road.at.grid;
    double cell = floor((begin - me->road.at.first) / grid) + 1;
    while (*kink <= begin && isfinite(*kink))
        kink++;
    for (;;) {
        double on_grid = me->road.at.first + cell * grid, met = on_grid < *kink ? on_grid : *kink;
        if (!(met <= end))
            return peak;
        if (met == *kink)
            kink++;
        else
            cell++;
        double share = (met - begin) / (end - begin), chord = height[0] + share * (height[1] - height[0]);
        if (step + share < from || step + share > to)
            continue;
        double load = a + share * (b - a) + numbers->stiffness[axle] * (ridelab_road_height(&me->road, met) - chord);
        peak = larger(peak, fabs(load < numbers->least_load[axle] ? numbers->least_load[axle] : load));
    }
}

/* Raise the peaks of the tyre loads in a section by those at kinks between two samples of a command, whose first sample
   is at `begin`: none where the samples, at most `highest`, do not come so near to the peak. */
static void raise_at_kinks(struct recorder *me, int section, int begin, const double *highest)
{
    int fine = (int)me->numbers->fine;
    double first = me->ends[2 * section], last = me->ends[2 * section + 1];
    double from = first > KINK_MARGIN ? first - KINK_MARGIN : 0, to = last + KINK_MARGIN;
    if (begin > to || begin + fine < from)
        return;
    for (int axle = 0; axle < AXLES; axle++) {
        int signal = LOAD - ACCELERATION + axle, inside = begin >= first && begin + fine <= last;
        double *peak = me->peaks + METRICS * section + signal;
        if (inside && highest[signal] < *peak - me->numbers->stiffness[axle] * me->max_chord_deviation[section])
            continue;
        for (int step = 0; step < fine; step++)
            *peak = at_kinks(me, axle, begin + step, from, to, me->samples[step][LOAD + axle],
                             me->samples[step + 1][LOAD + axle], *peak);
    }
}

double (*ridelab_samples(struct recorder *me, int step))[SIGNALS]
{
    return step < me->numbers->first ? NULL : me->samples;
}

void ridelab_record(struct recorder *me, int step)
{
    const struct record_numbers *numbers = me->numbers;
    int fine = (int)numbers->fine, begin = fine * (step - (int)numbers->first), sections = (int)numbers->sections;
    double integrals[METRICS] = {0}, highest[METRICS] = {0}, last = me->ends[2 * sections - 1] - begin;
    under_command(me->samples, fine, integrals, highest);
    for (int section = 0; section < sections; section++) {
        double from = me->ends[2 * section] - begin, to = me->ends[2 * section + 1] - begin;
        double *sum = me->integrals + METRICS * section, *peak = me->peaks + METRICS * section;
        if (from <= 0 && to >= fine)
            for (int i = 0; i < METRICS; i++) {
                sum[i] += integrals[i];
                peak[i] = larger(peak[i], highest[i]);
            }
        else if (from < fine && to > 0 && from < to)
            under_part(me->samples, larger(from, 0), to < fine ? to : fine, sum, peak);
        raise_at_kinks(me, section, begin, highest);
    }
    last = last < fine ? last : fine;
    if (last > 0 && (highest[FORCE_SIGNAL - ACCELERATION] > 0 || highest[FORCE_SIGNAL - ACCELERATION + 1] > 0))
        add_power(me, last);
    if (last > 0 && (highest[LOAD - ACCELERATION] >= -numbers->airborne_load[0] ||
                     highest[LOAD - ACCELERATION + 1] >= -numbers->airborne_load[1]))
        add_airborne(me, last);
    double front = highest[TRAVEL_SIGNAL - ACCELERATION], rear = highest[TRAVEL_SIGNAL - ACCELERATION + 1];
    if (last > 0 && (is_on_stop(numbers, 0, front) || is_on_stop(numbers, 0, -front) || is_on_stop(numbers, 1, rear) ||
                     is_on_stop(numbers, 1, -rear)))
        add_on_stops(me, last);
    int samples = (int)numbers->weighted_samples - begin;
    add_weighted(me, samples < fine ? samples : fine);
}

RIDELAB_NUMBERS_OF(record_numbers)
RIDELAB_NUMBERS_OF(totals)
RIDELAB_NUMBERS_OF(weighting)
RIDELAB_SIZE(sample, SIGNALS)
RIDELAB_SIZE(metrics, METRICS)

const char *ridelab_total_names(void)
{
    return TOTALS(NAMED);
}

/* The arguments as the struct has them. */
void ridelab_prepare_recorder(struct recorder *me, const struct record_numbers *numbers, const double *ends,
                              const double *max_chord_deviation, double *integrals, double *peaks, struct totals *totals,
                              const struct weighting *weighting, double (*samples)[SIGNALS], double *work,
                              const double *roughness, int road_samples, const struct layout *layout,
                              const double *position, const double *height, const double *kinks)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a recorder is prepared in memory of that size");
    *me = (struct recorder){numbers, ends, max_chord_deviation, integrals, peaks, totals, weighting, samples, work,
                            ridelab_road(roughness, road_samples, layout), position, height, kinks};
}
