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
    double time, *value;
    struct resources resources;
    void *memory;
};

static inline void begin_again(struct instance *me)
{
    me->phase = INSTANTIATED;
    me->time = 0;
    memcpy(me->value, me->resources.start, me->resources.variables * sizeof *me->value);
}

/* Read its numbers from the FMU's folder of resources. */
static inline const char *prepare(struct instance *me, const char *resources)
{
    const char *wrong = ridelab_read(&me->resources, resources);
    if (wrong)
        return wrong;
    me->value = malloc(me->resources.variables * sizeof *me->value);
    me->memory = model_prepare(&me->resources);
    if (!ridelab_is_whole(&me->resources))
        return "numbers.bin in the FMU's resources folder is of another program";
    if (!me->value || !me->memory)
        return "There is not enough memory";
    begin_again(me);
    return NULL;
}

static inline void release(struct instance *me)
{
    free(me->memory);
    free(me->value);
    ridelab_forget(&me->resources);
}

static inline const char *unusual(const struct instance *me, unsigned reference, int whole)
{
    if (reference >= me->resources.variables)
        return "There is no variable of this value reference";
    return (me->resources.whole[reference] == 1) == whole ? NULL : "The variable is of another type";
}

static inline const char *get_number(struct instance *me, unsigned reference, int whole, double *number)
{
    const char *wrong = unusual(me, reference, whole);
    if (wrong)
        return wrong;
    if (me->phase == INITIALIZING)
        model_begin(me->value, me->memory);
    *number = me->value[reference];
    return NULL;
}

static inline const char *set_number(struct instance *me, unsigned reference, int whole, double number)
{
    const char *wrong = unusual(me, reference, whole);
    if (wrong)
        return wrong;
    if (!isfinite(number))
        return "A value is not finite";
    double causality = me->resources.causality[reference];
    if (causality == CAUSALITY_PARAMETER ? me->phase > INITIALIZING : causality != CAUSALITY_INPUT)
        return "Only inputs can be set, and parameters before the first step";
    me->value[reference] = number;
    return NULL;
}

static inline const char *enter(struct instance *me, enum phase from, enum phase to)
{
    if (me->phase != from)
        return "The function is not allowed at this moment";
    if (from == INITIALIZING)
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
