// Edge function stepper: a word and its two steps; inside is a clear sign bit. Spec: edges E and C.
module edge_stepper #(
    parameter int M = 35                 // bits of an edge word
) (
    input  logic         clk,
    input  logic         rst,
    input  logic [1:0]   op,             // 0 load, 1 step by ea, 2 step by eb, 3 hold
    input  logic [M-1:0] e0,
    input  logic [M-1:0] ea,
    input  logic [M-1:0] eb,
    output logic [M-1:0] e,              // state after the clock edge
    output logic         in_v
);
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;

    always_ff @(posedge clk)
        if (rst) e <= {M{1'b0}};
        else
            case (op)
                LOAD: e <= e0;
                STEP_X: e <= e + ea;
                STEP_Y: e <= e + eb;
                default: ;
            endcase

    assign in_v = ~e[M-1];
endmodule
