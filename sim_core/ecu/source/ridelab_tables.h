/* The controller's numbers. ridelab_tables.c has them for one scenario; units: kN, cm, and SI for what is measured. */
#ifndef RIDELAB_TABLES_H
#define RIDELAB_TABLES_H

#include <stdint.h>

#define RIDELAB_STATES 8
#define RIDELAB_FORCES 2
#define RIDELAB_PREVIEWED 3 /* road velocity front and rear, braking deceleration */
#define RIDELAB_STAGES 3    /* cruise, brake, bump */
#define RIDELAB_AXLES 2

/* The control unit's real numbers. The simulation builds the solver in double as well. */
#ifndef RIDELAB_REAL
#define RIDELAB_REAL float
#endif
typedef RIDELAB_REAL ridelab_real;

/* Matrices are stored row after row. */
typedef struct {
    int32_t intervals;  /* of the prediction, Np */
    int32_t previewed;  /* intervals each input tells of: Np, or one more where the state is predicted */
    int32_t rows;       /* forces and deflections that are checked; the first two are the commands */
    int32_t predicts;   /* 1: predict the state for the moment the command takes effect */
    int32_t iterations; /* the solver stops after so many */
    int32_t highest;    /* greatest code of a command */
    int32_t active;     /* limits that may bind together, with one to spare */
    ridelab_real command_step; /* what one code of a command stands for [kN] */
    ridelab_real slack_price;  /* of a deflection beyond its limit [1/cm] */
    ridelab_real inverse_slack_weight;  /* inverse of its quadratic price [cm^2] */
    const ridelab_real *input_steps;              /* what one code stands for: states, then previewed (11) */
    const ridelab_real *a;                        /* (8, 8): the car over one control step */
    const ridelab_real *b;                        /* (8, 2): forces in kN */
    const ridelab_real *e;                        /* (8, 3): road velocities, deceleration */
    const ridelab_real *bounds;                   /* (rows): greatest magnitude [kN or cm] */
    const int8_t *axles;                   /* (rows): whose slack softens it, 0 or 1; -1 none */
    const ridelab_real *effects[RIDELAB_STAGES];  /* (rows, 10 + 3 Np) on state, previous command [kN], preview */
    const ridelab_real *gram[RIDELAB_STAGES];     /* (rows, rows): how a multiplier of one row moves the others */
} ridelab_tables;

#endif
