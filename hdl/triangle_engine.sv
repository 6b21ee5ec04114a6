// A small triangle engine: set-up words and a box in, one triangle at a time; covered runs, depths
// of covered samples and a summary out, each a valid/ready stream of its own. One sample a clock.
// Spec: coverage C, depth P and G, vectors N.
module triangle_engine #(
    parameter int M = 35,                // bits of an edge word
    parameter int G = 1,                 // guard bits
    parameter int I = 24,                // depth bits
    parameter int F = 13,                // interpolation bits
    parameter int MODE = 1,              // read-out, as dda has it; not saturate
    parameter int C = 17                 // bits of a pixel coordinate
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [31:0]      test,
    input  logic [M-1:0]     e0, a0, b0, e1, a1, b1, e2, a2, b2,
    input  logic [G+I+F-1:0] z, dzdx, dzdy,
    input  logic             zero_area,
    input  logic [C-1:0]     x0, y0, x1, y1,   // the box, half open
    // Maximal runs of covered samples, half open, in the order of y then x.
    output logic             span_valid,
    input  logic             span_ready,
    output logic [31:0]      span_test,
    output logic [C-1:0]     span_y, span_x0, span_x1,
    // Covered samples.
    output logic             depth_valid,
    input  logic             depth_ready,
    output logic [31:0]      depth_test,
    output logic [C-1:0]     depth_x, depth_y,
    output logic [I-1:0]     depth_z,
    // One a triangle, when the rest of it has been taken.
    output logic             triangle_valid,
    input  logic             triangle_ready,
    output logic [31:0]      triangle_test, triangle_spans, triangle_samples,
    output logic             triangle_zero_area
);
    typedef enum logic [1:0] {IDLE, CORNER, RUN, DONE} state_t;
    localparam logic [1:0] TO_CORNER = 2'd0, NEXT = 2'd1, ROW = 2'd2, HOLD = 2'd3;

    state_t state;
    logic [31:0] name;
    logic [M-1:0] e [0:2];
    logic [M-1:0] a [0:2];
    logic [M-1:0] b [0:2];
    logic [G+I+F-1:0] start, slope_x, slope_y;
    logic nothing;
    logic [C-1:0] left, right, bottom;
    logic [C-1:0] x, y;
    logic in_run;                        // samples since first are covered
    logic [C-1:0] first;
    logic [31:0] spans, samples;

    wire [2:0] covers;
    logic [1:0] op;
    edge_evaluator #(.M(M), .C(C)) edge_0 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[0]), .ea(a[0]), .eb(b[0]), .in_v(covers[0]));
    edge_evaluator #(.M(M), .C(C)) edge_1 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[1]), .ea(a[1]), .eb(b[1]), .in_v(covers[1]));
    edge_evaluator #(.M(M), .C(C)) edge_2 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[2]), .ea(a[2]), .eb(b[2]), .in_v(covers[2]));
    depth_evaluator #(.G(G), .I(I), .F(F), .MODE(MODE), .C(C)) plane (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .z(start), .dzdx(slope_x), .dzdy(slope_y), .depth(depth_z));

    wire at_end = x == right;
    wire covered = state == RUN && !at_end && covers == 3'b111;
    wire closes = state == RUN && in_run && !covered;
    wire stalled = (covered && !depth_ready) || (closes && !span_ready);
    wire moves = state == RUN && !stalled;
    wire last_row = y + 1'b1 >= bottom;

    always_comb
        case (state)
            CORNER: op = TO_CORNER;
            RUN: op = !moves || (at_end && last_row) ? HOLD : at_end ? ROW : NEXT;
            default: op = HOLD;
        endcase

    assign in_ready = state == IDLE;
    assign span_valid = closes;
    assign span_test = name;
    assign span_y = y;
    assign span_x0 = first;
    assign span_x1 = x;
    assign depth_valid = covered;
    assign depth_test = name;
    assign depth_x = x;
    assign depth_y = y;
    assign triangle_valid = state == DONE;
    assign triangle_test = name;
    assign triangle_spans = spans;
    assign triangle_samples = samples;
    assign triangle_zero_area = nothing;

    always_ff @(posedge clk)
        if (rst) begin
            state <= IDLE;
            in_run <= 1'b0;
        end
        else
            case (state)
                IDLE:
                    if (in_valid) begin
                        name <= test;
                        e[0] <= e0;
                        a[0] <= a0;
                        b[0] <= b0;
                        e[1] <= e1;
                        a[1] <= a1;
                        b[1] <= b1;
                        e[2] <= e2;
                        a[2] <= a2;
                        b[2] <= b2;
                        start <= z;
                        slope_x <= dzdx;
                        slope_y <= dzdy;
                        nothing <= zero_area;
                        left <= x0;
                        right <= x1;
                        bottom <= y1;
                        x <= x0;
                        y <= y0;
                        spans <= 0;
                        samples <= 0;
                        in_run <= 1'b0;
                        state <= CORNER;
                    end
                CORNER: state <= nothing || left >= right || y >= bottom ? DONE : RUN;
                RUN:
                    if (moves) begin
                        if (covered) begin
                            samples <= samples + 1;
                            if (!in_run) first <= x;
                        end
                        in_run <= covered;
                        if (closes) spans <= spans + 1;
                        if (!at_end) x <= x + 1'b1;
                        else begin
                            x <= left;
                            y <= y + 1'b1;
                            if (last_row) state <= DONE;
                        end
                    end
                default:
                    if (triangle_ready) state <= IDLE;
            endcase
endmodule
