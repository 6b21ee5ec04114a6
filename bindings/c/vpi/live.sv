// A device beside the live model in Icarus, clock by clock, with stimulus that no file holds.
module live;
    localparam int G = 2, I = 24, F = 13, N = G + I + F;

    reg clk = 1'b0;
    reg rst = 1'b1;
    reg [1:0] op = 2'd3;
    reg [N-1:0] init, dx, dy;
    wire [N-1:0] acc;
    wire [I-1:0] out_v;
    dda #(.G(G), .I(I), .F(F)) device (
        .clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(acc), .out_v(out_v)
    );

    // A system function's value has no sign of its own.
    integer model, walk, clocks, n, result, textured;
    reg [16:0] over, inverse;
    reg [7:0] code;
    reg [N-1:0] want_acc;
    reg [I-1:0] want_out;

    initial begin
        if (!$value$plusargs("clocks=%d", clocks)) clocks = 20000;
        model = $guardbit_open("sgi-4k");
        walk = $guardbit_walk(model, 0);
        if (model < 0 || walk < 0) $fatal(1, "no model");
        repeat (2) begin
            #1 clk = 1'b1;
            #1 clk = 1'b0;
        end
        rst = 1'b0;
        for (n = 0; n < clocks; n = n + 1) begin
            op = n == 0 ? 2'd0 : $urandom;
            init = {$urandom, $urandom};
            dx = {$urandom, $urandom};
            dy = {$urandom, $urandom};
            result = $guardbit_clock(walk, op, init, dx, dy, want_acc, want_out);
            if (result < 0) $fatal(1, "no clock");
            #1 clk = 1'b1;
            #1 clk = 1'b0;
            if (acc !== want_acc || out_v !== want_out) begin
                $display("MISMATCH clock %0d op %0d: expected %h %h, got %h %h", n, op, want_acc, want_out, acc, out_v);
                $fatal(1, "device and model disagree");
            end
        end
        // The quotient of u/w and 1/w with 8 bits below the binary point each: 124 of 41, 200 of 1/2.
        textured = $guardbit_open("channels.toml");
        over = 5084;
        inverse = 10496;
        result = $guardbit_divide(textured, 1, over, inverse, code);
        if (result < 0 || code !== 124) $fatal(1, "5084 over 10496 is %0d", code);
        over = 100;
        inverse = 128;
        result = $guardbit_divide(textured, 1, over, inverse, code);
        if (result < 0 || code !== 200) $fatal(1, "100 over 128 is %0d", code);
        result = $guardbit_divide(textured, 0, over, inverse, code);
        if (result >= 0) $fatal(1, "an affine channel is divided");
        init = {N{1'bx}};
        result = $guardbit_clock(walk, 2'd0, init, dx, dy, want_acc, want_out);
        if (result >= 0) $fatal(1, "X is no error");
        result = $guardbit_open("no such profile");
        if (result >= 0) $fatal(1, "a profile that is not there is no error");
        $display("PASS clocks=%0d", clocks);
        $finish;
    end
endmodule
