/* guardbit vector set tiny, model version 2: header for C99 and C++, generated.
 *
 * Widths, row counts and records of every file of the set. A record's words are raw patterns;
 * columns wider than 64 bits are two words, low word first. Read a file line by line:
 *     char text[GUARDBIT_DDA_EXP_LINE + 2];
 *     struct guardbit_dda_exp row;
 *     while (fgets(text, sizeof text, file))
 *         if (!guardbit_dda_exp_parse(text, &row)) return 1;
 * and count the rows. The parsers refuse lines that are short, long, over-wide or not lowercase
 * hexadecimal. Nothing to link: gcc -std=c99 your_bench.c, run from inside the set folder.
 */
#ifndef GUARDBIT_PKG_H
#define GUARDBIT_PKG_H

#include <stdint.h>

#define GUARDBIT_SET "tiny"
#define GUARDBIT_MODEL_VERSION 2

/* Depth machine: accumulator is guard, integer and interpolation bits, output is the integer bits. */
#define GUARDBIT_GUARD_BITS 1
#define GUARDBIT_INTEGER_BITS 3
#define GUARDBIT_FRACTION_BITS 3
#define GUARDBIT_CLAMP_WRAP 0
#define GUARDBIT_CLAMP_GUARD 1
#define GUARDBIT_CLAMP_SIGN 2
#define GUARDBIT_CLAMP_SATURATE 3
#define GUARDBIT_CLAMP_MODE GUARDBIT_CLAMP_GUARD

/* Set-up: sub-pixel bits of a vertex */
#define GUARDBIT_SUB_PIXEL_BITS 1
/* the sample in its pixel, in sub-pixels */
#define GUARDBIT_SAMPLE_X 1
/* the same, downward */
#define GUARDBIT_SAMPLE_Y 1
/* fill rule: 0 top-left, 1 shadow */
#define GUARDBIT_SHADOW_RULE 0
/* low bits of an edge value that are not kept */
#define GUARDBIT_EDGE_SHIFT 1
/* of start and slopes, as setup_divider has it: nearest-even */
#define GUARDBIT_ROUNDING 4
/* 1: the start gains half a depth step */
#define GUARDBIT_START_HALF 0

/* op columns: what the device does at the clock edge; the row gives the state after it. */
#define GUARDBIT_OP_LOAD 0
#define GUARDBIT_OP_STEP_X 1
#define GUARDBIT_OP_STEP_Y 2
#define GUARDBIT_OP_HOLD 3

/* Value of a two's complement pattern of 1 to 64 bits. */
static inline int64_t guardbit_signed(uint64_t bits, unsigned width) {
    uint64_t sign = UINT64_C(1) << (width - 1);
    uint64_t low = bits & (sign - 1);
    return (bits & sign) ? -(int64_t)(sign - 1 - low) - 1 : (int64_t)low;
}

/* One word of a line and the character after it; 0 if the text is not exactly that. */
static inline int guardbit_word(const char **text, unsigned digits, unsigned width, char end, uint64_t word[2]) {
    word[0] = word[1] = 0;
    for (; digits > 0; digits--) {
        char c = *(*text)++;
        unsigned value;
        if (c >= '0' && c <= '9')
            value = (unsigned)(c - '0');
        else if (c >= 'a' && c <= 'f')
            value = (unsigned)(c - 'a') + 10u;
        else
            return 0;
        word[1] = (word[1] << 4) | (word[0] >> 60);
        word[0] = (word[0] << 4) | value;
    }
    if (width < 64 ? (word[0] >> width) != 0 : (width > 64 && width < 128 && (word[1] >> (width - 64)) != 0))
        return 0;
    return *(*text)++ == end;
}

/* dda.cfg.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_DDA_CFG_ROWS UINT64_C(491)
#define GUARDBIT_DDA_CFG_LINE 9
#define GUARDBIT_DDA_CFG_BITS 24
/* init: signed, width 7, fraction bits 3. Accumulator that the load takes. */
#define GUARDBIT_DDA_CFG_INIT_WIDTH 7
#define GUARDBIT_DDA_CFG_INIT_FRACTION 3
#define GUARDBIT_DDA_CFG_INIT_SIGNED 1
/* dx: signed, width 7, fraction bits 3. Slope per pixel to the right. */
#define GUARDBIT_DDA_CFG_DX_WIDTH 7
#define GUARDBIT_DDA_CFG_DX_FRACTION 3
#define GUARDBIT_DDA_CFG_DX_SIGNED 1
/* dy: signed, width 7, fraction bits 3. Slope per row downward. */
#define GUARDBIT_DDA_CFG_DY_WIDTH 7
#define GUARDBIT_DDA_CFG_DY_FRACTION 3
#define GUARDBIT_DDA_CFG_DY_SIGNED 1
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_DDA_CFG_COLUMNS(X) \
    X(init, 7, 1, 3, 2, 16) \
    X(dx, 7, 1, 3, 2, 8) \
    X(dy, 7, 1, 3, 2, 0)
struct guardbit_dda_cfg {
    uint64_t init;
    uint64_t dx;
    uint64_t dy;
};
static inline int guardbit_dda_cfg_parse(const char *line, struct guardbit_dda_cfg *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->init = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->dx = word[0];
    if (!guardbit_word(&line, 2, 7, '\n', word)) return 0;
    row->dy = word[0];
    return 1;
}

/* dda.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_DDA_EXP_ROWS UINT64_C(4000)
#define GUARDBIT_DDA_EXP_LINE 7
#define GUARDBIT_DDA_EXP_BITS 16
/* op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold. */
#define GUARDBIT_DDA_EXP_OP_WIDTH 2
#define GUARDBIT_DDA_EXP_OP_FRACTION 0
#define GUARDBIT_DDA_EXP_OP_SIGNED 0
/* acc: signed, width 7, fraction bits 3. Accumulator after the clock edge. */
#define GUARDBIT_DDA_EXP_ACC_WIDTH 7
#define GUARDBIT_DDA_EXP_ACC_FRACTION 3
#define GUARDBIT_DDA_EXP_ACC_SIGNED 1
/* out: unsigned, width 3, fraction bits 0. Read-out after the clamp. */
#define GUARDBIT_DDA_EXP_OUT_V_WIDTH 3
#define GUARDBIT_DDA_EXP_OUT_V_FRACTION 0
#define GUARDBIT_DDA_EXP_OUT_V_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_DDA_EXP_COLUMNS(X) \
    X(op, 2, 0, 0, 1, 12) \
    X(acc, 7, 1, 3, 2, 4) \
    X(out_v, 3, 0, 0, 1, 0)
struct guardbit_dda_exp {
    uint64_t op;
    uint64_t acc;
    uint64_t out_v;
};
static inline int guardbit_dda_exp_parse(const char *line, struct guardbit_dda_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 1, 2, '_', word)) return 0;
    row->op = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->acc = word[0];
    if (!guardbit_word(&line, 1, 3, '\n', word)) return 0;
    row->out_v = word[0];
    return 1;
}

/* edge.cfg.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_EDGE_CFG_ROWS UINT64_C(364)
#define GUARDBIT_EDGE_CFG_LINE 9
#define GUARDBIT_EDGE_CFG_BITS 24
/* e0: signed, width 6, fraction bits 0. Edge word that the load takes, bias and shift done. */
#define GUARDBIT_EDGE_CFG_E0_WIDTH 6
#define GUARDBIT_EDGE_CFG_E0_FRACTION 0
#define GUARDBIT_EDGE_CFG_E0_SIGNED 1
/* ea: signed, width 6, fraction bits 0. Step per pixel to the right. */
#define GUARDBIT_EDGE_CFG_EA_WIDTH 6
#define GUARDBIT_EDGE_CFG_EA_FRACTION 0
#define GUARDBIT_EDGE_CFG_EA_SIGNED 1
/* eb: signed, width 6, fraction bits 0. Step per row downward. */
#define GUARDBIT_EDGE_CFG_EB_WIDTH 6
#define GUARDBIT_EDGE_CFG_EB_FRACTION 0
#define GUARDBIT_EDGE_CFG_EB_SIGNED 1
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_EDGE_CFG_COLUMNS(X) \
    X(e0, 6, 1, 0, 2, 16) \
    X(ea, 6, 1, 0, 2, 8) \
    X(eb, 6, 1, 0, 2, 0)
struct guardbit_edge_cfg {
    uint64_t e0;
    uint64_t ea;
    uint64_t eb;
};
static inline int guardbit_edge_cfg_parse(const char *line, struct guardbit_edge_cfg *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->e0 = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->ea = word[0];
    if (!guardbit_word(&line, 2, 6, '\n', word)) return 0;
    row->eb = word[0];
    return 1;
}

/* edge.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_EDGE_EXP_ROWS UINT64_C(4000)
#define GUARDBIT_EDGE_EXP_LINE 7
#define GUARDBIT_EDGE_EXP_BITS 16
/* op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold. */
#define GUARDBIT_EDGE_EXP_OP_WIDTH 2
#define GUARDBIT_EDGE_EXP_OP_FRACTION 0
#define GUARDBIT_EDGE_EXP_OP_SIGNED 0
/* e: signed, width 6, fraction bits 0. Edge word after the clock edge. */
#define GUARDBIT_EDGE_EXP_E_WIDTH 6
#define GUARDBIT_EDGE_EXP_E_FRACTION 0
#define GUARDBIT_EDGE_EXP_E_SIGNED 1
/* in: unsigned, width 1, fraction bits 0. 1 when the sign bit of e is clear. */
#define GUARDBIT_EDGE_EXP_IN_V_WIDTH 1
#define GUARDBIT_EDGE_EXP_IN_V_FRACTION 0
#define GUARDBIT_EDGE_EXP_IN_V_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_EDGE_EXP_COLUMNS(X) \
    X(op, 2, 0, 0, 1, 12) \
    X(e, 6, 1, 0, 2, 4) \
    X(in_v, 1, 0, 0, 1, 0)
struct guardbit_edge_exp {
    uint64_t op;
    uint64_t e;
    uint64_t in_v;
};
static inline int guardbit_edge_exp_parse(const char *line, struct guardbit_edge_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 1, 2, '_', word)) return 0;
    row->op = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->e = word[0];
    if (!guardbit_word(&line, 1, 1, '\n', word)) return 0;
    row->in_v = word[0];
    return 1;
}

/* setup.cfg.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_SETUP_CFG_ROWS UINT64_C(712)
#define GUARDBIT_SETUP_CFG_LINE 18
#define GUARDBIT_SETUP_CFG_BITS 36
/* v0_x: unsigned, width 4, fraction bits 1. Vertex 0, x in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V0_X_WIDTH 4
#define GUARDBIT_SETUP_CFG_V0_X_FRACTION 1
#define GUARDBIT_SETUP_CFG_V0_X_SIGNED 0
/* v0_y: unsigned, width 4, fraction bits 1. Vertex 0, y in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V0_Y_WIDTH 4
#define GUARDBIT_SETUP_CFG_V0_Y_FRACTION 1
#define GUARDBIT_SETUP_CFG_V0_Y_SIGNED 0
/* v0_z: unsigned, width 3, fraction bits 0. Vertex 0, depth code. */
#define GUARDBIT_SETUP_CFG_V0_Z_WIDTH 3
#define GUARDBIT_SETUP_CFG_V0_Z_FRACTION 0
#define GUARDBIT_SETUP_CFG_V0_Z_SIGNED 0
/* v1_x: unsigned, width 4, fraction bits 1. Vertex 1, x in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V1_X_WIDTH 4
#define GUARDBIT_SETUP_CFG_V1_X_FRACTION 1
#define GUARDBIT_SETUP_CFG_V1_X_SIGNED 0
/* v1_y: unsigned, width 4, fraction bits 1. Vertex 1, y in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V1_Y_WIDTH 4
#define GUARDBIT_SETUP_CFG_V1_Y_FRACTION 1
#define GUARDBIT_SETUP_CFG_V1_Y_SIGNED 0
/* v1_z: unsigned, width 3, fraction bits 0. Vertex 1, depth code. */
#define GUARDBIT_SETUP_CFG_V1_Z_WIDTH 3
#define GUARDBIT_SETUP_CFG_V1_Z_FRACTION 0
#define GUARDBIT_SETUP_CFG_V1_Z_SIGNED 0
/* v2_x: unsigned, width 4, fraction bits 1. Vertex 2, x in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V2_X_WIDTH 4
#define GUARDBIT_SETUP_CFG_V2_X_FRACTION 1
#define GUARDBIT_SETUP_CFG_V2_X_SIGNED 0
/* v2_y: unsigned, width 4, fraction bits 1. Vertex 2, y in sub-pixels. */
#define GUARDBIT_SETUP_CFG_V2_Y_WIDTH 4
#define GUARDBIT_SETUP_CFG_V2_Y_FRACTION 1
#define GUARDBIT_SETUP_CFG_V2_Y_SIGNED 0
/* v2_z: unsigned, width 3, fraction bits 0. Vertex 2, depth code. */
#define GUARDBIT_SETUP_CFG_V2_Z_WIDTH 3
#define GUARDBIT_SETUP_CFG_V2_Z_FRACTION 0
#define GUARDBIT_SETUP_CFG_V2_Z_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_SETUP_CFG_COLUMNS(X) \
    X(v0_x, 4, 0, 1, 1, 32) \
    X(v0_y, 4, 0, 1, 1, 28) \
    X(v0_z, 3, 0, 0, 1, 24) \
    X(v1_x, 4, 0, 1, 1, 20) \
    X(v1_y, 4, 0, 1, 1, 16) \
    X(v1_z, 3, 0, 0, 1, 12) \
    X(v2_x, 4, 0, 1, 1, 8) \
    X(v2_y, 4, 0, 1, 1, 4) \
    X(v2_z, 3, 0, 0, 1, 0)
struct guardbit_setup_cfg {
    uint64_t v0_x;
    uint64_t v0_y;
    uint64_t v0_z;
    uint64_t v1_x;
    uint64_t v1_y;
    uint64_t v1_z;
    uint64_t v2_x;
    uint64_t v2_y;
    uint64_t v2_z;
};
static inline int guardbit_setup_cfg_parse(const char *line, struct guardbit_setup_cfg *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v0_x = word[0];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v0_y = word[0];
    if (!guardbit_word(&line, 1, 3, '_', word)) return 0;
    row->v0_z = word[0];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v1_x = word[0];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v1_y = word[0];
    if (!guardbit_word(&line, 1, 3, '_', word)) return 0;
    row->v1_z = word[0];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v2_x = word[0];
    if (!guardbit_word(&line, 1, 4, '_', word)) return 0;
    row->v2_y = word[0];
    if (!guardbit_word(&line, 1, 3, '\n', word)) return 0;
    row->v2_z = word[0];
    return 1;
}

/* setup.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_SETUP_EXP_ROWS UINT64_C(712)
#define GUARDBIT_SETUP_EXP_LINE 38
#define GUARDBIT_SETUP_EXP_BITS 100
/* edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored. */
#define GUARDBIT_SETUP_EXP_EDGE0_INIT_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE0_INIT_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE0_INIT_SIGNED 1
/* edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right. */
#define GUARDBIT_SETUP_EXP_EDGE0_DX_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE0_DX_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE0_DX_SIGNED 1
/* edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward. */
#define GUARDBIT_SETUP_EXP_EDGE0_DY_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE0_DY_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE0_DY_SIGNED 1
/* edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored. */
#define GUARDBIT_SETUP_EXP_EDGE1_INIT_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE1_INIT_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE1_INIT_SIGNED 1
/* edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right. */
#define GUARDBIT_SETUP_EXP_EDGE1_DX_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE1_DX_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE1_DX_SIGNED 1
/* edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward. */
#define GUARDBIT_SETUP_EXP_EDGE1_DY_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE1_DY_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE1_DY_SIGNED 1
/* edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored. */
#define GUARDBIT_SETUP_EXP_EDGE2_INIT_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE2_INIT_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE2_INIT_SIGNED 1
/* edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right. */
#define GUARDBIT_SETUP_EXP_EDGE2_DX_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE2_DX_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE2_DX_SIGNED 1
/* edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward. */
#define GUARDBIT_SETUP_EXP_EDGE2_DY_WIDTH 6
#define GUARDBIT_SETUP_EXP_EDGE2_DY_FRACTION 1
#define GUARDBIT_SETUP_EXP_EDGE2_DY_SIGNED 1
/* depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0). */
#define GUARDBIT_SETUP_EXP_DEPTH_INIT_WIDTH 7
#define GUARDBIT_SETUP_EXP_DEPTH_INIT_FRACTION 3
#define GUARDBIT_SETUP_EXP_DEPTH_INIT_SIGNED 1
/* depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right. */
#define GUARDBIT_SETUP_EXP_DEPTH_DX_WIDTH 7
#define GUARDBIT_SETUP_EXP_DEPTH_DX_FRACTION 3
#define GUARDBIT_SETUP_EXP_DEPTH_DX_SIGNED 1
/* depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward. */
#define GUARDBIT_SETUP_EXP_DEPTH_DY_WIDTH 7
#define GUARDBIT_SETUP_EXP_DEPTH_DY_FRACTION 3
#define GUARDBIT_SETUP_EXP_DEPTH_DY_SIGNED 1
/* zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing. */
#define GUARDBIT_SETUP_EXP_ZERO_AREA_WIDTH 1
#define GUARDBIT_SETUP_EXP_ZERO_AREA_FRACTION 0
#define GUARDBIT_SETUP_EXP_ZERO_AREA_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_SETUP_EXP_COLUMNS(X) \
    X(edge0_init, 6, 1, 1, 2, 92) \
    X(edge0_dx, 6, 1, 1, 2, 84) \
    X(edge0_dy, 6, 1, 1, 2, 76) \
    X(edge1_init, 6, 1, 1, 2, 68) \
    X(edge1_dx, 6, 1, 1, 2, 60) \
    X(edge1_dy, 6, 1, 1, 2, 52) \
    X(edge2_init, 6, 1, 1, 2, 44) \
    X(edge2_dx, 6, 1, 1, 2, 36) \
    X(edge2_dy, 6, 1, 1, 2, 28) \
    X(depth_init, 7, 1, 3, 2, 20) \
    X(depth_dx, 7, 1, 3, 2, 12) \
    X(depth_dy, 7, 1, 3, 2, 4) \
    X(zero_area, 1, 0, 0, 1, 0)
struct guardbit_setup_exp {
    uint64_t edge0_init;
    uint64_t edge0_dx;
    uint64_t edge0_dy;
    uint64_t edge1_init;
    uint64_t edge1_dx;
    uint64_t edge1_dy;
    uint64_t edge2_init;
    uint64_t edge2_dx;
    uint64_t edge2_dy;
    uint64_t depth_init;
    uint64_t depth_dx;
    uint64_t depth_dy;
    uint64_t zero_area;
};
static inline int guardbit_setup_exp_parse(const char *line, struct guardbit_setup_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_dy = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_dy = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_dy = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_init = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_dx = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_dy = word[0];
    if (!guardbit_word(&line, 1, 1, '\n', word)) return 0;
    row->zero_area = word[0];
    return 1;
}

/* triangle.cfg.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_TRIANGLE_CFG_ROWS UINT64_C(871)
#define GUARDBIT_TRIANGLE_CFG_LINE 71
#define GUARDBIT_TRIANGLE_CFG_BITS 212
/* test: unsigned, width 32, fraction bits 0. Number of the test, from 0. */
#define GUARDBIT_TRIANGLE_CFG_TEST_WIDTH 32
#define GUARDBIT_TRIANGLE_CFG_TEST_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_TEST_SIGNED 0
/* edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored. */
#define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_SIGNED 1
/* edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right. */
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_SIGNED 1
/* edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward. */
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_SIGNED 1
/* edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored. */
#define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_SIGNED 1
/* edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right. */
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_SIGNED 1
/* edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward. */
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_SIGNED 1
/* edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored. */
#define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_SIGNED 1
/* edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right. */
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_SIGNED 1
/* edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward. */
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_WIDTH 6
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_FRACTION 1
#define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_SIGNED 1
/* depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0). */
#define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_WIDTH 7
#define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_FRACTION 3
#define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_SIGNED 1
/* depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right. */
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_WIDTH 7
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_FRACTION 3
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_SIGNED 1
/* depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward. */
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_WIDTH 7
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_FRACTION 3
#define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_SIGNED 1
/* zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing. */
#define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_WIDTH 1
#define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_SIGNED 0
/* box_y_begin: unsigned, width 17, fraction bits 0. First row of the bounding box in the window. */
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_WIDTH 17
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_SIGNED 0
/* box_y_end: unsigned, width 17, fraction bits 0. One past its last row. */
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_WIDTH 17
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_SIGNED 0
/* box_x_begin: unsigned, width 17, fraction bits 0. First column of the bounding box. */
#define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_WIDTH 17
#define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_SIGNED 0
/* box_x_end: unsigned, width 17, fraction bits 0. One past its last column. */
#define GUARDBIT_TRIANGLE_CFG_BOX_X_END_WIDTH 17
#define GUARDBIT_TRIANGLE_CFG_BOX_X_END_FRACTION 0
#define GUARDBIT_TRIANGLE_CFG_BOX_X_END_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_TRIANGLE_CFG_COLUMNS(X) \
    X(test, 32, 0, 0, 8, 180) \
    X(edge0_init, 6, 1, 1, 2, 172) \
    X(edge0_dx, 6, 1, 1, 2, 164) \
    X(edge0_dy, 6, 1, 1, 2, 156) \
    X(edge1_init, 6, 1, 1, 2, 148) \
    X(edge1_dx, 6, 1, 1, 2, 140) \
    X(edge1_dy, 6, 1, 1, 2, 132) \
    X(edge2_init, 6, 1, 1, 2, 124) \
    X(edge2_dx, 6, 1, 1, 2, 116) \
    X(edge2_dy, 6, 1, 1, 2, 108) \
    X(depth_init, 7, 1, 3, 2, 100) \
    X(depth_dx, 7, 1, 3, 2, 92) \
    X(depth_dy, 7, 1, 3, 2, 84) \
    X(zero_area, 1, 0, 0, 1, 80) \
    X(box_y_begin, 17, 0, 0, 5, 60) \
    X(box_y_end, 17, 0, 0, 5, 40) \
    X(box_x_begin, 17, 0, 0, 5, 20) \
    X(box_x_end, 17, 0, 0, 5, 0)
struct guardbit_triangle_cfg {
    uint64_t test;
    uint64_t edge0_init;
    uint64_t edge0_dx;
    uint64_t edge0_dy;
    uint64_t edge1_init;
    uint64_t edge1_dx;
    uint64_t edge1_dy;
    uint64_t edge2_init;
    uint64_t edge2_dx;
    uint64_t edge2_dy;
    uint64_t depth_init;
    uint64_t depth_dx;
    uint64_t depth_dy;
    uint64_t zero_area;
    uint64_t box_y_begin;
    uint64_t box_y_end;
    uint64_t box_x_begin;
    uint64_t box_x_end;
};
static inline int guardbit_triangle_cfg_parse(const char *line, struct guardbit_triangle_cfg *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->test = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge0_dy = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge1_dy = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_init = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_dx = word[0];
    if (!guardbit_word(&line, 2, 6, '_', word)) return 0;
    row->edge2_dy = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_init = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_dx = word[0];
    if (!guardbit_word(&line, 2, 7, '_', word)) return 0;
    row->depth_dy = word[0];
    if (!guardbit_word(&line, 1, 1, '_', word)) return 0;
    row->zero_area = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->box_y_begin = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->box_y_end = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->box_x_begin = word[0];
    if (!guardbit_word(&line, 5, 17, '\n', word)) return 0;
    row->box_x_end = word[0];
    return 1;
}

/* triangle.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_TRIANGLE_EXP_ROWS UINT64_C(871)
#define GUARDBIT_TRIANGLE_EXP_LINE 65
#define GUARDBIT_TRIANGLE_EXP_BITS 228
/* test: unsigned, width 32, fraction bits 0. Number of the test, from 0. */
#define GUARDBIT_TRIANGLE_EXP_TEST_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_TEST_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_TEST_SIGNED 0
/* spans: unsigned, width 32, fraction bits 0. Maximal runs of covered samples. */
#define GUARDBIT_TRIANGLE_EXP_SPANS_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_SPANS_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_SPANS_SIGNED 0
/* samples: unsigned, width 32, fraction bits 0. Covered samples. */
#define GUARDBIT_TRIANGLE_EXP_SAMPLES_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_SAMPLES_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_SAMPLES_SIGNED 0
/* wrap: unsigned, width 32, fraction bits 0. Covered samples whose depth left the guard range. */
#define GUARDBIT_TRIANGLE_EXP_WRAP_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_WRAP_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_WRAP_SIGNED 0
/* clamp_above: unsigned, width 32, fraction bits 0. Covered samples held at the maximum. */
#define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_SIGNED 0
/* clamp_below: unsigned, width 32, fraction bits 0. Covered samples held at zero. */
#define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_SIGNED 0
/* inexact: unsigned, width 32, fraction bits 0. Covered samples whose read-out dropped a fraction. */
#define GUARDBIT_TRIANGLE_EXP_INEXACT_WIDTH 32
#define GUARDBIT_TRIANGLE_EXP_INEXACT_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_INEXACT_SIGNED 0
/* zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing. */
#define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_WIDTH 1
#define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_FRACTION 0
#define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_TRIANGLE_EXP_COLUMNS(X) \
    X(test, 32, 0, 0, 8, 196) \
    X(spans, 32, 0, 0, 8, 164) \
    X(samples, 32, 0, 0, 8, 132) \
    X(wrap, 32, 0, 0, 8, 100) \
    X(clamp_above, 32, 0, 0, 8, 68) \
    X(clamp_below, 32, 0, 0, 8, 36) \
    X(inexact, 32, 0, 0, 8, 4) \
    X(zero_area, 1, 0, 0, 1, 0)
struct guardbit_triangle_exp {
    uint64_t test;
    uint64_t spans;
    uint64_t samples;
    uint64_t wrap;
    uint64_t clamp_above;
    uint64_t clamp_below;
    uint64_t inexact;
    uint64_t zero_area;
};
static inline int guardbit_triangle_exp_parse(const char *line, struct guardbit_triangle_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->test = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->spans = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->samples = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->wrap = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->clamp_above = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->clamp_below = word[0];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->inexact = word[0];
    if (!guardbit_word(&line, 1, 1, '\n', word)) return 0;
    row->zero_area = word[0];
    return 1;
}

/* span.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_SPAN_EXP_ROWS UINT64_C(1579)
#define GUARDBIT_SPAN_EXP_LINE 27
#define GUARDBIT_SPAN_EXP_BITS 92
/* test: unsigned, width 32, fraction bits 0. Number of the test, from 0. */
#define GUARDBIT_SPAN_EXP_TEST_WIDTH 32
#define GUARDBIT_SPAN_EXP_TEST_FRACTION 0
#define GUARDBIT_SPAN_EXP_TEST_SIGNED 0
/* y: unsigned, width 17, fraction bits 0. Row. */
#define GUARDBIT_SPAN_EXP_Y_WIDTH 17
#define GUARDBIT_SPAN_EXP_Y_FRACTION 0
#define GUARDBIT_SPAN_EXP_Y_SIGNED 0
/* x_begin: unsigned, width 17, fraction bits 0. First covered column. */
#define GUARDBIT_SPAN_EXP_X_BEGIN_WIDTH 17
#define GUARDBIT_SPAN_EXP_X_BEGIN_FRACTION 0
#define GUARDBIT_SPAN_EXP_X_BEGIN_SIGNED 0
/* x_end: unsigned, width 17, fraction bits 0. One past the last covered column. */
#define GUARDBIT_SPAN_EXP_X_END_WIDTH 17
#define GUARDBIT_SPAN_EXP_X_END_FRACTION 0
#define GUARDBIT_SPAN_EXP_X_END_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_SPAN_EXP_COLUMNS(X) \
    X(test, 32, 0, 0, 8, 60) \
    X(y, 17, 0, 0, 5, 40) \
    X(x_begin, 17, 0, 0, 5, 20) \
    X(x_end, 17, 0, 0, 5, 0)
struct guardbit_span_exp {
    uint64_t test;
    uint64_t y;
    uint64_t x_begin;
    uint64_t x_end;
};
static inline int guardbit_span_exp_parse(const char *line, struct guardbit_span_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->test = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->y = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->x_begin = word[0];
    if (!guardbit_word(&line, 5, 17, '\n', word)) return 0;
    row->x_end = word[0];
    return 1;
}

/* depth.exp.tv: rows, characters of a line with its newline, bits of a record */
#define GUARDBIT_DEPTH_EXP_ROWS UINT64_C(3944)
#define GUARDBIT_DEPTH_EXP_LINE 23
#define GUARDBIT_DEPTH_EXP_BITS 76
/* test: unsigned, width 32, fraction bits 0. Number of the test, from 0. */
#define GUARDBIT_DEPTH_EXP_TEST_WIDTH 32
#define GUARDBIT_DEPTH_EXP_TEST_FRACTION 0
#define GUARDBIT_DEPTH_EXP_TEST_SIGNED 0
/* y: unsigned, width 17, fraction bits 0. Row. */
#define GUARDBIT_DEPTH_EXP_Y_WIDTH 17
#define GUARDBIT_DEPTH_EXP_Y_FRACTION 0
#define GUARDBIT_DEPTH_EXP_Y_SIGNED 0
/* x: unsigned, width 17, fraction bits 0. Column. */
#define GUARDBIT_DEPTH_EXP_X_WIDTH 17
#define GUARDBIT_DEPTH_EXP_X_FRACTION 0
#define GUARDBIT_DEPTH_EXP_X_SIGNED 0
/* depth: unsigned, width 3, fraction bits 0. Depth read-out after the clamp. */
#define GUARDBIT_DEPTH_EXP_DEPTH_WIDTH 3
#define GUARDBIT_DEPTH_EXP_DEPTH_FRACTION 0
#define GUARDBIT_DEPTH_EXP_DEPTH_SIGNED 0
/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */
#define GUARDBIT_DEPTH_EXP_COLUMNS(X) \
    X(test, 32, 0, 0, 8, 44) \
    X(y, 17, 0, 0, 5, 24) \
    X(x, 17, 0, 0, 5, 4) \
    X(depth, 3, 0, 0, 1, 0)
struct guardbit_depth_exp {
    uint64_t test;
    uint64_t y;
    uint64_t x;
    uint64_t depth;
};
static inline int guardbit_depth_exp_parse(const char *line, struct guardbit_depth_exp *row) {
    uint64_t word[2];
    if (!guardbit_word(&line, 8, 32, '_', word)) return 0;
    row->test = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->y = word[0];
    if (!guardbit_word(&line, 5, 17, '_', word)) return 0;
    row->x = word[0];
    if (!guardbit_word(&line, 1, 3, '\n', word)) return 0;
    row->depth = word[0];
    return 1;
}

#endif
