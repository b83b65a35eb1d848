/* FMI 2.0 for co-simulation (Modelica Association, FMI 2.0.4, section 4.2): types and functions as the standard has them. */
#include "instance.h"

#ifdef RIDELAB_STANDARD_HEADERS
#include "fmi2Functions.h"
#else
typedef void *fmi2Component, *fmi2ComponentEnvironment, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef const char *fmi2String;
typedef char fmi2Byte;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;
typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;
typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged, valuesOfContinuousStatesChanged,
        nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;
#endif

struct fmu {
    struct instance instance;
    fmi2CallbackFunctions callbacks;
    char *name;
};

/* The status of what failed for a reason, or did not. */
static fmi2Status told(struct fmu *me, const char *wrong)
{
    if (!wrong)
        return fmi2OK;
    if (me->callbacks.logger)
        me->callbacks.logger(me->callbacks.componentEnvironment, me->name, fmi2Error, "logStatusError", wrong); /* none has a % */
    return fmi2Error;
}

RIDELAB_EXPORT const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

RIDELAB_EXPORT const char *fmi2GetVersion(void)
{
    return "2.0";
}

RIDELAB_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    (void)c, (void)on, (void)count, (void)categories; /* errors are all that is logged */
    return fmi2OK;
}

RIDELAB_EXPORT void fmi2FreeInstance(fmi2Component c)
{
    struct fmu *me = c;
    if (!me)
        return;
    release(&me->instance);
    free(me->name);
    free(me);
}

RIDELAB_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token, fmi2String resources,
                                             const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                                             fmi2Boolean logging)
{
    (void)visible, (void)logging;
    struct fmu *me = calloc(1, sizeof *me);
    if (!me)
        return NULL;
    if (callbacks)
        me->callbacks = *callbacks;
    me->name = calloc(1, strlen(name ? name : "") + 1);
    if (me->name && name)
        strcpy(me->name, name);
    const char *wrong = NULL;
    if (type != fmi2CoSimulation)
        wrong = "It is for co-simulation alone";
    else if (!me->name)
        wrong = "There is not enough memory";
    else
        wrong = prepare(&me->instance, resources);
    if (!wrong && (!token || strcmp(token, me->instance.resources.token) != 0))
        wrong = "The GUID is that of another FMU";
    if (told(me, wrong) == fmi2OK)
        return me;
    fmi2FreeInstance(me);
    return NULL;
}

RIDELAB_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                              fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    (void)tolerance_defined, (void)tolerance, (void)stop_defined, (void)stop;
    struct fmu *me = c;
    me->instance.time = start;
    return fmi2OK;
}

RIDELAB_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return told(c, enter(c, INSTANTIATED, INITIALIZING));
}

RIDELAB_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return told(c, enter(c, INITIALIZING, STEPPING));
}

RIDELAB_EXPORT fmi2Status fmi2Terminate(fmi2Component c)
{
    return told(c, enter(c, STEPPING, TERMINATED));
}

RIDELAB_EXPORT fmi2Status fmi2Reset(fmi2Component c)
{
    begin_again(c);
    return fmi2OK;
}

RIDELAB_EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2Real value[])
{
    const char *wrong = NULL;
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = get_number(c, reference[i], 0, value + i);
    return told(c, wrong);
}

RIDELAB_EXPORT fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                         fmi2Integer value[])
{
    const char *wrong = NULL;
    for (size_t i = 0; i < count && !wrong; i++) {
        double number = 0;
        wrong = get_number(c, reference[i], 1, &number);
        value[i] = (fmi2Integer)number;
    }
    return told(c, wrong);
}

RIDELAB_EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                      const fmi2Real value[])
{
    const char *wrong = NULL;
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = set_number(c, reference[i], 0, value[i]);
    return told(c, wrong);
}

RIDELAB_EXPORT fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                         const fmi2Integer value[])
{
    const char *wrong = NULL;
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = set_number(c, reference[i], 1, value[i]);
    return told(c, wrong);
}

RIDELAB_EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_return)
{
    (void)no_return;
    return told(c, make_step(c, time, step));
}

RIDELAB_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    struct fmu *me = c;
    *value = me->instance.time;
    return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}

RIDELAB_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    (void)c;
    *value = 0;
    return kind == fmi2Terminated ? fmi2OK : fmi2Discard;
}

/* What the standard wants to be there, and modelDescription.xml says is of no use; then what is for model exchange alone,
   without which some tools load no library. */
#define UNSUPPORTED(name, ...)                                        \
    RIDELAB_EXPORT fmi2Status name(fmi2Component c, __VA_ARGS__)      \
    {                                                                 \
        return told(c, "The function is not supported: " #name);      \
    }
#define UNSUPPORTED_ALONE(name)                                       \
    RIDELAB_EXPORT fmi2Status name(fmi2Component c)                   \
    {                                                                 \
        return told(c, "The function is not supported: " #name);      \
    }
UNSUPPORTED(fmi2GetBoolean, const fmi2ValueReference reference[], size_t count, fmi2Boolean value[])
UNSUPPORTED(fmi2GetString, const fmi2ValueReference reference[], size_t count, fmi2String value[])
UNSUPPORTED(fmi2SetBoolean, const fmi2ValueReference reference[], size_t count, const fmi2Boolean value[])
UNSUPPORTED(fmi2SetString, const fmi2ValueReference reference[], size_t count, const fmi2String value[])
UNSUPPORTED(fmi2GetFMUstate, fmi2FMUstate *state)
UNSUPPORTED(fmi2SetFMUstate, fmi2FMUstate state)
UNSUPPORTED(fmi2FreeFMUstate, fmi2FMUstate *state)
UNSUPPORTED(fmi2SerializedFMUstateSize, fmi2FMUstate state, size_t *size)
UNSUPPORTED(fmi2SerializeFMUstate, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
UNSUPPORTED(fmi2DeSerializeFMUstate, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
UNSUPPORTED(fmi2GetDirectionalDerivative, const fmi2ValueReference unknown[], size_t unknowns,
            const fmi2ValueReference known[], size_t knowns, const fmi2Real seed[], fmi2Real derivative[])
UNSUPPORTED(fmi2SetRealInputDerivatives, const fmi2ValueReference reference[], size_t count, const fmi2Integer order[],
            const fmi2Real value[])
UNSUPPORTED(fmi2GetRealOutputDerivatives, const fmi2ValueReference reference[], size_t count, const fmi2Integer order[],
            fmi2Real value[])
UNSUPPORTED(fmi2GetStatus, const fmi2StatusKind kind, fmi2Status *value)
UNSUPPORTED(fmi2GetIntegerStatus, const fmi2StatusKind kind, fmi2Integer *value)
UNSUPPORTED(fmi2GetStringStatus, const fmi2StatusKind kind, fmi2String *value)
UNSUPPORTED_ALONE(fmi2EnterEventMode)
UNSUPPORTED(fmi2NewDiscreteStates, fmi2EventInfo *info)
UNSUPPORTED_ALONE(fmi2EnterContinuousTimeMode)
UNSUPPORTED(fmi2CompletedIntegratorStep, fmi2Boolean no_return, fmi2Boolean *event, fmi2Boolean *terminate)
UNSUPPORTED(fmi2SetTime, fmi2Real time)
UNSUPPORTED(fmi2SetContinuousStates, const fmi2Real states[], size_t count)
UNSUPPORTED(fmi2GetDerivatives, fmi2Real derivatives[], size_t count)
UNSUPPORTED(fmi2GetEventIndicators, fmi2Real indicators[], size_t count)
UNSUPPORTED(fmi2GetContinuousStates, fmi2Real states[], size_t count)
UNSUPPORTED(fmi2GetNominalsOfContinuousStates, fmi2Real nominals[], size_t count)

RIDELAB_EXPORT fmi2Status fmi2CancelStep(fmi2Component c)
{
    return told(c, "No step is under way: they are made at once");
}
