// A restoring divider with two bits of the quotient a clock: the remainder against three multiples of the divisor.
module radix_4 #(
    parameter int NW = 117,
    parameter int DW = 52
) (
    input  logic          clock,
    input  logic          reset_n,
    input  logic          start,
    input  logic [NW-1:0] a,
    input  logic [DW-1:0] b,
    output logic          busy,
    output logic [NW-1:0] result
);
    localparam int W = NW + NW % 2;
    logic [W-1:0] q;
    logic [DW+1:0] r;
    logic [DW-1:0] d;
    logic [7:0] left;
    logic minus;
    wire [DW+3:0] four = {r, q[W-1:W-2]};
    wire [DW+3:0] once = {4'd0, d}, twice = {3'd0, d, 1'b0}, thrice = once + twice;
    wire fits = four >= once, twice_fits = four >= twice, thrice_fits = four >= thrice;
    wire [1:0] digit = {twice_fits, thrice_fits || (fits && !twice_fits)};
    wire [DW+3:0] rest = four - (thrice_fits ? thrice : twice_fits ? twice : fits ? once : {(DW+4){1'b0}});
    wire [NW-1:0] size = a[NW-1] ? -a : a;
    assign busy = left != 0;

    always_ff @(posedge clock)
        if (!reset_n) begin
            left <= 8'd0;
            q <= '0;
            r <= '0;
            d <= '0;
            minus <= 1'b0;
        end
        else if (busy) begin
            left <= left - 8'd1;
            q <= {q[W-3:0], digit};
            r <= rest[DW+1:0];
        end
        else if (start) begin
            left <= 8'(W / 2);
            q <= W'(size);
            r <= '0;
            d <= b;
            minus <= a[NW-1];
        end

    wire over = {r, 1'b0} > {3'd0, d}, tie = {r, 1'b0} == {3'd0, d};
    wire up = over || (tie && q[0]);
    wire [NW-1:0] rounded = q[NW-1:0] + NW'(up);
    assign result = minus ? -rounded : rounded;
endmodule
