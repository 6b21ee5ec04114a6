// A device beside the live model, clock by clock, with stimulus that no file holds.
module live;
    import guardbit_dpi::*;
    localparam int G = 2, I = 24, F = 13, N = G + I + F;

    bit clk = 1'b0;
    bit rst = 1'b1;
    bit [1:0] op = 2'd3;
    bit [N-1:0] init, dx, dy;
    wire [N-1:0] acc;
    wire [I-1:0] out_v;
    dda #(.G(G), .I(I), .F(F)) device (
        .clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(acc), .out_v(out_v)
    );

    int model, walk, wide;
    int clocks = 100000;
    int calls = 0;
    longint unsigned want_acc, want_out;
    bit [127:0] wide_acc, wide_out;

    function automatic bit [N-1:0] random();
        return N'({$urandom(), $urandom()});
    endfunction

    initial begin
        void'($value$plusargs("clocks=%d", clocks));
        void'($value$plusargs("calls=%d", calls));
        model = guardbit_good(guardbit_open("sgi-4k"), "open");
        walk = guardbit_good(guardbit_walk(model, 0), "walk");
        wide = guardbit_good(guardbit_walk(model, 0), "walk");
        repeat (2) begin
            #1 clk = 1'b1;
            #1 clk = 1'b0;
        end
        rst = 1'b0;
        for (int n = 0; n < clocks; n++) begin
            op = n == 0 ? 2'd0 : 2'($urandom());
            init = random();
            dx = random();
            dy = random();
            void'(guardbit_good(guardbit_clock64(walk, 32'(op), 64'(init), 64'(dx), 64'(dy), want_acc, want_out), "clock64"));
            void'(guardbit_good(guardbit_clock(wide, 32'(op), 128'(init), 128'(dx), 128'(dy), wide_acc, wide_out), "clock"));
            #1 clk = 1'b1;
            #1 clk = 1'b0;
            if (acc != want_acc[N-1:0] || out_v != want_out[I-1:0] || wide_acc != 128'(acc) || wide_out != 128'(out_v)) begin
                $display("MISMATCH clock %0d op %0d: expected %h %h, got %h %h", n, op, want_acc, want_out, acc, out_v);
                $fatal(1, "device and model disagree");
            end
        end
        // Calls alone, to be timed.
        for (int n = 0; n < calls; n++)
            void'(guardbit_clock64(walk, 1, 0, 12345, 0, want_acc, want_out));
        if (guardbit_clock64(12345, 0, 0, 0, 0, want_acc, want_out) >= 0) $fatal(1, "a handle never given is no error");
        $display("PASS clocks=%0d calls=%0d", clocks, calls);
        $finish;
    end
endmodule
