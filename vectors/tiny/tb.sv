// guardbit vector set tiny, model version 1: SystemVerilog testbench, generated.
//
// Drives the devices of dut.sv (replace them with yours, same ports) with the set beside this
// file and compares every row. Run from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim
// It ends with a PASS line, or with a FAIL line and a non-zero exit status.
//
// $readmemh and $fscanf hide short files, over-wide words and X digits, each simulator in its own
// way. So each line is read as text: its length, every character and every padding bit are
// checked, and the number of lines is checked against the package. Memory does not grow with
// the set.

// Reads a file of fixed-length lines. A whole line is decoded at once as one wide word: digits
// to nibbles, nibbles back to digits, and the two texts must agree.
module line_reader #(
    parameter NAME = "",
    parameter [63:0] ROWS = 0,
    parameter int CHARS = 2,                // characters of a line with its newline
    parameter [8*CHARS-1:0] FIXED = 0,      // separators and newline in their places, else 00
    parameter [8*CHARS-1:0] DIGITS = 0      // 01 in the place of each digit
) ();
    localparam [8*CHARS-1:0] NINE = 9;                  // code of a letter to its value, low nibble
    localparam [8*CHARS-1:0] TO_LETTER = 39;            // from what follows 9 in ASCII to a
    // Constants, but as variables: Icarus builds a wide constant anew at each use.
    reg [8*CHARS-1:0] separators = FIXED;
    reg [8*CHARS-1:0] ones = DIGITS;
    reg [8*CHARS-1:0] fifteens = DIGITS * 15;
    reg [8*CHARS-1:0] sixes = DIGITS * 6;               // carry into the next nibble from 10 on
    reg [8*CHARS-1:0] zeros = DIGITS * 48;              // the character 0 in the place of each digit

    integer file;
    integer got;
    longint unsigned line;                  // lines read so far
    reg [8*CHARS+7:0] raw;                  // one character more, to see that a line is too long
    reg [8*CHARS-1:0] text;
    reg [8*CHARS-1:0] letter;               // 01 in the place of each letter
    reg [8*CHARS-1:0] nibbles;              // one digit's value a byte

    initial begin
        line = 0;
        file = $fopen(NAME, "r");
        if (file == 0) begin
            $display("FAIL %0s: cannot be opened", NAME);
            $fatal(1, "bad vector set");
        end
    end

    task next;
        begin
            got = $fgets(raw, file);
            line = line + 1;
            if (got == 0) begin
                $display("FAIL %0s: no line %0d, the package says %0d rows", NAME, line, ROWS);
                $fatal(1, "bad vector set");
            end
            else if (got != CHARS || raw[7:0] != 8'h0a) begin
                $display("FAIL %0s line %0d: not %0d characters and a newline", NAME, line, CHARS - 1);
                $fatal(1, "bad vector set");
            end
            text = raw[8*CHARS-1:0] - separators;
            letter = (text >> 6) & ones;
            nibbles = (text + letter * NINE) & fifteens;
            letter = ((nibbles + sixes) >> 4) & ones;
            if (text != nibbles + zeros + letter * TO_LETTER) begin
                $display("FAIL %0s line %0d: not lowercase hexadecimal words of this row's widths", NAME, line);
                $fatal(1, "bad vector set");
            end
        end
    endtask

    task over_wide;
        begin
            $display("FAIL %0s line %0d: a word is wider than its column", NAME, line);
            $fatal(1, "bad vector set");
        end
    endtask

    task last;
        begin
            got = $fgets(raw, file);
            if (ROWS == 0) begin
                $display("FAIL %0s: the package says 0 rows, nothing to check", NAME);
                $fatal(1, "bad vector set");
            end
            if (got != 0) begin
                $display("FAIL %0s line %0d: more than the %0d rows of the package", NAME, line + 1, ROWS);
                $fatal(1, "bad vector set");
            end
            if (line != ROWS) begin
                $display("FAIL %0s: %0d of %0d rows used", NAME, line, ROWS);
                $fatal(1, "bad vector set");
            end
        end
    endtask
endmodule

// Drives dda with dda.cfg.tv and compares every row of dda.exp.tv. Inputs change and
// outputs are compared at the falling edge; the device works at the rising edge.
module dda_check (
    input  wire       clk,
    output reg        done,
    output reg [63:0] rows,
    output reg [63:0] mismatches
);
    import guardbit_pkg::*;
    localparam logic [63:0] REPORTED = 20;

    line_reader #(
        .NAME("dda.cfg.tv"), .ROWS(DDA_CFG_ROWS), .CHARS(DDA_CFG_LINE),
        .FIXED(72'h00005f00005f00000a),
        .DIGITS(72'h010100010100010100)
    ) cfg_file ();
    line_reader #(
        .NAME("dda.exp.tv"), .ROWS(DDA_EXP_ROWS), .CHARS(DDA_EXP_LINE),
        .FIXED(56'h005f00005f000a),
        .DIGITS(56'h01000101000100)
    ) exp_file ();

    reg [DDA_CFG_BITS-1:0] cfg_bits;
    reg [DDA_EXP_BITS-1:0] exp_bits;
    dda_cfg_t cfg;
    dda_exp_t want;
    longint unsigned walk;                  // number of the walk, from 0
    longint unsigned row;                   // row within the walk, from 0
    integer reset_left;
    reg pending;                            // a row has been applied and not yet compared

    reg rst;
    reg [1:0] op;
    wire [6:0] acc;
    wire [2:0] out_v;
    dda device (
        .clk(clk), .rst(rst), .op(op),
        .init(cfg.init), .dx(cfg.dx), .dy(cfg.dy),
        .acc(acc), .out_v(out_v)
    );

    initial begin
        done = 1'b0;
        rows = 0;
        mismatches = 0;
        walk = 0;
        row = 0;
        reset_left = 3;
        pending = 1'b0;
        rst = 1'b1;
        op = OP_HOLD;
        cfg = 0;
        want = 0;
    end

    task compare;
        begin
            rows = rows + 1;
            if (acc !== want.acc) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH dda walk %0d row %0d (dda.exp.tv line %0d, op %0d) field acc\n    expected %h  %b.%b.%b\n    got      %h  %b.%b.%b",
                        walk - 1, row, exp_file.line, op, want.acc, want.acc[6:6], want.acc[5:3], want.acc[2:0], acc, acc[6:6], acc[5:3], acc[2:0]);
            end
            if (out_v !== want.out_v) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH dda walk %0d row %0d (dda.exp.tv line %0d, op %0d) field out\n    expected %h  %b\n    got      %h  %b",
                        walk - 1, row, exp_file.line, op, want.out_v, want.out_v, out_v, out_v);
            end
        end
    endtask

    task apply;
        begin
            exp_file.next;
            exp_bits = {
                    exp_file.nibbles[51:48], exp_file.nibbles[35:32], exp_file.nibbles[27:24], exp_file.nibbles[11:8]};
            want = exp_bits;
            if (|(exp_bits & DDA_EXP_PADS)) exp_file.over_wide;
            if (want.op == OP_LOAD) begin
                cfg_file.next;
                cfg_bits = {
                    cfg_file.nibbles[67:64], cfg_file.nibbles[59:56], cfg_file.nibbles[43:40], cfg_file.nibbles[35:32],
                    cfg_file.nibbles[19:16], cfg_file.nibbles[11:8]};
                cfg = cfg_bits;
                if (|(cfg_bits & DDA_CFG_PADS)) cfg_file.over_wide;
                walk = walk + 1;
                row = 0;
            end
            else begin
                row = row + 1;
                if (walk == 0) begin
                    $display("FAIL dda.exp.tv line 1: the first row is not a load");
                    $fatal(1, "bad vector set");
                end
            end
            op = want.op;
            pending = 1'b1;
        end
    endtask

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            rst = 1'b0;
            if (pending) compare;
            if (exp_file.line < DDA_EXP_ROWS)
                apply;
            else begin
                exp_file.last;
                cfg_file.last;
                op = OP_HOLD;
                done = 1'b1;
            end
        end
endmodule

// Drives edge_stepper with edge.cfg.tv and compares every row of edge.exp.tv. Inputs change and
// outputs are compared at the falling edge; the device works at the rising edge.
module edge_check (
    input  wire       clk,
    output reg        done,
    output reg [63:0] rows,
    output reg [63:0] mismatches
);
    import guardbit_pkg::*;
    localparam logic [63:0] REPORTED = 20;

    line_reader #(
        .NAME("edge.cfg.tv"), .ROWS(EDGE_CFG_ROWS), .CHARS(EDGE_CFG_LINE),
        .FIXED(72'h00005f00005f00000a),
        .DIGITS(72'h010100010100010100)
    ) cfg_file ();
    line_reader #(
        .NAME("edge.exp.tv"), .ROWS(EDGE_EXP_ROWS), .CHARS(EDGE_EXP_LINE),
        .FIXED(56'h005f00005f000a),
        .DIGITS(56'h01000101000100)
    ) exp_file ();

    reg [EDGE_CFG_BITS-1:0] cfg_bits;
    reg [EDGE_EXP_BITS-1:0] exp_bits;
    edge_cfg_t cfg;
    edge_exp_t want;
    longint unsigned walk;                  // number of the walk, from 0
    longint unsigned row;                   // row within the walk, from 0
    integer reset_left;
    reg pending;                            // a row has been applied and not yet compared

    reg rst;
    reg [1:0] op;
    wire [5:0] e;
    wire [0:0] in_v;
    edge_stepper device (
        .clk(clk), .rst(rst), .op(op),
        .e0(cfg.e0), .ea(cfg.ea), .eb(cfg.eb),
        .e(e), .in_v(in_v)
    );

    initial begin
        done = 1'b0;
        rows = 0;
        mismatches = 0;
        walk = 0;
        row = 0;
        reset_left = 3;
        pending = 1'b0;
        rst = 1'b1;
        op = OP_HOLD;
        cfg = 0;
        want = 0;
    end

    task compare;
        begin
            rows = rows + 1;
            if (e !== want.e) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH edge walk %0d row %0d (edge.exp.tv line %0d, op %0d) field e\n    expected %h  %b\n    got      %h  %b",
                        walk - 1, row, exp_file.line, op, want.e, want.e[5:0], e, e[5:0]);
            end
            if (in_v !== want.in_v) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH edge walk %0d row %0d (edge.exp.tv line %0d, op %0d) field in\n    expected %h  %b\n    got      %h  %b",
                        walk - 1, row, exp_file.line, op, want.in_v, want.in_v, in_v, in_v);
            end
        end
    endtask

    task apply;
        begin
            exp_file.next;
            exp_bits = {
                    exp_file.nibbles[51:48], exp_file.nibbles[35:32], exp_file.nibbles[27:24], exp_file.nibbles[11:8]};
            want = exp_bits;
            if (|(exp_bits & EDGE_EXP_PADS)) exp_file.over_wide;
            if (want.op == OP_LOAD) begin
                cfg_file.next;
                cfg_bits = {
                    cfg_file.nibbles[67:64], cfg_file.nibbles[59:56], cfg_file.nibbles[43:40], cfg_file.nibbles[35:32],
                    cfg_file.nibbles[19:16], cfg_file.nibbles[11:8]};
                cfg = cfg_bits;
                if (|(cfg_bits & EDGE_CFG_PADS)) cfg_file.over_wide;
                walk = walk + 1;
                row = 0;
            end
            else begin
                row = row + 1;
                if (walk == 0) begin
                    $display("FAIL edge.exp.tv line 1: the first row is not a load");
                    $fatal(1, "bad vector set");
                end
            end
            op = want.op;
            pending = 1'b1;
        end
    endtask

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            rst = 1'b0;
            if (pending) compare;
            if (exp_file.line < EDGE_EXP_ROWS)
                apply;
            else begin
                exp_file.last;
                cfg_file.last;
                op = OP_HOLD;
                done = 1'b1;
            end
        end
endmodule

module tb;
    reg clk = 1'b0;
    always #1 clk = ~clk;

    wire dda_done;
    wire [63:0] dda_rows, dda_mismatches;
    dda_check dda_half (.clk(clk), .done(dda_done), .rows(dda_rows), .mismatches(dda_mismatches));

    wire edge_done;
    wire [63:0] edge_rows, edge_mismatches;
    edge_check edge_half (.clk(clk), .done(edge_done), .rows(edge_rows), .mismatches(edge_mismatches));

    always @(posedge clk)
        if (dda_done && edge_done) begin
            if (dda_mismatches != 0 || edge_mismatches != 0) begin
                $display("FAIL dda rows=%0d edge rows=%0d mismatches=%0d", dda_rows, edge_rows, dda_mismatches + edge_mismatches);
                $fatal(1, "device and vectors disagree");
            end
            else begin
                $display("PASS dda rows=%0d edge rows=%0d", dda_rows, edge_rows);
                $finish;
            end
        end
endmodule
