// The bit length of a word: the place of its highest one, counted from 1; 0 for zero.
module bit_length #(
    parameter int W = 28                 // bits of the word
) (
    input  logic [W-1:0]           word,
    output logic [$clog2(W+1)-1:0] length
);
    always_comb begin
        length = '0;
        for (int n = 0; n < W; n++)
            if (word[n]) length = ($clog2(W+1))'(n + 1);
    end
endmodule
