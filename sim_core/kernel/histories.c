/* Which samples of long time histories show them all in few (backend/runs/series.py). */

#include <math.h>

/* Judge one signal's samples, after others of the same drive.

   windows  first sample of each, and one after the last of all: window_count + 1, ascending
   parts    first sample, samples from one node to the next, and how many such gaps: part_count x 3
   shown    of each sample whether it is to be shown: the smallest and largest of each window are
   missed   of each sample of each gap, by how much of a signal's span the line between its nodes missed it at most */
void ridelab_judge_samples(const float *values, const int *windows, int window_count, const int *parts, int part_count,
                           unsigned char *shown, float *missed)
{
    float low = values[windows[0]], high = low;
    for (const int *window = windows; window < windows + window_count; window++) {
        int least = window[0], most = window[0];
        for (int i = window[0]; i < window[1]; i++) {
            least = values[i] < values[least] ? i : least;
            most = values[i] > values[most] ? i : most;
        }
        shown[least] = shown[most] = 1;
        low = fminf(low, values[least]);
        high = fmaxf(high, values[most]);
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
