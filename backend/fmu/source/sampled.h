/* What sampled controllers share: their control steps begin every SAMPLE_TIME seconds, whatever the communication steps
   are, and each takes the inputs of the communication step in which it begins. */
#ifndef RIDELAB_SAMPLED_H
#define RIDELAB_SAMPLED_H

#include "model.h"

enum { MOST_CONTROL_STEPS = 100000 }; /* in one communication step */

struct control_steps {
    double first, count; /* when the first one began [s]; how many have begun */
};

/* Whether another one begins in a communication step. */
static inline int next_control_step(struct control_steps *me, double time, double step)
{
    if (me->count == 0)
        me->first = time;
    if (me->first + me->count * SAMPLE_TIME >= time + step - 1e-6 * SAMPLE_TIME)
        return 0;
    me->count++;
    return 1;
}

#if PREVIEWED > 0
/* Both roads' mean velocities in each coming control step from the heights at their ends, then the braking. */
static inline void expected(const double *value, double *disturbances)
{
    double front = value[V_ROAD_FRONT], rear = value[V_ROAD_REAR];
    for (int i = 0; i < PREVIEWED; i++) {
        disturbances[i] = (value[V_PREVIEW_FRONT + i] - front) / SAMPLE_TIME;
        disturbances[PREVIEWED + i] = (value[V_PREVIEW_REAR + i] - rear) / SAMPLE_TIME;
        disturbances[2 * PREVIEWED + i] = value[V_BRAKING + i];
        front = value[V_PREVIEW_FRONT + i];
        rear = value[V_PREVIEW_REAR + i];
    }
}
#endif

#endif
