// Set-up divider: a signed numerator over a positive divisor, rounded once; one quotient bit a clock,
// or for quick simulation all of them. Spec: planes P and rounding R.
module setup_divider #(
    parameter int NW = 100,              // bits of the numerator and of the quotient, signed
    parameter int DW = 50,               // bits of the divisor, unsigned, at least 1
    parameter int ROUNDING = 4,          // one of the codes below
    parameter int SERIAL = 1             // 1 a quotient bit a clock, 0 a whole quotient
) (
    input  logic          clk,
    input  logic          rst,
    input  logic          start,         // takes the operands; ignored while busy
    input  logic [NW-1:0] numerator,
    input  logic [DW-1:0] divisor,
    output logic          busy,
    output logic [NW-1:0] quotient       // valid when not busy
);
    localparam int FLOOR = 0, CEILING = 1, TOWARD_ZERO = 2, AWAY_FROM_ZERO = 3;
    // To the nearest; a tie goes where the name says.
    localparam int NEAREST_EVEN = 4, NEAREST_UP = 5, NEAREST_DOWN = 6;
    localparam int NEAREST_AWAY = 7, NEAREST_TOWARD_ZERO = 8;
    localparam int ODD = 9;              // to the odd neighbour if inexact
    localparam int W = NW > DW ? NW : DW;
    // Magnitudes are divided: |n| = q d + r. The sign says what rounding does to q.
    logic [NW-1:0] q;                    // numerator shifting out, quotient shifting in
    logic [DW:0] r;
    logic [DW-1:0] d;
    logic negative;
    logic [$clog2(NW+1)-1:0] left;

    wire [DW:0] shifted = {r[DW-1:0], q[NW-1]};
    wire fits = shifted >= {1'b0, d};

    function automatic logic [NW-1:0] magnitude(input logic [NW-1:0] signed_word);
        magnitude = signed_word[NW-1] ? -signed_word : signed_word;
    endfunction

    always_ff @(posedge clk)
        if (rst) begin
            left <= '0;
            q <= '0;
            r <= '0;
            d <= '0;
            negative <= 1'b0;
        end
        else if (left != 0) begin
            q <= {q[NW-2:0], fits};
            r <= fits ? shifted - {1'b0, d} : shifted;
            left <= left - 1'b1;
        end
        else if (start) begin
            negative <= numerator[NW-1];
            d <= divisor;
            if (SERIAL == 0) begin
                // As the steps leave them, a divisor of zero apart: nobody reads that quotient.
                q <= divisor == 0 ? '1 : NW'(W'(magnitude(numerator)) / W'(divisor));
                r <= divisor == 0 ? '0 : (DW+1)'(W'(magnitude(numerator)) % W'(divisor));
            end
            else begin
                q <= magnitude(numerator);
                r <= '0;
                left <= ($clog2(NW+1))'(NW);
            end
        end

    assign busy = left != 0;

    // Rounded when it stands: nothing behind the registers moves while they work.
    wire [NW-1:0] whole = busy ? '0 : q;
    wire [DW:0] rest = busy ? '0 : r;
    wire inexact = rest != 0;
    wire [DW+1:0] twice = {rest, 1'b0};
    wire over = twice > {2'b00, d};
    wire tie = twice == {2'b00, d};
    wire is_odd = whole[0];
    logic up;                            // one more of magnitude
    always_comb
        case (ROUNDING)
            FLOOR: up = inexact && negative;
            CEILING: up = inexact && !negative;
            TOWARD_ZERO: up = 1'b0;
            AWAY_FROM_ZERO: up = inexact;
            NEAREST_EVEN: up = over || (tie && is_odd);
            NEAREST_UP: up = over || (tie && !negative);
            NEAREST_DOWN: up = over || (tie && negative);
            NEAREST_AWAY: up = over || tie;
            NEAREST_TOWARD_ZERO: up = over;
            ODD: up = inexact && !is_odd;
            default: up = 1'b0;
        endcase
    wire [NW-1:0] rounded = whole + {{(NW-1){1'b0}}, up};
    assign quotient = negative ? -rounded : rounded;
endmodule
