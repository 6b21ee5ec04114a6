// guardbit vector set tiny, model version 2: SystemVerilog testbench, generated.
//
// Drives the devices of dut.sv (replace them with yours, same ports) with the set beside this
// file and compares every row.
// Run from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim
// It ends with a PASS line, or with a FAIL line and a non-zero exit status. More, after the
// simulation's name: +dump writes what the devices answer to *.exp.dut.tv, for `guardbit verify
// --dut`; +vcd=FILE writes waves (Verilator needs --trace when it builds).
// For walks with registered outputs: +latency=N, or the macro GUARDBIT_VALID (-DGUARDBIT_VALID when you
// build), as the comment of each walk says. For engines with an order of their own: +anyorder. With the
// macro GUARDBIT_PARAMETERS the bench sets the parameters of the devices to the constants of pkg.sv.
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
// outputs are compared at the falling edge; the device works at the rising edge. Now and then the
// bench stalls: it holds for some clocks, with other slopes at the inputs, and nothing may change.
// With +dump or +vcd it does not stall: rows and waves are then those of the files.
// With +latency=N the outputs of a clock edge are compared N clocks later. With the macro
// GUARDBIT_VALID the device has two ports more, in_valid and out_valid: it takes a row where in_valid
// is high, and its rows are compared in order where out_valid is high.
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
    dda_exp_t answer;                      // what the outputs are compared with
    longint unsigned walk;                  // number of the walk, from 1
    longint unsigned row;                   // row within the walk, from 0
    integer reset_left;
    reg pending;                            // a row has been applied at the last falling edge
    // What the device has been told and has yet to answer, in a ring.
    localparam integer MOST = 64;
    integer latency;                        // clocks until an answer, where there is no out_valid
    reg [5:0] head, tail;                   // where the next entry comes and goes
    integer entries;
    integer open;                           // rows among them
    integer quiet;                          // clocks since the last row, once all are in
    reg [195+DDA_EXP_BITS:0] ring [0:MOST-1];
    reg judged;                             // whether the outputs are compared at all
    reg counted;                            // whether they are those of a row
    reg [1:0] was_op;
    longint unsigned was_walk, was_row, was_line;

    // One walk in 64 begins with a reset in the middle of a step, which leaves zero behind. Not with
    // +no-reset, +dump or +vcd, nor where answers take their time or have a valid.
    reg resets;
    reg restarting;

    reg rst;
    reg [1:0] op;
    reg [6:0] init, dx, dy;
    reg [15:0] noise;
    integer stall_left;
    reg stalls;
    integer dump;
    wire [6:0] acc;
    wire [2:0] out_v;
`ifdef GUARDBIT_VALID
    wire out_valid;
`endif
    dda 
`ifdef GUARDBIT_PARAMETERS
        #(.G(GUARD_BITS), .I(INTEGER_BITS), .F(FRACTION_BITS), .MODE(CLAMP_MODE))
`endif
        device (
        .clk(clk), .rst(rst), .op(op),
`ifdef GUARDBIT_VALID
        .in_valid(pending), .out_valid(out_valid),
`endif
        .init(init), .dx(dx), .dy(dy),
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
        noise = 16'hace1;
        stall_left = 0;
        dump = 0;
        head = 0;
        tail = 0;
        entries = 0;
        open = 0;
        quiet = 0;
        if (!$value$plusargs("latency=%d", latency)) latency = 0;
        if (latency < 0 || latency >= MOST) begin
            $display("FAIL +latency=%0d: 0 to %0d is possible", latency, MOST - 1);
            $fatal(1, "bad latency");
        end
        stalls = !$test$plusargs("dump") && !$test$plusargs("vcd");
        resets = !$test$plusargs("no-reset") && stalls && latency == 0;
`ifdef GUARDBIT_VALID
        resets = 1'b0;
`endif
        restarting = 1'b0;
        if ($test$plusargs("dump")) dump = $fopen("dda.exp.dut.tv", "w");
    end

    // Compares the outputs with the oldest entry of the ring.
    task compare;
        begin
            {judged, counted, was_op, was_walk, was_row, was_line, exp_bits} = ring[tail];
            answer = exp_bits;
            tail = tail + 1;
            entries = entries - 1;
            if (counted) open = open - 1;
            judge;
        end
    endtask

    // Compares the outputs with what the last rising edge was told: the ring is for late ones.
    task compare_now;
        begin
            judged = pending || op == OP_HOLD && walk != 0;
            counted = pending;
            was_op = op;
            was_walk = walk;
            was_row = row;
            was_line = exp_file.line;
            answer = want;
            judge;
        end
    endtask

    task judge;
        begin
            if (counted) begin
                rows = rows + 1;
                quiet = 0;
                if (dump != 0) begin
                    $fdisplay(dump, "%h_%h_%h", was_op, acc, out_v);
                    $fflush(dump);
                end
            end
            if (judged && acc !== answer.acc) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH dda walk %0d row %0d (dda.exp.tv line %0d, op %0d) field acc\n    expected %h  %b.%b.%b\n    got      %h  %b.%b.%b",
                        was_walk - 1, was_row, was_line, was_op, answer.acc, answer.acc[6:6], answer.acc[5:3], answer.acc[2:0], acc, acc[6:6], acc[5:3], acc[2:0]);
            end
            if (judged && out_v !== answer.out_v) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH dda walk %0d row %0d (dda.exp.tv line %0d, op %0d) field out\n    expected %h  %b\n    got      %h  %b",
                        was_walk - 1, was_row, was_line, was_op, answer.out_v, answer.out_v, out_v, out_v);
            end
        end
    endtask

    task apply;
        begin
            noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
            // One row in 32 stalls, for one to eight clocks.
            if (stalls && noise[4:0] == 0) stall_left = noise[7:5] + 1;
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
            drive;
            if (want.op == OP_LOAD && resets && walk[5:0] == 3) begin
                rst = 1'b1;
                op = OP_STEP_X;
                pending = 1'b0;
                restarting = 1'b1;
            end
        end
    endtask

    task drive;
        begin
            op = want.op;
            init = cfg.init;
            dx = cfg.dx;
            dy = cfg.dy;
            pending = 1'b1;
        end
    endtask

    // What the last rising edge was told, to be compared later.
    task enter;
        begin
            exp_bits = want;
            ring[head] = {pending || op == OP_HOLD && walk != 0, pending, op, walk, row, exp_file.line, exp_bits};
            head = head + 1;
            entries = entries + 1;
            if (pending) open = open + 1;
        end
    endtask

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            rst = 1'b0;
            quiet = quiet + 1;
`ifdef GUARDBIT_VALID
            if (pending) enter;
            if (out_valid !== 1'b0) begin
                if (open > 0 && out_valid === 1'b1) compare;
                else begin
                    mismatches = mismatches + 1;
                    if (mismatches <= REPORTED)
                        $display("MISMATCH dda (dda.exp.tv line %0d): out_valid is %b, and %0d rows are awaited", exp_file.line, out_valid, open);
                end
            end
`else
            if (latency == 0) compare_now;
            else begin
                enter;
                if (entries > latency) compare;
            end
`endif
            if (restarting) begin
                restarting = 1'b0;
                if (acc !== 0) begin
                    mismatches = mismatches + 1;
                    if (mismatches <= REPORTED)
                        $display("MISMATCH dda walk %0d: field acc is %h after a reset, not zero", walk - 1, acc);
                end
                drive;
            end
            else begin
                proceed;
            end
        end

    task proceed;
        begin
            if (pending && stall_left > 0) begin
                pending = 1'b0;
                op = OP_HOLD;
                init = ~init;
                dx = ~dx;
                dy = ~dy;
            end
            if (!pending && stall_left > 0) stall_left = stall_left - 1;
            else if (exp_file.line < DDA_EXP_ROWS && open < MOST - 1)
                apply;
            else begin
                pending = 1'b0;
                op = OP_HOLD;
                if (exp_file.line >= DDA_EXP_ROWS && open == 0) begin
                    exp_file.last;
                    cfg_file.last;
                    done = 1'b1;
                end
                else if (quiet > 1000) begin
                    $display("FAIL dda: out_valid has been low for %0d clocks, and %0d rows are awaited", quiet, open);
                    $fatal(1, "the device hangs, or rows are missing");
                end
            end
        end
    endtask
endmodule

// Drives edge_stepper with edge.cfg.tv and compares every row of edge.exp.tv. Inputs change and
// outputs are compared at the falling edge; the device works at the rising edge. Now and then the
// bench stalls: it holds for some clocks, with other slopes at the inputs, and nothing may change.
// With +dump or +vcd it does not stall: rows and waves are then those of the files.
// With +latency=N the outputs of a clock edge are compared N clocks later. With the macro
// GUARDBIT_VALID the device has two ports more, in_valid and out_valid: it takes a row where in_valid
// is high, and its rows are compared in order where out_valid is high.
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
    edge_exp_t answer;                      // what the outputs are compared with
    longint unsigned walk;                  // number of the walk, from 1
    longint unsigned row;                   // row within the walk, from 0
    integer reset_left;
    reg pending;                            // a row has been applied at the last falling edge
    // What the device has been told and has yet to answer, in a ring.
    localparam integer MOST = 64;
    integer latency;                        // clocks until an answer, where there is no out_valid
    reg [5:0] head, tail;                   // where the next entry comes and goes
    integer entries;
    integer open;                           // rows among them
    integer quiet;                          // clocks since the last row, once all are in
    reg [195+EDGE_EXP_BITS:0] ring [0:MOST-1];
    reg judged;                             // whether the outputs are compared at all
    reg counted;                            // whether they are those of a row
    reg [1:0] was_op;
    longint unsigned was_walk, was_row, was_line;

    // One walk in 64 begins with a reset in the middle of a step, which leaves zero behind. Not with
    // +no-reset, +dump or +vcd, nor where answers take their time or have a valid.
    reg resets;
    reg restarting;

    reg rst;
    reg [1:0] op;
    reg [5:0] e0, ea, eb;
    reg [15:0] noise;
    integer stall_left;
    reg stalls;
    integer dump;
    wire [5:0] e;
    wire [0:0] in_v;
`ifdef GUARDBIT_VALID
    wire out_valid;
`endif
    edge_stepper 
`ifdef GUARDBIT_PARAMETERS
        #(.M(EDGE_EXP_E_WIDTH))
`endif
        device (
        .clk(clk), .rst(rst), .op(op),
`ifdef GUARDBIT_VALID
        .in_valid(pending), .out_valid(out_valid),
`endif
        .e0(e0), .ea(ea), .eb(eb),
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
        noise = 16'hace1;
        stall_left = 0;
        dump = 0;
        head = 0;
        tail = 0;
        entries = 0;
        open = 0;
        quiet = 0;
        if (!$value$plusargs("latency=%d", latency)) latency = 0;
        if (latency < 0 || latency >= MOST) begin
            $display("FAIL +latency=%0d: 0 to %0d is possible", latency, MOST - 1);
            $fatal(1, "bad latency");
        end
        stalls = !$test$plusargs("dump") && !$test$plusargs("vcd");
        resets = !$test$plusargs("no-reset") && stalls && latency == 0;
`ifdef GUARDBIT_VALID
        resets = 1'b0;
`endif
        restarting = 1'b0;
        if ($test$plusargs("dump")) dump = $fopen("edge.exp.dut.tv", "w");
    end

    // Compares the outputs with the oldest entry of the ring.
    task compare;
        begin
            {judged, counted, was_op, was_walk, was_row, was_line, exp_bits} = ring[tail];
            answer = exp_bits;
            tail = tail + 1;
            entries = entries - 1;
            if (counted) open = open - 1;
            judge;
        end
    endtask

    // Compares the outputs with what the last rising edge was told: the ring is for late ones.
    task compare_now;
        begin
            judged = pending || op == OP_HOLD && walk != 0;
            counted = pending;
            was_op = op;
            was_walk = walk;
            was_row = row;
            was_line = exp_file.line;
            answer = want;
            judge;
        end
    endtask

    task judge;
        begin
            if (counted) begin
                rows = rows + 1;
                quiet = 0;
                if (dump != 0) begin
                    $fdisplay(dump, "%h_%h_%h", was_op, e, in_v);
                    $fflush(dump);
                end
            end
            if (judged && e !== answer.e) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH edge walk %0d row %0d (edge.exp.tv line %0d, op %0d) field e\n    expected %h  %b\n    got      %h  %b",
                        was_walk - 1, was_row, was_line, was_op, answer.e, answer.e[5:0], e, e[5:0]);
            end
            if (judged && in_v !== answer.in_v) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH edge walk %0d row %0d (edge.exp.tv line %0d, op %0d) field in\n    expected %h  %b\n    got      %h  %b",
                        was_walk - 1, was_row, was_line, was_op, answer.in_v, answer.in_v, in_v, in_v);
            end
        end
    endtask

    task apply;
        begin
            noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
            // One row in 32 stalls, for one to eight clocks.
            if (stalls && noise[4:0] == 0) stall_left = noise[7:5] + 1;
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
            drive;
            if (want.op == OP_LOAD && resets && walk[5:0] == 3) begin
                rst = 1'b1;
                op = OP_STEP_X;
                pending = 1'b0;
                restarting = 1'b1;
            end
        end
    endtask

    task drive;
        begin
            op = want.op;
            e0 = cfg.e0;
            ea = cfg.ea;
            eb = cfg.eb;
            pending = 1'b1;
        end
    endtask

    // What the last rising edge was told, to be compared later.
    task enter;
        begin
            exp_bits = want;
            ring[head] = {pending || op == OP_HOLD && walk != 0, pending, op, walk, row, exp_file.line, exp_bits};
            head = head + 1;
            entries = entries + 1;
            if (pending) open = open + 1;
        end
    endtask

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            rst = 1'b0;
            quiet = quiet + 1;
`ifdef GUARDBIT_VALID
            if (pending) enter;
            if (out_valid !== 1'b0) begin
                if (open > 0 && out_valid === 1'b1) compare;
                else begin
                    mismatches = mismatches + 1;
                    if (mismatches <= REPORTED)
                        $display("MISMATCH edge (edge.exp.tv line %0d): out_valid is %b, and %0d rows are awaited", exp_file.line, out_valid, open);
                end
            end
`else
            if (latency == 0) compare_now;
            else begin
                enter;
                if (entries > latency) compare;
            end
`endif
            if (restarting) begin
                restarting = 1'b0;
                if (e !== 0) begin
                    mismatches = mismatches + 1;
                    if (mismatches <= REPORTED)
                        $display("MISMATCH edge walk %0d: field e is %h after a reset, not zero", walk - 1, e);
                end
                drive;
            end
            else begin
                proceed;
            end
        end

    task proceed;
        begin
            if (pending && stall_left > 0) begin
                pending = 1'b0;
                op = OP_HOLD;
                e0 = ~e0;
                ea = ~ea;
                eb = ~eb;
            end
            if (!pending && stall_left > 0) stall_left = stall_left - 1;
            else if (exp_file.line < EDGE_EXP_ROWS && open < MOST - 1)
                apply;
            else begin
                pending = 1'b0;
                op = OP_HOLD;
                if (exp_file.line >= EDGE_EXP_ROWS && open == 0) begin
                    exp_file.last;
                    cfg_file.last;
                    done = 1'b1;
                end
                else if (quiet > 1000) begin
                    $display("FAIL edge: out_valid has been low for %0d clocks, and %0d rows are awaited", quiet, open);
                    $fatal(1, "the device hangs, or rows are missing");
                end
            end
        end
    endtask
endmodule

// Drives triangle_setup with setup.cfg.tv and compares what its streams answer. The bench stalls them in
// patterns that change every 16 records: never, every other clock, at random, in long pauses. Inputs
// change at the falling edge; what is taken at a rising edge is compared as it stands before it.
module setup_check (
    input  wire       clk,
    output reg        done,
    output reg [63:0] rows,
    output reg [63:0] mismatches
);
    import guardbit_pkg::*;
    localparam logic [63:0] REPORTED = 20;
    localparam integer PATIENCE = 100000;   // clocks without a transfer
    localparam integer IDLE = 300;          // clocks after which a device that is ready has nothing under way
    localparam integer MOST_EXTRAS = 4 * SETUP_CFG_ROWS + 1000;

    line_reader #(
        .NAME("setup.cfg.tv"), .ROWS(SETUP_CFG_ROWS), .CHARS(SETUP_CFG_LINE),
        .FIXED(144'h005f005f005f005f005f005f005f005f000a),
        .DIGITS(144'h010001000100010001000100010001000100)
    ) cfg_file ();
    reg [SETUP_CFG_BITS-1:0] cfg_bits;
    setup_cfg_t cfg;
    reg rst;
    reg in_valid;
    wire in_ready;
    reg taken;
    integer reset_left;
    integer quiet;                          // clocks since the last transfer
    integer extras;                         // answers that belong to no row
    integer beat;
    reg [15:0] noise;
    // Before some records the device is given another, with other words, and a reset while it works on
    // that. Nothing of it may be seen. Not with +no-reset, +dump or +vcd.
    reg cuts;
    reg cut_next;
    reg cutting;                            // the other record is in: no answer is taken
    integer cut_left;                       // clocks until the reset

    // Signals carry the names of the columns, as in the waves of `guardbit trace`.
    wire [3:0] v0_x = cfg.v0_x;
    wire [3:0] v0_y = cfg.v0_y;
    wire [2:0] v0_z = cfg.v0_z;
    wire [3:0] v1_x = cfg.v1_x;
    wire [3:0] v1_y = cfg.v1_y;
    wire [2:0] v1_z = cfg.v1_z;
    wire [3:0] v2_x = cfg.v2_x;
    wire [3:0] v2_y = cfg.v2_y;
    wire [2:0] v2_z = cfg.v2_z;
    wire [5:0] edge0_init = o_edge0_init;
    wire [5:0] edge0_dx = o_edge0_dx;
    wire [5:0] edge0_dy = o_edge0_dy;
    wire [5:0] edge1_init = o_edge1_init;
    wire [5:0] edge1_dx = o_edge1_dx;
    wire [5:0] edge1_dy = o_edge1_dy;
    wire [5:0] edge2_init = o_edge2_init;
    wire [5:0] edge2_dx = o_edge2_dx;
    wire [5:0] edge2_dy = o_edge2_dy;
    wire [6:0] depth_init = o_depth_init;
    wire [6:0] depth_dx = o_depth_dx;
    wire [6:0] depth_dy = o_depth_dy;
    wire [0:0] zero_area = o_zero_area;

    // Which clocks stall, by the record that is in the device.
    reg stalls;
    always @*
        case (cfg_file.line[5:4])
            2'd0: stalls = 1'b0;
            2'd1: stalls = beat[0];
            2'd2: stalls = noise[0];
            default: stalls = beat[4];
        endcase

    line_reader #(
        .NAME("setup.exp.tv"), .ROWS(SETUP_EXP_ROWS), .CHARS(SETUP_EXP_LINE),
        .FIXED(304'h00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f000a),
        .DIGITS(304'h0101000101000101000101000101000101000101000101000101000101000101000101000100)
    ) o_file ();
    reg [SETUP_EXP_BITS-1:0] o_bits;
    setup_exp_t o_want;
    wire [5:0] o_edge0_init;
    wire [5:0] o_edge0_dx;
    wire [5:0] o_edge0_dy;
    wire [5:0] o_edge1_init;
    wire [5:0] o_edge1_dx;
    wire [5:0] o_edge1_dy;
    wire [5:0] o_edge2_init;
    wire [5:0] o_edge2_dx;
    wire [5:0] o_edge2_dy;
    wire [6:0] o_depth_init;
    wire [6:0] o_depth_dx;
    wire [6:0] o_depth_dy;
    wire [0:0] o_zero_area;
    wire o_valid;
    reg o_ready;
    // An answer that has not been taken stays as it is.
    reg o_held;
    wire [75:0] o_now = {o_edge0_init, o_edge0_dx, o_edge0_dy, o_edge1_init, o_edge1_dx, o_edge1_dy, o_edge2_init, o_edge2_dx, o_edge2_dy, o_depth_init, o_depth_dx, o_depth_dy, o_zero_area};
    reg [75:0] o_kept;
    integer o_dump;

    task o_read;
        begin
            o_file.next;
            o_bits = {
                    o_file.nibbles[299:296], o_file.nibbles[291:288], o_file.nibbles[275:272], o_file.nibbles[267:264],
                    o_file.nibbles[251:248], o_file.nibbles[243:240], o_file.nibbles[227:224], o_file.nibbles[219:216],
                    o_file.nibbles[203:200], o_file.nibbles[195:192], o_file.nibbles[179:176], o_file.nibbles[171:168],
                    o_file.nibbles[155:152], o_file.nibbles[147:144], o_file.nibbles[131:128], o_file.nibbles[123:120],
                    o_file.nibbles[107:104], o_file.nibbles[99:96], o_file.nibbles[83:80], o_file.nibbles[75:72],
                    o_file.nibbles[59:56], o_file.nibbles[51:48], o_file.nibbles[35:32], o_file.nibbles[27:24],
                    o_file.nibbles[11:8]};
            o_want = o_bits;
            if (|(o_bits & SETUP_EXP_PADS)) o_file.over_wide;
        end
    endtask

    task o_judge(input longint unsigned line);
        begin
            if (o_edge0_init !== o_want.edge0_init) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge0_init\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge0_init, o_want.edge0_init, o_edge0_init, o_edge0_init);
            end
            if (o_edge0_dx !== o_want.edge0_dx) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge0_dx\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge0_dx, o_want.edge0_dx, o_edge0_dx, o_edge0_dx);
            end
            if (o_edge0_dy !== o_want.edge0_dy) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge0_dy\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge0_dy, o_want.edge0_dy, o_edge0_dy, o_edge0_dy);
            end
            if (o_edge1_init !== o_want.edge1_init) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge1_init\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge1_init, o_want.edge1_init, o_edge1_init, o_edge1_init);
            end
            if (o_edge1_dx !== o_want.edge1_dx) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge1_dx\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge1_dx, o_want.edge1_dx, o_edge1_dx, o_edge1_dx);
            end
            if (o_edge1_dy !== o_want.edge1_dy) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge1_dy\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge1_dy, o_want.edge1_dy, o_edge1_dy, o_edge1_dy);
            end
            if (o_edge2_init !== o_want.edge2_init) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge2_init\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge2_init, o_want.edge2_init, o_edge2_init, o_edge2_init);
            end
            if (o_edge2_dx !== o_want.edge2_dx) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge2_dx\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge2_dx, o_want.edge2_dx, o_edge2_dx, o_edge2_dx);
            end
            if (o_edge2_dy !== o_want.edge2_dy) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field edge2_dy\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.edge2_dy, o_want.edge2_dy, o_edge2_dy, o_edge2_dy);
            end
            if (o_depth_init !== o_want.depth_init) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field depth_init\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.depth_init, o_want.depth_init, o_depth_init, o_depth_init);
            end
            if (o_depth_dx !== o_want.depth_dx) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field depth_dx\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.depth_dx, o_want.depth_dx, o_depth_dx, o_depth_dx);
            end
            if (o_depth_dy !== o_want.depth_dy) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field depth_dy\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.depth_dy, o_want.depth_dy, o_depth_dy, o_depth_dy);
            end
            if (o_zero_area !== o_want.zero_area) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH setup (setup.exp.tv line %0d) field zero_area\n    expected %h  %b\n    got      %h  %b",
                        line, o_want.zero_area, o_want.zero_area, o_zero_area, o_zero_area);
            end
        end
    endtask

    task o_compare;
        begin
            quiet = 0;
            rows = rows + 1;
            if (o_dump != 0) begin
                $fdisplay(o_dump, "%h_%h_%h_%h_%h_%h_%h_%h_%h_%h_%h_%h_%h", o_edge0_init, o_edge0_dx, o_edge0_dy, o_edge1_init, o_edge1_dx, o_edge1_dy, o_edge2_init, o_edge2_dx, o_edge2_dy, o_depth_init, o_depth_dx, o_depth_dy, o_zero_area);
                $fflush(o_dump);
            end
            if (o_file.line >= SETUP_EXP_ROWS) too_much("setup.exp");
            else begin
                o_read;
                o_judge(o_file.line);
            end
        end
    endtask

    triangle_setup 
`ifdef GUARDBIT_PARAMETERS
        #(.VW(SETUP_CFG_V0_X_WIDTH), .VS(SETUP_CFG_V0_X_SIGNED), .S(SUB_PIXEL_BITS), .SAMPLE_X(SAMPLE_X), .SAMPLE_Y(SAMPLE_Y), .RULE(SHADOW_RULE), .SHIFT(EDGE_SHIFT), .M(SETUP_EXP_EDGE0_INIT_WIDTH), .G(GUARD_BITS), .I(INTEGER_BITS), .F(FRACTION_BITS), .ROUNDING(ROUNDING), .HALF(START_HALF))
`endif
        device (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready),
        .v0_x(cfg.v0_x),
        .v0_y(cfg.v0_y),
        .v0_z(cfg.v0_z),
        .v1_x(cfg.v1_x),
        .v1_y(cfg.v1_y),
        .v1_z(cfg.v1_z),
        .v2_x(cfg.v2_x),
        .v2_y(cfg.v2_y),
        .v2_z(cfg.v2_z),
        .o_edge0_init(o_edge0_init),
        .o_edge0_dx(o_edge0_dx),
        .o_edge0_dy(o_edge0_dy),
        .o_edge1_init(o_edge1_init),
        .o_edge1_dx(o_edge1_dx),
        .o_edge1_dy(o_edge1_dy),
        .o_edge2_init(o_edge2_init),
        .o_edge2_dx(o_edge2_dx),
        .o_edge2_dy(o_edge2_dy),
        .o_depth_init(o_depth_init),
        .o_depth_dx(o_depth_dx),
        .o_depth_dy(o_depth_dy),
        .o_zero_area(o_zero_area),
        .out_valid(o_valid),
        .out_ready(o_ready)
    );

    initial begin
        done = 1'b0;
        rows = 0;
        mismatches = 0;
        rst = 1'b1;
        in_valid = 1'b0;
        taken = 1'b0;
        reset_left = 3;
        quiet = 0;
        extras = 0;
        beat = 0;
        noise = 16'hace1;
        cfg = 0;
        cfg_bits = 0;
        cuts = !$test$plusargs("no-reset") && !$test$plusargs("dump") && !$test$plusargs("vcd");
        cutting = 1'b0;
        cut_left = 0;
        o_ready = 1'b0;
        o_held = 1'b0;
        o_dump = 0;
        if ($test$plusargs("dump")) o_dump = $fopen("setup.exp.dut.tv", "w");
    end

    task too_much(input reg [8*16-1:0] stream);
        begin
            mismatches = mismatches + 1;
            if (mismatches <= REPORTED)
                $display("MISMATCH setup (%0s.tv): a row too much, all %0d records are in", stream, cfg_file.line);
            extra;
        end
    endtask

    // A device that never stops answering must not run for ever.
    task extra;
        begin
            extras = extras + 1;
            if (extras > MOST_EXTRAS) begin
                $display("FAIL setup: %0d rows too much, %0d of %0d records taken", extras, cfg_file.line - 64'(in_valid), SETUP_CFG_ROWS);
                $fatal(1, "the device answers without end");
            end
        end
    endtask

    task unstable(input reg [8*16-1:0] stream, input longint unsigned line);
        begin
            mismatches = mismatches + 1;
            if (mismatches <= REPORTED)
                $display("MISMATCH setup (%0s.tv line %0d): an answer changes or goes before it is taken", stream, line);
        end
    endtask

    // What a rising edge takes.
    always @(posedge clk)
        if (reset_left == 0 && !done) begin
            quiet = quiet + 1;
            if (in_valid && in_ready === 1'b1) begin
                taken = 1'b1;
                quiet = 0;
            end
            if (rst) begin
                o_held = 1'b0;
            end
            else begin
                if (o_held || o_valid !== 1'b0) begin
                    if (o_held && (!o_valid || o_now !== o_kept))
                        unstable("setup.exp", o_file.line + 1);
                    o_held = o_valid && !o_ready;
                    if (o_held) o_kept = o_now;
                    if (o_valid === 1'b1 && o_ready) o_compare;
                end
            end
        end

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            beat = beat + 1;
            if (rst) begin
                rst = 1'b0;
                in_valid = cutting;
                cfg = cfg_bits;
                cutting = 1'b0;
            end
            else if (cut_left > 0) begin
                cut_left = cut_left - 1;
                rst = cut_left == 0;
            end
            else if (taken && cutting) cut_left = 1 + noise[4:0];
        o_ready = !stalls && !cutting;
        noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
            if (taken) begin
                // What stands at the inputs without a valid is nothing.
                in_valid = 1'b0;
                if (cuts) cfg = ~cfg;
            end
            taken = 1'b0;
            cut_next = cuts && cfg_file.line[5:0] == 2 && quiet <= PATIENCE / 2;
            if (!in_valid && !stalls && !cutting && cfg_file.line < SETUP_CFG_ROWS
                    && (!cut_next || quiet > IDLE && in_ready === 1'b1)) begin
                cutting = cut_next;
                cfg_file.next;
                cfg_bits = {
                    cfg_file.nibbles[139:136], cfg_file.nibbles[123:120], cfg_file.nibbles[107:104], cfg_file.nibbles[91:88],
                    cfg_file.nibbles[75:72], cfg_file.nibbles[59:56], cfg_file.nibbles[43:40], cfg_file.nibbles[27:24],
                    cfg_file.nibbles[11:8]};
                cfg = cfg_bits;
                if (|(cfg_bits & SETUP_CFG_PADS)) cfg_file.over_wide;
                if (cutting) begin
                    cfg.v0_x = ~cfg.v0_x;
                    cfg.v0_y = ~cfg.v0_y;
                    cfg.v0_z = ~cfg.v0_z;
                    cfg.v1_x = ~cfg.v1_x;
                    cfg.v1_y = ~cfg.v1_y;
                    cfg.v1_z = ~cfg.v1_z;
                    cfg.v2_x = ~cfg.v2_x;
                    cfg.v2_y = ~cfg.v2_y;
                    cfg.v2_z = ~cfg.v2_z;
                end
                in_valid = 1'b1;
            end
            // Some clocks more show what comes too much.
            if (quiet > IDLE) begin
                if (cfg_file.line >= SETUP_CFG_ROWS && !in_valid && !cutting && o_file.line >= SETUP_EXP_ROWS && !(o_valid)) begin
                    cfg_file.last;
                o_file.last;
                    done = 1'b1;
                end
                else if (quiet > PATIENCE) begin
                    $display("FAIL setup: no transfer for %0d clocks, %0d of %0d records taken", quiet, cfg_file.line - 64'(in_valid), SETUP_CFG_ROWS);
                    $fatal(1, "the device hangs, or rows are missing");
                end
            end
        end
endmodule

// Drives triangle_engine with triangle.cfg.tv and compares what its streams answer. The bench stalls them in
// patterns that change every 16 records: never, every other clock, at random, in long pauses. Inputs
// change at the falling edge; what is taken at a rising edge is compared as it stands before it.
// +anyorder takes the rows of a test in any order, each matched by its key; +fileorder takes them in
// the order of the files.
module triangle_check (
    input  wire       clk,
    output reg        done,
    output reg [63:0] rows,
    output reg [63:0] mismatches
);
    import guardbit_pkg::*;
    localparam logic [63:0] REPORTED = 20;
    localparam integer PATIENCE = 100000;   // clocks without a transfer
    localparam integer IDLE = 300;          // clocks after which a device that is ready has nothing under way
    localparam integer MOST_EXTRAS = 4 * TRIANGLE_CFG_ROWS + 1000;

    line_reader #(
        .NAME("triangle.cfg.tv"), .ROWS(TRIANGLE_CFG_ROWS), .CHARS(TRIANGLE_CFG_LINE),
        .FIXED(568'h00000000000000005f00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f00005f005f00000000005f00000000005f00000000005f00000000000a),
        .DIGITS(568'h0101010101010101000101000101000101000101000101000101000101000101000101000101000101000101000100010101010100010101010100010101010100010101010100)
    ) cfg_file ();
    reg [TRIANGLE_CFG_BITS-1:0] cfg_bits;
    triangle_cfg_t cfg;
    reg rst;
    reg in_valid;
    wire in_ready;
    reg taken;
    integer reset_left;
    integer quiet;                          // clocks since the last transfer
    integer extras;                         // answers that belong to no row
    integer beat;
    reg [15:0] noise;
    // Before some records the device is given another, with other words, and a reset while it works on
    // that. Nothing of it may be seen. Not with +no-reset, +dump or +vcd.
    reg cuts;
    reg cut_next;
    reg cutting;                            // the other record is in: no answer is taken
    integer cut_left;                       // clocks until the reset
    reg any_order;                          // rows of a test are matched by their key

    // Signals carry the names of the columns, as in the waves of `guardbit trace`.
    wire [5:0] edge0_init = cfg.edge0_init;
    wire [5:0] edge0_dx = cfg.edge0_dx;
    wire [5:0] edge0_dy = cfg.edge0_dy;
    wire [5:0] edge1_init = cfg.edge1_init;
    wire [5:0] edge1_dx = cfg.edge1_dx;
    wire [5:0] edge1_dy = cfg.edge1_dy;
    wire [5:0] edge2_init = cfg.edge2_init;
    wire [5:0] edge2_dx = cfg.edge2_dx;
    wire [5:0] edge2_dy = cfg.edge2_dy;
    wire [6:0] depth_init = cfg.depth_init;
    wire [6:0] depth_dx = cfg.depth_dx;
    wire [6:0] depth_dy = cfg.depth_dy;
    wire [16:0] box_y_begin = cfg.box_y_begin;
    wire [16:0] box_y_end = cfg.box_y_end;
    wire [16:0] box_x_begin = cfg.box_x_begin;
    wire [16:0] box_x_end = cfg.box_x_end;
    wire [16:0] x_begin = span_x_begin;
    wire [16:0] x_end = span_x_end;
    wire [16:0] y = sample_y;
    wire [16:0] x = sample_x;
    wire [2:0] depth = sample_depth;
    wire [31:0] test = triangle_test;
    wire [31:0] spans = triangle_spans;
    wire [31:0] samples = triangle_samples;
    wire [0:0] zero_area = triangle_zero_area;

    // Which clocks stall, by the record that is in the device.
    reg stalls;
    always @*
        case (cfg_file.line[5:4])
            2'd0: stalls = 1'b0;
            2'd1: stalls = beat[0];
            2'd2: stalls = noise[0];
            default: stalls = beat[4];
        endcase

    line_reader #(
        .NAME("span.exp.tv"), .ROWS(SPAN_EXP_ROWS), .CHARS(SPAN_EXP_LINE),
        .FIXED(216'h00000000000000005f00000000005f00000000005f00000000000a),
        .DIGITS(216'h010101010101010100010101010100010101010100010101010100)
    ) span_file ();
    reg [SPAN_EXP_BITS-1:0] span_bits;
    span_exp_t span_want;
    wire [31:0] span_test;
    wire [16:0] span_y;
    wire [16:0] span_x_begin;
    wire [16:0] span_x_end;
    wire span_valid;
    reg span_ready;
    // An answer that has not been taken stays as it is.
    reg span_held;
    wire [82:0] span_now = {span_test, span_y, span_x_begin, span_x_end};
    reg [82:0] span_kept;
    integer span_dump;

    task span_read;
        begin
            span_file.next;
            span_bits = {
                    span_file.nibbles[211:208], span_file.nibbles[203:200], span_file.nibbles[195:192], span_file.nibbles[187:184],
                    span_file.nibbles[179:176], span_file.nibbles[171:168], span_file.nibbles[163:160], span_file.nibbles[155:152],
                    span_file.nibbles[139:136], span_file.nibbles[131:128], span_file.nibbles[123:120], span_file.nibbles[115:112],
                    span_file.nibbles[107:104], span_file.nibbles[91:88], span_file.nibbles[83:80], span_file.nibbles[75:72],
                    span_file.nibbles[67:64], span_file.nibbles[59:56], span_file.nibbles[43:40], span_file.nibbles[35:32],
                    span_file.nibbles[27:24], span_file.nibbles[19:16], span_file.nibbles[11:8]};
            span_want = span_bits;
            if (|(span_bits & SPAN_EXP_PADS)) span_file.over_wide;
        end
    endtask

    task span_judge(input longint unsigned line);
        begin
            if (span_test !== span_want.test) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (span.exp.tv line %0d) field test\n    expected %h  %b\n    got      %h  %b",
                        line, span_want.test, span_want.test, span_test, span_test);
            end
            if (span_y !== span_want.y) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (span.exp.tv line %0d) field y\n    expected %h  %b\n    got      %h  %b",
                        line, span_want.y, span_want.y, span_y, span_y);
            end
            if (span_x_begin !== span_want.x_begin) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (span.exp.tv line %0d) field x_begin\n    expected %h  %b\n    got      %h  %b",
                        line, span_want.x_begin, span_want.x_begin, span_x_begin, span_x_begin);
            end
            if (span_x_end !== span_want.x_end) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (span.exp.tv line %0d) field x_end\n    expected %h  %b\n    got      %h  %b",
                        line, span_want.x_end, span_want.x_end, span_x_end, span_x_end);
            end
        end
    endtask

    // Rows of tests that have begun and that no answer has matched yet, each with its line.
    reg [63+SPAN_EXP_BITS:0] span_open [$];
    reg span_ahead;                      // span_want is of a later test, and not among them
    reg span_more;
    reg [SPAN_EXP_BITS-1:0] span_picked;
    longint unsigned span_line;
    integer span_at;

    // The row of this answer's key, wherever it stands among those of its test.
    task span_find;
        begin
            span_more = 1'b1;
            while (span_more === 1'b1) begin
                if (!span_ahead && span_file.line < SPAN_EXP_ROWS) begin
                    span_read;
                    span_ahead = 1'b1;
                end
                span_want = span_bits;
                span_more = span_ahead && span_want.test <= span_test && span_test <= cfg.test;
                if (span_more === 1'b1) begin
                    span_open.push_back({span_file.line, span_bits});
                    span_ahead = 1'b0;
                end
            end
            span_more = 1'b1;
            span_at = 0;
            while (span_more && span_at < span_open.size()) begin
                {span_line, span_picked} = span_open[span_at];
                span_want = span_picked;
                if (span_test === span_want.test && span_y === span_want.y && span_x_begin === span_want.x_begin && span_x_end === span_want.x_end) span_more = 1'b0;
                else span_at = span_at + 1;
            end
            if (span_more) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (span.exp.tv): no row is left with test %0d, y %0d, x_begin %0d, x_end %0d", span_test, span_y, span_x_begin, span_x_end);
                extra;
            end
            else begin
                span_judge(span_line);
                span_open.delete(span_at);
            end
        end
    endtask

    task span_compare;
        begin
            quiet = 0;
            rows = rows + 1;
            if (span_dump != 0) begin
                $fdisplay(span_dump, "%h_%h_%h_%h", span_test, span_y, span_x_begin, span_x_end);
                $fflush(span_dump);
            end
            if (any_order) span_find;
            else if (span_file.line >= SPAN_EXP_ROWS) too_much("span.exp");
            else begin
                span_read;
                span_judge(span_file.line);
            end
        end
    endtask

    line_reader #(
        .NAME("depth.exp.tv"), .ROWS(DEPTH_EXP_ROWS), .CHARS(DEPTH_EXP_LINE),
        .FIXED(184'h00000000000000005f00000000005f00000000005f000a),
        .DIGITS(184'h0101010101010101000101010101000101010101000100)
    ) sample_file ();
    reg [DEPTH_EXP_BITS-1:0] sample_bits;
    depth_exp_t sample_want;
    wire [31:0] sample_test;
    wire [16:0] sample_y;
    wire [16:0] sample_x;
    wire [2:0] sample_depth;
    wire sample_valid;
    reg sample_ready;
    // An answer that has not been taken stays as it is.
    reg sample_held;
    wire [68:0] sample_now = {sample_test, sample_y, sample_x, sample_depth};
    reg [68:0] sample_kept;
    integer sample_dump;

    task sample_read;
        begin
            sample_file.next;
            sample_bits = {
                    sample_file.nibbles[179:176], sample_file.nibbles[171:168], sample_file.nibbles[163:160], sample_file.nibbles[155:152],
                    sample_file.nibbles[147:144], sample_file.nibbles[139:136], sample_file.nibbles[131:128], sample_file.nibbles[123:120],
                    sample_file.nibbles[107:104], sample_file.nibbles[99:96], sample_file.nibbles[91:88], sample_file.nibbles[83:80],
                    sample_file.nibbles[75:72], sample_file.nibbles[59:56], sample_file.nibbles[51:48], sample_file.nibbles[43:40],
                    sample_file.nibbles[35:32], sample_file.nibbles[27:24], sample_file.nibbles[11:8]};
            sample_want = sample_bits;
            if (|(sample_bits & DEPTH_EXP_PADS)) sample_file.over_wide;
        end
    endtask

    task sample_judge(input longint unsigned line);
        begin
            if (sample_test !== sample_want.test) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (depth.exp.tv line %0d) field test\n    expected %h  %b\n    got      %h  %b",
                        line, sample_want.test, sample_want.test, sample_test, sample_test);
            end
            if (sample_y !== sample_want.y) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (depth.exp.tv line %0d) field y\n    expected %h  %b\n    got      %h  %b",
                        line, sample_want.y, sample_want.y, sample_y, sample_y);
            end
            if (sample_x !== sample_want.x) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (depth.exp.tv line %0d) field x\n    expected %h  %b\n    got      %h  %b",
                        line, sample_want.x, sample_want.x, sample_x, sample_x);
            end
            if (sample_depth !== sample_want.depth) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (depth.exp.tv line %0d) field depth\n    expected %h  %b\n    got      %h  %b",
                        line, sample_want.depth, sample_want.depth, sample_depth, sample_depth);
            end
        end
    endtask

    // Rows of tests that have begun and that no answer has matched yet, each with its line.
    reg [63+DEPTH_EXP_BITS:0] sample_open [$];
    reg sample_ahead;                      // sample_want is of a later test, and not among them
    reg sample_more;
    reg [DEPTH_EXP_BITS-1:0] sample_picked;
    longint unsigned sample_line;
    integer sample_at;

    // The row of this answer's key, wherever it stands among those of its test.
    task sample_find;
        begin
            sample_more = 1'b1;
            while (sample_more === 1'b1) begin
                if (!sample_ahead && sample_file.line < DEPTH_EXP_ROWS) begin
                    sample_read;
                    sample_ahead = 1'b1;
                end
                sample_want = sample_bits;
                sample_more = sample_ahead && sample_want.test <= sample_test && sample_test <= cfg.test;
                if (sample_more === 1'b1) begin
                    sample_open.push_back({sample_file.line, sample_bits});
                    sample_ahead = 1'b0;
                end
            end
            sample_more = 1'b1;
            sample_at = 0;
            while (sample_more && sample_at < sample_open.size()) begin
                {sample_line, sample_picked} = sample_open[sample_at];
                sample_want = sample_picked;
                if (sample_test === sample_want.test && sample_y === sample_want.y && sample_x === sample_want.x) sample_more = 1'b0;
                else sample_at = sample_at + 1;
            end
            if (sample_more) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (depth.exp.tv): no row is left with test %0d, y %0d, x %0d", sample_test, sample_y, sample_x);
                extra;
            end
            else begin
                sample_judge(sample_line);
                sample_open.delete(sample_at);
            end
        end
    endtask

    task sample_compare;
        begin
            quiet = 0;
            rows = rows + 1;
            if (sample_dump != 0) begin
                $fdisplay(sample_dump, "%h_%h_%h_%h", sample_test, sample_y, sample_x, sample_depth);
                $fflush(sample_dump);
            end
            if (any_order) sample_find;
            else if (sample_file.line >= DEPTH_EXP_ROWS) too_much("depth.exp");
            else begin
                sample_read;
                sample_judge(sample_file.line);
            end
        end
    endtask

    line_reader #(
        .NAME("triangle.exp.tv"), .ROWS(TRIANGLE_EXP_ROWS), .CHARS(TRIANGLE_EXP_LINE),
        .FIXED(520'h00000000000000005f00000000000000005f00000000000000005f00000000000000005f00000000000000005f00000000000000005f00000000000000005f000a),
        .DIGITS(520'h0101010101010101000101010101010101000101010101010101000101010101010101000101010101010101000101010101010101000101010101010101000100)
    ) triangle_file ();
    reg [TRIANGLE_EXP_BITS-1:0] triangle_bits;
    triangle_exp_t triangle_want;
    wire [31:0] triangle_test;
    wire [31:0] triangle_spans;
    wire [31:0] triangle_samples;
    wire [0:0] triangle_zero_area;
    wire triangle_valid;
    reg triangle_ready;
    // An answer that has not been taken stays as it is.
    reg triangle_held;
    wire [96:0] triangle_now = {triangle_test, triangle_spans, triangle_samples, triangle_zero_area};
    reg [96:0] triangle_kept;
    integer triangle_dump;

    task triangle_read;
        begin
            triangle_file.next;
            triangle_bits = {
                    triangle_file.nibbles[515:512], triangle_file.nibbles[507:504], triangle_file.nibbles[499:496], triangle_file.nibbles[491:488],
                    triangle_file.nibbles[483:480], triangle_file.nibbles[475:472], triangle_file.nibbles[467:464], triangle_file.nibbles[459:456],
                    triangle_file.nibbles[443:440], triangle_file.nibbles[435:432], triangle_file.nibbles[427:424], triangle_file.nibbles[419:416],
                    triangle_file.nibbles[411:408], triangle_file.nibbles[403:400], triangle_file.nibbles[395:392], triangle_file.nibbles[387:384],
                    triangle_file.nibbles[371:368], triangle_file.nibbles[363:360], triangle_file.nibbles[355:352], triangle_file.nibbles[347:344],
                    triangle_file.nibbles[339:336], triangle_file.nibbles[331:328], triangle_file.nibbles[323:320], triangle_file.nibbles[315:312],
                    triangle_file.nibbles[299:296], triangle_file.nibbles[291:288], triangle_file.nibbles[283:280], triangle_file.nibbles[275:272],
                    triangle_file.nibbles[267:264], triangle_file.nibbles[259:256], triangle_file.nibbles[251:248], triangle_file.nibbles[243:240],
                    triangle_file.nibbles[227:224], triangle_file.nibbles[219:216], triangle_file.nibbles[211:208], triangle_file.nibbles[203:200],
                    triangle_file.nibbles[195:192], triangle_file.nibbles[187:184], triangle_file.nibbles[179:176], triangle_file.nibbles[171:168],
                    triangle_file.nibbles[155:152], triangle_file.nibbles[147:144], triangle_file.nibbles[139:136], triangle_file.nibbles[131:128],
                    triangle_file.nibbles[123:120], triangle_file.nibbles[115:112], triangle_file.nibbles[107:104], triangle_file.nibbles[99:96],
                    triangle_file.nibbles[83:80], triangle_file.nibbles[75:72], triangle_file.nibbles[67:64], triangle_file.nibbles[59:56],
                    triangle_file.nibbles[51:48], triangle_file.nibbles[43:40], triangle_file.nibbles[35:32], triangle_file.nibbles[27:24],
                    triangle_file.nibbles[11:8]};
            triangle_want = triangle_bits;
            if (|(triangle_bits & TRIANGLE_EXP_PADS)) triangle_file.over_wide;
        end
    endtask

    task triangle_judge(input longint unsigned line);
        begin
            if (triangle_test !== triangle_want.test) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (triangle.exp.tv line %0d) field test\n    expected %h  %b\n    got      %h  %b",
                        line, triangle_want.test, triangle_want.test, triangle_test, triangle_test);
            end
            if (triangle_spans !== triangle_want.spans) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (triangle.exp.tv line %0d) field spans\n    expected %h  %b\n    got      %h  %b",
                        line, triangle_want.spans, triangle_want.spans, triangle_spans, triangle_spans);
            end
            if (triangle_samples !== triangle_want.samples) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (triangle.exp.tv line %0d) field samples\n    expected %h  %b\n    got      %h  %b",
                        line, triangle_want.samples, triangle_want.samples, triangle_samples, triangle_samples);
            end
            if (triangle_zero_area !== triangle_want.zero_area) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (triangle.exp.tv line %0d) field zero_area\n    expected %h  %b\n    got      %h  %b",
                        line, triangle_want.zero_area, triangle_want.zero_area, triangle_zero_area, triangle_zero_area);
            end
        end
    endtask

    // Rows of tests that have begun and that no answer has matched yet, each with its line.
    reg [63+TRIANGLE_EXP_BITS:0] triangle_open [$];
    reg triangle_ahead;                      // triangle_want is of a later test, and not among them
    reg triangle_more;
    reg [TRIANGLE_EXP_BITS-1:0] triangle_picked;
    longint unsigned triangle_line;
    integer triangle_at;

    // The row of this answer's key, wherever it stands among those of its test.
    task triangle_find;
        begin
            triangle_more = 1'b1;
            while (triangle_more === 1'b1) begin
                if (!triangle_ahead && triangle_file.line < TRIANGLE_EXP_ROWS) begin
                    triangle_read;
                    triangle_ahead = 1'b1;
                end
                triangle_want = triangle_bits;
                triangle_more = triangle_ahead && triangle_want.test <= triangle_test && triangle_test <= cfg.test;
                if (triangle_more === 1'b1) begin
                    triangle_open.push_back({triangle_file.line, triangle_bits});
                    triangle_ahead = 1'b0;
                end
            end
            triangle_more = 1'b1;
            triangle_at = 0;
            while (triangle_more && triangle_at < triangle_open.size()) begin
                {triangle_line, triangle_picked} = triangle_open[triangle_at];
                triangle_want = triangle_picked;
                if (triangle_test === triangle_want.test) triangle_more = 1'b0;
                else triangle_at = triangle_at + 1;
            end
            if (triangle_more) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display("MISMATCH triangle (triangle.exp.tv): no row is left with test %0d", triangle_test);
                extra;
            end
            else begin
                triangle_judge(triangle_line);
                triangle_open.delete(triangle_at);
            end
        end
    endtask

    task triangle_compare;
        begin
            quiet = 0;
            rows = rows + 1;
            if (triangle_dump != 0) begin
                $fdisplay(triangle_dump, "%h_%h_%h_%h_%h_%h_%h_%h_000000000000000000000000ffffffffffffffffffffffffffffffff0", triangle_test, triangle_spans, triangle_samples, 32'h0, 32'h0, 32'h0, 32'h0, triangle_zero_area);
                $fflush(triangle_dump);
            end
            if (any_order) triangle_find;
            else if (triangle_file.line >= TRIANGLE_EXP_ROWS) too_much("triangle.exp");
            else begin
                triangle_read;
                triangle_judge(triangle_file.line);
            end
        end
    endtask

    triangle_engine 
`ifdef GUARDBIT_PARAMETERS
        #(.M(TRIANGLE_CFG_EDGE0_INIT_WIDTH), .G(GUARD_BITS), .I(INTEGER_BITS), .F(FRACTION_BITS), .MODE(CLAMP_MODE), .C(TRIANGLE_CFG_BOX_X_BEGIN_WIDTH))
`endif
        device (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready),
        .test(cfg.test),
        .edge0_init(cfg.edge0_init),
        .edge0_dx(cfg.edge0_dx),
        .edge0_dy(cfg.edge0_dy),
        .edge1_init(cfg.edge1_init),
        .edge1_dx(cfg.edge1_dx),
        .edge1_dy(cfg.edge1_dy),
        .edge2_init(cfg.edge2_init),
        .edge2_dx(cfg.edge2_dx),
        .edge2_dy(cfg.edge2_dy),
        .depth_init(cfg.depth_init),
        .depth_dx(cfg.depth_dx),
        .depth_dy(cfg.depth_dy),
        .zero_area(cfg.zero_area),
        .box_y_begin(cfg.box_y_begin),
        .box_y_end(cfg.box_y_end),
        .box_x_begin(cfg.box_x_begin),
        .box_x_end(cfg.box_x_end),
        .span_test(span_test),
        .span_y(span_y),
        .span_x_begin(span_x_begin),
        .span_x_end(span_x_end),
        .span_valid(span_valid),
        .span_ready(span_ready),
        .sample_test(sample_test),
        .sample_y(sample_y),
        .sample_x(sample_x),
        .sample_depth(sample_depth),
        .sample_valid(sample_valid),
        .sample_ready(sample_ready),
        .triangle_test(triangle_test),
        .triangle_spans(triangle_spans),
        .triangle_samples(triangle_samples),
        .triangle_zero_area(triangle_zero_area),
        .triangle_valid(triangle_valid),
        .triangle_ready(triangle_ready)
    );

    initial begin
        done = 1'b0;
        rows = 0;
        mismatches = 0;
        rst = 1'b1;
        in_valid = 1'b0;
        taken = 1'b0;
        reset_left = 3;
        quiet = 0;
        extras = 0;
        beat = 0;
        noise = 16'hace1;
        cfg = 0;
        cfg_bits = 0;
        cuts = !$test$plusargs("no-reset") && !$test$plusargs("dump") && !$test$plusargs("vcd");
        cutting = 1'b0;
        cut_left = 0;
        any_order = 1'b0;
        if ($test$plusargs("anyorder")) any_order = 1'b1;
        if ($test$plusargs("fileorder")) any_order = 1'b0;
        span_ahead = 1'b0;
        span_ready = 1'b0;
        span_held = 1'b0;
        span_dump = 0;
        if ($test$plusargs("dump")) span_dump = $fopen("span.exp.dut.tv", "w");
        sample_ahead = 1'b0;
        sample_ready = 1'b0;
        sample_held = 1'b0;
        sample_dump = 0;
        if ($test$plusargs("dump")) sample_dump = $fopen("depth.exp.dut.tv", "w");
        triangle_ahead = 1'b0;
        triangle_ready = 1'b0;
        triangle_held = 1'b0;
        triangle_dump = 0;
        if ($test$plusargs("dump")) triangle_dump = $fopen("triangle.exp.dut.tv", "w");
    end

    task too_much(input reg [8*16-1:0] stream);
        begin
            mismatches = mismatches + 1;
            if (mismatches <= REPORTED)
                $display("MISMATCH triangle (%0s.tv): a row too much, all %0d records are in", stream, cfg_file.line);
            extra;
        end
    endtask

    // A device that never stops answering must not run for ever.
    task extra;
        begin
            extras = extras + 1;
            if (extras > MOST_EXTRAS) begin
                $display("FAIL triangle: %0d rows too much, %0d of %0d records taken", extras, cfg_file.line - 64'(in_valid), TRIANGLE_CFG_ROWS);
                $fatal(1, "the device answers without end");
            end
        end
    endtask

    task unstable(input reg [8*16-1:0] stream, input longint unsigned line);
        begin
            mismatches = mismatches + 1;
            if (mismatches <= REPORTED)
                $display("MISMATCH triangle (%0s.tv line %0d): an answer changes or goes before it is taken", stream, line);
        end
    endtask

    // What a rising edge takes.
    always @(posedge clk)
        if (reset_left == 0 && !done) begin
            quiet = quiet + 1;
            if (in_valid && in_ready === 1'b1) begin
                taken = 1'b1;
                quiet = 0;
            end
            if (rst) begin
                span_held = 1'b0;
                sample_held = 1'b0;
                triangle_held = 1'b0;
            end
            else begin
                if (span_held || span_valid !== 1'b0) begin
                    if (span_held && (!span_valid || span_now !== span_kept))
                        unstable("span.exp", span_file.line + 1);
                    span_held = span_valid && !span_ready;
                    if (span_held) span_kept = span_now;
                    if (span_valid === 1'b1 && span_ready) span_compare;
                end
                if (sample_held || sample_valid !== 1'b0) begin
                    if (sample_held && (!sample_valid || sample_now !== sample_kept))
                        unstable("depth.exp", sample_file.line + 1);
                    sample_held = sample_valid && !sample_ready;
                    if (sample_held) sample_kept = sample_now;
                    if (sample_valid === 1'b1 && sample_ready) sample_compare;
                end
                if (triangle_held || triangle_valid !== 1'b0) begin
                    if (triangle_held && (!triangle_valid || triangle_now !== triangle_kept))
                        unstable("triangle.exp", triangle_file.line + 1);
                    triangle_held = triangle_valid && !triangle_ready;
                    if (triangle_held) triangle_kept = triangle_now;
                    if (triangle_valid === 1'b1 && triangle_ready) triangle_compare;
                end
            end
        end

    always @(negedge clk)
        if (reset_left > 0)
            reset_left = reset_left - 1;
        else if (!done) begin
            beat = beat + 1;
            if (rst) begin
                rst = 1'b0;
                in_valid = cutting;
                cfg = cfg_bits;
                cutting = 1'b0;
            end
            else if (cut_left > 0) begin
                cut_left = cut_left - 1;
                rst = cut_left == 0;
            end
            else if (taken && cutting) cut_left = 1 + noise[4:0];
        span_ready = !stalls && !cutting;
        noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
        sample_ready = !stalls && !cutting;
        noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
        triangle_ready = !stalls && !cutting;
        noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
            if (taken) begin
                // What stands at the inputs without a valid is nothing.
                in_valid = 1'b0;
                if (cuts) cfg = ~cfg;
            end
            taken = 1'b0;
            cut_next = cuts && cfg_file.line[5:0] == 2 && quiet <= PATIENCE / 2;
            if (!in_valid && !stalls && !cutting && cfg_file.line < TRIANGLE_CFG_ROWS
                    && (!cut_next || quiet > IDLE && in_ready === 1'b1)) begin
                cutting = cut_next;
                cfg_file.next;
                cfg_bits = {
                    cfg_file.nibbles[563:560], cfg_file.nibbles[555:552], cfg_file.nibbles[547:544], cfg_file.nibbles[539:536],
                    cfg_file.nibbles[531:528], cfg_file.nibbles[523:520], cfg_file.nibbles[515:512], cfg_file.nibbles[507:504],
                    cfg_file.nibbles[491:488], cfg_file.nibbles[483:480], cfg_file.nibbles[467:464], cfg_file.nibbles[459:456],
                    cfg_file.nibbles[443:440], cfg_file.nibbles[435:432], cfg_file.nibbles[419:416], cfg_file.nibbles[411:408],
                    cfg_file.nibbles[395:392], cfg_file.nibbles[387:384], cfg_file.nibbles[371:368], cfg_file.nibbles[363:360],
                    cfg_file.nibbles[347:344], cfg_file.nibbles[339:336], cfg_file.nibbles[323:320], cfg_file.nibbles[315:312],
                    cfg_file.nibbles[299:296], cfg_file.nibbles[291:288], cfg_file.nibbles[275:272], cfg_file.nibbles[267:264],
                    cfg_file.nibbles[251:248], cfg_file.nibbles[243:240], cfg_file.nibbles[227:224], cfg_file.nibbles[219:216],
                    cfg_file.nibbles[203:200], cfg_file.nibbles[187:184], cfg_file.nibbles[179:176], cfg_file.nibbles[171:168],
                    cfg_file.nibbles[163:160], cfg_file.nibbles[155:152], cfg_file.nibbles[139:136], cfg_file.nibbles[131:128],
                    cfg_file.nibbles[123:120], cfg_file.nibbles[115:112], cfg_file.nibbles[107:104], cfg_file.nibbles[91:88],
                    cfg_file.nibbles[83:80], cfg_file.nibbles[75:72], cfg_file.nibbles[67:64], cfg_file.nibbles[59:56],
                    cfg_file.nibbles[43:40], cfg_file.nibbles[35:32], cfg_file.nibbles[27:24], cfg_file.nibbles[19:16],
                    cfg_file.nibbles[11:8]};
                cfg = cfg_bits;
                if (|(cfg_bits & TRIANGLE_CFG_PADS)) cfg_file.over_wide;
                if (cutting) begin
                    cfg.test = ~cfg.test;
                    cfg.depth_init = ~cfg.depth_init;
                    cfg.depth_dx = ~cfg.depth_dx;
                    cfg.depth_dy = ~cfg.depth_dy;
                end
                in_valid = 1'b1;
            end
            // Some clocks more show what comes too much.
            if (quiet > IDLE) begin
                if (cfg_file.line >= TRIANGLE_CFG_ROWS && !in_valid && !cutting && span_file.line >= SPAN_EXP_ROWS && !span_ahead && span_open.size() == 0 && sample_file.line >= DEPTH_EXP_ROWS && !sample_ahead && sample_open.size() == 0 && triangle_file.line >= TRIANGLE_EXP_ROWS && !triangle_ahead && triangle_open.size() == 0 && !(span_valid || sample_valid || triangle_valid)) begin
                    cfg_file.last;
                span_file.last;
                sample_file.last;
                triangle_file.last;
                    if (mismatches != 0 && !any_order)
                        $display("HINT triangle: rows are compared in the order of the files; for an engine with an order of its own, +anyorder");
                    done = 1'b1;
                end
                else if (quiet > PATIENCE) begin
                if (span_open.size() > 0) begin
                    {span_line, span_picked} = span_open[0];
                    $display("MISMATCH triangle (span.exp.tv line %0d): this row and %0d others of the tests so far are missing", span_line, span_open.size() - 1);
                end
                if (sample_open.size() > 0) begin
                    {sample_line, sample_picked} = sample_open[0];
                    $display("MISMATCH triangle (depth.exp.tv line %0d): this row and %0d others of the tests so far are missing", sample_line, sample_open.size() - 1);
                end
                if (triangle_open.size() > 0) begin
                    {triangle_line, triangle_picked} = triangle_open[0];
                    $display("MISMATCH triangle (triangle.exp.tv line %0d): this row and %0d others of the tests so far are missing", triangle_line, triangle_open.size() - 1);
                end
                    if (mismatches != 0 && !any_order)
                        $display("HINT triangle: rows are compared in the order of the files; for an engine with an order of its own, +anyorder");
                    $display("FAIL triangle: no transfer for %0d clocks, %0d of %0d records taken", quiet, cfg_file.line - 64'(in_valid), TRIANGLE_CFG_ROWS);
                    $fatal(1, "the device hangs, or rows are missing");
                end
            end
        end
endmodule

module tb;
    reg clk = 1'b0;
    always #1 clk = ~clk;

    wire dda_done;
    wire [63:0] dda_rows, dda_mismatches;
    dda_check dda (.clk(clk && !dda_done), .done(dda_done), .rows(dda_rows), .mismatches(dda_mismatches));

    wire edge_done;
    wire [63:0] edge_rows, edge_mismatches;
    edge_check edge_v (.clk(clk && !edge_done), .done(edge_done), .rows(edge_rows), .mismatches(edge_mismatches));

    wire setup_done;
    wire [63:0] setup_rows, setup_mismatches;
    setup_check setup (.clk(clk && !setup_done), .done(setup_done), .rows(setup_rows), .mismatches(setup_mismatches));

    wire triangle_done;
    wire [63:0] triangle_rows, triangle_mismatches;
    triangle_check triangle (.clk(clk && !triangle_done), .done(triangle_done), .rows(triangle_rows), .mismatches(triangle_mismatches));

    // Signals carry the names of the columns, as in the waves of `guardbit trace`.
    reg [8*256-1:0] wave;
    initial
        if ($value$plusargs("vcd=%s", wave)) begin
            $dumpfile(wave);
            $dumpvars(1, dda, edge_v, setup, triangle);
        end

    always @(posedge clk)
        if (dda_done && edge_done && setup_done && triangle_done) begin
            if ($test$plusargs("dump"))
                $display("NOTE +dump: walks do not stall, and nothing is reset in the middle; run the bench without it, too");
            if (dda_mismatches != 0 || edge_mismatches != 0 || setup_mismatches != 0 || triangle_mismatches != 0) begin
                $display("FAIL dda rows=%0d edge rows=%0d setup rows=%0d triangle rows=%0d mismatches=%0d", dda_rows, edge_rows, setup_rows, triangle_rows, dda_mismatches + edge_mismatches + setup_mismatches + triangle_mismatches);
                $fatal(1, "device and vectors disagree");
            end
            else begin
                $display("PASS dda rows=%0d edge rows=%0d setup rows=%0d triangle rows=%0d", dda_rows, edge_rows, setup_rows, triangle_rows);
                $finish;
            end
        end
endmodule
