/* What is measured of a run while it is driven. */
#ifndef RIDELAB_RECORD_H
#define RIDELAB_RECORD_H

/* A sample's numbers, two beside each other: the deflections' speeds, both accelerations of the body, the
   tyre loads, the deflections, the forces. The last eight have a mean square and a peak. */
enum { SPEED = 0, ACCELERATION = 2, LOAD = 4, TRAVEL_SIGNAL = 6, FORCE_SIGNAL = 8, SIGNALS = 10, METRICS = 8 };

struct recorder;

/* Where the samples of a control step go, those at the ends of its fine steps; NULL where it is not on record. */
double (*ridelab_samples(struct recorder *recorder, int step))[SIGNALS];

/* Measure what stands there. */
void ridelab_record(struct recorder *recorder, int step);

#endif
