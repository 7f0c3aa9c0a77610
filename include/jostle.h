// Vibrated granular disks as a C library. Made from capi/src by cbindgen: do not edit.

#ifndef JOSTLE_H
#define JOSTLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// One simulation is one pointer. Every function may be called from any thread, and different simulations at the same time;
// a call into a simulation in which another thread is at work is refused (JOSTLE_STATUS_BUSY) and changes nothing.
// Texts are UTF-8 that ends with a zero byte; numbers in texts have a point, whatever the locale. SI units.


// How a call ended. Unless it is JOSTLE_STATUS_OK, `jostle_error_text` says what was wrong and what to do.
typedef enum JostleStatus {
  // Done.
  JOSTLE_STATUS_OK = 0,
  // The step cannot be done. The simulation is as before the call: try a shorter step or other inputs.
  JOSTLE_STATUS_STEP_REFUSED = 1,
  // Refused: an argument is wrong. Nothing has changed.
  JOSTLE_STATUS_ERROR = 2,
  // A defect of the library showed. This simulation can only be read, restored and freed; others are not touched.
  JOSTLE_STATUS_FAILED = 3,
  // Another thread is at work in this simulation. Nothing has changed and no text was written.
  JOSTLE_STATUS_BUSY = 4,
  // The pointer is null or no simulation (any more). No text was written.
  JOSTLE_STATUS_NO_SIMULATION = 5,
} JostleStatus;

// Who sets a variable, and when.
typedef enum JostleCausality {
  // Given when the simulation is made, frozen since unless it is tunable.
  JOSTLE_CAUSALITY_PARAMETER = 0,
  // Computed from the parameters, constant unless one that it depends on is tuned.
  JOSTLE_CAUSALITY_CALCULATED_PARAMETER = 1,
  // Set between steps.
  JOSTLE_CAUSALITY_INPUT = 2,
  // Computed by the scene.
  JOSTLE_CAUSALITY_OUTPUT = 3,
} JostleCausality;

// What a variable holds.
typedef enum JostleKind {
  // A real number: jostle_get.
  JOSTLE_KIND_REAL = 0,
  // A whole number: jostle_get_integers.
  JOSTLE_KIND_INTEGER = 1,
  // The number of an option, the first being 1: jostle_get_integers.
  JOSTLE_KIND_ENUMERATION = 2,
} JostleKind;

// A simulation. Made by `jostle_new` or `jostle_new_from_toml`, ended by `jostle_free`.
typedef struct JostleSimulation JostleSimulation;

// A parameter, or an input at the start, and its value as a text: `{"drive.amplitude", "1e-4"}`, `{"seed", "7"}`,
// `{"base.model", "moving"}`.
typedef struct JostleSetting {
  // Name of the variable.
  const char *name;
  // Its value: digits with a point, or the name of an option.
  const char *value;
} JostleSetting;

// A variable. The texts live as long as its simulation.
typedef struct JostleVariable {
  // Name, such as `disk.angle[1]`.
  const char *name;
  // Unit, such as `m/s`; `1` for pure numbers.
  const char *unit;
  // One sentence.
  const char *description;
  // Names of the options of an enumeration, separated by commas; else empty.
  const char *options;
  // Who sets it.
  enum JostleCausality causality;
  // What it holds.
  enum JostleKind kind;
  // Smallest allowed value; minus infinity for none.
  double min;
  // Largest allowed value; infinity for none. (Whole numbers beyond 2^53 are rounded here.)
  double max;
  // Value if none is given.
  double start;
  // A parameter that jostle_set may change between steps too.
  bool tunable;
} JostleVariable;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Makes a simulation of a scene at time 0. `engine` and `drive` may be null and `disks` 0 for the scene's first;
// `jostle_scenes` lists them. `settings` has `count` elements and holds what differs from the start values; it may be
// null if `count` is 0. Returns null if anything is wrong, and then writes what it is to `error`, which has `error_size`
// bytes or is null.
//
// # Safety
// Pointers are null or as said; texts end with a zero byte.
struct JostleSimulation *jostle_new(const char *scene,
                                    const char *engine,
                                    const char *drive,
                                    uint32_t disks,
                                    const struct JostleSetting *settings,
                                    size_t count,
                                    char *error,
                                    size_t error_size);

// Makes a simulation from a TOML text at time 0: the keys `scene`, and if wanted `engine`, `drive`, `disks`, and a table
// `parameters`. Returns null if anything is wrong, and then writes what it is to `error`, which has `error_size` bytes or
// is null.
//
// # Safety
// Pointers are null or as said; `toml` ends with a zero byte.
struct JostleSimulation *jostle_new_from_toml(const char *toml,
                                              char *error,
                                              size_t error_size);

// Ends a simulation. Null is ignored.
//
// # Safety
// `simulation` is null or was made here and not freed.
void jostle_free(struct JostleSimulation *simulation);

// Copies the text of the last refusal in this simulation, empty if there was none: what was wrong, its value, what is
// allowed, what to do. At most `size` bytes are written, a zero byte at the end included. Returns the size of the whole
// text with its zero byte; 0 if the pointer is no simulation or another thread is at work in it.
//
// # Safety
// `simulation` is null or was made here and not freed; `text` is null or has `size` bytes.
size_t jostle_error_text(const struct JostleSimulation *simulation,
                         char *text,
                         size_t size);

// Version of the library, such as `0.1.0`.
const char *jostle_version(void);

// Lists what `jostle_new` takes: one line for each, with scene, engine and drive separated by spaces. The first engine of
// a scene is its default, and the first drive of an engine. At most `size` bytes are written, a zero byte at the end
// included. Returns the size of the whole text with its zero byte.
//
// # Safety
// `text` is null or has `size` bytes.
size_t jostle_scenes(char *text,
                     size_t size);

// Number of variables; 0 if the pointer is no simulation or another thread is at work in it.
//
// # Safety
// `simulation` is null or was made here and not freed.
uint32_t jostle_variable_count(const struct JostleSimulation *simulation);

// Describes variable number `variable`, from 0 on.
//
// # Safety
// `simulation` is null or was made here and not freed; `description` is null or may be written.
enum JostleStatus jostle_variable(const struct JostleSimulation *simulation,
                                  uint32_t variable,
                                  struct JostleVariable *description);

// Saves everything as bytes without pointers, for a file or another process. `size` becomes their number. With `bytes`
// null nothing else happens; otherwise `capacity` bytes may be written to `bytes`, and fewer than `size` are refused.
//
// # Safety
// `simulation` is null or was made here and not freed; `bytes` is null or has `capacity` bytes; `size` is null or may be
// written.
enum JostleStatus jostle_save(const struct JostleSimulation *simulation,
                              uint8_t *bytes,
                              size_t capacity,
                              size_t *size);

// Goes to a state that a simulation of the same scene, engine, drive, number of disks and version of the library saved;
// parameters and inputs come back too. If the bytes are refused, nothing has changed.
//
// # Safety
// `simulation` is null or was made here and not freed; `bytes` is null or has `size` bytes.
enum JostleStatus jostle_restore(struct JostleSimulation *simulation,
                                 const uint8_t *bytes,
                                 size_t size);

// Advances to `end_time` in seconds, under the inputs as they stand, as one communication step. `end_time` must lie after the
// present time. If the step is refused, nothing has changed.
//
// # Safety
// `simulation` is null or was made here and not freed.
enum JostleStatus jostle_advance_to(struct JostleSimulation *simulation,
                                    double end_time);

// Lets one step do no more than so much work, instead of what takes half an hour at most. A unit is an event (0.1 to 1
// microseconds) or a time step of ten disks; a step that asks for more is refused. No part of the state.
//
// # Safety
// `simulation` is null or was made here and not freed.
enum JostleStatus jostle_limit_work(struct JostleSimulation *simulation,
                                    uint64_t most);

// Writes the time reached, in seconds.
//
// # Safety
// `simulation` is null or was made here and not freed; `time` is null or may be written.
enum JostleStatus jostle_time(const struct JostleSimulation *simulation, double *time);

// Writes the number of the variable called `name`, for `jostle_set`, `jostle_get` and `jostle_variable`. It is the same
// for as long as the simulation lives.
//
// # Safety
// `simulation` is null or was made here and not freed; `name` is null or a text; `variable` is null or may be written.
enum JostleStatus jostle_find(const struct JostleSimulation *simulation,
                              const char *name,
                              uint32_t *variable);

// Sets inputs and tunable parameters: all, or none if one is refused. They hold until they are set again. A tunable parameter
// acts from the next step on, which is refused if its value does not go with the others.
//
// # Safety
// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
enum JostleStatus jostle_set(struct JostleSimulation *simulation,
                             const uint32_t *variables,
                             const double *values,
                             size_t count);

// Sets the input or tunable parameter called `name`. It holds until it is set again.
//
// # Safety
// `simulation` is null or was made here and not freed; `name` is null or a text.
enum JostleStatus jostle_set_by_name(struct JostleSimulation *simulation,
                                     const char *name,
                                     double value);

// Reads real variables, as of now. If one is refused, `values` holds those before it.
//
// # Safety
// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
enum JostleStatus jostle_get(const struct JostleSimulation *simulation,
                             const uint32_t *variables,
                             double *values,
                             size_t count);

// Reads whole numbers, enumerations among them (1 is the first option), as of now. If one is refused, `values` holds
// those before it.
//
// # Safety
// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
enum JostleStatus jostle_get_integers(const struct JostleSimulation *simulation,
                                      const uint32_t *variables,
                                      int64_t *values,
                                      size_t count);

// Reads the real variable called `name`, as of now.
//
// # Safety
// `simulation` is null or was made here and not freed; `name` is null or a text; `value` is null or may be written.
enum JostleStatus jostle_get_by_name(const struct JostleSimulation *simulation,
                                     const char *name,
                                     double *value);

// Reads the whole number called `name`, as of now.
//
// # Safety
// `simulation` is null or was made here and not freed; `name` is null or a text; `value` is null or may be written.
enum JostleStatus jostle_get_integer_by_name(const struct JostleSimulation *simulation,
                                             const char *name,
                                             int64_t *value);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* JOSTLE_H */
