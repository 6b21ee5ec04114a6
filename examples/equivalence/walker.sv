// A depth DDA of another architecture than hdl/dda.sv, for the profile sgi-4k: other names and codes, an
// adder in two slices, a read-out that is decoded ahead and registered, so that it comes a clock late.
module walker (
    input  wire clock, rst_n, test_mode,
    input  wire [2:0] cmd,
    input  wire [38:0] z0, zx, zy,
    output reg  [23:0] z
);
    reg [19:0] lo;
    reg [18:0] hi;
    wire [38:0] addend = cmd == 3'd2 ? zx : cmd == 3'd4 ? zy : 39'd0;
    wire [20:0] low = {1'b0, lo} + {1'b0, addend[19:0]};
    wire [18:0] high = hi + addend[38:20] + {18'd0, low[20]};
    wire [2:0] octant = hi[18:16];
    always @(posedge clock)
        if (!rst_n) begin
            lo <= 0;
            hi <= 0;
            z <= 0;
        end else begin
            {hi, lo} <= cmd == 3'd1 ? z0 : {high, low[19:0]};
            case (octant)
                3'd0, 3'd1: z <= {hi[16:0], lo[19:13]};
                3'd2, 3'd3, 3'd4: z <= 24'hffffff;
                default: z <= 24'd0;
            endcase
            if (test_mode) z <= {hi[3:0], lo};
        end
endmodule
