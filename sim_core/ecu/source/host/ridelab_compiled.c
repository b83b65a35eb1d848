/* Tables compiled in, from ridelab_tables.c. */
#include "ridelab_calibration.h"
#include "ridelab_prepare.h"

const ridelab_tables *ridelab_prepare(uint32_t *fingerprint)
{
    *fingerprint = RIDELAB_FINGERPRINT;
    return &ridelab_calibration;
}
