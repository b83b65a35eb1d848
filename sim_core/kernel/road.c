/* The road: its roughness, its bumps and its height (sim_core/road/profile.py). */

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "numbers.h"
#include "road.h"

enum shape { COSINE, HALF_SINE, CIRCULAR, FLAT_TOP, TRAPEZOID, KERB, SHAPES };

enum { SIMPSON_PARTS = 4 }; /* of a fine step on a bump */
static const double PI = 3.14159265358979323846;

RIDELAB_NUMBERS_OF(layout)

/* The number of a shape by its name in a scenario; -1 for none. */
int ridelab_shape_number(const char *name)
{
    static const char *const names[SHAPES] = {
        [COSINE] = "cosine",     [HALF_SINE] = "half_sine", [CIRCULAR] = "circular",
        [FLAT_TOP] = "flat_top", [TRAPEZOID] = "trapezoid", [KERB] = "kerb",
    };
    for (int shape = 0; shape < SHAPES; shape++)
        if (strcmp(names[shape], name) == 0)
            return shape;
    return -1;
}

/* Height of one bump [m] at a place from its start [m]. Cosine is Eq. 2 of the paper; circular the arc of a Watts hump
   through both feet and the crest. */
static double one_bump(const struct bump *bump, double along)
{
    double h = bump->height, w = bump->width, s = between(0, along / w, 1);
    if (h == 0)
        return 0;
    if (bump->shape == COSINE)
        return h / 2 * (1 - cos(2 * PI * s));
    if (bump->shape == HALF_SINE)
        return h * sin(PI * s);
    if (bump->shape == KERB)
        return h / 2 * (1 - cos(PI * s));
    if (bump->shape == CIRCULAR) {
        double radius = w * (w / fabs(h)) / 8 + fabs(h) / 2, from_crest = w * (s - 0.5), part = from_crest / radius;
        double depth = radius * sqrt(part * part < 1 ? 1 - part * part : 0) + radius - fabs(h);
        if (depth == 0) /* the feet of half a circle */
            return 0;
        return copysign((w * w / 4 - from_crest * from_crest) / depth, h);
    }
    double ramp = between(0, 4 * (s < 0.5 ? s : 1 - s), 1); /* 0 to 1 within a quarter of the width at either end */
    return bump->shape == TRAPEZOID ? h * ramp : h / 2 * (1 - cos(PI * ramp));
}

/* Height of the bumps alone [m]; behind a kerb its whole height. */
double ridelab_bump_height(const struct bump *bump, double position)
{
    double along = position - bump->start;
    if (bump->count == 1)
        return one_bump(bump, along);
    double met = between(0, floor(along / bump->spacing), bump->count - 1);
    double height = one_bump(bump, along - met * bump->spacing);
    return bump->shape == KERB ? height + met * bump->height : height;
}

/* Roughness from independent normal numbers, in place: each height is `keep` of the one before, and what keeps its
   standard deviation. Returns the difference between its steepest slopes up and down [1], the level one among them. */
double ridelab_roughness(double *samples, int count, double deviation, double keep, double grid)
{
    double noise = deviation * sqrt(1 - keep * keep), height = samples[0] * deviation, up = 0, down = 0;
    samples[0] = height;
    for (int i = 1; i < count; i++) {
        double next = keep * height + noise * samples[i], rise = next - height;
        up = rise > up ? rise : up;
        down = rise < down ? rise : down;
        samples[i] = height = next;
    }
    return (up - down) / grid;
}

/* Heights at n positions [m]. */
void ridelab_road_heights(const double *roughness, int samples, const struct layout *layout, const double *position,
                          int n, double *height)
{
    const struct road road = ridelab_road(roughness, samples, layout);
    for (int i = 0; i < n; i++)
        height[i] = ridelab_road_height(&road, position[i]);
}

/* How far a road lies above its chord on average, and the first moment of that [m]. Where the slope changes by k, at distances a
   and b from the ends, that adds -k a b / (2 (a + b)) to the mean and -k a b (a - b) / (12 (a + b)^2) to the moment. The
   bumps are judged at `SIMPSON_PARTS` - 1 places in between. */
static double above_chord(const struct road *road, double begin, double end, double *moment)
{
    double length = end - begin, all = *moment = 0;
    if (!(length > 0))
        return 0;
    double per_length = 1 / length, first = (begin - road->at.first) * road->cells;
    int last = (int)between(0, first + length * road->cells, road->samples - 2);
    for (int i = (int)between(0, first, road->samples) + 1; i <= last; i++) {
        const double *z = road->roughness + i;
        double a = road->at.first + i * road->at.grid - begin, b = length - a;
        double mean = -(z[1] - 2 * z[0] + z[-1]) * (road->cells / 2) * (a * b * per_length);
        all += mean;
        *moment += mean * (a - b) * (per_length / 6);
    }
    if (end > road->at.bump.start && begin < road->at.bump.until) {
        double low = ridelab_bump_height(&road->at.bump, begin), rise = ridelab_bump_height(&road->at.bump, end) - low;
        for (int part = 1; part < SIMPSON_PARTS; part++) {
            double share = (double)part / SIMPSON_PARTS, weight = (part % 2 ? 4.0 : 2.0) / (3 * SIMPSON_PARTS);
            double mean = weight * (ridelab_bump_height(&road->at.bump, begin + length * share) - low - rise * share);
            all += mean;
            *moment += mean * (share - 0.5);
        }
    }
    return all;
}

/* `car.above_chord` from the positions of both axles at every fine instant, 2 x (steps + 1) [m]. */
void ridelab_above_chords(const double *roughness, int samples, const struct layout *layout, const double *position,
                          int steps, double *above)
{
    const struct road road = ridelab_road(roughness, samples, layout);
    for (int axle = 0; axle < AXLES; axle++, position += steps + 1)
        for (int i = 0; i < steps; i++) {
            double *of_step = above + (ptrdiff_t)2 * AXLES * i + axle;
            of_step[0] = above_chord(&road, position[i], position[i + 1], of_step + AXLES);
        }
}
