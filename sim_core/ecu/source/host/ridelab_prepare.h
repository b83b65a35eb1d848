/* Where the tables come from: compiled in, or loaded at the start. */
#ifndef RIDELAB_PREPARE_H
#define RIDELAB_PREPARE_H

#include <stdint.h>

#include "ridelab_tables.h"

/* Reads what it needs from standard input; the tables, or NULL. `fingerprint` names them. */
const ridelab_tables *ridelab_prepare(uint32_t *fingerprint);

#endif
