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
    input  logic [M-1:0]     edge0_init, edge0_dx, edge0_dy,
    input  logic [M-1:0]     edge1_init, edge1_dx, edge1_dy,
    input  logic [M-1:0]     edge2_init, edge2_dx, edge2_dy,
    input  logic [G+I+F-1:0] depth_init, depth_dx, depth_dy,
    input  logic             zero_area,
    input  logic [C-1:0]     box_y_begin, box_y_end, box_x_begin, box_x_end,   // half open
    // Maximal runs of covered samples, half open, in the order of y then x.
    output logic             span_valid,
    input  logic             span_ready,
    output logic [31:0]      span_test,
    output logic [C-1:0]     span_y, span_x_begin, span_x_end,
    // Covered samples.
    output logic             sample_valid,
    input  logic             sample_ready,
    output logic [31:0]      sample_test,
    output logic [C-1:0]     sample_y, sample_x,
    output logic [I-1:0]     sample_depth,
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
    edge_evaluator #(.M(M), .C(C)) edge_0 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[0]), .edge_dx(a[0]), .edge_dy(b[0]), .in_v(covers[0]));
    edge_evaluator #(.M(M), .C(C)) edge_1 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[1]), .edge_dx(a[1]), .edge_dy(b[1]), .in_v(covers[1]));
    edge_evaluator #(.M(M), .C(C)) edge_2 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[2]), .edge_dx(a[2]), .edge_dy(b[2]), .in_v(covers[2]));
    depth_evaluator #(.G(G), .I(I), .F(F), .MODE(MODE), .C(C)) plane (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .depth_init(start), .depth_dx(slope_x), .depth_dy(slope_y), .depth(sample_depth));

    wire at_end = x == right;
    wire covered = state == RUN && !at_end && covers == 3'b111;
    wire closes = state == RUN && in_run && !covered;
    wire stalled = (covered && !sample_ready) || (closes && !span_ready);
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
    assign span_x_begin = first;
    assign span_x_end = x;
    assign sample_valid = covered;
    assign sample_test = name;
    assign sample_y = y;
    assign sample_x = x;
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
                        e[0] <= edge0_init;
                        a[0] <= edge0_dx;
                        b[0] <= edge0_dy;
                        e[1] <= edge1_init;
                        a[1] <= edge1_dx;
                        b[1] <= edge1_dy;
                        e[2] <= edge2_init;
                        a[2] <= edge2_dx;
                        b[2] <= edge2_dy;
                        start <= depth_init;
                        slope_x <= depth_dx;
                        slope_y <= depth_dy;
                        nothing <= zero_area;
                        left <= box_x_begin;
                        right <= box_x_end;
                        bottom <= box_y_end;
                        x <= box_x_begin;
                        y <= box_y_begin;
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
