// guardbit vector set tiny, model version 2: SystemVerilog package, generated.
//
// Widths, row counts and records of every file of the set. Each column fills whole nibbles, its
// value in the low bits, so a line read by $readmemh unpacks by assignment:
//     logic [DDA_EXP_BITS-1:0] mem [0:DDA_EXP_ROWS-1];
//     initial $readmemh("dda.exp.tv", mem);
//     dda_exp_t row;  ...  row = mem[i];
// Run the bench from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim
package guardbit_pkg;
    localparam SET = "tiny";
    localparam int MODEL_VERSION = 2;

    // Depth machine: accumulator is guard, integer and interpolation bits, output is the integer bits.
    localparam int GUARD_BITS = 1;
    localparam int INTEGER_BITS = 3;
    localparam int FRACTION_BITS = 3;
    localparam int CLAMP_WRAP = 0;
    localparam int CLAMP_GUARD = 1;
    localparam int CLAMP_SIGN = 2;
    localparam int CLAMP_SATURATE = 3;
    localparam int CLAMP_MODE = CLAMP_GUARD;

    // Set-up: sub-pixel bits of a vertex
    localparam int SUB_PIXEL_BITS = 1;
    // the sample in its pixel, in sub-pixels
    localparam int SAMPLE_X = 1;
    // the same, downward
    localparam int SAMPLE_Y = 1;
    // fill rule: 0 top-left, 1 shadow
    localparam int SHADOW_RULE = 0;
    // low bits of an edge value that are not kept
    localparam int EDGE_SHIFT = 1;
    // of start and slopes, as setup_divider has it: nearest-even
    localparam int ROUNDING = 4;
    // 1: the start gains half a depth step
    localparam int START_HALF = 0;

    // op columns: what the device does at the clock edge; the row gives the state after it.
    localparam logic [1:0] OP_LOAD = 2'd0;
    localparam logic [1:0] OP_STEP_X = 2'd1;
    localparam logic [1:0] OP_STEP_Y = 2'd2;
    localparam logic [1:0] OP_HOLD = 2'd3;

    // dda.cfg.tv
    localparam logic [63:0] DDA_CFG_ROWS = 64'd491;
    localparam int DDA_CFG_LINE = 9;  // characters of a line with its newline
    localparam int DDA_CFG_BITS = 24;  // four a digit
    localparam logic [23:0] DDA_CFG_PADS = 24'h808080;  // zero in every record
    // init: signed, width 7, fraction bits 3. Accumulator that the load takes.
    localparam int DDA_CFG_INIT_WIDTH = 7;
    localparam int DDA_CFG_INIT_FRACTION = 3;
    localparam int DDA_CFG_INIT_SIGNED = 1;
    // dx: signed, width 7, fraction bits 3. Slope per pixel to the right.
    localparam int DDA_CFG_DX_WIDTH = 7;
    localparam int DDA_CFG_DX_FRACTION = 3;
    localparam int DDA_CFG_DX_SIGNED = 1;
    // dy: signed, width 7, fraction bits 3. Slope per row downward.
    localparam int DDA_CFG_DY_WIDTH = 7;
    localparam int DDA_CFG_DY_FRACTION = 3;
    localparam int DDA_CFG_DY_SIGNED = 1;
    typedef struct packed {
        logic [0:0] pad0;
        logic signed [6:0] init;
        logic [0:0] pad1;
        logic signed [6:0] dx;
        logic [0:0] pad2;
        logic signed [6:0] dy;
    } dda_cfg_t;

    // dda.exp.tv
    localparam logic [63:0] DDA_EXP_ROWS = 64'd4000;
    localparam int DDA_EXP_LINE = 7;  // characters of a line with its newline
    localparam int DDA_EXP_BITS = 16;  // four a digit
    localparam logic [15:0] DDA_EXP_PADS = 16'hc808;  // zero in every record
    // op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
    localparam int DDA_EXP_OP_WIDTH = 2;
    localparam int DDA_EXP_OP_FRACTION = 0;
    localparam int DDA_EXP_OP_SIGNED = 0;
    // acc: signed, width 7, fraction bits 3. Accumulator after the clock edge.
    localparam int DDA_EXP_ACC_WIDTH = 7;
    localparam int DDA_EXP_ACC_FRACTION = 3;
    localparam int DDA_EXP_ACC_SIGNED = 1;
    // out: unsigned, width 3, fraction bits 0. Read-out after the clamp.
    localparam int DDA_EXP_OUT_V_WIDTH = 3;
    localparam int DDA_EXP_OUT_V_FRACTION = 0;
    localparam int DDA_EXP_OUT_V_SIGNED = 0;
    typedef struct packed {
        logic [1:0] pad0;
        logic [1:0] op;
        logic [0:0] pad1;
        logic signed [6:0] acc;
        logic [0:0] pad2;
        logic [2:0] out_v;
    } dda_exp_t;

    // edge.cfg.tv
    localparam logic [63:0] EDGE_CFG_ROWS = 64'd364;
    localparam int EDGE_CFG_LINE = 9;  // characters of a line with its newline
    localparam int EDGE_CFG_BITS = 24;  // four a digit
    localparam logic [23:0] EDGE_CFG_PADS = 24'hc0c0c0;  // zero in every record
    // e0: signed, width 6, fraction bits 0. Edge word that the load takes, bias and shift done.
    localparam int EDGE_CFG_E0_WIDTH = 6;
    localparam int EDGE_CFG_E0_FRACTION = 0;
    localparam int EDGE_CFG_E0_SIGNED = 1;
    // ea: signed, width 6, fraction bits 0. Step per pixel to the right.
    localparam int EDGE_CFG_EA_WIDTH = 6;
    localparam int EDGE_CFG_EA_FRACTION = 0;
    localparam int EDGE_CFG_EA_SIGNED = 1;
    // eb: signed, width 6, fraction bits 0. Step per row downward.
    localparam int EDGE_CFG_EB_WIDTH = 6;
    localparam int EDGE_CFG_EB_FRACTION = 0;
    localparam int EDGE_CFG_EB_SIGNED = 1;
    typedef struct packed {
        logic [1:0] pad0;
        logic signed [5:0] e0;
        logic [1:0] pad1;
        logic signed [5:0] ea;
        logic [1:0] pad2;
        logic signed [5:0] eb;
    } edge_cfg_t;

    // edge.exp.tv
    localparam logic [63:0] EDGE_EXP_ROWS = 64'd4000;
    localparam int EDGE_EXP_LINE = 7;  // characters of a line with its newline
    localparam int EDGE_EXP_BITS = 16;  // four a digit
    localparam logic [15:0] EDGE_EXP_PADS = 16'hcc0e;  // zero in every record
    // op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
    localparam int EDGE_EXP_OP_WIDTH = 2;
    localparam int EDGE_EXP_OP_FRACTION = 0;
    localparam int EDGE_EXP_OP_SIGNED = 0;
    // e: signed, width 6, fraction bits 0. Edge word after the clock edge.
    localparam int EDGE_EXP_E_WIDTH = 6;
    localparam int EDGE_EXP_E_FRACTION = 0;
    localparam int EDGE_EXP_E_SIGNED = 1;
    // in: unsigned, width 1, fraction bits 0. 1 when the sign bit of e is clear.
    localparam int EDGE_EXP_IN_V_WIDTH = 1;
    localparam int EDGE_EXP_IN_V_FRACTION = 0;
    localparam int EDGE_EXP_IN_V_SIGNED = 0;
    typedef struct packed {
        logic [1:0] pad0;
        logic [1:0] op;
        logic [1:0] pad1;
        logic signed [5:0] e;
        logic [2:0] pad2;
        logic [0:0] in_v;
    } edge_exp_t;

    // setup.cfg.tv
    localparam logic [63:0] SETUP_CFG_ROWS = 64'd712;
    localparam int SETUP_CFG_LINE = 18;  // characters of a line with its newline
    localparam int SETUP_CFG_BITS = 36;  // four a digit
    localparam logic [35:0] SETUP_CFG_PADS = 36'h008008008;  // zero in every record
    // v0_x: unsigned, width 4, fraction bits 1. Vertex 0, x in sub-pixels.
    localparam int SETUP_CFG_V0_X_WIDTH = 4;
    localparam int SETUP_CFG_V0_X_FRACTION = 1;
    localparam int SETUP_CFG_V0_X_SIGNED = 0;
    // v0_y: unsigned, width 4, fraction bits 1. Vertex 0, y in sub-pixels.
    localparam int SETUP_CFG_V0_Y_WIDTH = 4;
    localparam int SETUP_CFG_V0_Y_FRACTION = 1;
    localparam int SETUP_CFG_V0_Y_SIGNED = 0;
    // v0_z: unsigned, width 3, fraction bits 0. Vertex 0, depth code.
    localparam int SETUP_CFG_V0_Z_WIDTH = 3;
    localparam int SETUP_CFG_V0_Z_FRACTION = 0;
    localparam int SETUP_CFG_V0_Z_SIGNED = 0;
    // v1_x: unsigned, width 4, fraction bits 1. Vertex 1, x in sub-pixels.
    localparam int SETUP_CFG_V1_X_WIDTH = 4;
    localparam int SETUP_CFG_V1_X_FRACTION = 1;
    localparam int SETUP_CFG_V1_X_SIGNED = 0;
    // v1_y: unsigned, width 4, fraction bits 1. Vertex 1, y in sub-pixels.
    localparam int SETUP_CFG_V1_Y_WIDTH = 4;
    localparam int SETUP_CFG_V1_Y_FRACTION = 1;
    localparam int SETUP_CFG_V1_Y_SIGNED = 0;
    // v1_z: unsigned, width 3, fraction bits 0. Vertex 1, depth code.
    localparam int SETUP_CFG_V1_Z_WIDTH = 3;
    localparam int SETUP_CFG_V1_Z_FRACTION = 0;
    localparam int SETUP_CFG_V1_Z_SIGNED = 0;
    // v2_x: unsigned, width 4, fraction bits 1. Vertex 2, x in sub-pixels.
    localparam int SETUP_CFG_V2_X_WIDTH = 4;
    localparam int SETUP_CFG_V2_X_FRACTION = 1;
    localparam int SETUP_CFG_V2_X_SIGNED = 0;
    // v2_y: unsigned, width 4, fraction bits 1. Vertex 2, y in sub-pixels.
    localparam int SETUP_CFG_V2_Y_WIDTH = 4;
    localparam int SETUP_CFG_V2_Y_FRACTION = 1;
    localparam int SETUP_CFG_V2_Y_SIGNED = 0;
    // v2_z: unsigned, width 3, fraction bits 0. Vertex 2, depth code.
    localparam int SETUP_CFG_V2_Z_WIDTH = 3;
    localparam int SETUP_CFG_V2_Z_FRACTION = 0;
    localparam int SETUP_CFG_V2_Z_SIGNED = 0;
    typedef struct packed {
        logic [3:0] v0_x;
        logic [3:0] v0_y;
        logic [0:0] pad2;
        logic [2:0] v0_z;
        logic [3:0] v1_x;
        logic [3:0] v1_y;
        logic [0:0] pad5;
        logic [2:0] v1_z;
        logic [3:0] v2_x;
        logic [3:0] v2_y;
        logic [0:0] pad8;
        logic [2:0] v2_z;
    } setup_cfg_t;

    // setup.exp.tv
    localparam logic [63:0] SETUP_EXP_ROWS = 64'd712;
    localparam int SETUP_EXP_LINE = 38;  // characters of a line with its newline
    localparam int SETUP_EXP_BITS = 100;  // four a digit
    localparam logic [99:0] SETUP_EXP_PADS = 100'hc0c0c0c0c0c0c0c0c0808080e;  // zero in every record
    // edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
    localparam int SETUP_EXP_EDGE0_INIT_WIDTH = 6;
    localparam int SETUP_EXP_EDGE0_INIT_FRACTION = 1;
    localparam int SETUP_EXP_EDGE0_INIT_SIGNED = 1;
    // edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
    localparam int SETUP_EXP_EDGE0_DX_WIDTH = 6;
    localparam int SETUP_EXP_EDGE0_DX_FRACTION = 1;
    localparam int SETUP_EXP_EDGE0_DX_SIGNED = 1;
    // edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
    localparam int SETUP_EXP_EDGE0_DY_WIDTH = 6;
    localparam int SETUP_EXP_EDGE0_DY_FRACTION = 1;
    localparam int SETUP_EXP_EDGE0_DY_SIGNED = 1;
    // edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
    localparam int SETUP_EXP_EDGE1_INIT_WIDTH = 6;
    localparam int SETUP_EXP_EDGE1_INIT_FRACTION = 1;
    localparam int SETUP_EXP_EDGE1_INIT_SIGNED = 1;
    // edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
    localparam int SETUP_EXP_EDGE1_DX_WIDTH = 6;
    localparam int SETUP_EXP_EDGE1_DX_FRACTION = 1;
    localparam int SETUP_EXP_EDGE1_DX_SIGNED = 1;
    // edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
    localparam int SETUP_EXP_EDGE1_DY_WIDTH = 6;
    localparam int SETUP_EXP_EDGE1_DY_FRACTION = 1;
    localparam int SETUP_EXP_EDGE1_DY_SIGNED = 1;
    // edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
    localparam int SETUP_EXP_EDGE2_INIT_WIDTH = 6;
    localparam int SETUP_EXP_EDGE2_INIT_FRACTION = 1;
    localparam int SETUP_EXP_EDGE2_INIT_SIGNED = 1;
    // edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
    localparam int SETUP_EXP_EDGE2_DX_WIDTH = 6;
    localparam int SETUP_EXP_EDGE2_DX_FRACTION = 1;
    localparam int SETUP_EXP_EDGE2_DX_SIGNED = 1;
    // edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
    localparam int SETUP_EXP_EDGE2_DY_WIDTH = 6;
    localparam int SETUP_EXP_EDGE2_DY_FRACTION = 1;
    localparam int SETUP_EXP_EDGE2_DY_SIGNED = 1;
    // depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
    localparam int SETUP_EXP_DEPTH_INIT_WIDTH = 7;
    localparam int SETUP_EXP_DEPTH_INIT_FRACTION = 3;
    localparam int SETUP_EXP_DEPTH_INIT_SIGNED = 1;
    // depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
    localparam int SETUP_EXP_DEPTH_DX_WIDTH = 7;
    localparam int SETUP_EXP_DEPTH_DX_FRACTION = 3;
    localparam int SETUP_EXP_DEPTH_DX_SIGNED = 1;
    // depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
    localparam int SETUP_EXP_DEPTH_DY_WIDTH = 7;
    localparam int SETUP_EXP_DEPTH_DY_FRACTION = 3;
    localparam int SETUP_EXP_DEPTH_DY_SIGNED = 1;
    // zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    localparam int SETUP_EXP_ZERO_AREA_WIDTH = 1;
    localparam int SETUP_EXP_ZERO_AREA_FRACTION = 0;
    localparam int SETUP_EXP_ZERO_AREA_SIGNED = 0;
    typedef struct packed {
        logic [1:0] pad0;
        logic signed [5:0] edge0_init;
        logic [1:0] pad1;
        logic signed [5:0] edge0_dx;
        logic [1:0] pad2;
        logic signed [5:0] edge0_dy;
        logic [1:0] pad3;
        logic signed [5:0] edge1_init;
        logic [1:0] pad4;
        logic signed [5:0] edge1_dx;
        logic [1:0] pad5;
        logic signed [5:0] edge1_dy;
        logic [1:0] pad6;
        logic signed [5:0] edge2_init;
        logic [1:0] pad7;
        logic signed [5:0] edge2_dx;
        logic [1:0] pad8;
        logic signed [5:0] edge2_dy;
        logic [0:0] pad9;
        logic signed [6:0] depth_init;
        logic [0:0] pad10;
        logic signed [6:0] depth_dx;
        logic [0:0] pad11;
        logic signed [6:0] depth_dy;
        logic [2:0] pad12;
        logic [0:0] zero_area;
    } setup_exp_t;

    // triangle.cfg.tv
    localparam logic [63:0] TRIANGLE_CFG_ROWS = 64'd871;
    localparam int TRIANGLE_CFG_LINE = 71;  // characters of a line with its newline
    localparam int TRIANGLE_CFG_BITS = 212;  // four a digit
    localparam logic [211:0] TRIANGLE_CFG_PADS = 212'h00000000c0c0c0c0c0c0c0c0c0808080ee0000e0000e0000e0000;  // zero in every record
    // test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    localparam int TRIANGLE_CFG_TEST_WIDTH = 32;
    localparam int TRIANGLE_CFG_TEST_FRACTION = 0;
    localparam int TRIANGLE_CFG_TEST_SIGNED = 0;
    // edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
    localparam int TRIANGLE_CFG_EDGE0_INIT_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE0_INIT_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE0_INIT_SIGNED = 1;
    // edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
    localparam int TRIANGLE_CFG_EDGE0_DX_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE0_DX_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE0_DX_SIGNED = 1;
    // edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
    localparam int TRIANGLE_CFG_EDGE0_DY_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE0_DY_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE0_DY_SIGNED = 1;
    // edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
    localparam int TRIANGLE_CFG_EDGE1_INIT_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE1_INIT_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE1_INIT_SIGNED = 1;
    // edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
    localparam int TRIANGLE_CFG_EDGE1_DX_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE1_DX_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE1_DX_SIGNED = 1;
    // edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
    localparam int TRIANGLE_CFG_EDGE1_DY_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE1_DY_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE1_DY_SIGNED = 1;
    // edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
    localparam int TRIANGLE_CFG_EDGE2_INIT_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE2_INIT_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE2_INIT_SIGNED = 1;
    // edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
    localparam int TRIANGLE_CFG_EDGE2_DX_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE2_DX_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE2_DX_SIGNED = 1;
    // edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
    localparam int TRIANGLE_CFG_EDGE2_DY_WIDTH = 6;
    localparam int TRIANGLE_CFG_EDGE2_DY_FRACTION = 1;
    localparam int TRIANGLE_CFG_EDGE2_DY_SIGNED = 1;
    // depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
    localparam int TRIANGLE_CFG_DEPTH_INIT_WIDTH = 7;
    localparam int TRIANGLE_CFG_DEPTH_INIT_FRACTION = 3;
    localparam int TRIANGLE_CFG_DEPTH_INIT_SIGNED = 1;
    // depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
    localparam int TRIANGLE_CFG_DEPTH_DX_WIDTH = 7;
    localparam int TRIANGLE_CFG_DEPTH_DX_FRACTION = 3;
    localparam int TRIANGLE_CFG_DEPTH_DX_SIGNED = 1;
    // depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
    localparam int TRIANGLE_CFG_DEPTH_DY_WIDTH = 7;
    localparam int TRIANGLE_CFG_DEPTH_DY_FRACTION = 3;
    localparam int TRIANGLE_CFG_DEPTH_DY_SIGNED = 1;
    // zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    localparam int TRIANGLE_CFG_ZERO_AREA_WIDTH = 1;
    localparam int TRIANGLE_CFG_ZERO_AREA_FRACTION = 0;
    localparam int TRIANGLE_CFG_ZERO_AREA_SIGNED = 0;
    // box_y_begin: unsigned, width 17, fraction bits 0. First row of the bounding box in the window.
    localparam int TRIANGLE_CFG_BOX_Y_BEGIN_WIDTH = 17;
    localparam int TRIANGLE_CFG_BOX_Y_BEGIN_FRACTION = 0;
    localparam int TRIANGLE_CFG_BOX_Y_BEGIN_SIGNED = 0;
    // box_y_end: unsigned, width 17, fraction bits 0. One past its last row.
    localparam int TRIANGLE_CFG_BOX_Y_END_WIDTH = 17;
    localparam int TRIANGLE_CFG_BOX_Y_END_FRACTION = 0;
    localparam int TRIANGLE_CFG_BOX_Y_END_SIGNED = 0;
    // box_x_begin: unsigned, width 17, fraction bits 0. First column of the bounding box.
    localparam int TRIANGLE_CFG_BOX_X_BEGIN_WIDTH = 17;
    localparam int TRIANGLE_CFG_BOX_X_BEGIN_FRACTION = 0;
    localparam int TRIANGLE_CFG_BOX_X_BEGIN_SIGNED = 0;
    // box_x_end: unsigned, width 17, fraction bits 0. One past its last column.
    localparam int TRIANGLE_CFG_BOX_X_END_WIDTH = 17;
    localparam int TRIANGLE_CFG_BOX_X_END_FRACTION = 0;
    localparam int TRIANGLE_CFG_BOX_X_END_SIGNED = 0;
    typedef struct packed {
        logic [31:0] test;
        logic [1:0] pad1;
        logic signed [5:0] edge0_init;
        logic [1:0] pad2;
        logic signed [5:0] edge0_dx;
        logic [1:0] pad3;
        logic signed [5:0] edge0_dy;
        logic [1:0] pad4;
        logic signed [5:0] edge1_init;
        logic [1:0] pad5;
        logic signed [5:0] edge1_dx;
        logic [1:0] pad6;
        logic signed [5:0] edge1_dy;
        logic [1:0] pad7;
        logic signed [5:0] edge2_init;
        logic [1:0] pad8;
        logic signed [5:0] edge2_dx;
        logic [1:0] pad9;
        logic signed [5:0] edge2_dy;
        logic [0:0] pad10;
        logic signed [6:0] depth_init;
        logic [0:0] pad11;
        logic signed [6:0] depth_dx;
        logic [0:0] pad12;
        logic signed [6:0] depth_dy;
        logic [2:0] pad13;
        logic [0:0] zero_area;
        logic [2:0] pad14;
        logic [16:0] box_y_begin;
        logic [2:0] pad15;
        logic [16:0] box_y_end;
        logic [2:0] pad16;
        logic [16:0] box_x_begin;
        logic [2:0] pad17;
        logic [16:0] box_x_end;
    } triangle_cfg_t;

    // triangle.exp.tv
    localparam logic [63:0] TRIANGLE_EXP_ROWS = 64'd871;
    localparam int TRIANGLE_EXP_LINE = 65;  // characters of a line with its newline
    localparam int TRIANGLE_EXP_BITS = 228;  // four a digit
    localparam logic [227:0] TRIANGLE_EXP_PADS = 228'h00000000000000000000000000000000000000000000000000000000e;  // zero in every record
    // test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    localparam int TRIANGLE_EXP_TEST_WIDTH = 32;
    localparam int TRIANGLE_EXP_TEST_FRACTION = 0;
    localparam int TRIANGLE_EXP_TEST_SIGNED = 0;
    // spans: unsigned, width 32, fraction bits 0. Maximal runs of covered samples.
    localparam int TRIANGLE_EXP_SPANS_WIDTH = 32;
    localparam int TRIANGLE_EXP_SPANS_FRACTION = 0;
    localparam int TRIANGLE_EXP_SPANS_SIGNED = 0;
    // samples: unsigned, width 32, fraction bits 0. Covered samples.
    localparam int TRIANGLE_EXP_SAMPLES_WIDTH = 32;
    localparam int TRIANGLE_EXP_SAMPLES_FRACTION = 0;
    localparam int TRIANGLE_EXP_SAMPLES_SIGNED = 0;
    // wrap: unsigned, width 32, fraction bits 0. Covered samples whose depth left the guard range.
    localparam int TRIANGLE_EXP_WRAP_WIDTH = 32;
    localparam int TRIANGLE_EXP_WRAP_FRACTION = 0;
    localparam int TRIANGLE_EXP_WRAP_SIGNED = 0;
    // clamp_above: unsigned, width 32, fraction bits 0. Covered samples held at the maximum.
    localparam int TRIANGLE_EXP_CLAMP_ABOVE_WIDTH = 32;
    localparam int TRIANGLE_EXP_CLAMP_ABOVE_FRACTION = 0;
    localparam int TRIANGLE_EXP_CLAMP_ABOVE_SIGNED = 0;
    // clamp_below: unsigned, width 32, fraction bits 0. Covered samples held at zero.
    localparam int TRIANGLE_EXP_CLAMP_BELOW_WIDTH = 32;
    localparam int TRIANGLE_EXP_CLAMP_BELOW_FRACTION = 0;
    localparam int TRIANGLE_EXP_CLAMP_BELOW_SIGNED = 0;
    // inexact: unsigned, width 32, fraction bits 0. Covered samples whose read-out dropped a fraction.
    localparam int TRIANGLE_EXP_INEXACT_WIDTH = 32;
    localparam int TRIANGLE_EXP_INEXACT_FRACTION = 0;
    localparam int TRIANGLE_EXP_INEXACT_SIGNED = 0;
    // zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    localparam int TRIANGLE_EXP_ZERO_AREA_WIDTH = 1;
    localparam int TRIANGLE_EXP_ZERO_AREA_FRACTION = 0;
    localparam int TRIANGLE_EXP_ZERO_AREA_SIGNED = 0;
    typedef struct packed {
        logic [31:0] test;
        logic [31:0] spans;
        logic [31:0] samples;
        logic [31:0] wrap;
        logic [31:0] clamp_above;
        logic [31:0] clamp_below;
        logic [31:0] inexact;
        logic [2:0] pad7;
        logic [0:0] zero_area;
    } triangle_exp_t;

    // span.exp.tv
    localparam logic [63:0] SPAN_EXP_ROWS = 64'd1579;
    localparam int SPAN_EXP_LINE = 27;  // characters of a line with its newline
    localparam int SPAN_EXP_BITS = 92;  // four a digit
    localparam logic [91:0] SPAN_EXP_PADS = 92'h00000000e0000e0000e0000;  // zero in every record
    // test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    localparam int SPAN_EXP_TEST_WIDTH = 32;
    localparam int SPAN_EXP_TEST_FRACTION = 0;
    localparam int SPAN_EXP_TEST_SIGNED = 0;
    // y: unsigned, width 17, fraction bits 0. Row.
    localparam int SPAN_EXP_Y_WIDTH = 17;
    localparam int SPAN_EXP_Y_FRACTION = 0;
    localparam int SPAN_EXP_Y_SIGNED = 0;
    // x_begin: unsigned, width 17, fraction bits 0. First covered column.
    localparam int SPAN_EXP_X_BEGIN_WIDTH = 17;
    localparam int SPAN_EXP_X_BEGIN_FRACTION = 0;
    localparam int SPAN_EXP_X_BEGIN_SIGNED = 0;
    // x_end: unsigned, width 17, fraction bits 0. One past the last covered column.
    localparam int SPAN_EXP_X_END_WIDTH = 17;
    localparam int SPAN_EXP_X_END_FRACTION = 0;
    localparam int SPAN_EXP_X_END_SIGNED = 0;
    typedef struct packed {
        logic [31:0] test;
        logic [2:0] pad1;
        logic [16:0] y;
        logic [2:0] pad2;
        logic [16:0] x_begin;
        logic [2:0] pad3;
        logic [16:0] x_end;
    } span_exp_t;

    // depth.exp.tv
    localparam logic [63:0] DEPTH_EXP_ROWS = 64'd3944;
    localparam int DEPTH_EXP_LINE = 23;  // characters of a line with its newline
    localparam int DEPTH_EXP_BITS = 76;  // four a digit
    localparam logic [75:0] DEPTH_EXP_PADS = 76'h00000000e0000e00008;  // zero in every record
    // test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    localparam int DEPTH_EXP_TEST_WIDTH = 32;
    localparam int DEPTH_EXP_TEST_FRACTION = 0;
    localparam int DEPTH_EXP_TEST_SIGNED = 0;
    // y: unsigned, width 17, fraction bits 0. Row.
    localparam int DEPTH_EXP_Y_WIDTH = 17;
    localparam int DEPTH_EXP_Y_FRACTION = 0;
    localparam int DEPTH_EXP_Y_SIGNED = 0;
    // x: unsigned, width 17, fraction bits 0. Column.
    localparam int DEPTH_EXP_X_WIDTH = 17;
    localparam int DEPTH_EXP_X_FRACTION = 0;
    localparam int DEPTH_EXP_X_SIGNED = 0;
    // depth: unsigned, width 3, fraction bits 0. Depth read-out after the clamp.
    localparam int DEPTH_EXP_DEPTH_WIDTH = 3;
    localparam int DEPTH_EXP_DEPTH_FRACTION = 0;
    localparam int DEPTH_EXP_DEPTH_SIGNED = 0;
    typedef struct packed {
        logic [31:0] test;
        logic [2:0] pad1;
        logic [16:0] y;
        logic [2:0] pad2;
        logic [16:0] x;
        logic [0:0] pad3;
        logic [2:0] depth;
    } depth_exp_t;
endpackage
