/* What one FMU knows: its token, its variables, its model's numbers. The program is the same for all of them. */
#ifndef RIDELAB_RESOURCES_H
#define RIDELAB_RESOURCES_H

#include <stddef.h>

struct resources {
    char *content;                            /* of the file, freed by ridelab_forget */
    const char *token, *names;                /* texts; of each variable its name, one behind the other */
    size_t variables;                         /* how many */
    const double *causality, *whole, *start;  /* of each: CAUSALITY_...; 1 for a whole number; its first value */
    const double *numbers;                    /* the others */
    size_t count, taken;                      /* how many there are, and were taken so far */
    int damaged;                              /* 1 once something that was wanted is not there */
};

enum { CAUSALITY_INPUT, CAUSALITY_OUTPUT, CAUSALITY_PARAMETER, CAUSALITY_CONSTANT };

/* Read numbers.bin from the folder `resources`, a path or a file's address; NULL, or why it cannot be read.

   All is little-endian. 8 bytes: RIDELAB1. 4: CRC-32 (as zip has it) of what follows. 4: bytes of text, a multiple of 8.
   The text: token, then each variable's name, each with a zero behind it; zeros to its end. Then 64-bit real numbers: how
   many variables; their causality; whether they are whole; their start; what the model takes. */
const char *ridelab_read(struct resources *me, const char *resources);

void ridelab_forget(struct resources *me);

/* The value reference of a variable, from which on there are at least so many. */
size_t ridelab_place(struct resources *me, const char *name, size_t count);

/* The next numbers. NULL, and damaged, where there are not as many. */
const double *ridelab_take(struct resources *me, size_t count);

/* The next one, whole and in a range; the least, and damaged, where it is none. */
int ridelab_take_whole(struct resources *me, int least, int most);

/* Whether all was there and nothing is left. */
int ridelab_is_whole(const struct resources *me);

#endif
