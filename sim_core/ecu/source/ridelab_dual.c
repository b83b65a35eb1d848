#include "ridelab_dual.h"

#include "ridelab_controller.h"
#include "ridelab_count.h"

#define IN_DOUBLE (sizeof(ridelab_real) > sizeof(float))
#define TOLERANCE ((ridelab_real)(IN_DOUBLE ? 1e-9 : 1e-4)) /* kN or cm; in float 0.1 N, 1 um */
/* Below this share of its own size a row depends on those that bind. */
#define SINGULAR ((ridelab_real)(IN_DOUBLE ? 1e-12 : 1e-6))
#define NO_STEP 3.0e38f

static ridelab_real magnitude(ridelab_real value)
{
    return value < 0.0f ? -value : value;
}

/* a' H^-1 b of two limits. */
static ridelab_real coupling(const ridelab_tables *tables, const ridelab_real *gram, const ridelab_limit *one,
                      const ridelab_limit *two)
{
    ridelab_real sum = 0.0f;
    if (one->sign != 0 && two->sign != 0) {
        const ridelab_real entry = gram[(int32_t)one->row * tables->rows + two->row];
        sum = one->sign == two->sign ? entry : -entry;
    }
    if (one->axle >= 0 && one->axle == two->axle) {
        sum += tables->inverse_slack_weight;
    }
    return sum;
}

/* A further row of L D L': `solved` becomes it times D. Returns its own entry of D. */
static ridelab_real reduce(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram,
                           const ridelab_limit *limit)
{
    ridelab_real left = coupling(tables, gram, limit, limit);
    for (int32_t i = 0; i < me->count; i++) {
        RIDELAB_COUNT(i + 3); /* the products below, the coupling, the division */
        ridelab_real sum = coupling(tables, gram, limit, &me->limits[i]);
        for (int32_t j = 0; j < i; j++) {
            sum -= me->factor[i * me->most + j] * me->solved[j];
        }
        me->solved[i] = sum;
        left -= sum * sum / me->factor[i * me->most + i];
    }
    return left;
}

static void append(ridelab_dual *me, const ridelab_limit *limit, ridelab_real multiplier, ridelab_real left)
{
    const int32_t place = me->count;
    RIDELAB_COUNT(place);
    for (int32_t j = 0; j < place; j++) {
        me->factor[place * me->most + j] = me->solved[j] / me->factor[j * me->most + j];
    }
    me->factor[place * me->most + place] = left;
    me->limits[place] = *limit;
    me->multipliers[place] = multiplier;
    me->count = place + 1;
}

/* Drop the limit at `place`; those behind it are appended anew. */
static void drop(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram, int32_t place)
{
    const int32_t count = me->count;
    me->count = place;
    for (int32_t i = place + 1; i < count; i++) {
        const ridelab_limit limit = me->limits[i];
        const ridelab_real multiplier = me->multipliers[i];
        const ridelab_real own = coupling(tables, gram, &limit, &limit);
        ridelab_real left = reduce(me, tables, gram, &limit);
        if (left < SINGULAR * own) { /* rounding only: it was independent before */
            left = SINGULAR * own;
        }
        append(me, &limit, multiplier, left);
    }
}

/* The limit that is broken most, and by how much. */
static ridelab_real worst(const ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *values,
                          ridelab_limit *found)
{
    ridelab_real most = 0.0f;
    RIDELAB_COUNT(tables->rows);
    for (int32_t row = 0; row < tables->rows; row++) {
        const int8_t axle = tables->axles[row];
        const ridelab_real slack = axle >= 0 ? me->slacks[axle] : 0.0f;
        const ridelab_real excess = magnitude(values[row]) - tables->bounds[row] - slack;
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
static void move(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram, ridelab_real *values,
                 const ridelab_limit *limit, ridelab_real step)
{
    if (limit->sign != 0) {
        const ridelab_real *column = &gram[(int32_t)limit->row * tables->rows]; /* gram is symmetric */
        const ridelab_real signed_step = limit->sign > 0 ? step : -step;
        RIDELAB_COUNT(tables->rows);
        for (int32_t row = 0; row < tables->rows; row++) {
            values[row] -= signed_step * column[row];
        }
    }
    if (limit->axle >= 0) {
        me->slacks[limit->axle] += step * tables->inverse_slack_weight;
    }
}

/* How the multipliers of the binding limits fall as the new one's grows: the rest of the solve with the factor. */
static void find_direction(ridelab_dual *me)
{
    for (int32_t i = me->count - 1; i >= 0; i--) {
        ridelab_real sum = me->solved[i] / me->factor[i * me->most + i];
        RIDELAB_COUNT(me->count - i);
        for (int32_t j = i + 1; j < me->count; j++) {
            sum -= me->factor[j * me->most + i] * me->direction[j];
        }
        me->direction[i] = sum;
    }
}

/* The binding limit whose multiplier reaches zero first, and the step that takes; -1 for none. */
static int32_t find_blocking(const ridelab_dual *me, ridelab_real *step)
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
static int32_t advance(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram, ridelab_real *values,
                       const ridelab_limit *limit, ridelab_real *excess, ridelab_real *added)
{
    const ridelab_real own = coupling(tables, gram, limit, limit);
    const ridelab_real rate = reduce(me, tables, gram, limit);
    const ridelab_real full = rate > SINGULAR * own ? *excess / rate : NO_STEP;
    ridelab_real step;
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
    move(me, tables, gram, values, limit, step);
    for (int32_t i = 0; i < me->count; i++) {
        move(me, tables, gram, values, &me->limits[i], -step * me->direction[i]);
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
    drop(me, tables, gram, blocking);
    return 0;
}

void ridelab_dual_init(ridelab_dual *me, int32_t most, ridelab_limit *limits, ridelab_real *work)
{
    me->most = most;
    me->limits = limits;
    me->multipliers = work;
    me->direction = work + most;
    me->solved = work + 2 * most;
    me->factor = work + 3 * most;
}

static void start(ridelab_dual *me, const ridelab_tables *tables)
{
    me->count = 0;
    me->iterations = 0;
    for (int8_t axle = 0; axle < RIDELAB_AXLES; axle++) { /* unconstrained, a slack would be negative: its price says so */
        const ridelab_limit limit = {-1, 0, axle};
        for (int32_t j = 0; j < me->count; j++) {
            me->solved[j] = 0.0f;
        }
        append(me, &limit, tables->slack_price, tables->inverse_slack_weight);
        me->slacks[axle] = 0.0f;
    }
}

int32_t ridelab_dual_solve(ridelab_dual *me, const ridelab_tables *tables, const ridelab_real *gram,
                           ridelab_real *values)
{
    int32_t flags = 0;
    int32_t met = 1;
    ridelab_real excess = 0.0f;
    ridelab_real added = 0.0f;
    ridelab_limit limit = {-1, 0, -1};
    start(me, tables);
    /* One pass more than there are iterations, to see whether the last one was enough. */
    for (int32_t pass = 0; pass <= tables->iterations; pass++) {
        if (met != 0) {
            excess = worst(me, tables, values, &limit);
            added = 0.0f;
            if (excess <= TOLERANCE) {
                return flags;
            }
            flags |= RIDELAB_LIMITED;
        }
        if (pass == tables->iterations || me->count == me->most) {
            break;
        }
        me->iterations = pass + 1;
        met = advance(me, tables, gram, values, &limit, &excess, &added);
    }
    return flags | RIDELAB_UNFINISHED;
}

ridelab_real ridelab_dual_slack(const ridelab_dual *me)
{
    ridelab_real most = 0.0f;
    for (int32_t axle = 0; axle < RIDELAB_AXLES; axle++) {
        if (me->slacks[axle] > most) {
            most = me->slacks[axle];
        }
    }
    return most;
}
