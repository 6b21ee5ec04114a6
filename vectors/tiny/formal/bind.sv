// tiny: puts the properties of properties.sv into the devices, here those of dut.sv. Change the names for your own.
//     $ verilator --binary --assert -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv formal/reference.sv \
//       formal/properties.sv formal/bind.sv -o sim && obj_dir/sim
bind dda tiny_reference_dda_properties properties (
    .clk(clk), .rst(rst), .op(op), .init(init), .dx(dx), .dy(dy), .acc(acc), .out_v(out_v)
);
bind edge_stepper tiny_reference_edge_stepper_properties properties (
    .clk(clk), .rst(rst), .op(op), .e0(e0), .ea(ea), .eb(eb), .e(e), .in_v(in_v)
);
bind edge_evaluator tiny_reference_edge_evaluator_properties properties (
    .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin), .edge_init(edge_init),
    .edge_dx(edge_dx), .edge_dy(edge_dy), .in_v(in_v)
);
bind depth_evaluator tiny_reference_depth_evaluator_properties properties (
    .clk(clk), .rst(rst), .op(op), .box_x_begin(box_x_begin), .box_y_begin(box_y_begin),
    .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy), .depth(depth)
);
bind triangle_setup tiny_reference_triangle_setup_properties properties (
    .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .v0_x(v0_x),
    .v0_y(v0_y), .v1_x(v1_x), .v1_y(v1_y), .v2_x(v2_x), .v2_y(v2_y), .v0_z(v0_z), .v1_z(v1_z), .v2_z(v2_z),
    .edge0_init(o_edge0_init), .edge0_dx(o_edge0_dx), .edge0_dy(o_edge0_dy), .edge1_init(o_edge1_init),
    .edge1_dx(o_edge1_dx), .edge1_dy(o_edge1_dy), .edge2_init(o_edge2_init), .edge2_dx(o_edge2_dx),
    .edge2_dy(o_edge2_dy), .depth_init(o_depth_init), .depth_dx(o_depth_dx), .depth_dy(o_depth_dy),
    .zero_area(o_zero_area)
);
bind triangle_engine tiny_reference_triangle_engine_properties properties (
    .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .test(test), .edge0_init(edge0_init),
    .edge0_dx(edge0_dx), .edge0_dy(edge0_dy), .edge1_init(edge1_init), .edge1_dx(edge1_dx), .edge1_dy(edge1_dy),
    .edge2_init(edge2_init), .edge2_dx(edge2_dx), .edge2_dy(edge2_dy), .depth_init(depth_init),
    .depth_dx(depth_dx), .depth_dy(depth_dy), .zero_area(zero_area), .box_y_begin(box_y_begin),
    .box_y_end(box_y_end), .box_x_begin(box_x_begin), .box_x_end(box_x_end), .span_valid(span_valid),
    .span_ready(span_ready), .sample_valid(sample_valid), .sample_ready(sample_ready),
    .triangle_valid(triangle_valid), .triangle_ready(triangle_ready), .span_test(span_test),
    .sample_test(sample_test), .triangle_test(triangle_test), .triangle_spans(triangle_spans),
    .triangle_samples(triangle_samples), .sample_y(sample_y), .sample_x(sample_x), .sample_depth(sample_depth)
);
