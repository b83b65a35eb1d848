/* Which samples of long time histories are shown, so that few keep all extremes and edges. */

#include <math.h>

enum { LANES = 8 };

/* The first sample of that value, `first` where there is none. */
static int place_of(const float *values, int first, int last, float value)
{
    for (int i = first; i < last; i++)
        if (values[i] == value)
            return i;
    return first;
}

/* Extend both by the samples from `first` to before `last`; NaN are none. */
static void extend(const float *values, int first, int last, float *low, float *high)
{
    float lows[LANES], highs[LANES];
    for (int k = 0; k < LANES; k++)
        lows[k] = *low, highs[k] = *high;
    for (; first + LANES <= last; first += LANES)
        for (int k = 0; k < LANES; k++) {
            float value = values[first + k];
            lows[k] = value < lows[k] ? value : lows[k];
            highs[k] = value > highs[k] ? value : highs[k];
        }
    for (int k = 0; first + k < last; k++) {
        lows[k] = fminf(lows[k], values[first + k]);
        highs[k] = fmaxf(highs[k], values[first + k]);
    }
    for (int k = 0; k < LANES; k++)
        *low = fminf(*low, lows[k]), *high = fmaxf(*high, highs[k]);
}

/* Mark one signal's extremes, and how far a line would miss its samples, after others of the same drive; NaN are
   passed over.

   windows  first sample of each, and one after the last of all: window_count + 1, ascending
   parts    first sample, samples from one node to the next, and how many such gaps: part_count x 3
   shown    of each sample whether it is to be shown: the smallest and largest of each window are
   missed   of each sample of each gap, by how much of a signal's span the line between its nodes missed it at most */
void ridelab_mark_samples(const float *values, const int *windows, int window_count, const int *parts, int part_count,
                          unsigned char *shown, float *missed)
{
    float low = INFINITY, high = -INFINITY;
    for (const int *window = windows; window < windows + window_count; window++) {
        float least = INFINITY, most = -INFINITY;
        extend(values, window[0], window[1], &least, &most);
        shown[place_of(values, window[0], window[1], least)] = 1;
        shown[place_of(values, window[0], window[1], most)] = 1;
        low = fminf(low, least), high = fmaxf(high, most);
    }
    float span = high > low ? high - low : 1;
    for (const int *part = parts; part < parts + 3 * part_count; part += 3) {
        const int stride = part[1];
        const float *gap = values + part[0];
        for (int i = 0; i < part[2]; i++, gap += stride, missed += stride)
            for (int k = 0; k < stride; k++) {
                float line = gap[0] + (gap[stride] - gap[0]) * ((float)k / (float)stride);
                float away = fabsf(gap[k] - line) / span;
                missed[k] = away > missed[k] ? away : missed[k];
            }
    }
}
