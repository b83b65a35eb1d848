/* An instance of the model: its numbers, and what may be done to them when. Functions that can fail say why, else NULL. */
#ifndef RIDELAB_INSTANCE_H
#define RIDELAB_INSTANCE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

#if defined _WIN32
#define RIDELAB_EXPORT __declspec(dllexport)
#elif defined __GNUC__
#define RIDELAB_EXPORT __attribute__((visibility("default")))
#else
#define RIDELAB_EXPORT
#endif

enum phase { INSTANTIATED, INITIALIZING, STEPPING, TERMINATED };

struct instance {
    enum phase phase;
    double time, value[VARIABLES];
    void *memory;
};

static inline void begin_again(struct instance *me)
{
    static const double start[VARIABLES] = RIDELAB_START;
    me->phase = INSTANTIATED;
    me->time = 0;
    memcpy(me->value, start, sizeof start);
    memset(me->memory, 0, model_memory_bytes);
}

/* 0 where there is no memory. */
static inline int prepare(struct instance *me)
{
    me->memory = malloc(model_memory_bytes);
    if (me->memory)
        begin_again(me);
    return me->memory != NULL;
}

static inline const char *unusual(unsigned reference, int whole)
{
    static const char is_whole[VARIABLES + 1] = RIDELAB_WHOLE;
    if (reference >= VARIABLES)
        return "There is no variable of this value reference";
    return (is_whole[reference] == '1') == whole ? NULL : "The variable is of another type";
}

static inline const char *get_number(struct instance *me, unsigned reference, int whole, double *number)
{
    const char *wrong = unusual(reference, whole);
    if (wrong)
        return wrong;
    if (me->phase == INITIALIZING)
        model_begin(me->value, me->memory);
    *number = me->value[reference];
    return NULL;
}

static inline const char *set_number(struct instance *me, unsigned reference, int whole, double number)
{
    static const char causality[VARIABLES + 1] = RIDELAB_CAUSALITY;
    const char *wrong = unusual(reference, whole);
    if (wrong)
        return wrong;
    if (!isfinite(number))
        return "A value is not finite";
    if (causality[reference] == 'p' ? me->phase > INITIALIZING : causality[reference] != 'i')
        return "Only inputs can be set, and parameters before the first step";
    me->value[reference] = number;
    return NULL;
}

static inline const char *enter(struct instance *me, enum phase from, enum phase to)
{
    if (me->phase != from)
        return "The function is not allowed at this moment";
    if (to == STEPPING)
        model_begin(me->value, me->memory);
    me->phase = to;
    return NULL;
}

static inline const char *make_step(struct instance *me, double time, double step)
{
    if (me->phase != STEPPING)
        return "A step is made between initialization and termination";
    if (!(step > 0 && isfinite(time + step)))
        return "A step is longer than 0 s, and ends";
    const char *wrong = model_step(me->value, me->memory, time, step);
    me->time = time + step;
    return wrong;
}

#endif
