/* The road: samples of its roughness, and bumps. */
#ifndef RIDELAB_ROAD_H
#define RIDELAB_ROAD_H

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

static inline struct road ridelab_road(const double *roughness, int samples, const struct layout *layout)
{
    return (struct road){roughness, samples, *layout, 1 / layout->grid};
}

static inline double between(double low, double value, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Height of the bumps alone [m]; behind a kerb its whole height. */
double ridelab_bump_height(const struct bump *bump, double position);

/* Linear between the roughness' samples, level beyond them, and the bumps [m]. */
static inline double ridelab_road_height(const struct road *road, double position)
{
    double place = between(0, (position - road->at.first) * road->cells, road->samples - 1.000001);
    if (!(place >= 0)) /* not a number has no cell */
        return place;
    int cell = (int)place;
    double low = road->roughness[cell], height = (road->roughness[cell + 1] - low) * (place - cell) + low;
    if (position > road->at.bump.start && position < road->at.bump.until)
        height += ridelab_bump_height(&road->at.bump, position);
    return height;
}

#endif
