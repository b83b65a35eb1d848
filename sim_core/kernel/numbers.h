/* Sizes that all share, and sums. */
#ifndef RIDELAB_NUMBERS_H
#define RIDELAB_NUMBERS_H

enum { STATE = 8, AXLES = 2, FORCES = 2, INPUTS = STATE + FORCES, DISTURBANCES = 3, NORMS = 5, GROUP = 8 };

/* Before a short loop over numbers that do not depend on each other: gcc would unroll it before it sees that. */
#define NO_UNROLL _Pragma("GCC unroll 1")

/* Some sums beside each other: one alone would wait for each addition. */
enum { TOGETHER = 8 };

static inline double total(const double *sum)
{
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static inline double dot(const double *a, const double *b, int count)
{
    double sum[TOGETHER] = {0};
    int i = 0;
    for (; i + TOGETHER <= count; i += TOGETHER)
        for (int part = 0; part < TOGETHER; part++)
            sum[part] += a[i + part] * b[i + part];
    for (; i < count; i++)
        sum[0] += a[i] * b[i];
    return total(sum);
}

/* A function that returns a size of Python's arrays, so that Python states none; and one of a struct's numbers. */
#define RIDELAB_SIZE(name, size)        \
    int ridelab_size_of_##name(void)    \
    {                                   \
        return (int)(size);             \
    }
#define RIDELAB_NUMBERS_OF(name) RIDELAB_SIZE(name, sizeof(struct name) / sizeof(double))

/* Bytes that are enough for a law or a car of any kind. */
enum { RIDELAB_PREPARED = 2048 };

#endif
