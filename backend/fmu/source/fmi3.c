/* FMI 3.0 for co-simulation (Modelica Association, FMI 3.0.2, section 4.2): types and functions as the standard has them. */
#include "instance.h"

#ifdef RIDELAB_STANDARD_HEADERS
#include "fmi3Functions.h"
#else
#include <stdbool.h>
#include <stdint.h>
typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8, fmi3Byte;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean, fmi3Clock;
typedef const char *fmi3String;
typedef const fmi3Byte *fmi3Binary;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean *, fmi3Float64 *);
typedef void (*fmi3LockPreemptionCallback)();
typedef void (*fmi3UnlockPreemptionCallback)();
#endif

struct fmu {
    struct instance instance;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
};

/* The status of what failed for a reason, or did not. */
static fmi3Status told(struct fmu *me, const char *wrong)
{
    if (!wrong)
        return fmi3OK;
    if (me->log)
        me->log(me->environment, fmi3Error, "logStatusError", wrong);
    return fmi3Error;
}

RIDELAB_EXPORT const char *fmi3GetVersion(void)
{
    return "3.0";
}

RIDELAB_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance me, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    (void)me, (void)on, (void)count, (void)categories; /* errors are all that is logged */
    return fmi3OK;
}

RIDELAB_EXPORT void fmi3FreeInstance(fmi3Instance instance)
{
    struct fmu *me = instance;
    if (!me)
        return;
    release(&me->instance);
    free(me);
}

RIDELAB_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean events,
    fmi3Boolean early_return, const fmi3ValueReference intermediate[], size_t count, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)name, (void)visible, (void)logging, (void)early_return, (void)intermediate, (void)update;
    struct fmu *me = calloc(1, sizeof *me);
    if (!me)
        return NULL;
    me->environment = environment;
    me->log = log;
    const char *wrong = events || count ? "It has neither event mode nor intermediate variables"
                                        : prepare(&me->instance, resources);
    if (!wrong && (!token || strcmp(token, me->instance.resources.token) != 0))
        wrong = "The instantiation token is that of another FMU";
    if (told(me, wrong) == fmi3OK)
        return me;
    fmi3FreeInstance(me);
    return NULL;
}

RIDELAB_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                                         fmi3Boolean visible, fmi3Boolean logging,
                                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging;
    struct fmu nobody = {.environment = environment, .log = log};
    (void)told(&nobody, "It is for co-simulation alone");
    return NULL;
}

RIDELAB_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    (void)update, (void)lock, (void)unlock;
    return fmi3InstantiateModelExchange(name, token, resources, visible, logging, environment, log);
}

RIDELAB_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined,
                                                      fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean stop_defined,
                                                      fmi3Float64 stop)
{
    (void)tolerance_defined, (void)tolerance, (void)stop_defined, (void)stop;
    struct fmu *me = instance;
    me->instance.time = start;
    return told(me, enter(instance, INSTANTIATED, INITIALIZING));
}

RIDELAB_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance me)
{
    return told(me, enter(me, INITIALIZING, STEPPING));
}

RIDELAB_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance me)
{
    return told(me, enter(me, STEPPING, STEPPING));
}

RIDELAB_EXPORT fmi3Status fmi3Terminate(fmi3Instance me)
{
    return told(me, enter(me, STEPPING, TERMINATED));
}

RIDELAB_EXPORT fmi3Status fmi3Reset(fmi3Instance me)
{
    begin_again(me);
    return fmi3OK;
}

/* No variable is an array: there are as many values as references. */
static const char *uneven(size_t count, size_t values)
{
    return count == values ? NULL : "There are not as many values as value references";
}

RIDELAB_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference reference[], size_t count,
                                         fmi3Float64 value[], size_t values)
{
    struct fmu *me = instance;
    const char *wrong = uneven(count, values);
    for (size_t i = 0; i < count && !wrong; i++)
        if (reference[i] == me->instance.resources.variables) /* the independent one */
            value[i] = me->instance.time;
        else
            wrong = get_number(&me->instance, reference[i], 0, value + i);
    return told(me, wrong);
}

RIDELAB_EXPORT fmi3Status fmi3GetInt32(fmi3Instance me, const fmi3ValueReference reference[], size_t count,
                                       fmi3Int32 value[], size_t values)
{
    const char *wrong = uneven(count, values);
    for (size_t i = 0; i < count && !wrong; i++) {
        double number = 0;
        wrong = get_number(me, reference[i], 1, &number);
        value[i] = (fmi3Int32)number;
    }
    return told(me, wrong);
}

RIDELAB_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance me, const fmi3ValueReference reference[], size_t count,
                                         const fmi3Float64 value[], size_t values)
{
    const char *wrong = uneven(count, values);
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = set_number(me, reference[i], 0, value[i]);
    return told(me, wrong);
}

RIDELAB_EXPORT fmi3Status fmi3SetInt32(fmi3Instance me, const fmi3ValueReference reference[], size_t count,
                                       const fmi3Int32 value[], size_t values)
{
    const char *wrong = uneven(count, values);
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = set_number(me, reference[i], 1, value[i]);
    return told(me, wrong);
}

RIDELAB_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step, fmi3Boolean no_return,
                                     fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last)
{
    (void)no_return;
    struct fmu *me = instance;
    const char *wrong = make_step(&me->instance, time, step);
    *event = *terminate = *early = false;
    *last = me->instance.time;
    return told(me, wrong);
}

/* What the standard wants to be there, and modelDescription.xml says is of no use. */
#define UNSUPPORTED(name, ...)                                   \
    RIDELAB_EXPORT fmi3Status name(fmi3Instance me, __VA_ARGS__) \
    {                                                            \
        return told(me, "The function is not supported: " #name); \
    }
#define UNSUPPORTED_ALONE(name)                                  \
    RIDELAB_EXPORT fmi3Status name(fmi3Instance me)              \
    {                                                            \
        return told(me, "The function is not supported: " #name); \
    }
#define NO_SUCH_TYPE(type)                                                                                              \
    UNSUPPORTED(fmi3Get##type, const fmi3ValueReference reference[], size_t count, fmi3##type value[], size_t values)   \
    UNSUPPORTED(fmi3Set##type, const fmi3ValueReference reference[], size_t count, const fmi3##type value[], size_t values)
NO_SUCH_TYPE(Float32)
NO_SUCH_TYPE(Int8)
NO_SUCH_TYPE(UInt8)
NO_SUCH_TYPE(Int16)
NO_SUCH_TYPE(UInt16)
NO_SUCH_TYPE(UInt32)
NO_SUCH_TYPE(Int64)
NO_SUCH_TYPE(UInt64)
NO_SUCH_TYPE(Boolean)
NO_SUCH_TYPE(String)
#define REFERENCES const fmi3ValueReference reference[], size_t count
UNSUPPORTED(fmi3GetBinary, REFERENCES, size_t sizes[], fmi3Binary value[], size_t values)
UNSUPPORTED(fmi3SetBinary, REFERENCES, const size_t sizes[], const fmi3Binary value[], size_t values)
UNSUPPORTED(fmi3GetClock, REFERENCES, fmi3Clock value[])
UNSUPPORTED(fmi3SetClock, REFERENCES, const fmi3Clock value[])
UNSUPPORTED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference reference, size_t *count)
UNSUPPORTED(fmi3GetVariableDependencies, fmi3ValueReference dependent, size_t of_dependent[],
            fmi3ValueReference independents[], size_t of_independents[], fmi3DependencyKind kinds[], size_t count)
UNSUPPORTED(fmi3GetFMUState, fmi3FMUState *state)
UNSUPPORTED(fmi3SetFMUState, fmi3FMUState state)
UNSUPPORTED(fmi3FreeFMUState, fmi3FMUState *state)
UNSUPPORTED(fmi3SerializedFMUStateSize, fmi3FMUState state, size_t *size)
UNSUPPORTED(fmi3SerializeFMUState, fmi3FMUState state, fmi3Byte bytes[], size_t size)
UNSUPPORTED(fmi3DeserializeFMUState, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
UNSUPPORTED(fmi3GetDirectionalDerivative, const fmi3ValueReference unknowns[], size_t unknown, const fmi3ValueReference knowns[],
            size_t known, const fmi3Float64 seed[], size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities)
UNSUPPORTED(fmi3GetAdjointDerivative, const fmi3ValueReference unknowns[], size_t unknown, const fmi3ValueReference knowns[],
            size_t known, const fmi3Float64 seed[], size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities)
UNSUPPORTED_ALONE(fmi3EnterEventMode)
UNSUPPORTED_ALONE(fmi3EnterConfigurationMode)
UNSUPPORTED_ALONE(fmi3ExitConfigurationMode)
UNSUPPORTED(fmi3GetIntervalDecimal, REFERENCES, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
UNSUPPORTED(fmi3GetIntervalFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
            fmi3IntervalQualifier qualifiers[])
UNSUPPORTED(fmi3GetShiftDecimal, REFERENCES, fmi3Float64 shifts[])
UNSUPPORTED(fmi3GetShiftFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
UNSUPPORTED(fmi3SetIntervalDecimal, REFERENCES, const fmi3Float64 intervals[])
UNSUPPORTED(fmi3SetIntervalFraction, REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
UNSUPPORTED(fmi3SetShiftDecimal, REFERENCES, const fmi3Float64 shifts[])
UNSUPPORTED(fmi3SetShiftFraction, REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
UNSUPPORTED_ALONE(fmi3EvaluateDiscreteStates)
UNSUPPORTED(fmi3UpdateDiscreteStates, fmi3Boolean *update, fmi3Boolean *terminate, fmi3Boolean *nominals,
            fmi3Boolean *values, fmi3Boolean *defined, fmi3Float64 *next)
UNSUPPORTED_ALONE(fmi3EnterContinuousTimeMode)
UNSUPPORTED(fmi3CompletedIntegratorStep, fmi3Boolean no_return, fmi3Boolean *event, fmi3Boolean *terminate)
UNSUPPORTED(fmi3SetTime, fmi3Float64 time)
UNSUPPORTED(fmi3SetContinuousStates, const fmi3Float64 states[], size_t count)
UNSUPPORTED(fmi3GetContinuousStateDerivatives, fmi3Float64 derivatives[], size_t count)
UNSUPPORTED(fmi3GetEventIndicators, fmi3Float64 indicators[], size_t count)
UNSUPPORTED(fmi3GetContinuousStates, fmi3Float64 states[], size_t count)
UNSUPPORTED(fmi3GetNominalsOfContinuousStates, fmi3Float64 nominals[], size_t count)
UNSUPPORTED(fmi3GetNumberOfEventIndicators, size_t *count)
UNSUPPORTED(fmi3GetNumberOfContinuousStates, size_t *count)
UNSUPPORTED(fmi3GetOutputDerivatives, REFERENCES, const fmi3Int32 orders[], fmi3Float64 value[], size_t values)
UNSUPPORTED(fmi3ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)
