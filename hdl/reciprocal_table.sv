// The table of a reciprocal unit, a ROM that is filled by the formula or by entries of one's own.
// Spec: CH-10, CH-11.
module reciprocal_table #(
    parameter int K = 7,                 // bits of the index
    parameter int M = 10,                // bits of an entry
    parameter int LINEAR = 0,            // 1: entries at the lower ends of the intervals, 0: in the middle
    parameter int OWN = 0,               // 1: the entries are those of ENTRIES
    parameter logic [((1<<K)+1)*M-1:0] ENTRIES = '0  // entry j in the bits from j M on
) (
    input  logic [K:0]   index,          // one past the last interval is the end of the last line
    output logic [M-1:0] entry
);
    localparam int COUNT = (1 << K) + 1;

    // 2^M / (1 + place / 2^(K+1)), to the nearest, a tie to the even; at most all ones.
    function automatic logic [M-1:0] formula(input logic [63:0] place);
        logic [63:0] whole, rest, divisor;
        divisor = (64'd2 << K) + place;
        whole = (64'd1 << (M + K + 1)) / divisor;
        rest = (64'd1 << (M + K + 1)) % divisor;
        if (rest + rest > divisor || (rest + rest == divisor && whole[0])) whole = whole + 64'd1;
        formula = |(whole >> M) ? '1 : whole[M-1:0];
    endfunction

    logic [M-1:0] rom [0:COUNT-1];
    integer j;
    initial
        for (j = 0; j < COUNT; j = j + 1)
            rom[j] = OWN != 0 ? ENTRIES[j*M +: M] : formula(LINEAR != 0 ? 64'(j) * 64'd2 : 64'(j) * 64'd2 + 64'd1);
    assign entry = rom[index];
endmodule
