// A non-restoring divider, one bit a clock: the remainder may be below zero, and is put right at the end. The quotient
// is rounded to the nearest, ties to even, and stands with done.
module non_restoring #(
    parameter int NW = 117,
    parameter int DW = 52
) (
    input  logic          clk,
    input  logic          rst,
    input  logic          go,
    input  logic [NW-1:0] num,
    input  logic [DW-1:0] den,
    output logic          done,
    output logic [NW-1:0] quo
);
    logic [NW-1:0] n, q;
    logic signed [DW+1:0] r;
    logic [DW-1:0] d;
    logic neg, run;
    logic [7:0] cnt;
    wire signed [DW+1:0] shifted = {r[DW:0], n[NW-1]};
    wire signed [DW+1:0] next = r[DW+1] ? shifted + $signed({2'b00, d}) : shifted - $signed({2'b00, d});

    always_ff @(posedge clk)
        if (rst) begin
            run <= 1'b0;
            done <= 1'b0;
            cnt <= 8'd0;
            n <= '0;
            q <= '0;
            r <= '0;
            d <= '0;
            neg <= 1'b0;
        end
        else begin
            done <= 1'b0;
            if (run) begin
                n <= n << 1;
                q <= {q[NW-2:0], ~next[DW+1]};
                r <= next;
                cnt <= cnt - 8'd1;
                if (cnt == 8'd1) begin
                    run <= 1'b0;
                    done <= 1'b1;
                end
            end
            else if (go) begin
                n <= num[NW-1] ? -num : num;
                neg <= num[NW-1];
                d <= den;
                q <= '0;
                r <= '0;
                cnt <= 8'(NW);
                run <= 1'b1;
            end
        end

    wire [DW:0] rest = r[DW+1] ? (DW+1)'(r) + {1'b0, d} : (DW+1)'(r);
    wire up = {rest, 1'b0} > {2'b00, d} || ({rest, 1'b0} == {2'b00, d} && q[0]);
    wire [NW-1:0] rounded = q + NW'(up);
    assign quo = neg ? -rounded : rounded;
endmodule
