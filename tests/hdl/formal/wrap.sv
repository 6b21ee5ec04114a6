// Lemma: a narrow word is the low bits of a wide one that takes the same steps, whatever they are.
module wrap #(
    parameter int M = 35,
    parameter int W = 48
) (
    input logic         clk,
    input logic         rst,
    input logic [1:0]   op,
    input logic [W-1:0] e0,
    input logic [W-1:0] ea,
    input logic [W-1:0] eb
);
    wire [M-1:0] narrow;
    wire [W-1:0] wide;
    wire narrow_in, wide_in;
    edge_stepper #(.M(M)) device (
        .clk(clk), .rst(rst), .op(op), .e0(e0[M-1:0]), .ea(ea[M-1:0]), .eb(eb[M-1:0]), .e(narrow), .in_v(narrow_in)
    );
    edge_stepper #(.M(W)) truth (.clk(clk), .rst(rst), .op(op), .e0(e0), .ea(ea), .eb(eb), .e(wide), .in_v(wide_in));

    initial assume (rst);
    reg started = 1'b0;
    always @(posedge clk) started <= 1'b1;
    always @(*)
        if (started) assert (narrow == wide[M-1:0]);
endmodule
