// Units of a textured channel beside the live model: 1/w and u/w walked, and their quotient.
module live_channels;
    import guardbit_dpi::*;
    // A channel of 8 bits with 8 below them and 1 guard bit, over 1/w of the same words.
    localparam int G = 1, B = 8, F = 8, I = B + F, N = G + I;
    localparam int INVERSE_W = 2, CHANNEL = 1, CHANNEL_WALK = 16 + CHANNEL;

    bit clk = 1'b0;
    bit rst = 1'b1;
    bit [1:0] op = 2'd3;
    bit [N-1:0] init [2], dx [2], dy [2];
    wire [N-1:0] acc [2];
    wire [I-1:0] out_v [2];
    for (genvar n = 0; n < 2; n++) begin : walks
        interpolator #(.G(G), .I(I), .F(0)) device (
            .clk(clk), .rst(rst), .op(op), .init(init[n]), .dx(dx[n]), .dy(dy[n]), .acc(acc[n]), .out_v(out_v[n])
        );
    end
    bit in_valid = 1'b0;
    wire in_ready, out_valid;
    wire [B-1:0] code;
    perspective_divider #(.G(G), .I(B), .F(F), .GW(G), .B(B), .FW(F), .METHOD(0)) divider (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .acc(acc[0]), .acc_w(acc[1]),
        .out_valid(out_valid), .out_ready(1'b1), .o_p(), .o_q(), .o_mantissa(), .o_exponent(), .o_value(), .o_code(code)
    );

    int model, kind;
    int walk [2];
    int clocks = 20000;
    bit [127:0] want_acc, want_out, want_code;

    task automatic clock();
        #1 clk = 1'b1;
        #1 clk = 1'b0;
    endtask

    initial begin
        void'($value$plusargs("clocks=%d", clocks));
        model = guardbit_good(guardbit_open("channels.toml"), "open");
        for (int n = 0; n < 2; n++) begin
            kind = n == 0 ? CHANNEL_WALK : INVERSE_W;
            walk[n] = guardbit_good(guardbit_walk(model, kind), "walk");
        end
        repeat (2) clock();
        rst = 1'b0;
        for (int c = 0; c < clocks; c++) begin
            op = c == 0 ? 2'd0 : 2'($urandom());
            for (int n = 0; n < 2; n++) begin
                init[n] = N'($urandom());
                dx[n] = N'($urandom());
                dy[n] = N'($urandom());
            end
            clock();
            for (int n = 0; n < 2; n++) begin
                void'(guardbit_good(guardbit_clock(
                    walk[n], 32'(op), 128'(init[n]), 128'(dx[n]), 128'(dy[n]), want_acc, want_out), "clock"));
                if (128'(acc[n]) != want_acc || 128'(out_v[n]) != want_out) begin
                    $display("MISMATCH clock %0d walk %0d: expected %h %h, got %h %h", c, n, want_acc, want_out, acc[n], out_v[n]);
                    $fatal(1, "device and model disagree");
                end
            end
            if (c % 8 == 0) begin
                void'(guardbit_good(guardbit_divide(model, CHANNEL, 128'(acc[0]), 128'(acc[1]), want_code), "divide"));
                op = 2'd3;
                in_valid = 1'b1;
                while (!in_ready) clock();
                clock();
                in_valid = 1'b0;
                while (!out_valid) clock();
                if (128'(code) != want_code) begin
                    $display("MISMATCH clock %0d: %h over %h: expected %h, got %h", c, acc[0], acc[1], want_code, code);
                    $fatal(1, "device and model disagree");
                end
            end
        end
        if (guardbit_divide(model, 0, 0, 0, want_code) >= 0) $fatal(1, "an affine channel is divided");
        $display("PASS clocks=%0d", clocks);
        $finish;
    end
endmodule
