/* A model as a plain C programmer writes it from the headers of the standards: ten real inputs u (value references 1 to 10), ten real
   outputs y (11 to 20), which are 2 u at the end of initialisation, and a step that only moves the time (0).

   It has the functions that the benchmark calls, in both versions, and checks what the Reference FMUs of the Modelica Association check:
   null pointers, the state of the instance, unknown references, the number of values, communication point, step size and stop time.
   As there, an error terminates the instance, and a saved state is a copy of the instance in memory that is used again. */
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "fmi3Functions.h"

#define TOKEN "{ten-reals}"
#define COUNT 10

typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEP = 4, TERMINATED = 8 } State;
typedef int Status; /* alike in both versions */
#define OK 0
#define ERROR 3

typedef struct {
    State state;
    double start, time, stop;
    double u[COUNT], y[COUNT];
    bool dirty; /* y is to be computed */
    char *name;
    const fmi2CallbackFunctions *callbacks; /* of FMI 2.0 */
    fmi3LogMessageCallback log;             /* of FMI 3.0 */
    void *environment;
} Model;

static void report(Model *model, const char *format, ...) {
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (model->callbacks && model->callbacks->logger) {
        model->callbacks->logger(model->environment, model->name, fmi2Error, "logStatusError", "%s", text);
    } else if (model->log) {
        model->log(model->environment, fmi3Error, "logStatusError", text);
    }
}

static Status refuse(Model *model, const char *what) {
    report(model, "%s", what);
    model->state = TERMINATED;
    return ERROR;
}

#define BEGIN(function, allowed)                                                            \
    Model *model = instance;                                                                \
    if (!model) return ERROR;                                                               \
    if (!(model->state & (allowed))) return refuse(model, function ": illegal call sequence")

#define NOT_NULL(pointer) \
    if (!(pointer)) return refuse(model, "argument " #pointer " must not be null")

static void set_start_values(Model *model) {
    model->state = INSTANTIATED;
    model->start = model->time = 0.0;
    model->stop = INFINITY;
    memset(model->u, 0, sizeof model->u);
    memset(model->y, 0, sizeof model->y);
    model->dirty = true;
}

static Model *create(const char *name, const char *token) {
    if (!name || !*name || !token || strcmp(token, TOKEN) != 0) return NULL;
    Model *model = calloc(1, sizeof *model);
    if (!model) return NULL;
    model->name = malloc(strlen(name) + 1);
    if (!model->name) {
        free(model);
        return NULL;
    }
    strcpy(model->name, name);
    set_start_values(model);
    return model;
}

static void destroy(Model *model) {
    if (model) free(model->name);
    free(model);
}

static void compute(Model *model) {
    if (!model->dirty) return;
    if (model->state == INITIALIZATION) {
        for (int i = 0; i < COUNT; i++) model->y[i] = 2.0 * model->u[i];
    }
    model->dirty = false;
}

static Status get(Model *model, const unsigned references[], size_t count, double values[], size_t length) {
    if (count == 0) return OK;
    NOT_NULL(references);
    if (length > 0) NOT_NULL(values);
    compute(model);
    size_t index = 0;
    for (size_t i = 0; i < count; i++) {
        unsigned reference = references[i];
        if (index >= length) return refuse(model, "not enough values");
        if (reference == 0) {
            values[index++] = model->time;
        } else if (reference <= COUNT) {
            values[index++] = model->u[reference - 1];
        } else if (reference <= 2 * COUNT) {
            values[index++] = model->y[reference - COUNT - 1];
        } else {
            return refuse(model, "unknown value reference");
        }
    }
    return index == length ? OK : refuse(model, "too many values");
}

static Status set(Model *model, const unsigned references[], size_t count, const double values[], size_t length) {
    if (count == 0) return OK;
    NOT_NULL(references);
    if (length > 0) NOT_NULL(values);
    size_t index = 0;
    for (size_t i = 0; i < count; i++) {
        unsigned reference = references[i];
        if (index >= length) return refuse(model, "not enough values");
        if (reference < 1 || reference > COUNT) return refuse(model, "no input has this value reference");
        model->u[reference - 1] = values[index++];
    }
    model->dirty = true;
    return index == length ? OK : refuse(model, "too many values");
}

static Status do_step(Model *model, double current, double step) {
    double tolerance = 1e-10 * fmax(1.0, fabs(model->time));
    if (fabs(current - model->time) > tolerance) {
        report(model, "the communication point is %.16g, expected was %.16g", current, model->time);
        model->state = TERMINATED;
        return ERROR;
    }
    if (!(step > 0.0)) return refuse(model, "the step size must be greater than 0");
    if (current + step > model->stop + tolerance) return refuse(model, "the end of the step is after the stop time");
    model->time = current + step;
    return OK;
}

static Status save(Model *model, void **state) {
    NOT_NULL(state);
    if (!*state) *state = malloc(sizeof *model);
    if (!*state) return refuse(model, "out of memory");
    memcpy(*state, model, sizeof *model);
    return OK;
}

static Status restore(Model *model, const Model *state) {
    NOT_NULL(state);
    model->state = state->state;
    model->start = state->start;
    model->time = state->time;
    model->stop = state->stop;
    memcpy(model->u, state->u, sizeof model->u);
    memcpy(model->y, state->y, sizeof model->y);
    model->dirty = state->dirty;
    return OK;
}

static Status initialized(Model *model) {
    compute(model);
    model->state = STEP;
    return OK;
}

/* ---- FMI 2.0 ---- */

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type kind, fmi2String token, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging) {
    (void)resources, (void)visible, (void)logging;
    if (!callbacks || !callbacks->logger || kind != fmi2CoSimulation) return NULL;
    Model *model = create(name, token);
    if (!model) return NULL;
    model->callbacks = callbacks;
    model->environment = callbacks->componentEnvironment;
    return model;
}

void fmi2FreeInstance(fmi2Component instance) { destroy(instance); }

fmi2Status fmi2SetupExperiment(fmi2Component instance, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_defined, fmi2Real stop) {
    (void)tolerance_defined, (void)tolerance;
    BEGIN("fmi2SetupExperiment", INSTANTIATED);
    model->start = model->time = start;
    model->stop = stop_defined ? stop : INFINITY;
    return OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component instance) {
    BEGIN("fmi2EnterInitializationMode", INSTANTIATED);
    model->state = INITIALIZATION;
    return OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component instance) {
    BEGIN("fmi2ExitInitializationMode", INITIALIZATION);
    return initialized(model);
}

fmi2Status fmi2GetReal(fmi2Component instance, const fmi2ValueReference references[], size_t count, fmi2Real values[]) {
    BEGIN("fmi2GetReal", INITIALIZATION | STEP | TERMINATED);
    return get(model, references, count, values, count);
}

fmi2Status fmi2SetReal(fmi2Component instance, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[]) {
    BEGIN("fmi2SetReal", INSTANTIATED | INITIALIZATION | STEP);
    return set(model, references, count, values, count);
}

fmi2Status fmi2GetFMUstate(fmi2Component instance, fmi2FMUstate *state) {
    BEGIN("fmi2GetFMUstate", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    return save(model, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component instance, fmi2FMUstate state) {
    BEGIN("fmi2SetFMUstate", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    return restore(model, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component instance, fmi2FMUstate *state) {
    BEGIN("fmi2FreeFMUstate", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    NOT_NULL(state);
    free(*state);
    *state = NULL;
    return OK;
}

fmi2Status fmi2DoStep(fmi2Component instance, fmi2Real current, fmi2Real step, fmi2Boolean keep) {
    (void)keep;
    BEGIN("fmi2DoStep", STEP);
    return do_step(model, current, step);
}

/* ---- FMI 3.0 ---- */

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t required_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
    (void)resources, (void)visible, (void)logging, (void)early_return, (void)required, (void)required_count, (void)update;
    if (event_mode) return NULL;
    Model *model = create(name, token);
    if (!model) return NULL;
    model->log = log;
    model->environment = environment;
    return model;
}

void fmi3FreeInstance(fmi3Instance instance) { destroy(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean stop_defined, fmi3Float64 stop) {
    (void)tolerance_defined, (void)tolerance;
    BEGIN("fmi3EnterInitializationMode", INSTANTIATED);
    model->start = model->time = start;
    model->stop = stop_defined ? stop : INFINITY;
    model->state = INITIALIZATION;
    return OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    BEGIN("fmi3ExitInitializationMode", INITIALIZATION);
    return initialized(model);
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t count, fmi3Float64 values[],
                          size_t length) {
    BEGIN("fmi3GetFloat64", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    return get(model, references, count, values, length);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t length) {
    BEGIN("fmi3SetFloat64", INSTANTIATED | INITIALIZATION | STEP);
    return set(model, references, count, values, length);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state) {
    BEGIN("fmi3GetFMUState", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    return save(model, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
    BEGIN("fmi3SetFMUState", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    return restore(model, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state) {
    BEGIN("fmi3FreeFMUState", INSTANTIATED | INITIALIZATION | STEP | TERMINATED);
    NOT_NULL(state);
    free(*state);
    *state = NULL;
    return OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 current, fmi3Float64 step, fmi3Boolean no_set_before,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached) {
    (void)no_set_before;
    BEGIN("fmi3DoStep", STEP);
    NOT_NULL(event);
    NOT_NULL(terminate);
    NOT_NULL(early);
    NOT_NULL(reached);
    Status status = do_step(model, current, step);
    *event = *terminate = *early = false;
    *reached = model->time;
    return status;
}
