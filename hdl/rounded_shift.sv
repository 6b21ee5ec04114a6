// A signed word shifted to the right, rounded once. Spec: R-1.
module rounded_shift #(
    parameter int W = 60,                // bits of the word and of the result
    parameter int S = 6,                 // bits of the distance
    parameter int ROUNDING = 4           // one of the codes below
) (
    input  logic [W-1:0] word,
    input  logic [S-1:0] places,
    output logic [W-1:0] result
);
    localparam int FLOOR = 0, CEILING = 1, TOWARD_ZERO = 2, AWAY_FROM_ZERO = 3;
    // To the nearest; a tie goes where the name says.
    localparam int NEAREST_EVEN = 4, NEAREST_UP = 5, NEAREST_DOWN = 6;
    localparam int NEAREST_AWAY = 7, NEAREST_TOWARD_ZERO = 8;
    localparam int ODD = 9;              // to the odd neighbour if inexact
    wire negative = word[W-1];
    wire [W-1:0] magnitude = negative ? -word : word;
    // What is dropped stands in the lower half, its half at the top of it.
    wire [2*W-1:0] both = {magnitude, {W{1'b0}}} >> places;
    wire [W-1:0] whole = both[2*W-1:W];
    wire half = both[W-1];
    wire below = |both[W-2:0];
    wire inexact = half || below;
    wire over = half && below;
    wire tie = half && !below;
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
    wire [W-1:0] rounded = whole + {{(W-1){1'b0}}, up};
    assign result = negative ? -rounded : rounded;
endmodule
