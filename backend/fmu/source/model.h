/* A model behind both versions of FMI: numbers by value reference, and what a step makes of them. */
#ifndef RIDELAB_MODEL_H
#define RIDELAB_MODEL_H

#include "resources.h"

/* What a model keeps from step to step, to be freed; it takes its numbers, which outlive it. NULL where there is no memory. */
void *model_prepare(struct resources *from);

/* The outputs before the first step, from the parameters and the first inputs; called again where these change. */
void model_begin(double *value, void *memory);

/* The outputs after a step from the inputs at its beginning [s]; NULL, or why there are none. */
const char *model_step(double *value, void *memory, double time, double step);

#endif
