/* On a control unit nothing; where the program is measured, how many operations it did: a multiplication with an
   addition, a division, or the comparison of a row with its limit are one each. */
#ifndef RIDELAB_COUNT_H
#define RIDELAB_COUNT_H

#ifdef RIDELAB_COUNTED
#include <stdint.h>
extern uint32_t ridelab_counted;
#define RIDELAB_COUNT(operations) (ridelab_counted += (uint32_t)(operations))
#else
#define RIDELAB_COUNT(operations) ((void)0)
#endif

#endif
