// tiny: what its devices have to answer, as assertions. Spec clause J-13.
//
// Each module has the ports of a device as inputs, and asserts at the rising edge of the clock. Nothing is asserted
// before the first reset and while a reset is high. bind.sv puts these modules into the devices. The modules *_proof at
// the end have a device and its properties side by side, for tools that know no bind.

module tiny_reference_dda_properties #(parameter int N = tiny_reference::N, I = tiny_reference::I) (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [N-1:0] init, dx, dy, acc,
    input logic [I-1:0] out_v
);
    logic [N-1:0] want_acc;
    logic [I-1:0] want_out;
    tiny_reference_dda reference_ (.clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(want_acc), .out_v(want_out));
    logic known = 1'b0;
    always @(posedge clk) known <= known || rst;
    always @(posedge clk) if (known && !rst) begin
        accumulator: assert (acc == want_acc);
        read_out: assert (out_v == want_out);
    end
endmodule

module tiny_reference_edge_stepper_properties #(parameter int M = tiny_reference::M) (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [M-1:0] e0, ea, eb, e,
    input logic in_v
);
    logic [M-1:0] want_e;
    logic want_in;
    tiny_reference_edge_stepper reference_ (.clk(clk), .rst(rst), .op(op), .e0(e0), .ea(ea), .eb(eb), .e(want_e), .in_v(want_in));
    logic known = 1'b0;
    always @(posedge clk) known <= known || rst;
    always @(posedge clk) if (known && !rst) begin
        edge_word: assert (e == want_e);
        inside_bit: assert (in_v == want_in);
    end
endmodule

module tiny_reference_edge_evaluator_properties #(parameter int M = tiny_reference::M) (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [16:0] box_x_begin, box_y_begin,
    input logic [M-1:0] edge_init, edge_dx, edge_dy,
    input logic in_v
);
    logic want_in;
    tiny_reference_edge_evaluator reference_ (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .edge_init(edge_init), .edge_dx(edge_dx), .edge_dy(edge_dy), .in_v(want_in)
    );
    logic known = 1'b0;
    always @(posedge clk) known <= known || rst;
    always @(posedge clk) if (known && !rst) inside_bit: assert (in_v == want_in);
endmodule

module tiny_reference_depth_evaluator_properties #(parameter int N = tiny_reference::N, I = tiny_reference::I) (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [16:0] box_x_begin, box_y_begin,
    input logic [N-1:0] depth_init, depth_dx, depth_dy,
    input logic [I-1:0] depth
);
    logic [I-1:0] want_depth;
    tiny_reference_depth_evaluator reference_ (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy), .depth(want_depth)
    );
    logic known = 1'b0;
    always @(posedge clk) known <= known || rst;
    always @(posedge clk) if (known && !rst) read_out: assert (depth == want_depth);
endmodule

// A set-up that takes one triangle at a time.
module tiny_reference_triangle_setup_properties #(parameter int D = tiny_reference::D, M = tiny_reference::M, N = tiny_reference::N, I = tiny_reference::I, VERTEX = 4) (
    input logic clk, rst, in_valid, in_ready, out_valid,
    input logic [VERTEX-1:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
    input logic [I-1:0] v0_z, v1_z, v2_z,
    input logic [M-1:0] edge0_init, edge0_dx, edge0_dy,
    input logic [M-1:0] edge1_init, edge1_dx, edge1_dy,
    input logic [M-1:0] edge2_init, edge2_dx, edge2_dy,
    input logic [N-1:0] depth_init, depth_dx, depth_dy,
    input logic zero_area
);
    function automatic logic signed [D-1:0] coordinate(input logic [VERTEX-1:0] v);
        coordinate = {{(D-VERTEX){1'b0}}, v};
    endfunction
    logic signed [D-1:0] x0, y0, x1, y1, x2, y2;
    logic [I-1:0] z0, z1, z2;
    logic under_way = 1'b0;
    always @(posedge clk)
        if (rst) under_way <= 1'b0;
        else if (in_valid && in_ready) begin
            under_way <= 1'b1;
            {x0, y0, x1, y1} <= {coordinate(v0_x), coordinate(v0_y), coordinate(v1_x), coordinate(v1_y)};
            {x2, y2} <= {coordinate(v2_x), coordinate(v2_y)};
            {z0, z1, z2} <= {v0_z, v1_z, v2_z};
        end
    logic [M-1:0] want_e0, want_a0, want_b0, want_e1, want_a1, want_b1, want_e2, want_a2, want_b2;
    logic [N-1:0] want_init, want_dx, want_dy;
    logic want_zero;
    tiny_reference_setup reference_ (
        .v0_x(x0), .v0_y(y0), .v1_x(x1), .v1_y(y1), .v2_x(x2), .v2_y(y2), .v0_z(z0), .v1_z(z1), .v2_z(z2),
        .edge0_init(want_e0), .edge0_dx(want_a0), .edge0_dy(want_b0),
        .edge1_init(want_e1), .edge1_dx(want_a1), .edge1_dy(want_b1),
        .edge2_init(want_e2), .edge2_dx(want_a2), .edge2_dy(want_b2),
        .depth_init(want_init), .depth_dx(want_dx), .depth_dy(want_dy), .zero_area(want_zero)
    );
    always @(posedge clk) if (!rst && under_way && out_valid) begin
        edge_0: assert ({edge0_init, edge0_dx, edge0_dy} == {want_e0, want_a0, want_b0});
        edge_1: assert ({edge1_init, edge1_dx, edge1_dy} == {want_e1, want_a1, want_b1});
        edge_2: assert ({edge2_init, edge2_dx, edge2_dy} == {want_e2, want_a2, want_b2});
        plane: assert ({depth_init, depth_dx, depth_dy} == {want_init, want_dx, want_dy});
        no_area: assert (zero_area == want_zero);
    end
endmodule

// An engine: each sample is one of the triangle's, with its depth, and none comes twice or out of order; what is
// counted was taken. A sample that is left out shows in the vectors, not here.
module tiny_reference_triangle_engine_properties #(parameter int M = tiny_reference::M, N = tiny_reference::N, I = tiny_reference::I) (
    input logic clk, rst, in_valid, in_ready,
    input logic [31:0] test,
    input logic [M-1:0] edge0_init, edge0_dx, edge0_dy,
    input logic [M-1:0] edge1_init, edge1_dx, edge1_dy,
    input logic [M-1:0] edge2_init, edge2_dx, edge2_dy,
    input logic [N-1:0] depth_init, depth_dx, depth_dy,
    input logic zero_area,
    input logic [16:0] box_y_begin, box_y_end, box_x_begin, box_x_end,
    input logic span_valid, span_ready, sample_valid, sample_ready, triangle_valid, triangle_ready,
    input logic [31:0] span_test, sample_test, triangle_test, triangle_spans, triangle_samples,
    input logic [16:0] sample_y, sample_x,
    input logic [I-1:0] sample_depth
);
    logic [M-1:0] e0, a0, b0, e1, a1, b1, e2, a2, b2;
    logic [N-1:0] start, slope_x, slope_y;
    logic [16:0] left, right, top, bottom, last_x, last_y;
    logic [31:0] name, spans, samples;
    logic nothing, under_way = 1'b0;
    wire takes = in_valid && in_ready;
    wire mine = !rst && under_way;
    wire takes_sample = sample_valid && sample_ready && sample_test == name;
    wire takes_span = span_valid && span_ready && span_test == name;
    always @(posedge clk)
        if (rst) under_way <= 1'b0;
        else if (takes) begin
            under_way <= 1'b1;
            name <= test;
            {e0, a0, b0, e1, a1, b1} <= {edge0_init, edge0_dx, edge0_dy, edge1_init, edge1_dx, edge1_dy};
            {e2, a2, b2, start, slope_x, slope_y} <= {edge2_init, edge2_dx, edge2_dy, depth_init, depth_dx, depth_dy};
            {left, right, top, bottom, nothing} <= {box_x_begin, box_x_end, box_y_begin, box_y_end, zero_area};
            {spans, samples} <= 64'd0;
        end
        else begin
            if (takes_sample) begin
                {last_x, last_y} <= {sample_x, sample_y};
                samples <= samples + 32'd1;
            end
            if (takes_span) spans <= spans + 32'd1;
            if (triangle_valid && triangle_ready) under_way <= 1'b0;
        end
    logic covered;
    logic [I-1:0] want_depth;
    tiny_reference_sample reference_ (
        .edge0_init(e0), .edge0_dx(a0), .edge0_dy(b0), .edge1_init(e1), .edge1_dx(a1), .edge1_dy(b1),
        .edge2_init(e2), .edge2_dx(a2), .edge2_dy(b2), .depth_init(start), .depth_dx(slope_x), .depth_dy(slope_y),
        .zero_area(nothing), .x(sample_x), .y(sample_y), .covered(covered), .depth(want_depth)
    );
    always @(posedge clk) if (mine && takes_sample) begin
        in_the_box: assert (sample_x >= left && sample_x < right && sample_y >= top && sample_y < bottom);
        inside_bit: assert (covered);
        depth_code: assert (sample_depth == want_depth);
        in_order: assert (samples == 0 || sample_y > last_y || (sample_y == last_y && sample_x > last_x));
    end
    always @(posedge clk) if (mine && triangle_valid && triangle_test == name) begin
        sample_count: assert (triangle_samples == samples);
        span_count: assert (triangle_spans == spans);
    end
endmodule

module tiny_reference_dda_proof (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [tiny_reference::N-1:0] init, dx, dy
);
    logic [tiny_reference::N-1:0] acc;
    logic [tiny_reference::I-1:0] out_v;
    dda device (
        .clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(acc), .out_v(out_v)
    );
    tiny_reference_dda_properties properties (
        .clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(acc), .out_v(out_v)
    );
endmodule

module tiny_reference_edge_stepper_proof (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [tiny_reference::M-1:0] e0, ea, eb
);
    logic [tiny_reference::M-1:0] e;
    logic in_v;
    edge_stepper device (
        .clk(clk), .rst(rst), .op(op), .e0(e0), .ea(ea), .eb(eb), .e(e), .in_v(in_v)
    );
    tiny_reference_edge_stepper_properties properties (
        .clk(clk), .rst(rst), .op(op), .e0(e0), .ea(ea), .eb(eb), .e(e), .in_v(in_v)
    );
endmodule

module tiny_reference_edge_evaluator_proof (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [16:0] box_x_begin, box_y_begin,
    input logic [tiny_reference::M-1:0] edge_init, edge_dx, edge_dy
);
    logic in_v;
    edge_evaluator device (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .edge_init(edge_init), .edge_dx(edge_dx), .edge_dy(edge_dy), .in_v(in_v)
    );
    tiny_reference_edge_evaluator_properties properties (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .edge_init(edge_init), .edge_dx(edge_dx), .edge_dy(edge_dy), .in_v(in_v)
    );
endmodule

module tiny_reference_depth_evaluator_proof (
    input logic clk, rst,
    input logic [1:0] op,
    input logic [16:0] box_x_begin, box_y_begin,
    input logic [tiny_reference::N-1:0] depth_init, depth_dx, depth_dy
);
    logic [tiny_reference::I-1:0] depth;
    depth_evaluator device (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy), .depth(depth)
    );
    tiny_reference_depth_evaluator_properties properties (
        .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
        .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy), .depth(depth)
    );
endmodule
