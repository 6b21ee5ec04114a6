// The value of a channel's component at a sample, from the accumulators of u/w and 1/w: a quotient, or a
// product with the reciprocal. A record at a time. Spec: CH-5.
module perspective_divider #(
    parameter int G = 1,                 // guard bits of u/w
    parameter int I = 12,                // bits of a code
    parameter int F = 16,                // interpolation bits of u/w
    parameter int MODE = 1,              // read-out of u/w: 0 wrap, 1 guard, 2 sign
    parameter int SIGNED = 0,            // 1: codes are two's complement
    parameter int GW = 1,                // guard bits of 1/w
    parameter int B = 16,                // bits of a vertex's code of 1/w
    parameter int FW = 12,               // interpolation bits of 1/w
    parameter int MODE_W = 1,            // read-out of 1/w
    parameter int METHOD = 1,            // 0 quotient, 1 reciprocal and product
    parameter int ROUNDING = 4,          // of the quotient or the product, as setup_divider has it
    parameter int SERIAL = 0,            // 1: a quotient bit a clock
    parameter int P = 20,                // the reciprocal unit, as reciprocal_unit has it
    parameter int K = 7,
    parameter int M = 10,
    parameter int REFINE = 2,
    parameter int N1 = 18,
    parameter int N2 = 18,
    parameter int OWN = 0,
    parameter logic [((1<<K)+1)*M-1:0] ENTRIES = '0
) (
    input  logic               clk,
    input  logic               rst,
    input  logic               in_valid,
    output logic               in_ready,
    input  logic [G+I+F-1:0]   acc,            // of u/w
    input  logic [GW+B+FW-1:0] acc_w,          // of 1/w
    output logic               out_valid,
    input  logic               out_ready,
    output logic [I+F-1:0]     o_p,            // read out, with the fraction
    output logic [B+FW-1:0]    o_q,
    output logic [(REFINE==3?N2:REFINE==2?N1:M)-1:0] o_mantissa,
    output logic [$clog2((REFINE==3?N2:REFINE==2?N1:M)+B+FW)-1:0] o_exponent,
    output logic [I+B+FW+1:0]  o_value,        // rounded, before the clamp; signed
    output logic [I-1:0]       o_code
);
    localparam int N = REFINE == 3 ? N2 : REFINE == 2 ? N1 : M;
    localparam int W = B + FW;           // bits of Q, and the places that P is moved up by
    localparam int E = $clog2(N + W);
    localparam int V = I + W + 2;
    localparam int NW = I + F + 1 + W;   // bits of the numerator
    localparam int PW = NW + N;          // and of the product
    localparam int S = $clog2(F + N + W + 1);
    localparam logic [V-1:0] ONE = {{(V-1){1'b0}}, 1'b1};
    localparam logic [V-1:0] LOW = SIGNED != 0 ? -(ONE << (I - 1)) : '0;
    localparam logic [V-1:0] HIGH = SIGNED != 0 ? (ONE << (I - 1)) - ONE : (ONE << I) - ONE;

    wire [I+F-1:0] p;
    wire [W-1:0] q;
    held_value #(.G(G), .I(I + F), .MODE(MODE), .SIGNED(SIGNED)) over (.acc(acc), .held(p));
    held_value #(.G(GW), .I(W), .MODE(MODE_W), .SIGNED(0)) inverse (.acc(acc_w), .held(q));

    logic working, started;
    assign in_ready = !working && !out_valid;
    wire negative = SIGNED != 0 && o_p[I+F-1];
    wire [NW-1:0] numerator = {{(W+1){negative}}, o_p} << W;

    // The quotient.
    wire busy;
    /* verilator lint_off UNUSED */
    wire [NW-1:0] quotient;              // a quotient by Q of at least one fits V bits, as a product does
    setup_divider #(.NW(NW), .DW(W + F), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide (
        .clk(clk), .rst(rst), .start(working && !started && METHOD == 0),
        .numerator(numerator), .divisor((W+F)'(o_q) << F), .busy(busy), .quotient(quotient)
    );

    // The reciprocal, and the product.
    wire unit_ready, unit_valid;
    wire [PW-1:0] rounded;
    /* verilator lint_on UNUSED */
    wire [N-1:0] mantissa;
    wire [E-1:0] exponent;
    /* verilator lint_off PINCONNECTEMPTY */
    reciprocal_unit #(
        .W(W), .P(P), .K(K), .M(M), .REFINE(REFINE), .N1(N1), .N2(N2), .OWN(OWN), .ENTRIES(ENTRIES)
    ) reciprocal (
        .clk(clk), .rst(rst), .in_valid(working && !started && METHOD != 0), .in_ready(unit_ready),
        .q(o_q), .out_valid(unit_valid), .out_ready(working && started), .o_length(), .o_x(), .o_entry(),
        .o_far(), .o_part(), .o_fall(), .o_r1(), .o_t1(), .o_y1(), .o_r2(), .o_t2(), .o_y2(),
        .o_mantissa(mantissa), .o_exponent(exponent)
    );
    /* verilator lint_on PINCONNECTEMPTY */
    wire [PW-1:0] product = {{N{numerator[NW-1]}}, numerator} * {{NW{1'b0}}, mantissa};
    wire [S-1:0] places = S'(F) + S'(exponent);
    rounded_shift #(.W(PW), .S(S), .ROUNDING(ROUNDING)) round (
        .word(product), .places(places), .result(rounded)
    );

    wire none = o_q == 0;
    wire ready = METHOD != 0 ? unit_valid : !busy;
    wire signed [V-1:0] value = none ? {V{1'b0}} : METHOD != 0 ? V'($signed(rounded)) : V'($signed(quotient));
    wire above = none ? !negative : value > $signed(HIGH);
    wire below = none ? negative : value < $signed(LOW);
    always_ff @(posedge clk)
        if (rst) begin
            working <= 1'b0;
            started <= 1'b0;
            out_valid <= 1'b0;
        end
        else if (in_valid && in_ready) begin
            working <= 1'b1;
            started <= 1'b0;
        end
        else if (working && !started) started <= 1'b1;
        else if (working && ready) begin
            working <= 1'b0;
            out_valid <= 1'b1;
        end
        else if (out_ready) out_valid <= 1'b0;
    always_ff @(posedge clk)
        if (in_valid && in_ready) begin
            o_p <= p;
            o_q <= q;
        end
    always_ff @(posedge clk)
        if (working && started && ready) begin
            o_mantissa <= none ? {N{1'b0}} : mantissa;
            o_exponent <= none ? {E{1'b0}} : exponent;
            o_value <= value;
            o_code <= above ? HIGH[I-1:0] : below ? LOW[I-1:0] : value[I-1:0];
        end
endmodule
