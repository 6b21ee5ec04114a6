// guardbit vector set tiny, model version 2: macros for Verilog-2001, generated.
//
// Each column fills whole nibbles of a record, its value in the low bits:
//     `include "pkg.vh"
//     reg [`GUARDBIT_DDA_EXP_BITS-1:0] row, mem [0:`GUARDBIT_DDA_EXP_ROWS-1];
//     initial $readmemh("dda.exp.tv", mem);
//     ...  row = mem[i];  expected = `GUARDBIT_DDA_EXP_ACC(row);
// The bench of this set is in SystemVerilog; run it from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim
`ifndef GUARDBIT_PKG_VH
`define GUARDBIT_PKG_VH

`define GUARDBIT_SET "tiny"
`define GUARDBIT_MODEL_VERSION 2

// Depth machine: accumulator is guard, integer and interpolation bits, output is the integer bits.
`define GUARDBIT_GUARD_BITS 1
`define GUARDBIT_INTEGER_BITS 3
`define GUARDBIT_FRACTION_BITS 3
`define GUARDBIT_CLAMP_WRAP 0
`define GUARDBIT_CLAMP_GUARD 1
`define GUARDBIT_CLAMP_SIGN 2
`define GUARDBIT_CLAMP_SATURATE 3
`define GUARDBIT_CLAMP_MODE `GUARDBIT_CLAMP_GUARD

// Set-up: sub-pixel bits of a vertex
`define GUARDBIT_SUB_PIXEL_BITS 1
// the sample in its pixel, in sub-pixels
`define GUARDBIT_SAMPLE_X 1
// the same, downward
`define GUARDBIT_SAMPLE_Y 1
// fill rule: 0 top-left, 1 shadow
`define GUARDBIT_SHADOW_RULE 0
// low bits of an edge value that are not kept
`define GUARDBIT_EDGE_SHIFT 1
// of start and slopes, as setup_divider has it: nearest-even
`define GUARDBIT_ROUNDING 4
// 1: the start gains half a depth step
`define GUARDBIT_START_HALF 0

// op columns: what the device does at the clock edge; the row gives the state after it.
`define GUARDBIT_OP_LOAD 2'd0
`define GUARDBIT_OP_STEP_X 2'd1
`define GUARDBIT_OP_STEP_Y 2'd2
`define GUARDBIT_OP_HOLD 2'd3

// dda.cfg.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_DDA_CFG_ROWS 64'd491
`define GUARDBIT_DDA_CFG_LINE 9
`define GUARDBIT_DDA_CFG_BITS 24
`define GUARDBIT_DDA_CFG_PADS 24'h808080
// init: signed, width 7, fraction bits 3. Accumulator that the load takes.
`define GUARDBIT_DDA_CFG_INIT_WIDTH 7
`define GUARDBIT_DDA_CFG_INIT_FRACTION 3
`define GUARDBIT_DDA_CFG_INIT_SIGNED 1
`define GUARDBIT_DDA_CFG_INIT_MSB 22
`define GUARDBIT_DDA_CFG_INIT_LSB 16
`define GUARDBIT_DDA_CFG_INIT(row) row[22:16]
// dx: signed, width 7, fraction bits 3. Slope per pixel to the right.
`define GUARDBIT_DDA_CFG_DX_WIDTH 7
`define GUARDBIT_DDA_CFG_DX_FRACTION 3
`define GUARDBIT_DDA_CFG_DX_SIGNED 1
`define GUARDBIT_DDA_CFG_DX_MSB 14
`define GUARDBIT_DDA_CFG_DX_LSB 8
`define GUARDBIT_DDA_CFG_DX(row) row[14:8]
// dy: signed, width 7, fraction bits 3. Slope per row downward.
`define GUARDBIT_DDA_CFG_DY_WIDTH 7
`define GUARDBIT_DDA_CFG_DY_FRACTION 3
`define GUARDBIT_DDA_CFG_DY_SIGNED 1
`define GUARDBIT_DDA_CFG_DY_MSB 6
`define GUARDBIT_DDA_CFG_DY_LSB 0
`define GUARDBIT_DDA_CFG_DY(row) row[6:0]

// dda.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_DDA_EXP_ROWS 64'd4000
`define GUARDBIT_DDA_EXP_LINE 7
`define GUARDBIT_DDA_EXP_BITS 16
`define GUARDBIT_DDA_EXP_PADS 16'hc808
// op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
`define GUARDBIT_DDA_EXP_OP_WIDTH 2
`define GUARDBIT_DDA_EXP_OP_FRACTION 0
`define GUARDBIT_DDA_EXP_OP_SIGNED 0
`define GUARDBIT_DDA_EXP_OP_MSB 13
`define GUARDBIT_DDA_EXP_OP_LSB 12
`define GUARDBIT_DDA_EXP_OP(row) row[13:12]
// acc: signed, width 7, fraction bits 3. Accumulator after the clock edge.
`define GUARDBIT_DDA_EXP_ACC_WIDTH 7
`define GUARDBIT_DDA_EXP_ACC_FRACTION 3
`define GUARDBIT_DDA_EXP_ACC_SIGNED 1
`define GUARDBIT_DDA_EXP_ACC_MSB 10
`define GUARDBIT_DDA_EXP_ACC_LSB 4
`define GUARDBIT_DDA_EXP_ACC(row) row[10:4]
// out: unsigned, width 3, fraction bits 0. Read-out after the clamp.
`define GUARDBIT_DDA_EXP_OUT_V_WIDTH 3
`define GUARDBIT_DDA_EXP_OUT_V_FRACTION 0
`define GUARDBIT_DDA_EXP_OUT_V_SIGNED 0
`define GUARDBIT_DDA_EXP_OUT_V_MSB 2
`define GUARDBIT_DDA_EXP_OUT_V_LSB 0
`define GUARDBIT_DDA_EXP_OUT_V(row) row[2:0]

// edge.cfg.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_EDGE_CFG_ROWS 64'd364
`define GUARDBIT_EDGE_CFG_LINE 9
`define GUARDBIT_EDGE_CFG_BITS 24
`define GUARDBIT_EDGE_CFG_PADS 24'hc0c0c0
// e0: signed, width 6, fraction bits 0. Edge word that the load takes, bias and shift done.
`define GUARDBIT_EDGE_CFG_E0_WIDTH 6
`define GUARDBIT_EDGE_CFG_E0_FRACTION 0
`define GUARDBIT_EDGE_CFG_E0_SIGNED 1
`define GUARDBIT_EDGE_CFG_E0_MSB 21
`define GUARDBIT_EDGE_CFG_E0_LSB 16
`define GUARDBIT_EDGE_CFG_E0(row) row[21:16]
// ea: signed, width 6, fraction bits 0. Step per pixel to the right.
`define GUARDBIT_EDGE_CFG_EA_WIDTH 6
`define GUARDBIT_EDGE_CFG_EA_FRACTION 0
`define GUARDBIT_EDGE_CFG_EA_SIGNED 1
`define GUARDBIT_EDGE_CFG_EA_MSB 13
`define GUARDBIT_EDGE_CFG_EA_LSB 8
`define GUARDBIT_EDGE_CFG_EA(row) row[13:8]
// eb: signed, width 6, fraction bits 0. Step per row downward.
`define GUARDBIT_EDGE_CFG_EB_WIDTH 6
`define GUARDBIT_EDGE_CFG_EB_FRACTION 0
`define GUARDBIT_EDGE_CFG_EB_SIGNED 1
`define GUARDBIT_EDGE_CFG_EB_MSB 5
`define GUARDBIT_EDGE_CFG_EB_LSB 0
`define GUARDBIT_EDGE_CFG_EB(row) row[5:0]

// edge.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_EDGE_EXP_ROWS 64'd4000
`define GUARDBIT_EDGE_EXP_LINE 7
`define GUARDBIT_EDGE_EXP_BITS 16
`define GUARDBIT_EDGE_EXP_PADS 16'hcc0e
// op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
`define GUARDBIT_EDGE_EXP_OP_WIDTH 2
`define GUARDBIT_EDGE_EXP_OP_FRACTION 0
`define GUARDBIT_EDGE_EXP_OP_SIGNED 0
`define GUARDBIT_EDGE_EXP_OP_MSB 13
`define GUARDBIT_EDGE_EXP_OP_LSB 12
`define GUARDBIT_EDGE_EXP_OP(row) row[13:12]
// e: signed, width 6, fraction bits 0. Edge word after the clock edge.
`define GUARDBIT_EDGE_EXP_E_WIDTH 6
`define GUARDBIT_EDGE_EXP_E_FRACTION 0
`define GUARDBIT_EDGE_EXP_E_SIGNED 1
`define GUARDBIT_EDGE_EXP_E_MSB 9
`define GUARDBIT_EDGE_EXP_E_LSB 4
`define GUARDBIT_EDGE_EXP_E(row) row[9:4]
// in: unsigned, width 1, fraction bits 0. 1 when the sign bit of e is clear.
`define GUARDBIT_EDGE_EXP_IN_V_WIDTH 1
`define GUARDBIT_EDGE_EXP_IN_V_FRACTION 0
`define GUARDBIT_EDGE_EXP_IN_V_SIGNED 0
`define GUARDBIT_EDGE_EXP_IN_V_MSB 0
`define GUARDBIT_EDGE_EXP_IN_V_LSB 0
`define GUARDBIT_EDGE_EXP_IN_V(row) row[0:0]

// setup.cfg.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_SETUP_CFG_ROWS 64'd712
`define GUARDBIT_SETUP_CFG_LINE 18
`define GUARDBIT_SETUP_CFG_BITS 36
`define GUARDBIT_SETUP_CFG_PADS 36'h008008008
// v0_x: unsigned, width 4, fraction bits 1. Vertex 0, x in sub-pixels.
`define GUARDBIT_SETUP_CFG_V0_X_WIDTH 4
`define GUARDBIT_SETUP_CFG_V0_X_FRACTION 1
`define GUARDBIT_SETUP_CFG_V0_X_SIGNED 0
`define GUARDBIT_SETUP_CFG_V0_X_MSB 35
`define GUARDBIT_SETUP_CFG_V0_X_LSB 32
`define GUARDBIT_SETUP_CFG_V0_X(row) row[35:32]
// v0_y: unsigned, width 4, fraction bits 1. Vertex 0, y in sub-pixels.
`define GUARDBIT_SETUP_CFG_V0_Y_WIDTH 4
`define GUARDBIT_SETUP_CFG_V0_Y_FRACTION 1
`define GUARDBIT_SETUP_CFG_V0_Y_SIGNED 0
`define GUARDBIT_SETUP_CFG_V0_Y_MSB 31
`define GUARDBIT_SETUP_CFG_V0_Y_LSB 28
`define GUARDBIT_SETUP_CFG_V0_Y(row) row[31:28]
// v0_z: unsigned, width 3, fraction bits 0. Vertex 0, depth code.
`define GUARDBIT_SETUP_CFG_V0_Z_WIDTH 3
`define GUARDBIT_SETUP_CFG_V0_Z_FRACTION 0
`define GUARDBIT_SETUP_CFG_V0_Z_SIGNED 0
`define GUARDBIT_SETUP_CFG_V0_Z_MSB 26
`define GUARDBIT_SETUP_CFG_V0_Z_LSB 24
`define GUARDBIT_SETUP_CFG_V0_Z(row) row[26:24]
// v1_x: unsigned, width 4, fraction bits 1. Vertex 1, x in sub-pixels.
`define GUARDBIT_SETUP_CFG_V1_X_WIDTH 4
`define GUARDBIT_SETUP_CFG_V1_X_FRACTION 1
`define GUARDBIT_SETUP_CFG_V1_X_SIGNED 0
`define GUARDBIT_SETUP_CFG_V1_X_MSB 23
`define GUARDBIT_SETUP_CFG_V1_X_LSB 20
`define GUARDBIT_SETUP_CFG_V1_X(row) row[23:20]
// v1_y: unsigned, width 4, fraction bits 1. Vertex 1, y in sub-pixels.
`define GUARDBIT_SETUP_CFG_V1_Y_WIDTH 4
`define GUARDBIT_SETUP_CFG_V1_Y_FRACTION 1
`define GUARDBIT_SETUP_CFG_V1_Y_SIGNED 0
`define GUARDBIT_SETUP_CFG_V1_Y_MSB 19
`define GUARDBIT_SETUP_CFG_V1_Y_LSB 16
`define GUARDBIT_SETUP_CFG_V1_Y(row) row[19:16]
// v1_z: unsigned, width 3, fraction bits 0. Vertex 1, depth code.
`define GUARDBIT_SETUP_CFG_V1_Z_WIDTH 3
`define GUARDBIT_SETUP_CFG_V1_Z_FRACTION 0
`define GUARDBIT_SETUP_CFG_V1_Z_SIGNED 0
`define GUARDBIT_SETUP_CFG_V1_Z_MSB 14
`define GUARDBIT_SETUP_CFG_V1_Z_LSB 12
`define GUARDBIT_SETUP_CFG_V1_Z(row) row[14:12]
// v2_x: unsigned, width 4, fraction bits 1. Vertex 2, x in sub-pixels.
`define GUARDBIT_SETUP_CFG_V2_X_WIDTH 4
`define GUARDBIT_SETUP_CFG_V2_X_FRACTION 1
`define GUARDBIT_SETUP_CFG_V2_X_SIGNED 0
`define GUARDBIT_SETUP_CFG_V2_X_MSB 11
`define GUARDBIT_SETUP_CFG_V2_X_LSB 8
`define GUARDBIT_SETUP_CFG_V2_X(row) row[11:8]
// v2_y: unsigned, width 4, fraction bits 1. Vertex 2, y in sub-pixels.
`define GUARDBIT_SETUP_CFG_V2_Y_WIDTH 4
`define GUARDBIT_SETUP_CFG_V2_Y_FRACTION 1
`define GUARDBIT_SETUP_CFG_V2_Y_SIGNED 0
`define GUARDBIT_SETUP_CFG_V2_Y_MSB 7
`define GUARDBIT_SETUP_CFG_V2_Y_LSB 4
`define GUARDBIT_SETUP_CFG_V2_Y(row) row[7:4]
// v2_z: unsigned, width 3, fraction bits 0. Vertex 2, depth code.
`define GUARDBIT_SETUP_CFG_V2_Z_WIDTH 3
`define GUARDBIT_SETUP_CFG_V2_Z_FRACTION 0
`define GUARDBIT_SETUP_CFG_V2_Z_SIGNED 0
`define GUARDBIT_SETUP_CFG_V2_Z_MSB 2
`define GUARDBIT_SETUP_CFG_V2_Z_LSB 0
`define GUARDBIT_SETUP_CFG_V2_Z(row) row[2:0]

// setup.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_SETUP_EXP_ROWS 64'd712
`define GUARDBIT_SETUP_EXP_LINE 38
`define GUARDBIT_SETUP_EXP_BITS 100
`define GUARDBIT_SETUP_EXP_PADS 100'hc0c0c0c0c0c0c0c0c0808080e
// edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
`define GUARDBIT_SETUP_EXP_EDGE0_INIT_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE0_INIT_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE0_INIT_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE0_INIT_MSB 97
`define GUARDBIT_SETUP_EXP_EDGE0_INIT_LSB 92
`define GUARDBIT_SETUP_EXP_EDGE0_INIT(row) row[97:92]
// edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
`define GUARDBIT_SETUP_EXP_EDGE0_DX_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE0_DX_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE0_DX_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE0_DX_MSB 89
`define GUARDBIT_SETUP_EXP_EDGE0_DX_LSB 84
`define GUARDBIT_SETUP_EXP_EDGE0_DX(row) row[89:84]
// edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
`define GUARDBIT_SETUP_EXP_EDGE0_DY_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE0_DY_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE0_DY_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE0_DY_MSB 81
`define GUARDBIT_SETUP_EXP_EDGE0_DY_LSB 76
`define GUARDBIT_SETUP_EXP_EDGE0_DY(row) row[81:76]
// edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
`define GUARDBIT_SETUP_EXP_EDGE1_INIT_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE1_INIT_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE1_INIT_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE1_INIT_MSB 73
`define GUARDBIT_SETUP_EXP_EDGE1_INIT_LSB 68
`define GUARDBIT_SETUP_EXP_EDGE1_INIT(row) row[73:68]
// edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
`define GUARDBIT_SETUP_EXP_EDGE1_DX_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE1_DX_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE1_DX_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE1_DX_MSB 65
`define GUARDBIT_SETUP_EXP_EDGE1_DX_LSB 60
`define GUARDBIT_SETUP_EXP_EDGE1_DX(row) row[65:60]
// edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
`define GUARDBIT_SETUP_EXP_EDGE1_DY_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE1_DY_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE1_DY_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE1_DY_MSB 57
`define GUARDBIT_SETUP_EXP_EDGE1_DY_LSB 52
`define GUARDBIT_SETUP_EXP_EDGE1_DY(row) row[57:52]
// edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
`define GUARDBIT_SETUP_EXP_EDGE2_INIT_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE2_INIT_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE2_INIT_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE2_INIT_MSB 49
`define GUARDBIT_SETUP_EXP_EDGE2_INIT_LSB 44
`define GUARDBIT_SETUP_EXP_EDGE2_INIT(row) row[49:44]
// edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
`define GUARDBIT_SETUP_EXP_EDGE2_DX_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE2_DX_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE2_DX_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE2_DX_MSB 41
`define GUARDBIT_SETUP_EXP_EDGE2_DX_LSB 36
`define GUARDBIT_SETUP_EXP_EDGE2_DX(row) row[41:36]
// edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
`define GUARDBIT_SETUP_EXP_EDGE2_DY_WIDTH 6
`define GUARDBIT_SETUP_EXP_EDGE2_DY_FRACTION 1
`define GUARDBIT_SETUP_EXP_EDGE2_DY_SIGNED 1
`define GUARDBIT_SETUP_EXP_EDGE2_DY_MSB 33
`define GUARDBIT_SETUP_EXP_EDGE2_DY_LSB 28
`define GUARDBIT_SETUP_EXP_EDGE2_DY(row) row[33:28]
// depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
`define GUARDBIT_SETUP_EXP_DEPTH_INIT_WIDTH 7
`define GUARDBIT_SETUP_EXP_DEPTH_INIT_FRACTION 3
`define GUARDBIT_SETUP_EXP_DEPTH_INIT_SIGNED 1
`define GUARDBIT_SETUP_EXP_DEPTH_INIT_MSB 26
`define GUARDBIT_SETUP_EXP_DEPTH_INIT_LSB 20
`define GUARDBIT_SETUP_EXP_DEPTH_INIT(row) row[26:20]
// depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
`define GUARDBIT_SETUP_EXP_DEPTH_DX_WIDTH 7
`define GUARDBIT_SETUP_EXP_DEPTH_DX_FRACTION 3
`define GUARDBIT_SETUP_EXP_DEPTH_DX_SIGNED 1
`define GUARDBIT_SETUP_EXP_DEPTH_DX_MSB 18
`define GUARDBIT_SETUP_EXP_DEPTH_DX_LSB 12
`define GUARDBIT_SETUP_EXP_DEPTH_DX(row) row[18:12]
// depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
`define GUARDBIT_SETUP_EXP_DEPTH_DY_WIDTH 7
`define GUARDBIT_SETUP_EXP_DEPTH_DY_FRACTION 3
`define GUARDBIT_SETUP_EXP_DEPTH_DY_SIGNED 1
`define GUARDBIT_SETUP_EXP_DEPTH_DY_MSB 10
`define GUARDBIT_SETUP_EXP_DEPTH_DY_LSB 4
`define GUARDBIT_SETUP_EXP_DEPTH_DY(row) row[10:4]
// zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
`define GUARDBIT_SETUP_EXP_ZERO_AREA_WIDTH 1
`define GUARDBIT_SETUP_EXP_ZERO_AREA_FRACTION 0
`define GUARDBIT_SETUP_EXP_ZERO_AREA_SIGNED 0
`define GUARDBIT_SETUP_EXP_ZERO_AREA_MSB 0
`define GUARDBIT_SETUP_EXP_ZERO_AREA_LSB 0
`define GUARDBIT_SETUP_EXP_ZERO_AREA(row) row[0:0]

// triangle.cfg.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_TRIANGLE_CFG_ROWS 64'd871
`define GUARDBIT_TRIANGLE_CFG_LINE 71
`define GUARDBIT_TRIANGLE_CFG_BITS 212
`define GUARDBIT_TRIANGLE_CFG_PADS 212'h00000000c0c0c0c0c0c0c0c0c0808080ee0000e0000e0000e0000
// test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
`define GUARDBIT_TRIANGLE_CFG_TEST_WIDTH 32
`define GUARDBIT_TRIANGLE_CFG_TEST_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_TEST_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_TEST_MSB 211
`define GUARDBIT_TRIANGLE_CFG_TEST_LSB 180
`define GUARDBIT_TRIANGLE_CFG_TEST(row) row[211:180]
// edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_MSB 177
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT_LSB 172
`define GUARDBIT_TRIANGLE_CFG_EDGE0_INIT(row) row[177:172]
// edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_MSB 169
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX_LSB 164
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DX(row) row[169:164]
// edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_MSB 161
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY_LSB 156
`define GUARDBIT_TRIANGLE_CFG_EDGE0_DY(row) row[161:156]
// edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_MSB 153
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT_LSB 148
`define GUARDBIT_TRIANGLE_CFG_EDGE1_INIT(row) row[153:148]
// edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_MSB 145
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX_LSB 140
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DX(row) row[145:140]
// edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_MSB 137
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY_LSB 132
`define GUARDBIT_TRIANGLE_CFG_EDGE1_DY(row) row[137:132]
// edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_MSB 129
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT_LSB 124
`define GUARDBIT_TRIANGLE_CFG_EDGE2_INIT(row) row[129:124]
// edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_MSB 121
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX_LSB 116
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DX(row) row[121:116]
// edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_WIDTH 6
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_FRACTION 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_MSB 113
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY_LSB 108
`define GUARDBIT_TRIANGLE_CFG_EDGE2_DY(row) row[113:108]
// depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_WIDTH 7
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_FRACTION 3
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_MSB 106
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT_LSB 100
`define GUARDBIT_TRIANGLE_CFG_DEPTH_INIT(row) row[106:100]
// depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_WIDTH 7
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_FRACTION 3
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_MSB 98
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX_LSB 92
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DX(row) row[98:92]
// depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_WIDTH 7
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_FRACTION 3
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_SIGNED 1
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_MSB 90
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY_LSB 84
`define GUARDBIT_TRIANGLE_CFG_DEPTH_DY(row) row[90:84]
// zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_WIDTH 1
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_MSB 80
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA_LSB 80
`define GUARDBIT_TRIANGLE_CFG_ZERO_AREA(row) row[80:80]
// box_y_begin: unsigned, width 17, fraction bits 0. First row of the bounding box in the window.
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_WIDTH 17
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_MSB 76
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN_LSB 60
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_BEGIN(row) row[76:60]
// box_y_end: unsigned, width 17, fraction bits 0. One past its last row.
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_WIDTH 17
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_MSB 56
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END_LSB 40
`define GUARDBIT_TRIANGLE_CFG_BOX_Y_END(row) row[56:40]
// box_x_begin: unsigned, width 17, fraction bits 0. First column of the bounding box.
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_WIDTH 17
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_MSB 36
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN_LSB 20
`define GUARDBIT_TRIANGLE_CFG_BOX_X_BEGIN(row) row[36:20]
// box_x_end: unsigned, width 17, fraction bits 0. One past its last column.
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END_WIDTH 17
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END_FRACTION 0
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END_SIGNED 0
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END_MSB 16
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END_LSB 0
`define GUARDBIT_TRIANGLE_CFG_BOX_X_END(row) row[16:0]

// triangle.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_TRIANGLE_EXP_ROWS 64'd871
`define GUARDBIT_TRIANGLE_EXP_LINE 65
`define GUARDBIT_TRIANGLE_EXP_BITS 228
`define GUARDBIT_TRIANGLE_EXP_PADS 228'h00000000000000000000000000000000000000000000000000000000e
// test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
`define GUARDBIT_TRIANGLE_EXP_TEST_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_TEST_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_TEST_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_TEST_MSB 227
`define GUARDBIT_TRIANGLE_EXP_TEST_LSB 196
`define GUARDBIT_TRIANGLE_EXP_TEST(row) row[227:196]
// spans: unsigned, width 32, fraction bits 0. Maximal runs of covered samples.
`define GUARDBIT_TRIANGLE_EXP_SPANS_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_SPANS_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_SPANS_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_SPANS_MSB 195
`define GUARDBIT_TRIANGLE_EXP_SPANS_LSB 164
`define GUARDBIT_TRIANGLE_EXP_SPANS(row) row[195:164]
// samples: unsigned, width 32, fraction bits 0. Covered samples.
`define GUARDBIT_TRIANGLE_EXP_SAMPLES_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_SAMPLES_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_SAMPLES_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_SAMPLES_MSB 163
`define GUARDBIT_TRIANGLE_EXP_SAMPLES_LSB 132
`define GUARDBIT_TRIANGLE_EXP_SAMPLES(row) row[163:132]
// wrap: unsigned, width 32, fraction bits 0. Covered samples whose depth left the guard range.
`define GUARDBIT_TRIANGLE_EXP_WRAP_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_WRAP_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_WRAP_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_WRAP_MSB 131
`define GUARDBIT_TRIANGLE_EXP_WRAP_LSB 100
`define GUARDBIT_TRIANGLE_EXP_WRAP(row) row[131:100]
// clamp_above: unsigned, width 32, fraction bits 0. Covered samples held at the maximum.
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_MSB 99
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE_LSB 68
`define GUARDBIT_TRIANGLE_EXP_CLAMP_ABOVE(row) row[99:68]
// clamp_below: unsigned, width 32, fraction bits 0. Covered samples held at zero.
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_MSB 67
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW_LSB 36
`define GUARDBIT_TRIANGLE_EXP_CLAMP_BELOW(row) row[67:36]
// inexact: unsigned, width 32, fraction bits 0. Covered samples whose read-out dropped a fraction.
`define GUARDBIT_TRIANGLE_EXP_INEXACT_WIDTH 32
`define GUARDBIT_TRIANGLE_EXP_INEXACT_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_INEXACT_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_INEXACT_MSB 35
`define GUARDBIT_TRIANGLE_EXP_INEXACT_LSB 4
`define GUARDBIT_TRIANGLE_EXP_INEXACT(row) row[35:4]
// zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_WIDTH 1
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_FRACTION 0
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_SIGNED 0
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_MSB 0
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA_LSB 0
`define GUARDBIT_TRIANGLE_EXP_ZERO_AREA(row) row[0:0]

// span.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_SPAN_EXP_ROWS 64'd1579
`define GUARDBIT_SPAN_EXP_LINE 27
`define GUARDBIT_SPAN_EXP_BITS 92
`define GUARDBIT_SPAN_EXP_PADS 92'h00000000e0000e0000e0000
// test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
`define GUARDBIT_SPAN_EXP_TEST_WIDTH 32
`define GUARDBIT_SPAN_EXP_TEST_FRACTION 0
`define GUARDBIT_SPAN_EXP_TEST_SIGNED 0
`define GUARDBIT_SPAN_EXP_TEST_MSB 91
`define GUARDBIT_SPAN_EXP_TEST_LSB 60
`define GUARDBIT_SPAN_EXP_TEST(row) row[91:60]
// y: unsigned, width 17, fraction bits 0. Row.
`define GUARDBIT_SPAN_EXP_Y_WIDTH 17
`define GUARDBIT_SPAN_EXP_Y_FRACTION 0
`define GUARDBIT_SPAN_EXP_Y_SIGNED 0
`define GUARDBIT_SPAN_EXP_Y_MSB 56
`define GUARDBIT_SPAN_EXP_Y_LSB 40
`define GUARDBIT_SPAN_EXP_Y(row) row[56:40]
// x_begin: unsigned, width 17, fraction bits 0. First covered column.
`define GUARDBIT_SPAN_EXP_X_BEGIN_WIDTH 17
`define GUARDBIT_SPAN_EXP_X_BEGIN_FRACTION 0
`define GUARDBIT_SPAN_EXP_X_BEGIN_SIGNED 0
`define GUARDBIT_SPAN_EXP_X_BEGIN_MSB 36
`define GUARDBIT_SPAN_EXP_X_BEGIN_LSB 20
`define GUARDBIT_SPAN_EXP_X_BEGIN(row) row[36:20]
// x_end: unsigned, width 17, fraction bits 0. One past the last covered column.
`define GUARDBIT_SPAN_EXP_X_END_WIDTH 17
`define GUARDBIT_SPAN_EXP_X_END_FRACTION 0
`define GUARDBIT_SPAN_EXP_X_END_SIGNED 0
`define GUARDBIT_SPAN_EXP_X_END_MSB 16
`define GUARDBIT_SPAN_EXP_X_END_LSB 0
`define GUARDBIT_SPAN_EXP_X_END(row) row[16:0]

// depth.exp.tv: rows, characters of a line with its newline, bits of a record
`define GUARDBIT_DEPTH_EXP_ROWS 64'd3944
`define GUARDBIT_DEPTH_EXP_LINE 23
`define GUARDBIT_DEPTH_EXP_BITS 76
`define GUARDBIT_DEPTH_EXP_PADS 76'h00000000e0000e00008
// test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
`define GUARDBIT_DEPTH_EXP_TEST_WIDTH 32
`define GUARDBIT_DEPTH_EXP_TEST_FRACTION 0
`define GUARDBIT_DEPTH_EXP_TEST_SIGNED 0
`define GUARDBIT_DEPTH_EXP_TEST_MSB 75
`define GUARDBIT_DEPTH_EXP_TEST_LSB 44
`define GUARDBIT_DEPTH_EXP_TEST(row) row[75:44]
// y: unsigned, width 17, fraction bits 0. Row.
`define GUARDBIT_DEPTH_EXP_Y_WIDTH 17
`define GUARDBIT_DEPTH_EXP_Y_FRACTION 0
`define GUARDBIT_DEPTH_EXP_Y_SIGNED 0
`define GUARDBIT_DEPTH_EXP_Y_MSB 40
`define GUARDBIT_DEPTH_EXP_Y_LSB 24
`define GUARDBIT_DEPTH_EXP_Y(row) row[40:24]
// x: unsigned, width 17, fraction bits 0. Column.
`define GUARDBIT_DEPTH_EXP_X_WIDTH 17
`define GUARDBIT_DEPTH_EXP_X_FRACTION 0
`define GUARDBIT_DEPTH_EXP_X_SIGNED 0
`define GUARDBIT_DEPTH_EXP_X_MSB 20
`define GUARDBIT_DEPTH_EXP_X_LSB 4
`define GUARDBIT_DEPTH_EXP_X(row) row[20:4]
// depth: unsigned, width 3, fraction bits 0. Depth read-out after the clamp.
`define GUARDBIT_DEPTH_EXP_DEPTH_WIDTH 3
`define GUARDBIT_DEPTH_EXP_DEPTH_FRACTION 0
`define GUARDBIT_DEPTH_EXP_DEPTH_SIGNED 0
`define GUARDBIT_DEPTH_EXP_DEPTH_MSB 2
`define GUARDBIT_DEPTH_EXP_DEPTH_LSB 0
`define GUARDBIT_DEPTH_EXP_DEPTH(row) row[2:0]

`endif
