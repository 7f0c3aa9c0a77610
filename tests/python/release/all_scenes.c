/* Every scene of the C library along a short run: name and a checksum over the bits of all its variables. The base moves by 1 mm at
 * 20 Hz, by a rotation instead of the system's sine, so that its C library does not count. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "jostle.h"

static void must(int holds, const JostleSimulation *simulation, const char *what) {
    if (!holds) {
        char text[1024] = "";
        jostle_error_text(simulation, text, sizeof text);
        fprintf(stderr, "failed: %s: %s\n", what, text);
        exit(1);
    }
}

#define AMPLITUDE 1e-3
#define OMEGA 125.66370614359172
/* Of the angle OMEGA / 512. */
#define COSINE 0.970031253194544
#define SINE 0.24298017990326387

/* FNV-1a. */
static uint64_t joined(uint64_t sum, uint64_t bits) {
    for (int byte = 0; byte < 8; byte++) {
        sum = (sum ^ (bits >> (8 * byte) & 0xff)) * UINT64_C(0x100000001b3);
    }
    return sum;
}

static uint64_t bits_of(const JostleSimulation *simulation, uint32_t variable) {
    JostleVariable about;
    double real;
    int64_t whole;
    uint64_t bits;
    must(jostle_variable(simulation, variable, &about) == JOSTLE_STATUS_OK, simulation, "describe");
    if (about.kind == JOSTLE_KIND_REAL) {
        must(jostle_get(simulation, &variable, &real, 1) == JOSTLE_STATUS_OK, simulation, about.name);
        memcpy(&bits, &real, sizeof bits);
    } else {
        must(jostle_get_integers(simulation, &variable, &whole, 1) == JOSTLE_STATUS_OK, simulation, about.name);
        memcpy(&bits, &whole, sizeof bits);
    }
    return bits;
}

static uint64_t checksum(JostleSimulation *simulation) {
    uint64_t sum = UINT64_C(0xcbf29ce484222325);
    double c = 1.0, s = 0.0;
    for (int n = 0; n < 64; n++) {
        /* Refused where there is no such input. */
        jostle_set_by_name(simulation, "base.displacement", AMPLITUDE * (1.0 - c));
        jostle_set_by_name(simulation, "base.velocity", AMPLITUDE * OMEGA * s);
        jostle_set_by_name(simulation, "torque", 1e-4 * s);
        const double turned = c * COSINE - s * SINE;
        s = s * COSINE + c * SINE;
        c = turned;
        must(jostle_advance_to(simulation, (n + 1) / 512.0) == JOSTLE_STATUS_OK, simulation, "step");
        for (uint32_t variable = 0; variable < jostle_variable_count(simulation); variable++) {
            sum = joined(sum, bits_of(simulation, variable));
        }
    }
    return sum;
}

int main(void) {
    static char list[1 << 16];
    char error[1024] = "";
    const JostleSetting amplitude = {"drive.amplitude", "1e-3"};
    jostle_scenes(list, sizeof list);
    for (char *line = strtok(list, "\n"); line; line = strtok(NULL, "\n")) {
        char scene[64], engine[64], drive[64];
        must(sscanf(line, "%63s %63s %63s", scene, engine, drive) == 3, NULL, line);
        JostleSimulation *simulation = jostle_new(scene, engine, drive, 0, &amplitude, 1, error, sizeof error);
        if (!simulation) simulation = jostle_new(scene, engine, drive, 0, NULL, 0, error, sizeof error); /* it has none */
        must(simulation != NULL, NULL, error);
        printf("%s %s %s %016" PRIx64 "\n", scene, engine, drive, checksum(simulation));
        jostle_free(simulation);
    }
    return 0;
}
