// An engine of another kind: it visits every pixel of the box by its number, works out the words there by
// products, and holds what it found in output registers. Written from the specification.
module pixel_engine #(
    parameter EW = 6, DW = 7, ZW = 3, FW = 3
) (
    input  wire          clock, resetn,
    input  wire          go,
    output wire          idle,
    input  wire [31:0]   id,
    input  wire [EW-1:0] e0, a0, b0, e1, a1, b1, e2, a2, b2,
    input  wire [DW-1:0] z0, zx, zy,
    input  wire          flat,
    input  wire [16:0]   y0, y1, x0, x1,
    output reg           run_valid,
    input  wire          run_ready,
    output reg  [16:0]   run_y, run_from, run_to,
    output reg           dot_valid,
    input  wire          dot_ready,
    output reg  [16:0]   dot_y, dot_x,
    output reg  [ZW-1:0] dot_z,
    output reg           end_valid,
    input  wire          end_ready,
    output wire [31:0]   end_id,
    output reg  [31:0]   end_runs, end_dots
);
    reg [31:0] held_id;
    reg [EW-1:0] c0, c1, c2, p0, p1, p2, q0, q1, q2;
    reg [DW-1:0] cz, pz, qz;
    reg [16:0] top, bottom, left, right, x, y, from;
    reg working, ended, open;
    // A pixel is looked at where both outputs are free.
    wire free = (!run_valid || run_ready) && (!dot_valid || dot_ready);
    wire [EW-1:0] w0 = c0 + x * p0 + y * q0;
    wire [EW-1:0] w1 = c1 + x * p1 + y * q1;
    wire [EW-1:0] w2 = c2 + x * p2 + y * q2;
    wire [DW-1:0] wz = cz + x * pz + y * qz;
    wire inside = !(w0[EW-1] | w1[EW-1] | w2[EW-1]);
    wire last = x + 1 == right;
    // The depth between 0 and its largest code: two bits above it tell below zero from beyond.
    wire [DW-1-FW:0] whole = wz[DW-1:FW];
    wire [ZW-1:0] code = !whole[ZW] ? whole[ZW-1:0] : whole[ZW-1] ? {ZW{1'b0}} : {ZW{1'b1}};
    assign idle = !working && !ended && !end_valid && !run_valid && !dot_valid;
    assign end_id = held_id;
    always @(posedge clock)
        if (!resetn) begin
            working <= 0; ended <= 0; end_valid <= 0; run_valid <= 0; dot_valid <= 0; open <= 0;
        end else begin
            if (run_ready) run_valid <= 0;
            if (dot_ready) dot_valid <= 0;
            if (end_ready) end_valid <= 0;
            if (go && idle) begin
                held_id <= id;
                c0 <= e0; p0 <= a0; q0 <= b0; c1 <= e1; p1 <= a1; q1 <= b1; c2 <= e2; p2 <= a2; q2 <= b2;
                cz <= z0; pz <= zx; qz <= zy;
                top <= y0; bottom <= y1; left <= x0; right <= x1; x <= x0; y <= y0;
                end_runs <= 0; end_dots <= 0; open <= 0;
                working <= !flat && y0 != y1 && x0 != x1;
                ended <= flat || y0 == y1 || x0 == x1;
            end
            if (working && free) begin
                if (inside) begin
                    dot_valid <= 1; dot_y <= y; dot_x <= x; dot_z <= code;
                    end_dots <= end_dots + 1;
                    if (!open) from <= x;
                end
                // A run ends before a pixel outside, or with the row.
                if (inside ? last : open) begin
                    run_valid <= 1; run_y <= y; run_from <= open ? from : x; run_to <= inside ? x + 1 : x;
                    end_runs <= end_runs + 1;
                end
                open <= inside && !last;
                x <= last ? left : x + 1;
                if (last) begin
                    y <= y + 1;
                    if (y + 1 == bottom) begin working <= 0; ended <= 1; end
                end
            end
            if (ended && free) begin ended <= 0; end_valid <= 1; end
        end
endmodule
