// Lemma: M bits tell inside from outside. The device takes the exact word of an edge at a sample, cut
// to M bits; by the lemma of wrap.sv a walk to that sample ends with the same word. With CORNERS, each
// coordinate is free to be one end of its range: E is linear in each of them, so its extremes lie
// there. Without, all are free: small fields only.
module edge_width #(
    parameter int M = 35,                // 2 k + s + 1
    parameter int K = 12,                // the window has 2^K pixels
    parameter int S = 10,                // sub-pixel bits
    parameter int CORNERS = 1
) (
    input logic clk,
    input logic rst
);
    localparam int V = K + S + 2;        // a coordinate, signed
    localparam int W = 2 * V + 4;        // exact
    localparam logic [V-1:0] HIGH = {{(V-1){1'b0}}, 1'b1} << (K + S);
    localparam logic [V-1:0] HALF = {{(V-1){1'b0}}, 1'b1} << (S - 1);
    (* anyconst *) reg [V-1:0] any_fx;
    (* anyconst *) reg [V-1:0] any_fy;
    (* anyconst *) reg [V-1:0] any_tx;
    (* anyconst *) reg [V-1:0] any_ty;
    (* anyconst *) reg [K-1:0] any_x;
    (* anyconst *) reg [K-1:0] any_y;

    function [W-1:0] vertex(input [V-1:0] any);
        vertex = CORNERS ? (any[0] ? {{(W-V){1'b0}}, HIGH} : {W{1'b0}}) : {{(W-V){1'b0}}, any};
    endfunction
    function [W-1:0] sample(input [K-1:0] any);
        sample = ({{(W-K){1'b0}}, CORNERS ? {K{any[0]}} : any} << S) + {{(W-V){1'b0}}, HALF};
    endfunction
    wire signed [W-1:0] fx = vertex(any_fx);
    wire signed [W-1:0] fy = vertex(any_fy);
    wire signed [W-1:0] dx = vertex(any_tx) - fx;
    wire signed [W-1:0] dy = vertex(any_ty) - fy;
    wire signed [W-1:0] e = dx * (sample(any_y) - fy) - dy * (sample(any_x) - fx);
    // A top or left edge owns its samples; any other is biased.
    wire owns = dy < 0 || (dy == 0 && dx > 0);
    wire signed [W-1:0] word = (e - (owns ? 0 : 1)) >>> S;

    wire [M-1:0] stored;
    wire in_v;
    edge_stepper #(.M(M)) device (
        .clk(clk), .rst(rst), .op(2'd0), .e0(word[M-1:0]), .ea({M{1'b0}}), .eb({M{1'b0}}), .e(stored), .in_v(in_v)
    );

    initial assume (rst);
    reg started = 1'b0;
    reg loaded = 1'b0;
    always @(posedge clk) begin
        started <= 1'b1;
        loaded <= !rst;
    end
    always @(*) begin
        assume (CORNERS || (any_fx <= HIGH && any_fy <= HIGH && any_tx <= HIGH && any_ty <= HIGH));
        if (started && loaded) assert (in_v == (e > 0 || (e == 0 && owns)));
    end
endmodule
