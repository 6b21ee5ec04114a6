// guardbit's live model over DPI-C. What each function does is in guardbit.h; a result below 0 is an
// error, and guardbit_fail says it and ends the simulation.
package guardbit_dpi;
    import "DPI-C" function int guardbit_open(input string profile);
    import "DPI-C" function int guardbit_close(input int handle);
    import "DPI-C" function int guardbit_walk(input int model, input int unsigned kind);
    import "DPI-C" function int guardbit_clock(
        input int walk, input int unsigned op,
        input bit [127:0] init, input bit [127:0] dx, input bit [127:0] dy,
        output bit [127:0] acc, output bit [127:0] out_v
    );
    import "DPI-C" function int guardbit_clock64(
        input int walk, input int unsigned op,
        input longint unsigned init, input longint unsigned dx, input longint unsigned dy,
        output longint unsigned acc, output longint unsigned out_v
    );
    // Kinds of walks: 0 depth, 1 edge, 2 1/w, 16 + n channel n.
    import "DPI-C" function int guardbit_divide(
        input int model, input int unsigned channel, input bit [127:0] acc, input bit [127:0] acc_w,
        output bit [127:0] code
    );
    import "DPI-C" function int guardbit_draw(input int model, input longint vertices [9]);
    import "DPI-C" function int guardbit_span(input int model, input int unsigned index, output int unsigned run [3]);

    // The handle or count that a call gave, if it went well.
    function automatic int guardbit_good(input int result, input string what);
        if (result < 0) $fatal(1, "%s: guardbit error %0d", what, result);
        return result;
    endfunction
endpackage
