/* A model behind both versions of FMI: numbers by value reference, and what a step makes of them. */
#ifndef RIDELAB_MODEL_H
#define RIDELAB_MODEL_H

#include <stddef.h>

#include "ridelab_variables.h" /* generated: VARIABLES, the place V_... of each or of an array's first, what they are and begin with */

/* Bytes that a model keeps from step to step, all of them 0 at the beginning. */
extern const size_t model_memory_bytes;

/* The outputs before the first step, from the parameters and the first inputs; called again where these change. */
void model_begin(double *value, void *memory);

/* The outputs after a step from the inputs at its beginning [s]; NULL, or why there are none. */
const char *model_step(double *value, void *memory, double time, double step);

#endif
