/* What sampled controllers share: their control steps begin every `sample_time` seconds, whatever the communication steps
   are, and each takes the inputs of the communication step in which it begins. */
#ifndef RIDELAB_SAMPLED_H
#define RIDELAB_SAMPLED_H

#include "model.h"

enum { MOST_CONTROL_STEPS = 100000, MOST_PREVIEWED = 1000 }; /* in one communication step; control steps ahead */

struct control_steps {
    double sample_time;  /* [s] */
    double first, count; /* when the first one began [s]; how many have begun */
};

/* Whether another one begins in a communication step. */
static inline int next_control_step(struct control_steps *me, double time, double step)
{
    if (me->count == 0)
        me->first = time;
    if (me->first + me->count * me->sample_time >= time + step - 1e-6 * me->sample_time)
        return 0;
    me->count++;
    return 1;
}

/* Where the preview's inputs are: the roads' heights now, and of each coming control step. */
struct preview {
    int steps;
    size_t now, front, rear, braking;
};

static inline struct preview find_preview(struct resources *from)
{
    int steps = ridelab_take_whole(from, 0, MOST_PREVIEWED);
    struct preview me = {.steps = steps};
    if (steps > 0) {
        me.now = ridelab_place(from, "road_front", 2);
        me.front = ridelab_place(from, "preview_front[1]", (size_t)steps);
        me.rear = ridelab_place(from, "preview_rear[1]", (size_t)steps);
        me.braking = ridelab_place(from, "braking[1]", (size_t)steps);
    }
    return me;
}

/* Both roads' mean velocities in each coming control step from the heights at their ends, then the braking. */
static inline void expected(const struct preview *me, const double *value, double sample_time, double *disturbances)
{
    double front = value[me->now], rear = value[me->now + 1];
    for (int i = 0; i < me->steps; i++) {
        disturbances[i] = (value[me->front + (size_t)i] - front) / sample_time;
        disturbances[me->steps + i] = (value[me->rear + (size_t)i] - rear) / sample_time;
        disturbances[2 * me->steps + i] = value[me->braking + (size_t)i];
        front = value[me->front + (size_t)i];
        rear = value[me->rear + (size_t)i];
    }
}

#endif
