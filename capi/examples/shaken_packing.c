/* A packing on a shaken base, by the C library. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "jostle.h"

static void check(JostleStatus status, const JostleSimulation *packing) {
    if (status != JOSTLE_STATUS_OK) {
        char text[1024] = "no simulation";
        jostle_error_text(packing, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
}

int main(void) {
    const JostleSetting settings[] = {{"seed", "1"}};
    char error[1024];
    JostleSimulation *packing = jostle_new("packing", NULL, "input", 60, settings, 1, error, sizeof error);
    if (!packing) {
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    const char *names[] = {"base.displacement", "base.velocity", "disk.angle[1]", "base.reaction_force"};
    uint32_t numbers[4];
    for (int n = 0; n < 4; n++) {
        check(jostle_find(packing, names[n], &numbers[n]), packing);
    }
    const double amplitude = 1e-3, omega = 2 * 3.14159265358979323846 * 20, step = 1.0 / 512;
    const int steps = 1024;
    double seen[2], force = 0;
    for (int n = 0; n < steps; n++) {
        const double time = n * step;
        const double base[] = {amplitude * (1 - cos(omega * time)), amplitude * omega * sin(omega * time)};
        check(jostle_set(packing, numbers, base, 2), packing);
        check(jostle_advance_to(packing, time + step), packing);
        check(jostle_get(packing, numbers + 2, seen, 2), packing);
        force += seen[1] / steps;
    }
    printf("angle of disk 1: %.17g rad\nmean force on the base: %.17g N\n", seen[0], force);
    jostle_free(packing);
    return 0;
}
