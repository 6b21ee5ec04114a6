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
    EXPECT(guardbit_walk(model, 2), GUARDBIT_ARGUMENT, "kind = 2");
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
    if (!failed) printf("PASS\n");
    return failed;
}
