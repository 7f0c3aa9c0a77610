/* An importer of FMI 3.0 without anything of jostle: loads a library by its path and prints the bits of what it computes.
 *
 *   host LIBRARY TOKEN cycles COUNT VARIABLE          loads, steps and unloads it so often
 *   host LIBRARY TOKEN save FILE INPUT VARIABLE       steps, writes its state to FILE, steps on
 *   host LIBRARY TOKEN restore FILE INPUT VARIABLE    reads the state of FILE, steps on
 *   host LIBRARY TOKEN panic PARAMETER VARIABLE       one instance panics at the time of PARAMETER, its neighbour does not
 *
 * Variables are value references; INPUT may be - for none. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3FunctionTypes.h"

#ifdef _WIN32
#include <windows.h>
#include <shellapi.h>
typedef HMODULE Handle;
typedef wchar_t *Path;
static Handle load(Path path) { return LoadLibraryW(path); }
static FILE *opened(Path path, int writes) { return _wfopen(path, writes ? L"wb" : L"rb"); }
#define SYMBOL(handle, name) (void *)GetProcAddress(handle, name)
#define UNLOAD(handle) (FreeLibrary(handle) ? 0 : 1)
#else
#include <dlfcn.h>
typedef void *Handle;
typedef char *Path;
static Handle load(Path path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static FILE *opened(Path path, int writes) { return fopen(path, writes ? "wb" : "rb"); }
#define SYMBOL(handle, name) dlsym(handle, name)
#define UNLOAD(handle) dlclose(handle)
#endif

#define STEP (1.0 / 512.0)
#define STEPS 64

static void must(int holds, const char *what) {
    if (!holds) {
        fprintf(stderr, "failed: %s\n", what);
        exit(1);
    }
}

static void check(fmi3Status status, const char *what) { must(status == fmi3OK, what); }

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)status, (void)category, (void)message;
}

#define FUNCTIONS(DO)                                                                                                 \
    DO(fmi3InstantiateCoSimulation)                                                                                   \
    DO(fmi3EnterInitializationMode)                                                                                   \
    DO(fmi3ExitInitializationMode)                                                                                    \
    DO(fmi3SetFloat64)                                                                                                \
    DO(fmi3GetFloat64)                                                                                                \
    DO(fmi3DoStep)                                                                                                    \
    DO(fmi3Reset)                                                                                                     \
    DO(fmi3GetFMUState)                                                                                               \
    DO(fmi3SetFMUState)                                                                                               \
    DO(fmi3FreeFMUState)                                                                                              \
    DO(fmi3SerializedFMUStateSize)                                                                                    \
    DO(fmi3SerializeFMUState)                                                                                         \
    DO(fmi3DeserializeFMUState)                                                                                       \
    DO(fmi3FreeInstance)

#define DECLARE(name) static name##TYPE *name##_;
FUNCTIONS(DECLARE)

static Handle library_at(Path path) {
    Handle handle = load(path);
    must(handle != NULL, "load the library");
#define FIND(name)                                 \
    name##_ = (name##TYPE *)SYMBOL(handle, #name); \
    must(name##_ != NULL, #name);
    FUNCTIONS(FIND)
    return handle;
}

static fmi3Instance instance_of(const char *token) {
    fmi3Instance made = fmi3InstantiateCoSimulation_("host", token, NULL, fmi3False, fmi3False, fmi3False, fmi3False, NULL, 0,
                                                     NULL, log_message, NULL);
    must(made != NULL, "instantiate");
    return made;
}

static void initialise(fmi3Instance instance, fmi3ValueReference parameter, double value) {
    if (parameter) check(fmi3SetFloat64_(instance, &parameter, 1, &value, 1), "set a parameter");
    check(fmi3EnterInitializationMode_(instance, fmi3False, 0.0, 0.0, fmi3False, 0.0), "enter initialisation");
    check(fmi3ExitInitializationMode_(instance), "exit initialisation");
}

static fmi3Status step(fmi3Instance instance, int number, double length) {
    fmi3Boolean event, terminate, early;
    fmi3Float64 reached;
    return fmi3DoStep_(instance, number * length, length, fmi3True, &event, &terminate, &early, &reached);
}

static void print_value(fmi3Instance instance, fmi3ValueReference variable) {
    double value;
    uint64_t bits;
    check(fmi3GetFloat64_(instance, &variable, 1, &value, 1), "read a variable");
    memcpy(&bits, &value, sizeof bits);
    printf("%016" PRIx64 "\n", bits);
}

/* The input is a polynomial of time, so that it is the same on every system. */
static void run(fmi3Instance instance, fmi3ValueReference input, fmi3ValueReference variable, int first, int last) {
    for (int n = first; n < last; n++) {
        const double time = n * STEP, value = 1e-4 * time * (1.0 - 8.0 * time);
        if (input) check(fmi3SetFloat64_(instance, &input, 1, &value, 1), "set the input");
        check(step(instance, n, STEP), "step");
        if (n % 8 == 7) print_value(instance, variable);
    }
}

static void cycles(Path path, const char *token, int count, fmi3ValueReference variable) {
    for (int n = 0; n < count; n++) {
        Handle handle = library_at(path);
        fmi3Instance instance = instance_of(token);
        initialise(instance, 0, 0.0);
        check(step(instance, 0, STEP), "step");
        if (n == 0 || n == count - 1) print_value(instance, variable);
        fmi3FreeInstance_(instance);
        must(UNLOAD(handle) == 0, "unload the library");
    }
}

static void save(Path file, const char *token, fmi3ValueReference input, fmi3ValueReference variable) {
    fmi3Instance instance = instance_of(token);
    fmi3FMUState state = NULL;
    size_t size = 0;
    initialise(instance, 0, 0.0);
    run(instance, input, variable, 0, STEPS);
    check(fmi3GetFMUState_(instance, &state), "get the state");
    check(fmi3SerializedFMUStateSize_(instance, state, &size), "size of the state");
    fmi3Byte *bytes = malloc(size);
    must(bytes != NULL, "make room");
    check(fmi3SerializeFMUState_(instance, state, bytes, size), "serialise the state");
    check(fmi3FreeFMUState_(instance, &state), "free the state");
    FILE *out = opened(file, 1);
    must(out && fwrite(bytes, 1, size, out) == size && fclose(out) == 0, "write the state");
    printf("on\n");
    run(instance, input, variable, STEPS, 2 * STEPS);
    fmi3FreeInstance_(instance);
    free(bytes);
}

static void restore(Path file, const char *token, fmi3ValueReference input, fmi3ValueReference variable) {
    static fmi3Byte bytes[1 << 20];
    FILE *in = opened(file, 0);
    must(in != NULL, "open the state");
    const size_t size = fread(bytes, 1, sizeof bytes, in);
    fclose(in);
    fmi3Instance instance = instance_of(token);
    fmi3FMUState state = NULL;
    initialise(instance, 0, 0.0);
    check(fmi3DeserializeFMUState_(instance, bytes, size, &state), "deserialise the state");
    check(fmi3SetFMUState_(instance, state), "set the state");
    check(fmi3FreeFMUState_(instance, &state), "free the state");
    printf("on\n");
    run(instance, input, variable, STEPS, 2 * STEPS);
    fmi3FreeInstance_(instance);
}

static void panic_of_one(const char *token, fmi3ValueReference parameter, fmi3ValueReference variable) {
    const double length = 0.01;
    fmi3Instance panics = instance_of(token), neighbour = instance_of(token);
    initialise(panics, parameter, 0.05);
    initialise(neighbour, parameter, 1e9);
    for (int n = 0; n < 8; n++) {
        const fmi3Status status = step(panics, n, length);
        check(step(neighbour, n, length), "step of the neighbour");
        printf("%s ", status == fmi3OK ? "done" : "refused");
        print_value(neighbour, variable);
    }
    check(fmi3Reset_(panics), "reset");
    initialise(panics, parameter, 1e9);
    for (int n = 0; n < 8; n++) check(step(panics, n, length), "step after the reset");
    print_value(panics, variable);
    fmi3FreeInstance_(panics);
    fmi3FreeInstance_(neighbour);
}

static int work(Path library, const char *token, const char *command, const char *word, Path file, const char *third,
                const char *variable) {
    const fmi3ValueReference input = (fmi3ValueReference)strtoul(third, NULL, 10); /* 0, which is time, for - */
    const fmi3ValueReference output = (fmi3ValueReference)strtoul(variable, NULL, 10);
    if (strcmp(command, "cycles") == 0) {
        cycles(library, token, atoi(word), output);
        return 0;
    }
    Handle handle = library_at(library);
    if (strcmp(command, "save") == 0) save(file, token, input, output);
    if (strcmp(command, "restore") == 0) restore(file, token, input, output);
    if (strcmp(command, "panic") == 0) panic_of_one(token, input, output);
    must(UNLOAD(handle) == 0, "unload the library");
    return 0;
}

int main(int count, char **words) {
    must(count == 7, "usage: host LIBRARY TOKEN COMMAND FILE|COUNT|- INPUT|PARAMETER|- VARIABLE");
#ifdef _WIN32
    int wide_count;
    wchar_t **paths = CommandLineToArgvW(GetCommandLineW(), &wide_count);
#else
    char **paths = words;
#endif
    return work(paths[1], words[2], words[3], words[4], paths[4], words[5], words[6]);
}
