/* Calls that are wrong get a code and a message; calls that are right, words. */
#include "guardbit.h"
#include <stdio.h>
#include <string.h>

static int failed = 0;

static void expect(int32_t got, int32_t wanted, const char *says, int line) {
    char message[512] = "";
    if (wanted < 0) guardbit_message(message, sizeof message);
    if ((wanted < 0 ? got != wanted : got < 0) || !strstr(message, says)) {
        printf("line %d: %d instead of %d: %s\n", line, (int)got, (int)wanted, message);
        failed = 1;
    }
}
#define EXPECT(call, wanted, says) expect((call), (wanted), (says), __LINE__)

static void is(int32_t got, int32_t wanted, int line) {
    if (got != wanted) failed = 1, printf("line %d: %d instead of %d\n", line, (int)got, (int)wanted);
}
#define IS(call, wanted) is((call), (wanted), __LINE__)

/* Every kind through one door. */
static void primitives(void) {
    /* Half pixels: the samples of pixels 0 to 3 are at 1, 3, 5, 7. */
    int64_t corner[6] = {0, 0, 8, 0, 0, 8}, line[4] = {1, 1, 5, 1}, far[4] = {1, 1, 99, 1};
    int64_t square[8] = {0, 0, 8, 0, 8, 8, 0, 8}, clip[9] = {0, 0, 1, 8, 0, 1, 0, 8, 1};
    int64_t right[10] = {64, 64, 96, 64, 64, 96, 48, 48, 127, 127}, wide[1] = {(int64_t)1 << 32};
    uint32_t run[3], words[8];
    uint8_t letter = 0;
    int32_t tiny = guardbit_open("tiny"), psp = guardbit_open("psp");

    IS(guardbit_draw_primitive(tiny, GUARDBIT_TRIANGLE, corner, 6), 3);
    IS(guardbit_draw_primitive(tiny, GUARDBIT_POINT, line, 2), 1);
    IS(guardbit_draw_primitive(tiny, GUARDBIT_LINE, line, 4), 1);
    EXPECT(guardbit_span(tiny, 0, run), 0, "");
    if (run[0] != 0 || run[1] != 0 || run[2] != 2) failed = 1, printf("line %u %u %u\n", run[0], run[1], run[2]);
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_LINE, far, 4), GUARDBIT_REFUSED, "line[1][0] = 99");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_LINE, far, 3), GUARDBIT_ARGUMENT, "4 numbers");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_POLYGON, square, 8), GUARDBIT_REFUSED, "polygons");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_POLYGON_DEPTH, square, 8), GUARDBIT_ARGUMENT, "3 numbers for each");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_CLIP, clip, 9), GUARDBIT_REFUSED, "homogeneous");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_WORDS, right, 10), GUARDBIT_REFUSED, "not registers");
    EXPECT(guardbit_draw_primitive(tiny, 7, right, 10), GUARDBIT_ARGUMENT, "kinds are 0 to 6");
    EXPECT(guardbit_draw_primitive(tiny, GUARDBIT_LINE, 0, 4), GUARDBIT_NULL, "numbers");
    IS(guardbit_draw_primitive(psp, GUARDBIT_WORDS, right, 10), 3);
    IS(guardbit_record(psp, 0, &letter, words, 8), 4);
    /* Twice the legs, 32, times the distances of the sample 7 / 16 from the corner at (4, 4). */
    if (letter != 'P' || words[0] != (4 | 4 << 16) || words[1] != 32 * 18) failed = 1, printf("record %u\n", words[1]);
    EXPECT(guardbit_record(psp, 3, &letter, words, 8), GUARDBIT_ARGUMENT, "there are 3 records");
    EXPECT(guardbit_draw_primitive(psp, GUARDBIT_WORDS, wide, 1), GUARDBIT_ARGUMENT, "4294967295");
    EXPECT(guardbit_draw_primitive(psp, GUARDBIT_WORDS, right, 9), GUARDBIT_REFUSED, "takes 10");
    EXPECT(guardbit_close(tiny), 0, "");
    EXPECT(guardbit_close(psp), 0, "");
}

/* Channels of channels.toml: color (r, g) affine, texcoord (u) by quotient, face (id) of the last vertex. */
static void channels(void) {
    int64_t corner[9] = {0, 0, 0, 8, 0, 0, 0, 8, 0}, flat[6] = {0, 0, 8, 0, 0, 8};
    int64_t codes[12] = {0, 8, 16, 8, 8, 8, 40, 40, 40, 1, 2, 3}, q[3] = {255, 128, 64};
    int64_t far[12] = {0, 8, 256, 8, 8, 8, 40, 40, 40, 1, 2, 3}, zero[3] = {255, 0, 64};
    /* r is x + 2 y in half pixels, at samples 1, 3, 5. */
    int64_t color[12] = {3, 8, 5, 8, 7, 8, 7, 8, 9, 8, 11, 8}, got[12];
    int32_t model = guardbit_open("channels.toml"), tiny = guardbit_open("tiny"), n;
    uint32_t over[4] = {5084, 0, 0, 0}, inverse[4] = {10496, 0, 0, 0}, code[4];
    uint64_t word, shown;
    char name[16];

    IS(guardbit_channels(model), 3);
    IS(guardbit_channels(tiny), 0);
    IS(guardbit_channel(model, 0, name, sizeof name), 2);
    if (strcmp(name, "color")) failed = 1, printf("channel %s\n", name);
    EXPECT(guardbit_component(model, 0, 1, name, sizeof name), 0, "");
    if (strcmp(name, "g")) failed = 1, printf("component %s\n", name);
    IS(guardbit_draw_shaded(model, corner, 9, codes, 12, q), 3);
    IS(guardbit_code_count(model, 0), 12);
    IS(guardbit_code_count(model, 2), 6);
    EXPECT(guardbit_codes(model, 0, 0, 12, got), 0, "");
    if (memcmp(got, color, sizeof color)) failed = 1, printf("not x + 2 y\n");
    EXPECT(guardbit_codes(model, 1, 0, 6, got), 0, "");
    for (n = 0; n < 6; n++) IS((int32_t)got[n], 40);
    EXPECT(guardbit_codes(model, 2, 1, 5, got), 0, "");
    for (n = 0; n < 5; n++) IS((int32_t)got[n], 3);
    EXPECT(guardbit_codes(model, 2, 2, 5, got), GUARDBIT_ARGUMENT, "there are 6 codes");
    EXPECT(guardbit_codes(model, 3, 0, 1, got), GUARDBIT_ARGUMENT, "there are 3 channels");
    EXPECT(guardbit_codes(model, 0, 0, 1, 0), GUARDBIT_NULL, "codes");
    EXPECT(guardbit_code_count(model, 3), GUARDBIT_ARGUMENT, "channel = 3");
    EXPECT(guardbit_channel(model, 3, name, sizeof name), GUARDBIT_ARGUMENT, "index = 3");
    EXPECT(guardbit_channel(model, 0, 0, 0), GUARDBIT_NULL, "name");
    EXPECT(guardbit_component(model, 1, 1, name, sizeof name), GUARDBIT_ARGUMENT, "there are 1 components");
    EXPECT(guardbit_draw_shaded(model, corner, 9, codes, 11, q), GUARDBIT_ARGUMENT, "12 codes are needed");
    EXPECT(guardbit_draw_shaded(model, corner, 8, codes, 12, q), GUARDBIT_ARGUMENT, "6 or 9 numbers");
    EXPECT(guardbit_draw_shaded(model, 0, 9, codes, 12, q), GUARDBIT_NULL, "numbers");
    EXPECT(guardbit_draw_shaded(model, corner, 9, 0, 12, q), GUARDBIT_NULL, "codes");
    IS(guardbit_code_count(model, 0), 12);
    EXPECT(guardbit_draw_shaded(model, corner, 9, codes, 12, 0), GUARDBIT_REFUSED, "each vertex needs its 1/w");
    IS(guardbit_code_count(model, 0), 0);
    EXPECT(guardbit_draw_shaded(model, corner, 9, far, 12, q), GUARDBIT_REFUSED, "r = 256: 0 <= r <= 255");
    EXPECT(guardbit_draw_shaded(model, corner, 9, codes, 12, zero), GUARDBIT_REFUSED, "q = 0: 1 <= q <= 255");
    EXPECT(guardbit_draw_shaded(tiny, corner, 9, codes, 12, q), GUARDBIT_REFUSED, "no [[channel]]");
    EXPECT(guardbit_draw_shaded(0, corner, 9, codes, 12, q), GUARDBIT_HANDLE, "no handle");
    IS(guardbit_draw_shaded(model, flat, 6, codes, 12, q), 3);
    IS(guardbit_code_count(model, 0), 12);
    /* The units. A code of the affine channel has 4 bits below it; 256 is above the range, 384 below 0. */
    n = guardbit_walk(model, GUARDBIT_CHANNEL_WALK);
    EXPECT(n, 0, "");
    EXPECT(guardbit_clock64(n, 0, 255 << 4, 1 << 4, 128 << 4, &word, &shown), 0, "");
    IS((int32_t)shown, 255);
    EXPECT(guardbit_clock64(n, 1, 255 << 4, 1 << 4, 128 << 4, &word, &shown), 0, "");
    IS((int32_t)word, 256 << 4);
    IS((int32_t)shown, 255);
    EXPECT(guardbit_clock64(n, 2, 255 << 4, 1 << 4, 128 << 4, &word, &shown), 0, "");
    IS((int32_t)shown, 0);
    /* 1/w is read with its fraction. */
    n = guardbit_walk(model, 2);
    EXPECT(guardbit_clock64(n, 0, 10496, 0, 0, &word, &shown), 0, "");
    IS((int32_t)shown, 10496);
    EXPECT(guardbit_walk(model, GUARDBIT_CHANNEL_WALK + 2), GUARDBIT_ARGUMENT, "no channel 2 that is walked");
    EXPECT(guardbit_walk(model, GUARDBIT_CHANNEL_WALK + 9), GUARDBIT_ARGUMENT, "no channel 9 that is walked");
    EXPECT(guardbit_divide(model, 1, over, inverse, code), 0, "");
    if (code[0] != 124 || code[1] || code[2] || code[3]) failed = 1, printf("5084 over 10496 is %u\n", code[0]);
    /* Words are taken mod 2^17; 1/w of 0 gives the farthest code. */
    over[0] = (1 << 17) + 5084, over[3] = 7;
    EXPECT(guardbit_divide(model, 1, over, inverse, code), 0, "");
    IS((int32_t)code[0], 124);
    inverse[0] = 0;
    EXPECT(guardbit_divide(model, 1, over, inverse, code), 0, "");
    IS((int32_t)code[0], 255);
    EXPECT(guardbit_divide(model, 0, over, inverse, code), GUARDBIT_ARGUMENT, "not divided by 1/w");
    EXPECT(guardbit_divide(model, 3, over, inverse, code), GUARDBIT_ARGUMENT, "there are 3 channels");
    EXPECT(guardbit_divide(model, 1, over, 0, code), GUARDBIT_NULL, "acc_w");
    EXPECT(guardbit_divide(tiny, 0, over, inverse, code), GUARDBIT_ARGUMENT, "there are 0 channels");
    /* Drawn without channels. */
    IS(guardbit_draw(model, corner), 3);
    IS(guardbit_code_count(model, 0), 0);
    EXPECT(guardbit_close(model), 0, "");
    EXPECT(guardbit_close(tiny), 0, "");
}

int main(void) {
    uint32_t word[4] = {1, 0, 0, 0}, acc[4], out[4], run[3];
    uint64_t acc64, out64, depth[4];
    int64_t vertices[9] = {0, 0, 1, 8192, 0, 2, 0, 8192, 3}, outside[9] = {-1, 0, 0, 0, 0, 0, 0, 0, 0};
    char name[16], tiny[4];
    int32_t model = guardbit_open("sgi-4k"), walk, edge;

    EXPECT(guardbit_interface(), 0, "");
    EXPECT(model, 0, "");
    EXPECT(guardbit_open(0), GUARDBIT_NULL, "profile");
    EXPECT(guardbit_open("no-such-profile"), GUARDBIT_PROFILE, "no-such-profile");
    EXPECT(guardbit_open("\xff"), GUARDBIT_ARGUMENT, "UTF-8");
    EXPECT(guardbit_walk(model + 1, 0), GUARDBIT_HANDLE, "no handle");
    EXPECT(guardbit_walk(model, 2), GUARDBIT_ARGUMENT, "no 1/w that is walked");
    EXPECT(guardbit_walk(model, 3), GUARDBIT_ARGUMENT, "kind = 3");
    EXPECT(guardbit_walk(model, GUARDBIT_CHANNEL_WALK), GUARDBIT_ARGUMENT, "no channel 0 that is walked");
    walk = guardbit_walk(model, 0);
    edge = guardbit_walk(model, 1);
    EXPECT(walk, 0, "");
    EXPECT(edge, 0, "");
    EXPECT(guardbit_walk(walk, 0), GUARDBIT_HANDLE, "open model");
    EXPECT(guardbit_clock(walk, 0, word, word, word, acc, out), 0, "");
    EXPECT(guardbit_clock(walk, 1, word, word, word, acc, out), 0, "");
    if (acc[0] != 2 || acc[1] || acc[2] || acc[3] || out[0]) failed = 1, printf("1 + 1 is not 2\n");
    EXPECT(guardbit_clock(walk, 4, word, word, word, acc, out), GUARDBIT_ARGUMENT, "op = 4");
    EXPECT(guardbit_clock(walk, 0, 0, word, word, acc, out), GUARDBIT_NULL, "init");
    EXPECT(guardbit_clock(walk, 0, word, word, word, acc, 0), GUARDBIT_NULL, "out");
    EXPECT(guardbit_clock(model, 0, word, word, word, acc, out), GUARDBIT_HANDLE, "open walk");
    EXPECT(guardbit_clock64(edge, 0, UINT64_MAX, 0, 0, &acc64, &out64), 0, "");
    if (acc64 != 0x7ffffffff || out64 != 0) failed = 1, printf("minus one is not outside\n");
    EXPECT(guardbit_clock64(edge, 0, 0, 0, 0, 0, &out64), GUARDBIT_NULL, "acc");
    EXPECT(guardbit_draw(model, 0), GUARDBIT_NULL, "vertices");
    EXPECT(guardbit_draw(model, outside), GUARDBIT_REFUSED, "-1");
    EXPECT(guardbit_draw(model, vertices), 0, "");
    EXPECT(guardbit_span(model, 0, run), 0, "");
    if (run[0] != 0 || run[1] != 0 || run[2] != 7) failed = 1, printf("run %u %u %u\n", run[0], run[1], run[2]);
    EXPECT(guardbit_span(model, 1000, run), GUARDBIT_ARGUMENT, "index = 1000");
    EXPECT(guardbit_depth(model, 0, 4, depth), 0, "");
    EXPECT(guardbit_depth(model, UINT64_MAX, 4, depth), GUARDBIT_ARGUMENT, "depths");
    EXPECT(guardbit_setup(model, 0, word), 0, "");
    EXPECT(guardbit_setup(model, 99, word), GUARDBIT_ARGUMENT, "index = 99");
    EXPECT(guardbit_column(model, 0, name, sizeof name), 0, "");
    if (strcmp(name, "edge0_init")) failed = 1, printf("column %s\n", name);
    EXPECT(guardbit_column(model, 0, name, 0), GUARDBIT_NULL, "name");
    if (guardbit_message(tiny, sizeof tiny) <= 3 || strlen(tiny) != 3) failed = 1, printf("not cut\n");
    EXPECT(guardbit_close(walk), 0, "");
    EXPECT(guardbit_close(walk), GUARDBIT_HANDLE, "no handle");
    EXPECT(guardbit_clock(walk, 0, word, word, word, acc, out), GUARDBIT_HANDLE, "no handle");
    EXPECT(guardbit_close(model), 0, "");
    EXPECT(guardbit_draw(model, vertices), GUARDBIT_HANDLE, "no handle");
    EXPECT(guardbit_close(0), GUARDBIT_HANDLE, "no handle");
    EXPECT(guardbit_close(-7), GUARDBIT_HANDLE, "no handle");
    primitives();
    channels();
    if (!failed) printf("PASS\n");
    return failed;
}
