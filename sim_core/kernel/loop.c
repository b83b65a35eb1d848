/* Controller and car over many control steps (sim_core/loop/closed_loop.py). */

#include "loop.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double BELOW_LIMIT = 1 - 1e-9; /* of a limit: so that rounding does not pass it */
static const double SAME_FORCE = 1e-6; /* [N]: rounding */

RIDELAB_SIZE(prepared, RIDELAB_PREPARED)
RIDELAB_SIZE(disturbances, DISTURBANCES)
RIDELAB_SIZE(forces, FORCES)
RIDELAB_SIZE(state, STATE)
RIDELAB_SIZE(bounded_rows, GROUP)

static double clipped(double value, double limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

/* What the actuators are told where a force is requested after the previous command: no more than `limits` [N] of the
   force, then of its change, then of the actuators. Returns whether that shapes it. */
int ridelab_limit_force(const double *limits, const double *requested, const double *previous, double *command)
{
    int limit_active = 0;
    for (int axle = 0; axle < FORCES; axle++) {
        double force = clipped(requested[axle], limits[0]), change = force - previous[axle];
        if (fabs(change) > limits[1])
            force = previous[axle] + clipped(change, limits[1]);
        command[axle] = clipped(force, limits[2]);
        limit_active |= !(fabs(command[axle] - requested[axle]) <= SAME_FORCE);
    }
    return limit_active;
}

/* What a law multiplies in a control step: the car's state, the previous force, the preview, one kind after another. */
static void gather_inputs(const struct run_inputs *run, size_t horizon, int step, const double *now, const double *previous)
{
    const double *preview = run->preview + (ptrdiff_t)run->numbers->step_stride * step;
    memcpy(run->inputs, now, STATE * sizeof(double));
    memcpy(run->inputs + STATE, previous, FORCES * sizeof(double));
    for (size_t kind = 0; kind < DISTURBANCES; kind++)
        memcpy(run->inputs + INPUTS + kind * horizon, preview + (ptrdiff_t)run->numbers->kind_stride * (ptrdiff_t)kind,
               horizon * sizeof(double));
}

/* Whether every row is within its limit. Most groups of rows need no closer look, by Cauchy and Schwarz, and most rows
   none beyond their gains on state and force. */
static int is_unconstrained(const struct law_design *design, const struct run_inputs *run, int step)
{
    const double *inputs = run->inputs;
    double size[NORMS], scaled[INPUTS];
    for (int i = 0; i < INPUTS; i++)
        scaled[i] = design->scale[i] * inputs[i];
    size[0] = sqrt(dot(scaled, scaled, INPUTS));
    for (int i = 1; i < NORMS; i++)
        size[i] = run->preview_norms[(ptrdiff_t)run->numbers->steps * (i - 1) + step];
    for (int first = 0; first < design->rows; first += GROUP) {
        const struct row_bounds *row_bounds = design->bounds + first / GROUP;
        if (row_bounds->largest[0] * size[0] + (row_bounds->largest[1] * size[1] + row_bounds->largest[2] * size[2]) +
                (row_bounds->largest[3] * size[3] + row_bounds->largest[4] * size[4]) <=
            BELOW_LIMIT)
            continue;
        double by_state[GROUP], by_preview[GROUP];
        for (int j = 0; j < GROUP; j++) {
            double sum = 0, most = 0;
            for (int i = 0; i < INPUTS; i++)
                sum += row_bounds->gains[i][j] * inputs[i];
            for (int i = 1; i < NORMS; i++)
                most += row_bounds->norms[i - 1][j] * size[i];
            by_state[j] = sum;
            by_preview[j] = most;
        }
        for (int j = 0; j < GROUP && first + j < design->rows; j++) {
            const double *of_preview = design->limits + (ptrdiff_t)design->columns * (first + j) + INPUTS;
            if (!(fabs(by_state[j]) + by_preview[j] <= BELOW_LIMIT) &&
                !(fabs(by_state[j] + dot(of_preview, inputs + INPUTS, design->columns - INPUTS)) <= BELOW_LIMIT))
                return 0;
        }
    }
    return 1;
}

/* Control steps from `first` to before `last`, in rows of `loop`, [car; previous command], of which the first is given.
   `qp`, NULL for none, solves those in which a limit of the law binds. Returns the first step that neither decides, or
   `last`; `limited` counts those in which a limit bound. */
int ridelab_follow_law(struct car *car, const struct run_inputs *run, double *loop, int *limited,
                       const struct law_design *law, const struct qp *qp, struct qp_run *qp_run, int first, int last)
{
    const struct law_numbers *numbers = run->numbers;
    const double *inputs = run->inputs;
    int size = ridelab_car_size(car), width = size + FORCES, previewed = law->columns - INPUTS;
    for (int step = first; step < last; step++) {
        double *now = loop + (ptrdiff_t)width * step, *next = now + width, requested[FORCES], command[FORCES];
        const double *previous = now + size;
        int beyond = 0, lost = 0, by_qp = 0;
        gather_inputs(run, (size_t)law->horizon, step, now, previous);
        for (int axle = 0; axle < FORCES; axle++) {
            const double *gain = law->gain + law->columns * axle;
            requested[axle] = dot(gain, inputs, INPUTS) + dot(gain + INPUTS, inputs + INPUTS, previewed);
            beyond |= !(fabs(requested[axle]) <= numbers->force_limits[0] * BELOW_LIMIT);
            lost |= isnan(requested[axle]);
        }
        if (lost || (beyond && !numbers->clips) || !is_unconstrained(law, run, step)) {
            by_qp = qp && ridelab_may_solve(qp_run) && ridelab_solve_qp(qp, qp_run, inputs, requested);
            if (!by_qp)
                return step;
        }
        *limited += ridelab_limit_force(numbers->force_limits, requested, previous, command) | by_qp;
        ridelab_drive(car, step, now, command, next);
        memcpy(next + size, command, sizeof command);
    }
    return last;
}

/* One control step whose command stands in the next row already. */
void ridelab_advance(struct car *car, double *loop, int step)
{
    int size = ridelab_car_size(car);
    double *now = loop + (ptrdiff_t)(size + FORCES) * step, *next = now + size + FORCES;
    ridelab_drive(car, step, now, next + size, next);
}

void ridelab_prepare_law_design(struct law_design *me, int rows, int horizon, const double *gain, const double *limits,
                                const double *scale, const struct row_bounds *bounds)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "a law is prepared in memory of that size");
    *me = (struct law_design){rows, horizon, INPUTS + DISTURBANCES * horizon, gain, limits, scale, bounds};
}

RIDELAB_NUMBERS_OF(law_numbers)

void ridelab_prepare_run_inputs(struct run_inputs *me, const struct law_numbers *numbers, const double *preview,
                                const double *preview_norms, double *inputs)
{
    _Static_assert(sizeof *me <= RIDELAB_PREPARED, "what laws share is prepared in memory of that size");
    *me = (struct run_inputs){numbers, preview, preview_norms, inputs};
}

/* What `run_inputs.preview_norms` has of each window of `horizon` numbers over what is previewed (3 x count): its sum and
   its sum of squares follow from those of the window before. */
void ridelab_window_sizes(const double *ahead, int count, int horizon, double *sizes)
{
    int windows = count - horizon + 1;
    for (int kind = 0; kind < DISTURBANCES; kind++, ahead += count) {
        double *norm = sizes + (ptrdiff_t)windows * (1 + kind), sum = 0, squares = 0;
        for (int i = 0; i < count; i++) {
            double leaves = i < horizon ? 0 : ahead[i - horizon];
            sum += ahead[i] - leaves;
            squares += ahead[i] * ahead[i] - leaves * leaves;
            if (i + 1 < horizon)
                continue;
            double mean = sum / horizon, about = kind == DISTURBANCES - 1 ? squares - horizon * mean * mean : squares;
            norm[i + 1 - horizon] = about > 0 ? sqrt(about) : 0;
            if (kind == DISTURBANCES - 1)
                sizes[i + 1 - horizon] = fabs(mean);
        }
    }
}
