/* The road: samples of its roughness, and bumps. */
#ifndef RIDELAB_ROAD_H
#define RIDELAB_ROAD_H

enum shape { COSINE, HALF_SINE, CIRCULAR, FLAT_TOP, TRAPEZOID, KERB, SHAPES };

/* All numbers, as they come from outside. */
struct bump {
    double shape, count, start, height, width, spacing;
    double until; /* from here on the road is as it would be without it [m] */
};

/* The same: samples of the roughness from `first` on, `grid` apart [m], and the bumps. */
struct layout {
    double first, grid;
    struct bump bump;
};

struct road {
    const double *roughness;
    int samples; /* two at least */
    struct layout at;
    double cells; /* in a metre */
};

struct road ridelab_road(const double *roughness, int samples, const struct layout *layout);

/* Linear between the roughness' samples, level beyond them, and the bumps [m]. */
double ridelab_road_height(const struct road *road, double position);

/* How far the road lies above its chord between two positions, on average [m]; `moment` is its first moment about the
   middle, per length [m]. */
double ridelab_above_chord(const struct road *road, double begin, double end, double *moment);

#endif
