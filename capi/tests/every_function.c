/* Calls every function of jostle.h as it is meant and as it is not. Prints nothing and ends with 0 if all answers are right. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "jostle.h"

#define EXPECT(condition)                                                         \
    do {                                                                          \
        if (!(condition)) {                                                       \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
            exit(1);                                                              \
        }                                                                         \
    } while (0)

static char text[4096];

static const char *told(const JostleSimulation *simulation) {
    EXPECT(jostle_error_text(simulation, text, sizeof text) == strlen(text) + 1);
    return text;
}

static void listing(const JostleSimulation *wedge) {
    const uint32_t count = jostle_variable_count(wedge);
    int inputs = 0, enumerations = 0, tunable = 0;
    EXPECT(count > 10);
    for (uint32_t number = 0; number < count; number++) {
        JostleVariable variable;
        uint32_t found;
        EXPECT(jostle_variable(wedge, number, &variable) == JOSTLE_STATUS_OK);
        EXPECT(jostle_find(wedge, variable.name, &found) == JOSTLE_STATUS_OK && found == number);
        EXPECT(strlen(variable.unit) > 0 && strlen(variable.description) > 0);
        EXPECT(variable.causality == JOSTLE_CAUSALITY_OUTPUT || variable.causality == JOSTLE_CAUSALITY_CALCULATED_PARAMETER ||
               (variable.start >= variable.min && variable.start <= variable.max));
        inputs += variable.causality == JOSTLE_CAUSALITY_INPUT;
        tunable += variable.tunable;
        EXPECT(!variable.tunable || variable.causality == JOSTLE_CAUSALITY_PARAMETER);
        enumerations += variable.kind == JOSTLE_KIND_ENUMERATION;
        EXPECT((variable.kind == JOSTLE_KIND_ENUMERATION) == (strlen(variable.options) > 0));
    }
    EXPECT(inputs == 3 && enumerations == 0 && tunable == 3);
    JostleVariable variable;
    EXPECT(jostle_variable(wedge, count, &variable) == JOSTLE_STATUS_ERROR);
    EXPECT(strstr(told(wedge), "jostle_find"));
    EXPECT(jostle_variable(wedge, 0, NULL) == JOSTLE_STATUS_ERROR);
}

static void values(JostleSimulation *wedge) {
    uint32_t numbers[3];
    double now[3] = {-7, -7, -7};
    int64_t count;
    EXPECT(jostle_find(wedge, "base.displacement", &numbers[0]) == JOSTLE_STATUS_OK);
    EXPECT(jostle_find(wedge, "base.velocity", &numbers[1]) == JOSTLE_STATUS_OK);
    EXPECT(jostle_find(wedge, "collisions", &numbers[2]) == JOSTLE_STATUS_OK);
    EXPECT(jostle_find(wedge, "glue", &numbers[2]) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "glue"));
    EXPECT(jostle_find(wedge, NULL, &numbers[2]) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_find(wedge, "gravity", NULL) == JOSTLE_STATUS_ERROR);

    /* All or none. */
    const double fine[] = {1e-4, 0.01}, broken[] = {2e-4, NAN};
    EXPECT(jostle_set(wedge, numbers, fine, 2) == JOSTLE_STATUS_OK);
    EXPECT(jostle_set(wedge, numbers, broken, 2) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "base.velocity"));
    EXPECT(jostle_get(wedge, numbers, now, 2) == JOSTLE_STATUS_OK && now[0] == 1e-4 && now[1] == 0.01);
    EXPECT(jostle_set(wedge, NULL, NULL, 0) == JOSTLE_STATUS_OK);
    EXPECT(jostle_set(wedge, NULL, fine, 1) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_set(wedge, numbers, NULL, 1) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_set(wedge, numbers, fine, SIZE_MAX) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_set_by_name(wedge, "base.velocity", 0.0) == JOSTLE_STATUS_OK);
    EXPECT(jostle_set_by_name(wedge, "disk.mass", 1.0) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "frozen"));
    EXPECT(jostle_set_by_name(wedge, "gravity", -1.0) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "gravity"));
    EXPECT(jostle_set_by_name(wedge, "gravity", 9.5) == JOSTLE_STATUS_OK);
    EXPECT(jostle_get_by_name(wedge, "gravity", now) == JOSTLE_STATUS_OK && now[0] == 9.5);
    now[0] = 1e-4;
    EXPECT(jostle_set_by_name(wedge, "energy.kinetic", 1.0) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_set_by_name(wedge, "\xff", 1.0) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "UTF-8"));

    EXPECT(jostle_advance_to(wedge, 0.0) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_advance_to(wedge, NAN) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_advance_to(wedge, 0.5) == JOSTLE_STATUS_OK);
    EXPECT(jostle_advance_to(wedge, 0.25) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_limit_work(wedge, 3) == JOSTLE_STATUS_OK);
    EXPECT(jostle_advance_to(wedge, 100) == JOSTLE_STATUS_STEP_REFUSED && strstr(told(wedge), "more than one call may do"));
    EXPECT(jostle_limit_work(wedge, 1000000000) == JOSTLE_STATUS_OK);
    EXPECT(jostle_limit_work(NULL, 1) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_time(wedge, now) == JOSTLE_STATUS_OK && now[0] == 0.5);
    EXPECT(jostle_time(wedge, NULL) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_get_by_name(wedge, "disk.y[1]", now) == JOSTLE_STATUS_OK && now[0] > 0);
    EXPECT(jostle_get_by_name(wedge, "collisions", now) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_get_integer_by_name(wedge, "collisions", &count) == JOSTLE_STATUS_OK && count > 0);
    EXPECT(jostle_get_integer_by_name(wedge, "disk.y[1]", &count) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_get(wedge, numbers + 2, now, 1) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "jostle_get_integers"));
    EXPECT(jostle_get_integers(wedge, numbers, &count, 1) == JOSTLE_STATUS_ERROR);
    const int64_t seen = count;
    EXPECT(jostle_get_integers(wedge, numbers + 2, &count, 1) == JOSTLE_STATUS_OK && count == seen);
}

static void states(JostleSimulation *wedge, JostleSimulation *other) {
    size_t size = 0;
    double first, second;
    EXPECT(jostle_save(wedge, NULL, 0, &size) == JOSTLE_STATUS_OK && size > 100);
    EXPECT(jostle_save(wedge, NULL, 0, NULL) == JOSTLE_STATUS_ERROR);
    uint8_t *bytes = malloc(size);
    EXPECT(jostle_save(wedge, bytes, size - 1, &size) == JOSTLE_STATUS_ERROR && strstr(told(wedge), "capacity"));
    EXPECT(jostle_save(wedge, bytes, size, &size) == JOSTLE_STATUS_OK);
    EXPECT(jostle_advance_to(wedge, 1.0) == JOSTLE_STATUS_OK);
    EXPECT(jostle_get_by_name(wedge, "disk.angle[1]", &first) == JOSTLE_STATUS_OK);
    EXPECT(jostle_restore(other, bytes, size) == JOSTLE_STATUS_OK);
    EXPECT(jostle_advance_to(other, 1.0) == JOSTLE_STATUS_OK);
    EXPECT(jostle_get_by_name(other, "disk.angle[1]", &second) == JOSTLE_STATUS_OK && first == second);
    bytes[size / 2] ^= 4;
    EXPECT(jostle_restore(other, bytes, size) == JOSTLE_STATUS_ERROR && strstr(told(other), "damaged"));
    EXPECT(jostle_restore(other, bytes, size / 2) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_restore(other, NULL, size) == JOSTLE_STATUS_ERROR);
    EXPECT(jostle_restore(other, NULL, 0) == JOSTLE_STATUS_ERROR);
    free(bytes);
}

static void wrong_creation(void) {
    const JostleSetting half[] = {{"seed", NULL}}, unknown[] = {{"glue", "1"}};
    EXPECT(!jostle_new(NULL, NULL, NULL, 0, NULL, 0, text, sizeof text) && strstr(text, "scene is a null pointer"));
    EXPECT(!jostle_new("sandpile", NULL, NULL, 0, NULL, 0, text, sizeof text) && strstr(text, "one of: packing"));
    EXPECT(!jostle_new("packing", "magic", NULL, 0, NULL, 0, text, sizeof text) && strstr(text, "molecular-dynamics"));
    EXPECT(!jostle_new("packing", NULL, NULL, 0, NULL, 1, text, sizeof text) && strstr(text, "settings"));
    EXPECT(!jostle_new("packing", NULL, NULL, 0, half, 1, text, sizeof text) && strstr(text, "value of setting 0"));
    EXPECT(!jostle_new("packing", NULL, NULL, 0, unknown, 1, text, sizeof text) && strstr(text, "glue"));
    EXPECT(!jostle_new("packing", NULL, NULL, 4000000000u, NULL, 0, text, 8) && strlen(text) == 7);
    EXPECT(!jostle_new("sandpile", NULL, NULL, 0, NULL, 0, NULL, 0));
    EXPECT(!jostle_new_from_toml("scene = [", text, sizeof text) && strstr(text, "TOML"));
    EXPECT(!jostle_new_from_toml(NULL, NULL, 5));
}

static void no_simulation(void) {
    double value = 0;
    size_t size = 0;
    uint32_t number = 0;
    EXPECT(jostle_advance_to(NULL, 1) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_time(NULL, &value) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_find(NULL, "seed", &number) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_get(NULL, &number, &value, 1) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_save(NULL, NULL, 0, &size) == JOSTLE_STATUS_NO_SIMULATION);
    EXPECT(jostle_error_text(NULL, text, sizeof text) == 0);
    EXPECT(jostle_variable_count(NULL) == 0);
    jostle_free(NULL);
}

int main(void) {
    EXPECT(strlen(jostle_version()) >= 5);
    const size_t needed = jostle_scenes(text, sizeof text);
    EXPECT(needed == strlen(text) + 1 && strstr(text, "wedge event-driven input\n"));
    EXPECT(jostle_scenes(NULL, 0) == needed);
    wrong_creation();
    no_simulation();
    const JostleSetting settings[] = {{"seed", "9"}, {"wedge.tilt", "0.1"}};
    JostleSimulation *wedge = jostle_new("wedge", "event-driven", NULL, 0, settings, 2, text, sizeof text);
    JostleSimulation *other = jostle_new_from_toml(
        "scene = 'wedge'\nengine = 'event-driven'\n[parameters]\nwedge.tilt = 0.2", text, sizeof text);
    EXPECT(wedge && other);
    EXPECT(jostle_error_text(wedge, text, sizeof text) == 1 && !*text);
    listing(wedge);
    values(wedge);
    states(wedge, other);
    jostle_free(wedge);
    jostle_free(other);
    return 0;
}
