// A DDA that takes its slopes with a load: two clocks late, a read-out by octants.
module latched (input logic clk, rst_n, input logic [2:0] cmd,
  input logic [38:0] z0, zx, zy, output logic [23:0] z);
  logic [38:0] acc, sx, sy;
  logic [23:0] z1;
  wire [2:0] oct = acc[38:36];
  always_ff @(posedge clk)
    if (!rst_n) begin acc<=0; sx<=0; sy<=0; z1<=0; z<=0; end
    else begin
      case (cmd)
        3'd6: begin acc<=z0; sx<=zx; sy<=zy; end
        3'd5: acc <= acc + sx;
        3'd3: acc <= acc + sy;
        default: ;
      endcase
      z1 <= (oct==0||oct==1) ? acc[36:13] : (oct[2] && oct[1:0]!=0) ? 24'd0 : 24'hffffff;
      z <= z1;
    end
endmodule
