/* guardbit's live model as system functions of Icarus Verilog:
 *     $guardbit_open("profile")                            a model's handle
 *     $guardbit_walk(model, kind)                          a walk's handle
 *     $guardbit_clock(walk, op, init, dx, dy, acc, out)    one clock edge; writes acc and out
 *     $guardbit_divide(model, channel, acc, acc_w, code)   a division of a channel; writes code
 * A result below 0 is an error of guardbit.h, and is said. */
#include "guardbit.h"
#include <vpi_user.h>

enum { OPEN, WALK, CLOCK, DIVIDE };

/* A word without X or Z in four parts; 0 where it has some. */
static int word_in(vpiHandle argument, uint32_t part[4]) {
    s_vpi_value value = {.format = vpiVectorVal};
    int parts = (vpi_get(vpiSize, argument) + 31) / 32;
    vpi_get_value(argument, &value);
    for (int n = 0; n < 4; n++) {
        part[n] = n < parts ? (uint32_t)value.value.vector[n].aval : 0;
        if (n < parts && value.value.vector[n].bval != 0) return 0;
    }
    return 1;
}

static void word_out(vpiHandle argument, const uint32_t part[4]) {
    s_vpi_vecval vector[4];
    s_vpi_value value = {.format = vpiVectorVal, .value.vector = vector};
    for (int n = 0; n < 4; n++) vector[n] = (s_vpi_vecval){(PLI_INT32)part[n], 0};
    vpi_put_value(argument, &value, 0, vpiNoDelay);
}

static PLI_INT32 call(PLI_BYTE8 *which) {
    vpiHandle self = vpi_handle(vpiSysTfCall, 0), list = vpi_iterate(vpiArgument, self), argument[7] = {0};
    s_vpi_value value = {.format = vpiStringVal};
    uint32_t in[5][4] = {{0}}, acc[4], out[4];
    char message[256] = "an argument has X or Z bits, or too few are given";
    static const int wanted[] = {1, 2, 7, 5}, read[] = {0, 2, 5, 4};
    int kind = (int)(intptr_t)which, result = GUARDBIT_ARGUMENT, count = 0, known = 1;
    for (vpiHandle next; list && (next = vpi_scan(list));) if (count < 7) argument[count++] = next;
    if (count < wanted[kind]) known = 0;
    else for (int n = 0; n < read[kind]; n++) known &= word_in(argument[n], in[n]);
    if (known) {
        if (kind == OPEN) {
            vpi_get_value(argument[0], &value);
            result = guardbit_open(value.value.str);
        } else if (kind == WALK) result = guardbit_walk((int32_t)in[0][0], in[1][0]);
        else if (kind == DIVIDE)
            result = guardbit_divide((int32_t)in[0][0], in[1][0], in[2], in[3], out);
        else result = guardbit_clock((int32_t)in[0][0], in[1][0], in[2], in[3], in[4], acc, out);
        if (result < 0) guardbit_message(message, sizeof message);
    }
    if (result < 0) vpi_printf("guardbit error %d: %s\n", result, message);
    else if (kind == CLOCK) word_out(argument[5], acc), word_out(argument[6], out);
    else if (kind == DIVIDE) word_out(argument[4], out);
    value.format = vpiIntVal;
    value.value.integer = result;
    vpi_put_value(self, &value, 0, vpiNoDelay);
    return 0;
}

static void enter(void) {
    static const char *const name[] = {"$guardbit_open", "$guardbit_walk", "$guardbit_clock", "$guardbit_divide"};
    for (int n = OPEN; n <= DIVIDE; n++) {
        s_vpi_systf_data data = {.type = vpiSysFunc, .sysfunctype = vpiIntFunc, .calltf = call};
        data.tfname = (PLI_BYTE8 *)name[n];
        data.user_data = (PLI_BYTE8 *)(intptr_t)n;
        vpi_register_systf(&data);
    }
}

void (*vlog_startup_routines[])(void) = {enter, 0};
