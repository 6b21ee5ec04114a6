// Lemma: as long as the value stays in the guard range, the read-out is the value held between zero
// and the maximum, however the accumulator wraps.
module guard #(
    parameter int G = 2,
    parameter int I = 24,
    parameter int F = 13,
    parameter int MODE = 1
) (
    input logic                  clk,
    input logic                  rst,
    input logic [1:0]            op,
    input logic signed [G+I+F+3:0] init,
    input logic signed [G+I+F+3:0] dx,
    input logic signed [G+I+F+3:0] dy
);
    localparam int N = G + I + F;
    localparam int W = N + 4;
    localparam logic signed [W-1:0] ONE = 1;
    // One past the highest value, and the lowest, that the guard bits tell apart.
    localparam logic signed [W-1:0] TOP = (ONE << (N - 1)) + (ONE << (I + F - 1));
    localparam logic signed [W-1:0] BOTTOM = TOP - (ONE << N);

    wire [N-1:0] acc;
    wire [I-1:0] out_v;
    dda #(.G(G), .I(I), .F(F), .MODE(MODE)) device (
        .clk(clk), .rst(rst), .op(op), .init(init[N-1:0]), .dx(dx[N-1:0]), .dy(dy[N-1:0]), .acc(acc), .out_v(out_v)
    );

    // The value itself, which is never far outside.
    reg signed [W-1:0] value;
    always @(posedge clk)
        if (rst) value <= 0;
        else
            case (op)
                2'd0: value <= init;
                2'd1: value <= value + dx;
                2'd2: value <= value + dy;
                default: ;
            endcase

    wire signed [W-1:0] whole = value >>> F;
    wire [I-1:0] held = value < 0 ? {I{1'b0}} : value >= (ONE << (I + F)) ? {I{1'b1}} : whole[I-1:0];

    initial assume (rst);
    reg started = 1'b0;
    always @(posedge clk) started <= 1'b1;
    always @(*)
        if (started) begin
            assume (value >= BOTTOM && value < TOP);
            assert (acc == value[N-1:0]);
            assert (out_v == held);
        end
endmodule
