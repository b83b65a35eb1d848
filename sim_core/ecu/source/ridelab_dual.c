#include "ridelab_dual.h"

#include "ridelab_controller.h"
#include "ridelab_count.h"

#define TOLERANCE 1e-4f /* kN or cm: 0.1 N, 1 um */
#define SINGULAR 1e-6f  /* below this share of its own size a row depends on those that bind */
#define NO_STEP 3.0e38f

static float magnitude(float value)
{
    return value < 0.0f ? -value : value;
}

/* a' H^-1 b of two limits. */
static float coupling(const ridelab_tables *known, const float *gram, const ridelab_limit *one,
                      const ridelab_limit *two)
{
    float sum = 0.0f;
    if (one->sign != 0 && two->sign != 0) {
        const float entry = gram[(int32_t)one->row * known->rows + two->row];
        sum = one->sign == two->sign ? entry : -entry;
    }
    if (one->axle >= 0 && one->axle == two->axle) {
        sum += known->slack_yield;
    }
    return sum;
}

/* A further row of L D L': `solved` becomes it times D. Returns its own entry of D. */
static float reduce(ridelab_dual *me, const ridelab_tables *known, const float *gram, const ridelab_limit *limit)
{
    float left = coupling(known, gram, limit, limit);
    for (int32_t i = 0; i < me->count; i++) {
        RIDELAB_COUNT(i + 3); /* the products below, the coupling, the division */
        float sum = coupling(known, gram, limit, &me->limits[i]);
        for (int32_t j = 0; j < i; j++) {
            sum -= me->factor[i][j] * me->solved[j];
        }
        me->solved[i] = sum;
        left -= sum * sum / me->factor[i][i];
    }
    return left;
}

static void append(ridelab_dual *me, const ridelab_limit *limit, float multiplier, float left)
{
    const int32_t place = me->count;
    RIDELAB_COUNT(place);
    for (int32_t j = 0; j < place; j++) {
        me->factor[place][j] = me->solved[j] / me->factor[j][j];
    }
    me->factor[place][place] = left;
    me->limits[place] = *limit;
    me->multipliers[place] = multiplier;
    me->count = place + 1;
}

/* Drop the limit at `place`; those behind it are appended anew. */
static void drop(ridelab_dual *me, const ridelab_tables *known, const float *gram, int32_t place)
{
    const int32_t count = me->count;
    me->count = place;
    for (int32_t i = place + 1; i < count; i++) {
        const ridelab_limit limit = me->limits[i];
        const float multiplier = me->multipliers[i];
        const float own = coupling(known, gram, &limit, &limit);
        float left = reduce(me, known, gram, &limit);
        if (left < SINGULAR * own) { /* rounding only: it was independent before */
            left = SINGULAR * own;
        }
        append(me, &limit, multiplier, left);
    }
}

/* The limit that is broken most, and by how much. */
static float worst(const ridelab_dual *me, const ridelab_tables *known, const float *values, ridelab_limit *found)
{
    float most = 0.0f;
    RIDELAB_COUNT(known->rows);
    for (int32_t row = 0; row < known->rows; row++) {
        const int8_t axle = known->axles[row];
        const float slack = axle >= 0 ? me->slacks[axle] : 0.0f;
        const float excess = magnitude(values[row]) - known->bounds[row] - slack;
        if (excess > most) {
            most = excess;
            found->row = (int16_t)row;
            found->sign = values[row] > 0.0f ? 1 : -1;
            found->axle = axle;
        }
    }
    for (int8_t axle = 0; axle < RIDELAB_AXLES; axle++) {
        if (-me->slacks[axle] > most) {
            most = -me->slacks[axle];
            found->row = -1;
            found->sign = 0;
            found->axle = axle;
        }
    }
    return most;
}

/* values and slacks as a multiplier of that limit grows by `step`. */
static void move(ridelab_dual *me, const ridelab_tables *known, const float *gram, float *values,
                 const ridelab_limit *limit, float step)
{
    if (limit->sign != 0) {
        const float *column = &gram[(int32_t)limit->row * known->rows]; /* gram is symmetric */
        const float signed_step = limit->sign > 0 ? step : -step;
        RIDELAB_COUNT(known->rows);
        for (int32_t row = 0; row < known->rows; row++) {
            values[row] -= signed_step * column[row];
        }
    }
    if (limit->axle >= 0) {
        me->slacks[limit->axle] += step * known->slack_yield;
    }
}

/* How the multipliers of the binding limits fall as the new one's grows: the rest of the solve with the factor. */
static void find_direction(ridelab_dual *me)
{
    for (int32_t i = me->count - 1; i >= 0; i--) {
        float sum = me->solved[i] / me->factor[i][i];
        RIDELAB_COUNT(me->count - i);
        for (int32_t j = i + 1; j < me->count; j++) {
            sum -= me->factor[j][i] * me->direction[j];
        }
        me->direction[i] = sum;
    }
}

/* The binding limit whose multiplier reaches zero first, and the step that takes; -1 for none. */
static int32_t find_blocking(const ridelab_dual *me, float *step)
{
    int32_t blocking = -1;
    *step = NO_STEP;
    for (int32_t i = 0; i < me->count; i++) {
        if (me->direction[i] > 0.0f && me->multipliers[i] < *step * me->direction[i]) {
            *step = me->multipliers[i] / me->direction[i];
            blocking = i;
        }
    }
    return blocking;
}

/* One step towards meeting `limit`; whether it is met now. */
static int32_t advance(ridelab_dual *me, const ridelab_tables *known, const float *gram, float *values,
                       const ridelab_limit *limit, float *excess, float *added)
{
    const float own = coupling(known, gram, limit, limit);
    const float rate = reduce(me, known, gram, limit);
    const float full = rate > SINGULAR * own ? *excess / rate : NO_STEP;
    float step;
    int32_t blocking;
    find_direction(me);
    blocking = find_blocking(me, &step);
    if (full <= step) {
        step = full;
        blocking = -1;
    }
    if (step >= NO_STEP) { /* nothing would help: cannot be, for the slacks always do */
        return 1;
    }
    move(me, known, gram, values, limit, step);
    for (int32_t i = 0; i < me->count; i++) {
        move(me, known, gram, values, &me->limits[i], -step * me->direction[i]);
        me->multipliers[i] -= step * me->direction[i];
        if (me->multipliers[i] < 0.0f) {
            me->multipliers[i] = 0.0f;
        }
    }
    *added += step;
    *excess -= step * rate;
    if (blocking < 0) {
        append(me, limit, *added, rate);
        return 1;
    }
    drop(me, known, gram, blocking);
    return 0;
}

static void start(ridelab_dual *me, const ridelab_tables *known)
{
    me->count = 0;
    me->iterations = 0;
    for (int8_t axle = 0; axle < RIDELAB_AXLES; axle++) { /* unconstrained, a slack would be negative: its price says so */
        const ridelab_limit limit = {-1, 0, axle};
        for (int32_t j = 0; j < me->count; j++) {
            me->solved[j] = 0.0f;
        }
        append(me, &limit, known->slack_price, known->slack_yield);
        me->slacks[axle] = 0.0f;
    }
}

int32_t ridelab_dual_solve(ridelab_dual *me, const ridelab_tables *known, const float *gram, float *values)
{
    int32_t flags = 0;
    int32_t met = 1;
    float excess = 0.0f;
    float added = 0.0f;
    ridelab_limit limit = {-1, 0, -1};
    start(me, known);
    /* One pass more than there are iterations, to see whether the last one was enough. */
    for (int32_t pass = 0; pass <= known->iterations; pass++) {
        if (met != 0) {
            excess = worst(me, known, values, &limit);
            added = 0.0f;
            if (excess <= TOLERANCE) {
                return flags;
            }
            flags |= RIDELAB_LIMITED;
        }
        if (pass == known->iterations || me->count == RIDELAB_MOST_ACTIVE) {
            break;
        }
        me->iterations = pass + 1;
        met = advance(me, known, gram, values, &limit, &excess, &added);
    }
    return flags | RIDELAB_UNFINISHED;
}

float ridelab_dual_slack(const ridelab_dual *me)
{
    float most = 0.0f;
    for (int32_t axle = 0; axle < RIDELAB_AXLES; axle++) {
        if (me->slacks[axle] > most) {
            most = me->slacks[axle];
        }
    }
    return most;
}
