/* guardbit: the live model for simulators. Generated from bindings/c/src; do not edit. */

#ifndef GUARDBIT_H
#define GUARDBIT_H

#include <stddef.h>
#include <stdint.h>

/*
 The handle is of nothing that is open, or of something of another kind.
 */
#define GUARDBIT_HANDLE -1

/*
 A pointer is null.
 */
#define GUARDBIT_NULL -2

/*
 An argument is outside its range.
 */
#define GUARDBIT_ARGUMENT -3

/*
 The profile cannot be read, or is refused.
 */
#define GUARDBIT_PROFILE -4

/*
 The profile refuses what is to be drawn.
 */
#define GUARDBIT_REFUSED -5

/*
 A defect of this library.
 */
#define GUARDBIT_INTERNAL -6

/*
 A triangle: x, y of three vertices, or x, y, z of three.
 */
#define GUARDBIT_TRIANGLE 0

/*
 A line: x, y of both ends.
 */
#define GUARDBIT_LINE 1

/*
 A point: x, y.
 */
#define GUARDBIT_POINT 2

/*
 A polygon: x, y of three or more vertices.
 */
#define GUARDBIT_POLYGON 3

/*
 A polygon with depth: x, y, z of three or more vertices.
 */
#define GUARDBIT_POLYGON_DEPTH 4

/*
 A triangle that is neither projected nor clipped: X, Y, W of three vertices, or X, Y, Z, W.
 */
#define GUARDBIT_CLIP 5

/*
 The register words of a machine that begins there, each 0 to 2^32 - 1.
 */
#define GUARDBIT_WORDS 6

/*
 The kind of walk of channel 0: a component, or the component over w. Channel n is n more.
 */
#define GUARDBIT_CHANNEL_WALK 16

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Version of this interface; it grows when a function changes its meaning.
 */
int32_t guardbit_interface(void);

/*
 Copies what this thread's last failed call said, ended by a zero and cut to `size` bytes, and
 returns the bytes that the whole message has without its zero.

 # Safety
 `buffer` is null or leads to `size` bytes.
 */
int32_t guardbit_message(char *buffer, uintptr_t size);

/*
 Draws a triangle with channels. `numbers` has x, y of three vertices (`count` is 6) or x, y, z (9),
 as `guardbit_draw_primitive` takes them. `codes` has the codes of the vertices in the order of
 channel, component, vertex: r0 r1 r2 g0 g1 g2 and so on, `code_count` numbers, 3 for each component
 of the profile (clause CH-2). A code of an unsigned channel of i bits is 0 to 2^i - 1, of a signed
 one -2^(i-1) to 2^(i-1) - 1. `q` has the three codes of 1/w, 1 to 2^B - 1, where B is the `integer`
 of `[w]` (clause CH-4). It may be null if no channel is corrected by it, and is ignored by a
 profile without `[w]`. Returns the number of covered runs.

 Another number of codes is `GUARDBIT_ARGUMENT`. A code outside its range, a q that is missing and
 a profile without channels are `GUARDBIT_REFUSED`.

 # Safety
 `numbers` is null or leads to `count` numbers, `codes` is null or leads to `code_count` numbers,
 `q` is null or leads to three numbers.
 */
int32_t guardbit_draw_shaded(int32_t model,
                             const int64_t *numbers,
                             uint32_t count,
                             const int64_t *codes,
                             uint32_t code_count,
                             const int64_t *q);

/*
 How many channels the profile of a model has.
 */
int32_t guardbit_channels(int32_t model);

/*
 Copies the name of channel `index`, in the order of the profile, ended by a zero and cut to `size`
 bytes; returns the number of its components.

 # Safety
 `name` is null or leads to `size` bytes.
 */
int32_t guardbit_channel(int32_t model, uint32_t index, char *name, uintptr_t size);

/*
 Copies the name of component `index` of a channel, ended by a zero and cut to `size` bytes.

 # Safety
 `name` is null or leads to `size` bytes.
 */
int32_t guardbit_component(int32_t model,
                           uint32_t channel,
                           uint32_t index,
                           char *name,
                           uintptr_t size);

/*
 The division of a channel at a sample (clause CH-5): the accumulators of u/w and 1/w in, the code
 out, as a word of four parts each; a code of a signed channel is sign-extended. A channel that is
 not divided by 1/w is `GUARDBIT_ARGUMENT`.

 # Safety
 Each pointer is null or leads to four parts.
 */
int32_t guardbit_divide(int32_t model,
                        uint32_t channel,
                        const uint32_t *acc,
                        const uint32_t *acc_w,
                        uint32_t *code);

/*
 How many codes of a channel the last drawing has: 0 if it was drawn without channels.
 */
int32_t guardbit_code_count(int32_t model, uint32_t channel);

/*
 Copies `count` codes of a channel of the last drawing from code `first` on: run by run, in the
 order of pixel, sample, component (clause CH-7).

 # Safety
 `codes` is null or leads to `count` numbers.
 */
int32_t guardbit_codes(int32_t model,
                       uint32_t channel,
                       uint64_t first,
                       uint32_t count,
                       int64_t *codes);

/*
 `guardbit_clock` for words as `std_logic_vector(127 downto 0)`, one byte a bit, the highest
 first; a bit that is neither 0 nor 1 is an error.

 # Safety
 Each pointer is null or leads to 128 bytes.
 */
int32_t guardbit_clock_logic(int32_t walk,
                             int32_t op,
                             const uint8_t *init,
                             const uint8_t *dx,
                             const uint8_t *dy,
                             uint8_t *acc,
                             uint8_t *out);

/*
 `guardbit_divide` for the same words.

 # Safety
 Each pointer is null or leads to 128 bytes.
 */
int32_t guardbit_divide_logic(int32_t model,
                              int32_t channel,
                              const uint8_t *acc,
                              const uint8_t *acc_w,
                              uint8_t *code);

/*
 Opens a model by the name of a built-in profile or the path of a TOML file, and returns its
 handle.

 # Safety
 `profile` is null or leads to bytes that a zero ends.
 */
int32_t guardbit_open(const char *profile);

/*
 Closes a model or a walk.
 */
int32_t guardbit_close(int32_t handle);

/*
 Draws a triangle: x, y and z of each vertex on the profile's grid and in depth codes; z is
 ignored by a profile without depth. Returns the number of covered runs.

 # Safety
 `vertices` is null or leads to nine numbers.
 */
int32_t guardbit_draw(int32_t model, const int64_t *vertices);

/*
 Draws one primitive of any kind that the profile's machine takes: `kind` is `GUARDBIT_TRIANGLE`
 to `GUARDBIT_WORDS`, `numbers` its coordinates on the profile's input lattice and in depth codes,
 or its words. Returns the number of covered runs, or of records where words were drawn.

 # Safety
 `numbers` is null or leads to `count` numbers.
 */
int32_t guardbit_draw_primitive(int32_t model,
                                uint32_t kind,
                                const int64_t *numbers,
                                uint32_t count);

/*
 Record `index` of the last words drawn: up to `size` of its words; returns how many it has. Its
 letter goes to `letter`.

 # Safety
 `letter` is null or leads to one byte; `words` is null or leads to `size` words.
 */
int32_t guardbit_record(int32_t model,
                        uint32_t index,
                        uint8_t *letter,
                        uint32_t *words,
                        uint32_t size);

/*
 Run `index` of the last drawing as y, x0, x1, half open.

 # Safety
 `run` is null or leads to three numbers.
 */
int32_t guardbit_span(int32_t model, uint32_t index, uint32_t *run);

/*
 Copies `count` depths of the last drawing from covered sample `first` on, run by run.

 # Safety
 `depths` is null or leads to `count` numbers.
 */
int32_t guardbit_depth(int32_t model, uint64_t first, uint32_t count, uint64_t *depths);

/*
 Word `index` of the last drawing's set-up, reduced to its column; returns the column's width.

 # Safety
 `word` is null or leads to four parts.
 */
int32_t guardbit_setup(int32_t model, uint32_t index, uint32_t *word);

/*
 Copies the name of set-up column `index`, ended by a zero and cut to `size` bytes; returns the
 column's width.

 # Safety
 `name` is null or leads to `size` bytes.
 */
int32_t guardbit_column(int32_t model, uint32_t index, char *name, uintptr_t size);

/*
 Opens a walk of a model, all zeros: kind 0 is its depth accumulator, 1 its edge word, 2 its 1/w,
 `GUARDBIT_CHANNEL_WALK` + n an accumulator of channel n (clause CH-16). Returns the walk's handle;
 `guardbit_close` closes it.
 */
int32_t guardbit_walk(int32_t model, uint32_t kind);

/*
 One clock edge of a walk: op 0 loads `init`, 1 adds `dx`, 2 adds `dy`, 3 holds. `acc` and `out`
 take the state after it: the accumulator, and the bits of its read-out or 1 for inside.

 # Safety
 Each pointer is null or leads to four parts.
 */
int32_t guardbit_clock(int32_t walk,
                       uint32_t op,
                       const uint32_t *init,
                       const uint32_t *dx,
                       const uint32_t *dy,
                       uint32_t *acc,
                       uint32_t *out);

/*
 The same for words of at most 64 bits.

 # Safety
 Each pointer is null or leads to one word.
 */
int32_t guardbit_clock64(int32_t walk,
                         uint32_t op,
                         uint64_t init,
                         uint64_t dx,
                         uint64_t dy,
                         uint64_t *acc,
                         uint64_t *out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* GUARDBIT_H */
