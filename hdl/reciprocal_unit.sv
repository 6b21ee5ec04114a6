// A reciprocal unit: q is normalised, a table is read, and what it says is refined. 1/q is mantissa
// 2^-exponent. A record is answered a clock after it was taken. Spec: CH-9 to CH-12.
module reciprocal_unit #(
    parameter int W = 28,                // bits of q
    parameter int P = 20,                // bits of the normalised operand, its leading one included
    parameter int K = 7,                 // bits of the table's index, at most P - 1
    parameter int M = 10,                // bits of an entry
    parameter int REFINE = 2,            // 0 nothing, 1 straight lines, 2 a Newton step, 3 two of them
    parameter int N1 = 18,               // bits of the result of the first step
    parameter int N2 = 18,               // and of the second
    parameter int OWN = 0,               // 1: the entries are those of ENTRIES
    parameter logic [((1<<K)+1)*M-1:0] ENTRIES = '0
) (
    input  logic                   clk,
    input  logic                   rst,
    input  logic                   in_valid,
    output logic                   in_ready,
    input  logic [W-1:0]           q,
    output logic                   out_valid,
    input  logic                   out_ready,
    output logic [$clog2(W+1)-1:0] o_length,    // bit length of q
    output logic [P-1:0]           o_x,         // the normalised operand
    output logic [M-1:0]           o_entry,
    output logic [M-1:0]           o_far,       // the entry at the far end of its interval
    output logic [(P>K+1?P-1-K:1)-1:0] o_part,  // the bits of x below the index
    output logic [M-1:0]           o_fall,      // of the line up to x
    output logic [N1:0]            o_r1,
    output logic [N1+1:0]          o_t1,
    output logic [N1-1:0]          o_y1,
    output logic [N2:0]            o_r2,
    output logic [N2+1:0]          o_t2,
    output logic [N2-1:0]          o_y2,
    output logic [(REFINE==3?N2:REFINE==2?N1:M)-1:0] o_mantissa,
    output logic [$clog2((REFINE==3?N2:REFINE==2?N1:M)+W)-1:0] o_exponent
);
    localparam int LINES = 1, ONE_STEP = 2, TWO_STEPS = 3;
    localparam int N = REFINE == TWO_STEPS ? N2 : REFINE == ONE_STEP ? N1 : M;
    localparam int L = $clog2(W + 1);
    localparam int E = $clog2(N + W);
    localparam int H = P - 1 - K;
    localparam int HW = H > 0 ? H : 1;
    localparam int LINEAR = REFINE == LINES ? 1 : 0;

    // Normalise: the highest one of q goes to the top, and the top P bits are kept.
    wire [L-1:0] length;
    bit_length #(.W(W)) measure (.word(q), .length(length));
    /* verilator lint_off UNUSED */
    wire [W+P-1:0] moved = {q, {P{1'b0}}} << (L'(W) - length);
    /* verilator lint_on UNUSED */
    wire [P-1:0] x = moved[W+P-1:W];

    // The table, and the line to its next entry.
    wire [K:0] index = {1'b0, x[P-2:H]};
    wire [HW-1:0] part = H > 0 ? x[HW-1:0] : {HW{1'b0}};
    wire [M-1:0] entry, next;
    reciprocal_table #(.K(K), .M(M), .LINEAR(LINEAR), .OWN(OWN), .ENTRIES(ENTRIES)) here (
        .index(index), .entry(entry)
    );
    reciprocal_table #(.K(K), .M(M), .LINEAR(LINEAR), .OWN(OWN), .ENTRIES(ENTRIES)) beyond (
        .index(index + 1'b1), .entry(next)
    );
    /* verilator lint_off UNUSED */
    wire [M-1:0] drop = entry - next;
    wire [M+HW-1:0] product = {{HW{1'b0}}, drop} * {{M{1'b0}}, part};
    wire [M+HW-1:0] shifted = product >> H;
    /* verilator lint_on UNUSED */
    wire [M-1:0] fall = shifted[M-1:0];
    wire [M-1:0] line = entry - fall;

    // Newton steps.
    wire [N1:0] r1;
    wire [N1+1:0] t1;
    wire [N1-1:0] y1;
    newton_step #(.P(P), .M(M), .B(N1)) first (.x(x), .y(entry), .r(r1), .t(t1), .next(y1));
    wire [N2:0] r2;
    wire [N2+1:0] t2;
    wire [N2-1:0] y2;
    newton_step #(.P(P), .M(N1), .B(N2)) second (.x(x), .y(y1), .r(r2), .t(t2), .next(y2));

    wire [N-1:0] mantissa = REFINE == TWO_STEPS ? N'(y2) : REFINE == ONE_STEP ? N'(y1)
        : REFINE == LINES ? N'(line) : N'(entry);
    wire [E-1:0] exponent = E'(N - 1) + E'(length);

    assign in_ready = !out_valid || out_ready;
    always_ff @(posedge clk)
        if (rst) out_valid <= 1'b0;
        else if (in_ready) out_valid <= in_valid;
    always_ff @(posedge clk)
        if (in_valid && in_ready) begin
            o_length <= length;
            o_x <= x;
            o_entry <= entry;
            o_far <= next;
            o_part <= part;
            o_fall <= fall;
            o_r1 <= r1;
            o_t1 <= t1;
            o_y1 <= y1;
            o_r2 <= r2;
            o_t2 <= t2;
            o_y2 <= y2;
            o_mantissa <= mantissa;
            o_exponent <= exponent;
        end
endmodule
