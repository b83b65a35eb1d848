/* How much memory the program keeps: enough for any scenario. An exported controller comes with its own sizes. */
#ifndef RIDELAB_SIZES_H
#define RIDELAB_SIZES_H

#define RIDELAB_MOST_PREVIEWED 201
#define RIDELAB_MOST_ROWS 600
#define RIDELAB_MOST_ACTIVE 44

#endif
