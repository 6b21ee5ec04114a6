-- guardbit vector set tiny, model version 2: VHDL-2008 package, generated.
--
-- Widths, row counts and records of every file of the set. Each column fills whole nibbles of a
-- line, its value in the low bits; hread passes over the separators:
--     variable bits : std_logic_vector(DDA_EXP_BITS - 1 downto 0);
--     readline(f, l);  hread(l, bits);  row := to_dda_exp(bits);
-- Row counts are unsigned because VHDL integers end at 31 bits.
-- Run the bench from inside the set folder:
--     $ ghdl -a --std=08 pkg.vhd dut.vhd tb.vhd && ghdl -e --std=08 tb && ghdl -r --std=08 tb
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package guardbit_pkg is
    constant SET : string := "tiny";
    constant MODEL_VERSION : natural := 2;

    -- Depth machine: accumulator is guard, integer and interpolation bits, output is the integer bits.
    constant GUARD_BITS : natural := 1;
    constant INTEGER_BITS : positive := 3;
    constant FRACTION_BITS : natural := 3;
    type clamp_t is (CLAMP_WRAP, CLAMP_GUARD, CLAMP_SIGN, CLAMP_SATURATE);
    constant CLAMP_MODE : clamp_t := CLAMP_GUARD;

    -- Set-up: sub-pixel bits of a vertex
    constant SUB_PIXEL_BITS : natural := 1;
    -- the sample in its pixel, in sub-pixels
    constant SAMPLE_X : natural := 1;
    -- the same, downward
    constant SAMPLE_Y : natural := 1;
    -- fill rule: 0 top-left, 1 shadow
    constant SHADOW_RULE : natural := 0;
    -- low bits of an edge value that are not kept
    constant EDGE_SHIFT : natural := 1;
    -- of start and slopes, as setup_divider has it: nearest-even
    constant ROUNDING : natural := 4;
    -- 1: the start gains half a depth step
    constant START_HALF : natural := 0;

    -- op columns: what the device does at the clock edge; the row gives the state after it.
    constant OP_LOAD : std_logic_vector(1 downto 0) := "00";
    constant OP_STEP_X : std_logic_vector(1 downto 0) := "01";
    constant OP_STEP_Y : std_logic_vector(1 downto 0) := "10";
    constant OP_HOLD : std_logic_vector(1 downto 0) := "11";

    -- dda.cfg.tv: rows, characters of a line without its newline, bits of a record
    constant DDA_CFG_ROWS : unsigned(63 downto 0) := x"00000000000001eb";  -- 491
    constant DDA_CFG_LINE : positive := 8;
    constant DDA_CFG_BITS : positive := 24;
    constant DDA_CFG_PADS : std_logic_vector(23 downto 0) := x"808080";
    -- init: signed, width 7, fraction bits 3. Accumulator that the load takes.
    constant DDA_CFG_INIT_WIDTH : positive := 7;
    constant DDA_CFG_INIT_FRACTION : natural := 3;
    constant DDA_CFG_INIT_SIGNED : boolean := true;
    -- dx: signed, width 7, fraction bits 3. Slope per pixel to the right.
    constant DDA_CFG_DX_WIDTH : positive := 7;
    constant DDA_CFG_DX_FRACTION : natural := 3;
    constant DDA_CFG_DX_SIGNED : boolean := true;
    -- dy: signed, width 7, fraction bits 3. Slope per row downward.
    constant DDA_CFG_DY_WIDTH : positive := 7;
    constant DDA_CFG_DY_FRACTION : natural := 3;
    constant DDA_CFG_DY_SIGNED : boolean := true;
    type dda_cfg_t is record
        init : std_logic_vector(6 downto 0);
        dx : std_logic_vector(6 downto 0);
        dy : std_logic_vector(6 downto 0);
    end record dda_cfg_t;
    function to_dda_cfg(bits : std_logic_vector) return dda_cfg_t;

    -- dda.exp.tv: rows, characters of a line without its newline, bits of a record
    constant DDA_EXP_ROWS : unsigned(63 downto 0) := x"0000000000000fa0";  -- 4000
    constant DDA_EXP_LINE : positive := 6;
    constant DDA_EXP_BITS : positive := 16;
    constant DDA_EXP_PADS : std_logic_vector(15 downto 0) := x"c808";
    -- op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
    constant DDA_EXP_OP_WIDTH : positive := 2;
    constant DDA_EXP_OP_FRACTION : natural := 0;
    constant DDA_EXP_OP_SIGNED : boolean := false;
    -- acc: signed, width 7, fraction bits 3. Accumulator after the clock edge.
    constant DDA_EXP_ACC_WIDTH : positive := 7;
    constant DDA_EXP_ACC_FRACTION : natural := 3;
    constant DDA_EXP_ACC_SIGNED : boolean := true;
    -- out: unsigned, width 3, fraction bits 0. Read-out after the clamp.
    constant DDA_EXP_OUT_V_WIDTH : positive := 3;
    constant DDA_EXP_OUT_V_FRACTION : natural := 0;
    constant DDA_EXP_OUT_V_SIGNED : boolean := false;
    type dda_exp_t is record
        op : std_logic_vector(1 downto 0);
        acc : std_logic_vector(6 downto 0);
        out_v : std_logic_vector(2 downto 0);
    end record dda_exp_t;
    function to_dda_exp(bits : std_logic_vector) return dda_exp_t;

    -- edge.cfg.tv: rows, characters of a line without its newline, bits of a record
    constant EDGE_CFG_ROWS : unsigned(63 downto 0) := x"000000000000016c";  -- 364
    constant EDGE_CFG_LINE : positive := 8;
    constant EDGE_CFG_BITS : positive := 24;
    constant EDGE_CFG_PADS : std_logic_vector(23 downto 0) := x"c0c0c0";
    -- e0: signed, width 6, fraction bits 0. Edge word that the load takes, bias and shift done.
    constant EDGE_CFG_E0_WIDTH : positive := 6;
    constant EDGE_CFG_E0_FRACTION : natural := 0;
    constant EDGE_CFG_E0_SIGNED : boolean := true;
    -- ea: signed, width 6, fraction bits 0. Step per pixel to the right.
    constant EDGE_CFG_EA_WIDTH : positive := 6;
    constant EDGE_CFG_EA_FRACTION : natural := 0;
    constant EDGE_CFG_EA_SIGNED : boolean := true;
    -- eb: signed, width 6, fraction bits 0. Step per row downward.
    constant EDGE_CFG_EB_WIDTH : positive := 6;
    constant EDGE_CFG_EB_FRACTION : natural := 0;
    constant EDGE_CFG_EB_SIGNED : boolean := true;
    type edge_cfg_t is record
        e0 : std_logic_vector(5 downto 0);
        ea : std_logic_vector(5 downto 0);
        eb : std_logic_vector(5 downto 0);
    end record edge_cfg_t;
    function to_edge_cfg(bits : std_logic_vector) return edge_cfg_t;

    -- edge.exp.tv: rows, characters of a line without its newline, bits of a record
    constant EDGE_EXP_ROWS : unsigned(63 downto 0) := x"0000000000000fa0";  -- 4000
    constant EDGE_EXP_LINE : positive := 6;
    constant EDGE_EXP_BITS : positive := 16;
    constant EDGE_EXP_PADS : std_logic_vector(15 downto 0) := x"cc0e";
    -- op: unsigned, width 2, fraction bits 0. 0 load, 1 step by dx, 2 step by dy, 3 hold.
    constant EDGE_EXP_OP_WIDTH : positive := 2;
    constant EDGE_EXP_OP_FRACTION : natural := 0;
    constant EDGE_EXP_OP_SIGNED : boolean := false;
    -- e: signed, width 6, fraction bits 0. Edge word after the clock edge.
    constant EDGE_EXP_E_WIDTH : positive := 6;
    constant EDGE_EXP_E_FRACTION : natural := 0;
    constant EDGE_EXP_E_SIGNED : boolean := true;
    -- in: unsigned, width 1, fraction bits 0. 1 when the sign bit of e is clear.
    constant EDGE_EXP_IN_V_WIDTH : positive := 1;
    constant EDGE_EXP_IN_V_FRACTION : natural := 0;
    constant EDGE_EXP_IN_V_SIGNED : boolean := false;
    type edge_exp_t is record
        op : std_logic_vector(1 downto 0);
        e : std_logic_vector(5 downto 0);
        in_v : std_logic_vector(0 downto 0);
    end record edge_exp_t;
    function to_edge_exp(bits : std_logic_vector) return edge_exp_t;

    -- setup.cfg.tv: rows, characters of a line without its newline, bits of a record
    constant SETUP_CFG_ROWS : unsigned(63 downto 0) := x"00000000000002c8";  -- 712
    constant SETUP_CFG_LINE : positive := 17;
    constant SETUP_CFG_BITS : positive := 36;
    constant SETUP_CFG_PADS : std_logic_vector(35 downto 0) := x"008008008";
    -- v0_x: unsigned, width 4, fraction bits 1. Vertex 0, x in sub-pixels.
    constant SETUP_CFG_V0_X_WIDTH : positive := 4;
    constant SETUP_CFG_V0_X_FRACTION : natural := 1;
    constant SETUP_CFG_V0_X_SIGNED : boolean := false;
    -- v0_y: unsigned, width 4, fraction bits 1. Vertex 0, y in sub-pixels.
    constant SETUP_CFG_V0_Y_WIDTH : positive := 4;
    constant SETUP_CFG_V0_Y_FRACTION : natural := 1;
    constant SETUP_CFG_V0_Y_SIGNED : boolean := false;
    -- v0_z: unsigned, width 3, fraction bits 0. Vertex 0, depth code.
    constant SETUP_CFG_V0_Z_WIDTH : positive := 3;
    constant SETUP_CFG_V0_Z_FRACTION : natural := 0;
    constant SETUP_CFG_V0_Z_SIGNED : boolean := false;
    -- v1_x: unsigned, width 4, fraction bits 1. Vertex 1, x in sub-pixels.
    constant SETUP_CFG_V1_X_WIDTH : positive := 4;
    constant SETUP_CFG_V1_X_FRACTION : natural := 1;
    constant SETUP_CFG_V1_X_SIGNED : boolean := false;
    -- v1_y: unsigned, width 4, fraction bits 1. Vertex 1, y in sub-pixels.
    constant SETUP_CFG_V1_Y_WIDTH : positive := 4;
    constant SETUP_CFG_V1_Y_FRACTION : natural := 1;
    constant SETUP_CFG_V1_Y_SIGNED : boolean := false;
    -- v1_z: unsigned, width 3, fraction bits 0. Vertex 1, depth code.
    constant SETUP_CFG_V1_Z_WIDTH : positive := 3;
    constant SETUP_CFG_V1_Z_FRACTION : natural := 0;
    constant SETUP_CFG_V1_Z_SIGNED : boolean := false;
    -- v2_x: unsigned, width 4, fraction bits 1. Vertex 2, x in sub-pixels.
    constant SETUP_CFG_V2_X_WIDTH : positive := 4;
    constant SETUP_CFG_V2_X_FRACTION : natural := 1;
    constant SETUP_CFG_V2_X_SIGNED : boolean := false;
    -- v2_y: unsigned, width 4, fraction bits 1. Vertex 2, y in sub-pixels.
    constant SETUP_CFG_V2_Y_WIDTH : positive := 4;
    constant SETUP_CFG_V2_Y_FRACTION : natural := 1;
    constant SETUP_CFG_V2_Y_SIGNED : boolean := false;
    -- v2_z: unsigned, width 3, fraction bits 0. Vertex 2, depth code.
    constant SETUP_CFG_V2_Z_WIDTH : positive := 3;
    constant SETUP_CFG_V2_Z_FRACTION : natural := 0;
    constant SETUP_CFG_V2_Z_SIGNED : boolean := false;
    type setup_cfg_t is record
        v0_x : std_logic_vector(3 downto 0);
        v0_y : std_logic_vector(3 downto 0);
        v0_z : std_logic_vector(2 downto 0);
        v1_x : std_logic_vector(3 downto 0);
        v1_y : std_logic_vector(3 downto 0);
        v1_z : std_logic_vector(2 downto 0);
        v2_x : std_logic_vector(3 downto 0);
        v2_y : std_logic_vector(3 downto 0);
        v2_z : std_logic_vector(2 downto 0);
    end record setup_cfg_t;
    function to_setup_cfg(bits : std_logic_vector) return setup_cfg_t;

    -- setup.exp.tv: rows, characters of a line without its newline, bits of a record
    constant SETUP_EXP_ROWS : unsigned(63 downto 0) := x"00000000000002c8";  -- 712
    constant SETUP_EXP_LINE : positive := 37;
    constant SETUP_EXP_BITS : positive := 100;
    constant SETUP_EXP_PADS : std_logic_vector(99 downto 0) := x"c0c0c0c0c0c0c0c0c0808080e";
    -- edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
    constant SETUP_EXP_EDGE0_INIT_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE0_INIT_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE0_INIT_SIGNED : boolean := true;
    -- edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
    constant SETUP_EXP_EDGE0_DX_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE0_DX_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE0_DX_SIGNED : boolean := true;
    -- edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
    constant SETUP_EXP_EDGE0_DY_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE0_DY_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE0_DY_SIGNED : boolean := true;
    -- edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
    constant SETUP_EXP_EDGE1_INIT_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE1_INIT_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE1_INIT_SIGNED : boolean := true;
    -- edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
    constant SETUP_EXP_EDGE1_DX_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE1_DX_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE1_DX_SIGNED : boolean := true;
    -- edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
    constant SETUP_EXP_EDGE1_DY_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE1_DY_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE1_DY_SIGNED : boolean := true;
    -- edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
    constant SETUP_EXP_EDGE2_INIT_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE2_INIT_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE2_INIT_SIGNED : boolean := true;
    -- edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
    constant SETUP_EXP_EDGE2_DX_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE2_DX_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE2_DX_SIGNED : boolean := true;
    -- edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
    constant SETUP_EXP_EDGE2_DY_WIDTH : positive := 6;
    constant SETUP_EXP_EDGE2_DY_FRACTION : natural := 1;
    constant SETUP_EXP_EDGE2_DY_SIGNED : boolean := true;
    -- depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
    constant SETUP_EXP_DEPTH_INIT_WIDTH : positive := 7;
    constant SETUP_EXP_DEPTH_INIT_FRACTION : natural := 3;
    constant SETUP_EXP_DEPTH_INIT_SIGNED : boolean := true;
    -- depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
    constant SETUP_EXP_DEPTH_DX_WIDTH : positive := 7;
    constant SETUP_EXP_DEPTH_DX_FRACTION : natural := 3;
    constant SETUP_EXP_DEPTH_DX_SIGNED : boolean := true;
    -- depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
    constant SETUP_EXP_DEPTH_DY_WIDTH : positive := 7;
    constant SETUP_EXP_DEPTH_DY_FRACTION : natural := 3;
    constant SETUP_EXP_DEPTH_DY_SIGNED : boolean := true;
    -- zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    constant SETUP_EXP_ZERO_AREA_WIDTH : positive := 1;
    constant SETUP_EXP_ZERO_AREA_FRACTION : natural := 0;
    constant SETUP_EXP_ZERO_AREA_SIGNED : boolean := false;
    type setup_exp_t is record
        edge0_init : std_logic_vector(5 downto 0);
        edge0_dx : std_logic_vector(5 downto 0);
        edge0_dy : std_logic_vector(5 downto 0);
        edge1_init : std_logic_vector(5 downto 0);
        edge1_dx : std_logic_vector(5 downto 0);
        edge1_dy : std_logic_vector(5 downto 0);
        edge2_init : std_logic_vector(5 downto 0);
        edge2_dx : std_logic_vector(5 downto 0);
        edge2_dy : std_logic_vector(5 downto 0);
        depth_init : std_logic_vector(6 downto 0);
        depth_dx : std_logic_vector(6 downto 0);
        depth_dy : std_logic_vector(6 downto 0);
        zero_area : std_logic_vector(0 downto 0);
    end record setup_exp_t;
    function to_setup_exp(bits : std_logic_vector) return setup_exp_t;

    -- triangle.cfg.tv: rows, characters of a line without its newline, bits of a record
    constant TRIANGLE_CFG_ROWS : unsigned(63 downto 0) := x"0000000000000367";  -- 871
    constant TRIANGLE_CFG_LINE : positive := 70;
    constant TRIANGLE_CFG_BITS : positive := 212;
    constant TRIANGLE_CFG_PADS : std_logic_vector(211 downto 0) := x"00000000c0c0c0c0c0c0c0c0c0808080ee0000e0000e0000e0000";
    -- test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    constant TRIANGLE_CFG_TEST_WIDTH : positive := 32;
    constant TRIANGLE_CFG_TEST_FRACTION : natural := 0;
    constant TRIANGLE_CFG_TEST_SIGNED : boolean := false;
    -- edge0_init: signed, width 6, fraction bits 1. Edge 0 at pixel (0, 0), biased and stored.
    constant TRIANGLE_CFG_EDGE0_INIT_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE0_INIT_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE0_INIT_SIGNED : boolean := true;
    -- edge0_dx: signed, width 6, fraction bits 1. Edge 0, step per pixel to the right.
    constant TRIANGLE_CFG_EDGE0_DX_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE0_DX_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE0_DX_SIGNED : boolean := true;
    -- edge0_dy: signed, width 6, fraction bits 1. Edge 0, step per row downward.
    constant TRIANGLE_CFG_EDGE0_DY_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE0_DY_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE0_DY_SIGNED : boolean := true;
    -- edge1_init: signed, width 6, fraction bits 1. Edge 1 at pixel (0, 0), biased and stored.
    constant TRIANGLE_CFG_EDGE1_INIT_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE1_INIT_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE1_INIT_SIGNED : boolean := true;
    -- edge1_dx: signed, width 6, fraction bits 1. Edge 1, step per pixel to the right.
    constant TRIANGLE_CFG_EDGE1_DX_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE1_DX_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE1_DX_SIGNED : boolean := true;
    -- edge1_dy: signed, width 6, fraction bits 1. Edge 1, step per row downward.
    constant TRIANGLE_CFG_EDGE1_DY_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE1_DY_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE1_DY_SIGNED : boolean := true;
    -- edge2_init: signed, width 6, fraction bits 1. Edge 2 at pixel (0, 0), biased and stored.
    constant TRIANGLE_CFG_EDGE2_INIT_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE2_INIT_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE2_INIT_SIGNED : boolean := true;
    -- edge2_dx: signed, width 6, fraction bits 1. Edge 2, step per pixel to the right.
    constant TRIANGLE_CFG_EDGE2_DX_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE2_DX_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE2_DX_SIGNED : boolean := true;
    -- edge2_dy: signed, width 6, fraction bits 1. Edge 2, step per row downward.
    constant TRIANGLE_CFG_EDGE2_DY_WIDTH : positive := 6;
    constant TRIANGLE_CFG_EDGE2_DY_FRACTION : natural := 1;
    constant TRIANGLE_CFG_EDGE2_DY_SIGNED : boolean := true;
    -- depth_init: signed, width 7, fraction bits 3. Depth accumulator at pixel (0, 0).
    constant TRIANGLE_CFG_DEPTH_INIT_WIDTH : positive := 7;
    constant TRIANGLE_CFG_DEPTH_INIT_FRACTION : natural := 3;
    constant TRIANGLE_CFG_DEPTH_INIT_SIGNED : boolean := true;
    -- depth_dx: signed, width 7, fraction bits 3. Depth slope per pixel to the right.
    constant TRIANGLE_CFG_DEPTH_DX_WIDTH : positive := 7;
    constant TRIANGLE_CFG_DEPTH_DX_FRACTION : natural := 3;
    constant TRIANGLE_CFG_DEPTH_DX_SIGNED : boolean := true;
    -- depth_dy: signed, width 7, fraction bits 3. Depth slope per row downward.
    constant TRIANGLE_CFG_DEPTH_DY_WIDTH : positive := 7;
    constant TRIANGLE_CFG_DEPTH_DY_FRACTION : natural := 3;
    constant TRIANGLE_CFG_DEPTH_DY_SIGNED : boolean := true;
    -- zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    constant TRIANGLE_CFG_ZERO_AREA_WIDTH : positive := 1;
    constant TRIANGLE_CFG_ZERO_AREA_FRACTION : natural := 0;
    constant TRIANGLE_CFG_ZERO_AREA_SIGNED : boolean := false;
    -- box_y_begin: unsigned, width 17, fraction bits 0. First row of the bounding box in the window.
    constant TRIANGLE_CFG_BOX_Y_BEGIN_WIDTH : positive := 17;
    constant TRIANGLE_CFG_BOX_Y_BEGIN_FRACTION : natural := 0;
    constant TRIANGLE_CFG_BOX_Y_BEGIN_SIGNED : boolean := false;
    -- box_y_end: unsigned, width 17, fraction bits 0. One past its last row.
    constant TRIANGLE_CFG_BOX_Y_END_WIDTH : positive := 17;
    constant TRIANGLE_CFG_BOX_Y_END_FRACTION : natural := 0;
    constant TRIANGLE_CFG_BOX_Y_END_SIGNED : boolean := false;
    -- box_x_begin: unsigned, width 17, fraction bits 0. First column of the bounding box.
    constant TRIANGLE_CFG_BOX_X_BEGIN_WIDTH : positive := 17;
    constant TRIANGLE_CFG_BOX_X_BEGIN_FRACTION : natural := 0;
    constant TRIANGLE_CFG_BOX_X_BEGIN_SIGNED : boolean := false;
    -- box_x_end: unsigned, width 17, fraction bits 0. One past its last column.
    constant TRIANGLE_CFG_BOX_X_END_WIDTH : positive := 17;
    constant TRIANGLE_CFG_BOX_X_END_FRACTION : natural := 0;
    constant TRIANGLE_CFG_BOX_X_END_SIGNED : boolean := false;
    type triangle_cfg_t is record
        test : std_logic_vector(31 downto 0);
        edge0_init : std_logic_vector(5 downto 0);
        edge0_dx : std_logic_vector(5 downto 0);
        edge0_dy : std_logic_vector(5 downto 0);
        edge1_init : std_logic_vector(5 downto 0);
        edge1_dx : std_logic_vector(5 downto 0);
        edge1_dy : std_logic_vector(5 downto 0);
        edge2_init : std_logic_vector(5 downto 0);
        edge2_dx : std_logic_vector(5 downto 0);
        edge2_dy : std_logic_vector(5 downto 0);
        depth_init : std_logic_vector(6 downto 0);
        depth_dx : std_logic_vector(6 downto 0);
        depth_dy : std_logic_vector(6 downto 0);
        zero_area : std_logic_vector(0 downto 0);
        box_y_begin : std_logic_vector(16 downto 0);
        box_y_end : std_logic_vector(16 downto 0);
        box_x_begin : std_logic_vector(16 downto 0);
        box_x_end : std_logic_vector(16 downto 0);
    end record triangle_cfg_t;
    function to_triangle_cfg(bits : std_logic_vector) return triangle_cfg_t;

    -- triangle.exp.tv: rows, characters of a line without its newline, bits of a record
    constant TRIANGLE_EXP_ROWS : unsigned(63 downto 0) := x"0000000000000367";  -- 871
    constant TRIANGLE_EXP_LINE : positive := 64;
    constant TRIANGLE_EXP_BITS : positive := 228;
    constant TRIANGLE_EXP_PADS : std_logic_vector(227 downto 0) := x"00000000000000000000000000000000000000000000000000000000e";
    -- test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    constant TRIANGLE_EXP_TEST_WIDTH : positive := 32;
    constant TRIANGLE_EXP_TEST_FRACTION : natural := 0;
    constant TRIANGLE_EXP_TEST_SIGNED : boolean := false;
    -- spans: unsigned, width 32, fraction bits 0. Maximal runs of covered samples.
    constant TRIANGLE_EXP_SPANS_WIDTH : positive := 32;
    constant TRIANGLE_EXP_SPANS_FRACTION : natural := 0;
    constant TRIANGLE_EXP_SPANS_SIGNED : boolean := false;
    -- samples: unsigned, width 32, fraction bits 0. Covered samples.
    constant TRIANGLE_EXP_SAMPLES_WIDTH : positive := 32;
    constant TRIANGLE_EXP_SAMPLES_FRACTION : natural := 0;
    constant TRIANGLE_EXP_SAMPLES_SIGNED : boolean := false;
    -- wrap: unsigned, width 32, fraction bits 0. Covered samples whose depth left the guard range.
    constant TRIANGLE_EXP_WRAP_WIDTH : positive := 32;
    constant TRIANGLE_EXP_WRAP_FRACTION : natural := 0;
    constant TRIANGLE_EXP_WRAP_SIGNED : boolean := false;
    -- clamp_above: unsigned, width 32, fraction bits 0. Covered samples held at the maximum.
    constant TRIANGLE_EXP_CLAMP_ABOVE_WIDTH : positive := 32;
    constant TRIANGLE_EXP_CLAMP_ABOVE_FRACTION : natural := 0;
    constant TRIANGLE_EXP_CLAMP_ABOVE_SIGNED : boolean := false;
    -- clamp_below: unsigned, width 32, fraction bits 0. Covered samples held at zero.
    constant TRIANGLE_EXP_CLAMP_BELOW_WIDTH : positive := 32;
    constant TRIANGLE_EXP_CLAMP_BELOW_FRACTION : natural := 0;
    constant TRIANGLE_EXP_CLAMP_BELOW_SIGNED : boolean := false;
    -- inexact: unsigned, width 32, fraction bits 0. Covered samples whose read-out dropped a fraction.
    constant TRIANGLE_EXP_INEXACT_WIDTH : positive := 32;
    constant TRIANGLE_EXP_INEXACT_FRACTION : natural := 0;
    constant TRIANGLE_EXP_INEXACT_SIGNED : boolean := false;
    -- zero_area: unsigned, width 1, fraction bits 0. 1 when the triangle has no area and draws nothing.
    constant TRIANGLE_EXP_ZERO_AREA_WIDTH : positive := 1;
    constant TRIANGLE_EXP_ZERO_AREA_FRACTION : natural := 0;
    constant TRIANGLE_EXP_ZERO_AREA_SIGNED : boolean := false;
    type triangle_exp_t is record
        test : std_logic_vector(31 downto 0);
        spans : std_logic_vector(31 downto 0);
        samples : std_logic_vector(31 downto 0);
        wrap : std_logic_vector(31 downto 0);
        clamp_above : std_logic_vector(31 downto 0);
        clamp_below : std_logic_vector(31 downto 0);
        inexact : std_logic_vector(31 downto 0);
        zero_area : std_logic_vector(0 downto 0);
    end record triangle_exp_t;
    function to_triangle_exp(bits : std_logic_vector) return triangle_exp_t;

    -- span.exp.tv: rows, characters of a line without its newline, bits of a record
    constant SPAN_EXP_ROWS : unsigned(63 downto 0) := x"000000000000062b";  -- 1579
    constant SPAN_EXP_LINE : positive := 26;
    constant SPAN_EXP_BITS : positive := 92;
    constant SPAN_EXP_PADS : std_logic_vector(91 downto 0) := x"00000000e0000e0000e0000";
    -- test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    constant SPAN_EXP_TEST_WIDTH : positive := 32;
    constant SPAN_EXP_TEST_FRACTION : natural := 0;
    constant SPAN_EXP_TEST_SIGNED : boolean := false;
    -- y: unsigned, width 17, fraction bits 0. Row.
    constant SPAN_EXP_Y_WIDTH : positive := 17;
    constant SPAN_EXP_Y_FRACTION : natural := 0;
    constant SPAN_EXP_Y_SIGNED : boolean := false;
    -- x_begin: unsigned, width 17, fraction bits 0. First covered column.
    constant SPAN_EXP_X_BEGIN_WIDTH : positive := 17;
    constant SPAN_EXP_X_BEGIN_FRACTION : natural := 0;
    constant SPAN_EXP_X_BEGIN_SIGNED : boolean := false;
    -- x_end: unsigned, width 17, fraction bits 0. One past the last covered column.
    constant SPAN_EXP_X_END_WIDTH : positive := 17;
    constant SPAN_EXP_X_END_FRACTION : natural := 0;
    constant SPAN_EXP_X_END_SIGNED : boolean := false;
    type span_exp_t is record
        test : std_logic_vector(31 downto 0);
        y : std_logic_vector(16 downto 0);
        x_begin : std_logic_vector(16 downto 0);
        x_end : std_logic_vector(16 downto 0);
    end record span_exp_t;
    function to_span_exp(bits : std_logic_vector) return span_exp_t;

    -- depth.exp.tv: rows, characters of a line without its newline, bits of a record
    constant DEPTH_EXP_ROWS : unsigned(63 downto 0) := x"0000000000000f68";  -- 3944
    constant DEPTH_EXP_LINE : positive := 22;
    constant DEPTH_EXP_BITS : positive := 76;
    constant DEPTH_EXP_PADS : std_logic_vector(75 downto 0) := x"00000000e0000e00008";
    -- test: unsigned, width 32, fraction bits 0. Number of the test, from 0.
    constant DEPTH_EXP_TEST_WIDTH : positive := 32;
    constant DEPTH_EXP_TEST_FRACTION : natural := 0;
    constant DEPTH_EXP_TEST_SIGNED : boolean := false;
    -- y: unsigned, width 17, fraction bits 0. Row.
    constant DEPTH_EXP_Y_WIDTH : positive := 17;
    constant DEPTH_EXP_Y_FRACTION : natural := 0;
    constant DEPTH_EXP_Y_SIGNED : boolean := false;
    -- x: unsigned, width 17, fraction bits 0. Column.
    constant DEPTH_EXP_X_WIDTH : positive := 17;
    constant DEPTH_EXP_X_FRACTION : natural := 0;
    constant DEPTH_EXP_X_SIGNED : boolean := false;
    -- depth: unsigned, width 3, fraction bits 0. Depth read-out after the clamp.
    constant DEPTH_EXP_DEPTH_WIDTH : positive := 3;
    constant DEPTH_EXP_DEPTH_FRACTION : natural := 0;
    constant DEPTH_EXP_DEPTH_SIGNED : boolean := false;
    type depth_exp_t is record
        test : std_logic_vector(31 downto 0);
        y : std_logic_vector(16 downto 0);
        x : std_logic_vector(16 downto 0);
        depth : std_logic_vector(2 downto 0);
    end record depth_exp_t;
    function to_depth_exp(bits : std_logic_vector) return depth_exp_t;
end package guardbit_pkg;

package body guardbit_pkg is
    function to_dda_cfg(bits : std_logic_vector) return dda_cfg_t is
        alias packed_bits : std_logic_vector(23 downto 0) is bits;
        variable row : dda_cfg_t;
    begin
        row.init := packed_bits(22 downto 16);
        row.dx := packed_bits(14 downto 8);
        row.dy := packed_bits(6 downto 0);
        return row;
    end function to_dda_cfg;

    function to_dda_exp(bits : std_logic_vector) return dda_exp_t is
        alias packed_bits : std_logic_vector(15 downto 0) is bits;
        variable row : dda_exp_t;
    begin
        row.op := packed_bits(13 downto 12);
        row.acc := packed_bits(10 downto 4);
        row.out_v := packed_bits(2 downto 0);
        return row;
    end function to_dda_exp;

    function to_edge_cfg(bits : std_logic_vector) return edge_cfg_t is
        alias packed_bits : std_logic_vector(23 downto 0) is bits;
        variable row : edge_cfg_t;
    begin
        row.e0 := packed_bits(21 downto 16);
        row.ea := packed_bits(13 downto 8);
        row.eb := packed_bits(5 downto 0);
        return row;
    end function to_edge_cfg;

    function to_edge_exp(bits : std_logic_vector) return edge_exp_t is
        alias packed_bits : std_logic_vector(15 downto 0) is bits;
        variable row : edge_exp_t;
    begin
        row.op := packed_bits(13 downto 12);
        row.e := packed_bits(9 downto 4);
        row.in_v := packed_bits(0 downto 0);
        return row;
    end function to_edge_exp;

    function to_setup_cfg(bits : std_logic_vector) return setup_cfg_t is
        alias packed_bits : std_logic_vector(35 downto 0) is bits;
        variable row : setup_cfg_t;
    begin
        row.v0_x := packed_bits(35 downto 32);
        row.v0_y := packed_bits(31 downto 28);
        row.v0_z := packed_bits(26 downto 24);
        row.v1_x := packed_bits(23 downto 20);
        row.v1_y := packed_bits(19 downto 16);
        row.v1_z := packed_bits(14 downto 12);
        row.v2_x := packed_bits(11 downto 8);
        row.v2_y := packed_bits(7 downto 4);
        row.v2_z := packed_bits(2 downto 0);
        return row;
    end function to_setup_cfg;

    function to_setup_exp(bits : std_logic_vector) return setup_exp_t is
        alias packed_bits : std_logic_vector(99 downto 0) is bits;
        variable row : setup_exp_t;
    begin
        row.edge0_init := packed_bits(97 downto 92);
        row.edge0_dx := packed_bits(89 downto 84);
        row.edge0_dy := packed_bits(81 downto 76);
        row.edge1_init := packed_bits(73 downto 68);
        row.edge1_dx := packed_bits(65 downto 60);
        row.edge1_dy := packed_bits(57 downto 52);
        row.edge2_init := packed_bits(49 downto 44);
        row.edge2_dx := packed_bits(41 downto 36);
        row.edge2_dy := packed_bits(33 downto 28);
        row.depth_init := packed_bits(26 downto 20);
        row.depth_dx := packed_bits(18 downto 12);
        row.depth_dy := packed_bits(10 downto 4);
        row.zero_area := packed_bits(0 downto 0);
        return row;
    end function to_setup_exp;

    function to_triangle_cfg(bits : std_logic_vector) return triangle_cfg_t is
        alias packed_bits : std_logic_vector(211 downto 0) is bits;
        variable row : triangle_cfg_t;
    begin
        row.test := packed_bits(211 downto 180);
        row.edge0_init := packed_bits(177 downto 172);
        row.edge0_dx := packed_bits(169 downto 164);
        row.edge0_dy := packed_bits(161 downto 156);
        row.edge1_init := packed_bits(153 downto 148);
        row.edge1_dx := packed_bits(145 downto 140);
        row.edge1_dy := packed_bits(137 downto 132);
        row.edge2_init := packed_bits(129 downto 124);
        row.edge2_dx := packed_bits(121 downto 116);
        row.edge2_dy := packed_bits(113 downto 108);
        row.depth_init := packed_bits(106 downto 100);
        row.depth_dx := packed_bits(98 downto 92);
        row.depth_dy := packed_bits(90 downto 84);
        row.zero_area := packed_bits(80 downto 80);
        row.box_y_begin := packed_bits(76 downto 60);
        row.box_y_end := packed_bits(56 downto 40);
        row.box_x_begin := packed_bits(36 downto 20);
        row.box_x_end := packed_bits(16 downto 0);
        return row;
    end function to_triangle_cfg;

    function to_triangle_exp(bits : std_logic_vector) return triangle_exp_t is
        alias packed_bits : std_logic_vector(227 downto 0) is bits;
        variable row : triangle_exp_t;
    begin
        row.test := packed_bits(227 downto 196);
        row.spans := packed_bits(195 downto 164);
        row.samples := packed_bits(163 downto 132);
        row.wrap := packed_bits(131 downto 100);
        row.clamp_above := packed_bits(99 downto 68);
        row.clamp_below := packed_bits(67 downto 36);
        row.inexact := packed_bits(35 downto 4);
        row.zero_area := packed_bits(0 downto 0);
        return row;
    end function to_triangle_exp;

    function to_span_exp(bits : std_logic_vector) return span_exp_t is
        alias packed_bits : std_logic_vector(91 downto 0) is bits;
        variable row : span_exp_t;
    begin
        row.test := packed_bits(91 downto 60);
        row.y := packed_bits(56 downto 40);
        row.x_begin := packed_bits(36 downto 20);
        row.x_end := packed_bits(16 downto 0);
        return row;
    end function to_span_exp;

    function to_depth_exp(bits : std_logic_vector) return depth_exp_t is
        alias packed_bits : std_logic_vector(75 downto 0) is bits;
        variable row : depth_exp_t;
    begin
        row.test := packed_bits(75 downto 44);
        row.y := packed_bits(40 downto 24);
        row.x := packed_bits(20 downto 4);
        row.depth := packed_bits(2 downto 0);
        return row;
    end function to_depth_exp;
end package body guardbit_pkg;
