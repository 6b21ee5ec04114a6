// Edge words at 3 bits a coordinate: a module of its own, and the exported reference with the same vertices.
module small_edge (
    input signed [4:0] fx, fy, tx, ty,
    output [3:0] init, dx, dy
);
    wire signed [3:0] ex = tx - fx, ey = ty - fy;
    wire owns = ey < 0 || (ey == 0 && ex > 0);
    wire signed [11:0] value = ex * (1 - fy) - ey * (1 - fx) - (owns ? 0 : 1);
    wire signed [11:0] kept = value >>> 1;
    assign init = kept[3:0];
    assign dx = -ey;
    assign dy = ex;
endmodule

module small (
    input [2:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
    output [3:0] edge0_init, edge0_dx, edge0_dy, edge1_init, edge1_dx, edge1_dy, edge2_init, edge2_dx, edge2_dy,
    output zero_area
);
    wire signed [4:0] x0 = v0_x, y0 = v0_y, x1 = v1_x, y1 = v1_y, x2 = v2_x, y2 = v2_y;
    wire signed [9:0] area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
    wire turned = area < 0;
    wire signed [4:0] xb = turned ? x2 : x1, yb = turned ? y2 : y1;
    wire signed [4:0] xc = turned ? x1 : x2, yc = turned ? y1 : y2;
    wire [3:0] init0, dx0, dy0, init1, dx1, dy1, init2, dx2, dy2;
    small_edge edge0 (x0, y0, xb, yb, init0, dx0, dy0);
    small_edge edge1 (xb, yb, xc, yc, init1, dx1, dy1);
    small_edge edge2 (xc, yc, x0, y0, init2, dx2, dy2);
    wire [3:0] live = {4{area != 0}};
    assign {edge0_init, edge0_dx, edge0_dy} = {init0, dx0, dy0} & {3{live}};
    assign {edge1_init, edge1_dx, edge1_dy} = {init1, dx1, dy1} & {3{live}};
    assign {edge2_init, edge2_dx, edge2_dy} = {init2, dx2, dy2} & {3{live}};
    assign zero_area = area == 0;
endmodule

// For a solver of bits: differs is high where the words of a triangle of the field are not the reference's.
module both (
    input [2:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
    output differs
);
    wire [36:0] got, want;
    small own (
        v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
        got[35:32], got[31:28], got[27:24], got[23:20], got[19:16], got[15:12], got[11:8], got[7:4], got[3:0], got[36]
    );
    wire [6:0] depth_init, depth_dx, depth_dy;
    mini_reference_setup reference (
        .v0_x(v0_x), .v0_y(v0_y), .v1_x(v1_x), .v1_y(v1_y), .v2_x(v2_x), .v2_y(v2_y),
        .v0_z(3'd0), .v1_z(3'd0), .v2_z(3'd0),
        .edge0_init(want[35:32]), .edge0_dx(want[31:28]), .edge0_dy(want[27:24]),
        .edge1_init(want[23:20]), .edge1_dx(want[19:16]), .edge1_dy(want[15:12]),
        .edge2_init(want[11:8]), .edge2_dx(want[7:4]), .edge2_dy(want[3:0]), .zero_area(want[36]),
        .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy)
    );
    wire inside = v0_x <= 4 && v0_y <= 4 && v1_x <= 4 && v1_y <= 4 && v2_x <= 4 && v2_y <= 4;
    assign differs = inside && got != want;
endmodule

