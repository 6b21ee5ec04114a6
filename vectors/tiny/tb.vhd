-- guardbit vector set tiny, model version 2: VHDL-2008 testbench, generated.
--
-- Drives the devices of dut.vhd (replace them with yours, same ports) with the set beside this
-- file and compares every row.
-- Run from inside the set folder:
--     $ ghdl -a --std=08 pkg.vhd dut.vhd tb.vhd && ghdl -e --std=08 tb && ghdl -r --std=08 tb
-- It ends with a PASS line, or with a FAIL line and a non-zero exit status. More, after tb: -gDUMP=true
-- writes what the devices answer to *.exp.dut.tv, for `guardbit verify --dut`; --vcd=FILE writes waves.
-- The generics of tb below are for devices with registered outputs or an order of their own.
--
-- Files are read line by line, so memory does not grow with the set. Each line's length, digits
-- and padding bits are checked, and the number of lines is checked against the package.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

package guardbit_bench is
    subtype count_t is unsigned(63 downto 0);
    constant REPORTED : natural := 20;

    procedure say(message : string);
    -- Says it and stops the simulation with exit status 1.
    procedure fail(message : string);
    procedure open_file(file f : text; name : string);
    -- One line as a packed record; fails unless it is exactly one record. shape is the line with
    -- its digits as 0.
    procedure next_row(file f : text; name : string; shape : string; pads : std_logic_vector;
        rows : count_t; number : inout count_t; bits : out std_logic_vector);
    -- Fails unless all rows of the package have been read and no more are there.
    procedure last_row(file f : text; name : string; rows : count_t; number : count_t);
    function decimal(number : unsigned) return string;
end package guardbit_bench;

package body guardbit_bench is
    procedure say(message : string) is
        variable l : line;
    begin
        write(l, message);
        writeline(output, l);
    end procedure say;

    procedure fail(message : string) is
    begin
        say("FAIL " & message);
        std.env.stop(1);
        wait;
    end procedure fail;

    procedure open_file(file f : text; name : string) is
        variable status : file_open_status;
    begin
        file_open(status, f, name, read_mode);
        if status /= open_ok then
            fail(name & ": cannot be opened");
        end if;
    end procedure open_file;

    procedure next_row(file f : text; name : string; shape : string; pads : std_logic_vector;
        rows : count_t; number : inout count_t; bits : out std_logic_vector) is
        variable l : line;
        variable c : character;
        variable packed_bits : std_logic_vector(bits'length - 1 downto 0);
        variable top : integer := bits'length - 1;
        variable nibble : std_logic_vector(3 downto 0);
    begin
        if endfile(f) then
            fail(name & ": no line " & decimal(number + 1) & ", the package says " & decimal(rows) & " rows");
        end if;
        readline(f, l);
        number := number + 1;
        if l'length /= shape'length then
            fail(name & " line " & decimal(number) & ": not " & integer'image(shape'length) & " characters and a newline");
        end if;
        for k in 0 to shape'length - 1 loop
            c := l(l'left + k);
            if shape(shape'left + k) = '0' then
                case c is
                    when '0' => nibble := x"0";
                    when '1' => nibble := x"1";
                    when '2' => nibble := x"2";
                    when '3' => nibble := x"3";
                    when '4' => nibble := x"4";
                    when '5' => nibble := x"5";
                    when '6' => nibble := x"6";
                    when '7' => nibble := x"7";
                    when '8' => nibble := x"8";
                    when '9' => nibble := x"9";
                    when 'a' => nibble := x"a";
                    when 'b' => nibble := x"b";
                    when 'c' => nibble := x"c";
                    when 'd' => nibble := x"d";
                    when 'e' => nibble := x"e";
                    when 'f' => nibble := x"f";
                    when others =>
                        fail(name & " line " & decimal(number) & ": " & character'image(c)
                            & " is not a lowercase hexadecimal digit");
                end case;
                packed_bits(top downto top - 3) := nibble;
                top := top - 4;
            elsif c /= shape(shape'left + k) then
                fail(name & " line " & decimal(number) & ": words do not have this row's widths");
            end if;
        end loop;
        deallocate(l);
        if (or (packed_bits and pads)) /= '0' then
            fail(name & " line " & decimal(number) & ": a word is wider than its column");
        end if;
        bits := packed_bits;
    end procedure next_row;

    procedure last_row(file f : text; name : string; rows : count_t; number : count_t) is
    begin
        if rows = 0 then
            fail(name & ": the package says 0 rows, nothing to check");
        elsif number /= rows then
            fail(name & ": " & decimal(number) & " of " & decimal(rows) & " rows used");
        elsif not endfile(f) then
            fail(name & " line " & decimal(number + 1) & ": more than the " & decimal(rows) & " rows of the package");
        end if;
    end procedure last_row;

    -- integer'image ends at 31 bits.
    function decimal(number : unsigned) return string is
        variable rest : unsigned(number'length - 1 downto 0) := number;
        variable digits : string(1 to 20);
        variable first : positive := 20;
    begin
        loop
            digits(first) := character'val(character'pos('0') + to_integer(rest mod 10));
            rest := rest / 10;
            exit when rest = 0;
            first := first - 1;
        end loop;
        return digits(first to 20);
    end function decimal;
end package body guardbit_bench;

-- Drives dda with dda.cfg.tv and compares every row of dda.exp.tv. Inputs change and
-- outputs are compared at the falling edge; the device works at the rising edge. Now and then the
-- bench stalls: it holds for some clocks, with other slopes at the inputs, and nothing may change.
-- In one walk of 64 the device is reset while it is told to step; its state must be zero then.
-- With DUMP it does neither: rows are then those of the files. With LATENCY the outputs come so many
-- clocks later, and the device is not reset.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity dda_check is
    generic (DUMP : boolean; LATENCY : natural range 0 to 63);
    port (
        clk        : in  std_logic;
        done       : out boolean := false;
        rows       : out count_t := (others => '0');
        mismatches : out count_t := (others => '0')
    );
end entity dda_check;

architecture bench of dda_check is
    signal rst : std_logic := '1';
    signal op : std_logic_vector(1 downto 0) := OP_HOLD;
    signal init, dx, dy, acc : std_logic_vector(6 downto 0) := (others => '0');
    signal out_v : std_logic_vector(2 downto 0);
begin
    device : entity work.dda
        port map (clk => clk, rst => rst, op => op,
            init => init, dx => dx, dy => dy, acc => acc, out_v => out_v);

    check : process is
        file cfg_file : text;
        file exp_file : text;
        file dump_file : text;
        variable dump_line : line;
        variable cfg_line, exp_line : count_t := (others => '0');
        variable walk, row, bad : count_t := (others => '0');
        variable cfg_bits : std_logic_vector(DDA_CFG_BITS - 1 downto 0);
        variable exp_bits : std_logic_vector(DDA_EXP_BITS - 1 downto 0);
        variable cfg : dda_cfg_t;
        variable want : dda_exp_t;
        variable noise : std_logic_vector(15 downto 0) := x"ace1";
        -- What the clocks of the last LATENCY edges were told.
        type told_t is record
            counted         : boolean;          -- a row of the file, and no stall
            walk, row, line : count_t;
            want            : dda_exp_t;
        end record told_t;
        type ring_t is array (0 to LATENCY) of told_t;
        variable ring : ring_t;
        variable head : natural range 0 to LATENCY := 0;
        variable entries : natural := 0;
        variable told : told_t;

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(field : string; expected, got : std_logic_vector; expected_bits, got_bits : string) is
        begin
            if expected /= got then
                bad := bad + 1;
                if bad <= REPORTED then
                    say("MISMATCH dda walk " & decimal(told.walk - 1) & " row " & decimal(told.row) & " (dda.exp.tv line "
                        & decimal(told.line) & ", op " & to_hstring(told.want.op) & ") field " & field);
                    say("    expected " & to_hstring(expected) & "  " & expected_bits);
                    say("    got      " & to_hstring(got) & "  " & got_bits);
                end if;
            end if;
        end procedure compare;

        -- Ends a clock, and compares the outputs with what the one LATENCY clocks before was told.
        procedure clock(counted : boolean) is
        begin
            wait until falling_edge(clk);
            ring(head) := (counted, walk, row, exp_line, want);
            head := (head + 1) mod (LATENCY + 1);
            entries := entries + 1;
            if entries > LATENCY then
                told := ring(head);
                compare("acc", told.want.acc, acc, to_string(told.want.acc(6 downto 6)) & "." & to_string(told.want.acc(5 downto 3)) & "." & to_string(told.want.acc(2 downto 0)), to_string(acc(6 downto 6)) & "." & to_string(acc(5 downto 3)) & "." & to_string(acc(2 downto 0)));
                compare("out", told.want.out_v, out_v, to_string(told.want.out_v), to_string(out_v));
                if DUMP and told.counted then
                    write(dump_line, to_hstring(told.want.op) & "_" & to_hstring(acc) & "_" & to_hstring(out_v));
                    writeline(dump_file, dump_line);
                end if;
            end if;
        end procedure clock;
    begin
        open_file(cfg_file, "dda.cfg.tv");
        open_file(exp_file, "dda.exp.tv");
        if DUMP then
            file_open(dump_file, "dda.exp.dut.tv", write_mode);
        end if;
        wait until falling_edge(clk);
        wait until falling_edge(clk);
        rst <= '0';
        while exp_line < DDA_EXP_ROWS loop
            next_row(exp_file, "dda.exp.tv", "0_00_0", DDA_EXP_PADS, DDA_EXP_ROWS, exp_line, exp_bits);
            want := to_dda_exp(exp_bits);
            if want.op = OP_LOAD then
                next_row(cfg_file, "dda.cfg.tv", "00_00_00", DDA_CFG_PADS, DDA_CFG_ROWS, cfg_line, cfg_bits);
                cfg := to_dda_cfg(cfg_bits);
                walk := walk + 1;
                row := (others => '0');
                init <= cfg.init;
                dx <= cfg.dx;
                dy <= cfg.dy;
                if not DUMP and LATENCY = 0 and walk(5 downto 0) = 3 then
                    rst <= '1';
                    op <= OP_STEP_X;
                    wait until falling_edge(clk);
                    rst <= '0';
                    if unsigned(acc) /= 0 or is_x(acc) then
                        bad := bad + 1;
                        if bad <= REPORTED then
                            say("MISMATCH dda walk " & decimal(walk - 1) & ": field acc is "
                                & to_hstring(acc) & " after a reset, not zero");
                        end if;
                    end if;
                end if;
            elsif walk = 0 then
                fail("dda.exp.tv line 1: the first row is not a load");
            else
                row := row + 1;
            end if;
            op <= want.op;
            clock(true);
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            -- One row in 32 stalls, for one to eight clocks.
            if not DUMP and unsigned(noise(4 downto 0)) = 0 then
                op <= OP_HOLD;
                init <= not init;
                dx <= not dx;
                dy <= not dy;
                for k in 0 to to_integer(unsigned(noise(7 downto 5))) loop
                    clock(false);
                end loop;
                init <= cfg.init;
                dx <= cfg.dx;
                dy <= cfg.dy;
            end if;
        end loop;
        last_row(exp_file, "dda.exp.tv", DDA_EXP_ROWS, exp_line);
        last_row(cfg_file, "dda.cfg.tv", DDA_CFG_ROWS, cfg_line);
        op <= OP_HOLD;
        for k in 1 to LATENCY loop
            clock(false);
        end loop;
        rows <= exp_line;
        mismatches <= bad;
        done <= true;
        wait;
    end process check;
end architecture bench;

-- Drives edge_stepper with edge.cfg.tv and compares every row of edge.exp.tv. Inputs change and
-- outputs are compared at the falling edge; the device works at the rising edge. Now and then the
-- bench stalls: it holds for some clocks, with other slopes at the inputs, and nothing may change.
-- In one walk of 64 the device is reset while it is told to step; its state must be zero then.
-- With DUMP it does neither: rows are then those of the files. With LATENCY the outputs come so many
-- clocks later, and the device is not reset.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity edge_check is
    generic (DUMP : boolean; LATENCY : natural range 0 to 63);
    port (
        clk        : in  std_logic;
        done       : out boolean := false;
        rows       : out count_t := (others => '0');
        mismatches : out count_t := (others => '0')
    );
end entity edge_check;

architecture bench of edge_check is
    signal rst : std_logic := '1';
    signal op : std_logic_vector(1 downto 0) := OP_HOLD;
    signal e0, ea, eb, e : std_logic_vector(5 downto 0) := (others => '0');
    signal in_v : std_logic_vector(0 downto 0);
begin
    device : entity work.edge_stepper
        port map (clk => clk, rst => rst, op => op,
            e0 => e0, ea => ea, eb => eb, e => e, in_v => in_v(0));

    check : process is
        file cfg_file : text;
        file exp_file : text;
        file dump_file : text;
        variable dump_line : line;
        variable cfg_line, exp_line : count_t := (others => '0');
        variable walk, row, bad : count_t := (others => '0');
        variable cfg_bits : std_logic_vector(EDGE_CFG_BITS - 1 downto 0);
        variable exp_bits : std_logic_vector(EDGE_EXP_BITS - 1 downto 0);
        variable cfg : edge_cfg_t;
        variable want : edge_exp_t;
        variable noise : std_logic_vector(15 downto 0) := x"ace1";
        -- What the clocks of the last LATENCY edges were told.
        type told_t is record
            counted         : boolean;          -- a row of the file, and no stall
            walk, row, line : count_t;
            want            : edge_exp_t;
        end record told_t;
        type ring_t is array (0 to LATENCY) of told_t;
        variable ring : ring_t;
        variable head : natural range 0 to LATENCY := 0;
        variable entries : natural := 0;
        variable told : told_t;

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(field : string; expected, got : std_logic_vector; expected_bits, got_bits : string) is
        begin
            if expected /= got then
                bad := bad + 1;
                if bad <= REPORTED then
                    say("MISMATCH edge walk " & decimal(told.walk - 1) & " row " & decimal(told.row) & " (edge.exp.tv line "
                        & decimal(told.line) & ", op " & to_hstring(told.want.op) & ") field " & field);
                    say("    expected " & to_hstring(expected) & "  " & expected_bits);
                    say("    got      " & to_hstring(got) & "  " & got_bits);
                end if;
            end if;
        end procedure compare;

        -- Ends a clock, and compares the outputs with what the one LATENCY clocks before was told.
        procedure clock(counted : boolean) is
        begin
            wait until falling_edge(clk);
            ring(head) := (counted, walk, row, exp_line, want);
            head := (head + 1) mod (LATENCY + 1);
            entries := entries + 1;
            if entries > LATENCY then
                told := ring(head);
                compare("e", told.want.e, e, to_string(told.want.e(5 downto 0)), to_string(e(5 downto 0)));
                compare("in", told.want.in_v, in_v, to_string(told.want.in_v), to_string(in_v));
                if DUMP and told.counted then
                    write(dump_line, to_hstring(told.want.op) & "_" & to_hstring(e) & "_" & to_hstring(in_v));
                    writeline(dump_file, dump_line);
                end if;
            end if;
        end procedure clock;
    begin
        open_file(cfg_file, "edge.cfg.tv");
        open_file(exp_file, "edge.exp.tv");
        if DUMP then
            file_open(dump_file, "edge.exp.dut.tv", write_mode);
        end if;
        wait until falling_edge(clk);
        wait until falling_edge(clk);
        rst <= '0';
        while exp_line < EDGE_EXP_ROWS loop
            next_row(exp_file, "edge.exp.tv", "0_00_0", EDGE_EXP_PADS, EDGE_EXP_ROWS, exp_line, exp_bits);
            want := to_edge_exp(exp_bits);
            if want.op = OP_LOAD then
                next_row(cfg_file, "edge.cfg.tv", "00_00_00", EDGE_CFG_PADS, EDGE_CFG_ROWS, cfg_line, cfg_bits);
                cfg := to_edge_cfg(cfg_bits);
                walk := walk + 1;
                row := (others => '0');
                e0 <= cfg.e0;
                ea <= cfg.ea;
                eb <= cfg.eb;
                if not DUMP and LATENCY = 0 and walk(5 downto 0) = 3 then
                    rst <= '1';
                    op <= OP_STEP_X;
                    wait until falling_edge(clk);
                    rst <= '0';
                    if unsigned(e) /= 0 or is_x(e) then
                        bad := bad + 1;
                        if bad <= REPORTED then
                            say("MISMATCH edge walk " & decimal(walk - 1) & ": field e is "
                                & to_hstring(e) & " after a reset, not zero");
                        end if;
                    end if;
                end if;
            elsif walk = 0 then
                fail("edge.exp.tv line 1: the first row is not a load");
            else
                row := row + 1;
            end if;
            op <= want.op;
            clock(true);
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            -- One row in 32 stalls, for one to eight clocks.
            if not DUMP and unsigned(noise(4 downto 0)) = 0 then
                op <= OP_HOLD;
                e0 <= not e0;
                ea <= not ea;
                eb <= not eb;
                for k in 0 to to_integer(unsigned(noise(7 downto 5))) loop
                    clock(false);
                end loop;
                e0 <= cfg.e0;
                ea <= cfg.ea;
                eb <= cfg.eb;
            end if;
        end loop;
        last_row(exp_file, "edge.exp.tv", EDGE_EXP_ROWS, exp_line);
        last_row(cfg_file, "edge.cfg.tv", EDGE_CFG_ROWS, cfg_line);
        op <= OP_HOLD;
        for k in 1 to LATENCY loop
            clock(false);
        end loop;
        rows <= exp_line;
        mismatches <= bad;
        done <= true;
        wait;
    end process check;
end architecture bench;

-- Drives triangle_setup with setup.cfg.tv and compares what its streams answer. The bench stalls them in
-- patterns that change every 16 records: never, every other clock, at random, in long pauses. Inputs
-- change at the falling edge; what is taken at a rising edge is compared as it stands before it.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity setup_check is
    generic (DUMP : boolean);
    port (
        clk        : in  std_logic;
        done       : out boolean := false;
        rows       : out count_t := (others => '0');
        mismatches : out count_t := (others => '0')
    );
end entity setup_check;

architecture bench of setup_check is
    signal rst : std_logic := '1';
    signal in_valid : std_logic := '0';
    signal in_ready : std_logic;
    signal v0_x : std_logic_vector(3 downto 0);
    signal v0_y : std_logic_vector(3 downto 0);
    signal v0_z : std_logic_vector(2 downto 0);
    signal v1_x : std_logic_vector(3 downto 0);
    signal v1_y : std_logic_vector(3 downto 0);
    signal v1_z : std_logic_vector(2 downto 0);
    signal v2_x : std_logic_vector(3 downto 0);
    signal v2_y : std_logic_vector(3 downto 0);
    signal v2_z : std_logic_vector(2 downto 0);
    signal o_edge0_init : std_logic_vector(5 downto 0);
    signal o_edge0_dx : std_logic_vector(5 downto 0);
    signal o_edge0_dy : std_logic_vector(5 downto 0);
    signal o_edge1_init : std_logic_vector(5 downto 0);
    signal o_edge1_dx : std_logic_vector(5 downto 0);
    signal o_edge1_dy : std_logic_vector(5 downto 0);
    signal o_edge2_init : std_logic_vector(5 downto 0);
    signal o_edge2_dx : std_logic_vector(5 downto 0);
    signal o_edge2_dy : std_logic_vector(5 downto 0);
    signal o_depth_init : std_logic_vector(6 downto 0);
    signal o_depth_dx : std_logic_vector(6 downto 0);
    signal o_depth_dy : std_logic_vector(6 downto 0);
    signal o_zero_area : std_logic_vector(0 downto 0);
    signal o_valid : std_logic;
    signal o_ready : std_logic := '0';
begin
    device : entity work.triangle_setup
        port map (clk => clk, rst => rst, in_valid => in_valid, in_ready => in_ready,
            v0_x => v0_x,
            v0_y => v0_y,
            v0_z => v0_z,
            v1_x => v1_x,
            v1_y => v1_y,
            v1_z => v1_z,
            v2_x => v2_x,
            v2_y => v2_y,
            v2_z => v2_z,
            o_edge0_init => o_edge0_init,
            o_edge0_dx => o_edge0_dx,
            o_edge0_dy => o_edge0_dy,
            o_edge1_init => o_edge1_init,
            o_edge1_dx => o_edge1_dx,
            o_edge1_dy => o_edge1_dy,
            o_edge2_init => o_edge2_init,
            o_edge2_dx => o_edge2_dx,
            o_edge2_dy => o_edge2_dy,
            o_depth_init => o_depth_init,
            o_depth_dx => o_depth_dx,
            o_depth_dy => o_depth_dy,
            o_zero_area => o_zero_area(0),
            out_valid => o_valid,
            out_ready => o_ready);

    check : process is
        constant PATIENCE : natural := 100000;  -- clocks without a transfer
        constant IDLE : natural := 300;         -- clocks after which a device that is ready has nothing under way
        constant MOST_EXTRAS : count_t := shift_left(SETUP_CFG_ROWS, 2) + 1000;
        file cfg_file : text;
        variable cfg_line, compared, bad, extras : count_t := (others => '0');
        variable cfg_bits : std_logic_vector(SETUP_CFG_BITS - 1 downto 0);
        variable cfg : setup_cfg_t;
        variable quiet : natural := 0;          -- clocks since the last transfer
        variable cut_left : natural := 0;       -- clocks until the reset
        variable offers, taken, resets : boolean := false;
        -- Before some records the device is given another, with other words, and a reset while it works
        -- on that. Nothing of it may be seen. Not with DUMP.
        variable cut_next : boolean;
        variable cutting : boolean := false;    -- the other record is in: no answer is taken
        variable noise : std_logic_vector(15 downto 0) := x"ace1";
        variable beat : unsigned(4 downto 0) := (others => '0');
        file o_file, o_dump : text;
        variable o_line : count_t := (others => '0');
        variable o_bits : std_logic_vector(SETUP_EXP_BITS - 1 downto 0);
        variable o_want : setup_exp_t;
        variable o_held : boolean := false;
        variable o_kept : std_logic_vector(75 downto 0);

        procedure mismatch(message : string) is
        begin
            bad := bad + 1;
            if bad <= REPORTED then
                say("MISMATCH setup " & message);
            end if;
        end procedure mismatch;

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(name : string; number : count_t; field : string; expected, got : std_logic_vector) is
        begin
            if expected /= got then
                mismatch("(" & name & " line " & decimal(number) & ") field " & field);
                if bad <= REPORTED then
                    say("    expected " & to_hstring(expected) & "  " & to_string(expected));
                    say("    got      " & to_hstring(got) & "  " & to_string(got));
                end if;
            end if;
        end procedure compare;

        -- A device that never stops answering must not run for ever.
        procedure extra is
        begin
            extras := extras + 1;
            if extras > MOST_EXTRAS then
                fail("setup: " & decimal(extras) & " rows too much, " & decimal(cfg_line) & " of "
                    & decimal(SETUP_CFG_ROWS) & " records taken: the device answers without end");
            end if;
        end procedure extra;

        -- Which clocks stall, by the record that is in the device.
        impure function stalls return boolean is
        begin
            case cfg_line(5 downto 4) is
                when "00" => return false;
                when "01" => return beat(0) = '1';
                when "10" => return noise(0) = '1';
                when others => return beat(4) = '1';
            end case;
        end function stalls;

        procedure o_read is
        begin
            next_row(o_file, "setup.exp.tv", "00_00_00_00_00_00_00_00_00_00_00_00_0", SETUP_EXP_PADS, SETUP_EXP_ROWS, o_line, o_bits);
            o_want := to_setup_exp(o_bits);
        end procedure o_read;

        procedure o_judge(number : count_t) is
        begin
            compare("setup.exp.tv", number, "edge0_init", o_want.edge0_init, o_edge0_init);
            compare("setup.exp.tv", number, "edge0_dx", o_want.edge0_dx, o_edge0_dx);
            compare("setup.exp.tv", number, "edge0_dy", o_want.edge0_dy, o_edge0_dy);
            compare("setup.exp.tv", number, "edge1_init", o_want.edge1_init, o_edge1_init);
            compare("setup.exp.tv", number, "edge1_dx", o_want.edge1_dx, o_edge1_dx);
            compare("setup.exp.tv", number, "edge1_dy", o_want.edge1_dy, o_edge1_dy);
            compare("setup.exp.tv", number, "edge2_init", o_want.edge2_init, o_edge2_init);
            compare("setup.exp.tv", number, "edge2_dx", o_want.edge2_dx, o_edge2_dx);
            compare("setup.exp.tv", number, "edge2_dy", o_want.edge2_dy, o_edge2_dy);
            compare("setup.exp.tv", number, "depth_init", o_want.depth_init, o_depth_init);
            compare("setup.exp.tv", number, "depth_dx", o_want.depth_dx, o_depth_dx);
            compare("setup.exp.tv", number, "depth_dy", o_want.depth_dy, o_depth_dy);
            compare("setup.exp.tv", number, "zero_area", o_want.zero_area, o_zero_area);
        end procedure o_judge;

        -- An answer that has not been taken stays as it is.
        procedure o_watch is
            variable now : std_logic_vector(75 downto 0);
            variable line_out : line;
        begin
            now := o_edge0_init & o_edge0_dx & o_edge0_dy & o_edge1_init & o_edge1_dx & o_edge1_dy & o_edge2_init & o_edge2_dx & o_edge2_dy & o_depth_init & o_depth_dx & o_depth_dy & o_zero_area;
            if o_held and (o_valid /= '1' or now /= o_kept) then
                mismatch("(setup.exp.tv line " & decimal(o_line + 1) & "): an answer changes or goes before it is taken");
            end if;
            o_held := o_valid = '1' and o_ready = '0';
            o_kept := now;
            if o_valid = '1' and o_ready = '1' then
                quiet := 0;
                compared := compared + 1;
                if DUMP then
                    write(line_out, to_hstring(o_edge0_init) & "_" & to_hstring(o_edge0_dx) & "_" & to_hstring(o_edge0_dy) & "_" & to_hstring(o_edge1_init) & "_" & to_hstring(o_edge1_dx) & "_" & to_hstring(o_edge1_dy) & "_" & to_hstring(o_edge2_init) & "_" & to_hstring(o_edge2_dx) & "_" & to_hstring(o_edge2_dy) & "_" & to_hstring(o_depth_init) & "_" & to_hstring(o_depth_dx) & "_" & to_hstring(o_depth_dy) & "_" & to_hstring(o_zero_area));
                    writeline(o_dump, line_out);
                end if;
                if o_line >= SETUP_EXP_ROWS then
                    mismatch("(setup.exp.tv): a row too much, " & decimal(cfg_line) & " records are in");
                    extra;
                else
                    o_read;
                    o_judge(o_line);
                end if;
            end if;
        end procedure o_watch;
    begin
        open_file(cfg_file, "setup.cfg.tv");
        open_file(o_file, "setup.exp.tv");
        if DUMP then
            file_open(o_dump, "setup.exp.dut.tv", write_mode);
        end if;
        for k in 1 to 3 loop
            wait until falling_edge(clk);
        end loop;
        rst <= '0';
        loop
            -- What a rising edge takes.
            wait until rising_edge(clk);
            quiet := quiet + 1;
            if in_valid = '1' and in_ready = '1' then
                taken := true;
                quiet := 0;
            end if;
            if rst = '1' then
                o_held := false;
            else
                o_watch;
            end if;

            wait until falling_edge(clk);
            beat := beat + 1;
            if resets then
                resets := false;
                offers := cutting;
                cfg := to_setup_cfg(cfg_bits);
                cutting := false;
            elsif cut_left > 0 then
                cut_left := cut_left - 1;
                resets := cut_left = 0;
            elsif taken and cutting then
                cut_left := 1 + to_integer(unsigned(noise(4 downto 0)));
            end if;
            o_ready <= '0' when stalls or cutting else '1';
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            if taken then
                offers := false;
                if not DUMP then
                    -- What stands at the inputs without a valid is nothing.
                    cfg.v0_x := not cfg.v0_x;
                    cfg.v0_y := not cfg.v0_y;
                    cfg.v0_z := not cfg.v0_z;
                    cfg.v1_x := not cfg.v1_x;
                    cfg.v1_y := not cfg.v1_y;
                    cfg.v1_z := not cfg.v1_z;
                    cfg.v2_x := not cfg.v2_x;
                    cfg.v2_y := not cfg.v2_y;
                    cfg.v2_z := not cfg.v2_z;
                end if;
            end if;
            taken := false;
            cut_next := not DUMP and cfg_line(5 downto 0) = 2 and quiet <= PATIENCE / 2;
            if not offers and not stalls and not cutting and cfg_line < SETUP_CFG_ROWS
                and (not cut_next or (quiet > IDLE and in_ready = '1')) then
                cutting := cut_next;
                next_row(cfg_file, "setup.cfg.tv", "0_0_0_0_0_0_0_0_0", SETUP_CFG_PADS, SETUP_CFG_ROWS, cfg_line, cfg_bits);
                cfg := to_setup_cfg(cfg_bits);
                if cutting then
                    cfg.v0_x := not cfg.v0_x;
                    cfg.v0_y := not cfg.v0_y;
                    cfg.v0_z := not cfg.v0_z;
                    cfg.v1_x := not cfg.v1_x;
                    cfg.v1_y := not cfg.v1_y;
                    cfg.v1_z := not cfg.v1_z;
                    cfg.v2_x := not cfg.v2_x;
                    cfg.v2_y := not cfg.v2_y;
                    cfg.v2_z := not cfg.v2_z;
                end if;
                offers := true;
            end if;
            -- Some clocks more show what comes too much.
            if quiet > IDLE then
                exit when cfg_line >= SETUP_CFG_ROWS and not offers and not cutting
                    and o_line >= SETUP_EXP_ROWS and not (o_valid = '1');
                if quiet > PATIENCE then
                    fail("setup: no transfer for " & integer'image(quiet) & " clocks, " & decimal(cfg_line) & " of "
                        & decimal(SETUP_CFG_ROWS) & " records begun: the device hangs, or rows are missing");
                end if;
            end if;
            rst <= '1' when resets else '0';
            in_valid <= '1' when offers else '0';
            v0_x <= cfg.v0_x;
            v0_y <= cfg.v0_y;
            v0_z <= cfg.v0_z;
            v1_x <= cfg.v1_x;
            v1_y <= cfg.v1_y;
            v1_z <= cfg.v1_z;
            v2_x <= cfg.v2_x;
            v2_y <= cfg.v2_y;
            v2_z <= cfg.v2_z;
        end loop;
        last_row(cfg_file, "setup.cfg.tv", SETUP_CFG_ROWS, cfg_line);
        last_row(o_file, "setup.exp.tv", SETUP_EXP_ROWS, o_line);
        rows <= compared;
        mismatches <= bad;
        done <= true;
        wait;
    end process check;
end architecture bench;

-- Drives triangle_engine with triangle.cfg.tv and compares what its streams answer. The bench stalls them in
-- patterns that change every 16 records: never, every other clock, at random, in long pauses. Inputs
-- change at the falling edge; what is taken at a rising edge is compared as it stands before it.
-- With ANY_ORDER the rows of a test come in any order, each matched by its key.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity triangle_check is
    generic (DUMP, ANY_ORDER : boolean);
    port (
        clk        : in  std_logic;
        done       : out boolean := false;
        rows       : out count_t := (others => '0');
        mismatches : out count_t := (others => '0')
    );
end entity triangle_check;

architecture bench of triangle_check is
    signal rst : std_logic := '1';
    signal in_valid : std_logic := '0';
    signal in_ready : std_logic;
    signal test : std_logic_vector(31 downto 0);
    signal edge0_init : std_logic_vector(5 downto 0);
    signal edge0_dx : std_logic_vector(5 downto 0);
    signal edge0_dy : std_logic_vector(5 downto 0);
    signal edge1_init : std_logic_vector(5 downto 0);
    signal edge1_dx : std_logic_vector(5 downto 0);
    signal edge1_dy : std_logic_vector(5 downto 0);
    signal edge2_init : std_logic_vector(5 downto 0);
    signal edge2_dx : std_logic_vector(5 downto 0);
    signal edge2_dy : std_logic_vector(5 downto 0);
    signal depth_init : std_logic_vector(6 downto 0);
    signal depth_dx : std_logic_vector(6 downto 0);
    signal depth_dy : std_logic_vector(6 downto 0);
    signal zero_area : std_logic_vector(0 downto 0);
    signal box_y_begin : std_logic_vector(16 downto 0);
    signal box_y_end : std_logic_vector(16 downto 0);
    signal box_x_begin : std_logic_vector(16 downto 0);
    signal box_x_end : std_logic_vector(16 downto 0);
    signal span_test : std_logic_vector(31 downto 0);
    signal span_y : std_logic_vector(16 downto 0);
    signal span_x_begin : std_logic_vector(16 downto 0);
    signal span_x_end : std_logic_vector(16 downto 0);
    signal span_valid : std_logic;
    signal span_ready : std_logic := '0';
    signal sample_test : std_logic_vector(31 downto 0);
    signal sample_y : std_logic_vector(16 downto 0);
    signal sample_x : std_logic_vector(16 downto 0);
    signal sample_depth : std_logic_vector(2 downto 0);
    signal sample_valid : std_logic;
    signal sample_ready : std_logic := '0';
    signal triangle_test : std_logic_vector(31 downto 0);
    signal triangle_spans : std_logic_vector(31 downto 0);
    signal triangle_samples : std_logic_vector(31 downto 0);
    signal triangle_zero_area : std_logic_vector(0 downto 0);
    signal triangle_valid : std_logic;
    signal triangle_ready : std_logic := '0';
begin
    device : entity work.triangle_engine
        port map (clk => clk, rst => rst, in_valid => in_valid, in_ready => in_ready,
            test => test,
            edge0_init => edge0_init,
            edge0_dx => edge0_dx,
            edge0_dy => edge0_dy,
            edge1_init => edge1_init,
            edge1_dx => edge1_dx,
            edge1_dy => edge1_dy,
            edge2_init => edge2_init,
            edge2_dx => edge2_dx,
            edge2_dy => edge2_dy,
            depth_init => depth_init,
            depth_dx => depth_dx,
            depth_dy => depth_dy,
            zero_area => zero_area(0),
            box_y_begin => box_y_begin,
            box_y_end => box_y_end,
            box_x_begin => box_x_begin,
            box_x_end => box_x_end,
            span_test => span_test,
            span_y => span_y,
            span_x_begin => span_x_begin,
            span_x_end => span_x_end,
            span_valid => span_valid,
            span_ready => span_ready,
            sample_test => sample_test,
            sample_y => sample_y,
            sample_x => sample_x,
            sample_depth => sample_depth,
            sample_valid => sample_valid,
            sample_ready => sample_ready,
            triangle_test => triangle_test,
            triangle_spans => triangle_spans,
            triangle_samples => triangle_samples,
            triangle_zero_area => triangle_zero_area(0),
            triangle_valid => triangle_valid,
            triangle_ready => triangle_ready);

    check : process is
        constant PATIENCE : natural := 100000;  -- clocks without a transfer
        constant IDLE : natural := 300;         -- clocks after which a device that is ready has nothing under way
        constant MOST_EXTRAS : count_t := shift_left(TRIANGLE_CFG_ROWS, 2) + 1000;
        file cfg_file : text;
        variable cfg_line, compared, bad, extras : count_t := (others => '0');
        variable cfg_bits : std_logic_vector(TRIANGLE_CFG_BITS - 1 downto 0);
        variable cfg : triangle_cfg_t;
        variable quiet : natural := 0;          -- clocks since the last transfer
        variable cut_left : natural := 0;       -- clocks until the reset
        variable offers, taken, resets : boolean := false;
        -- Before some records the device is given another, with other words, and a reset while it works
        -- on that. Nothing of it may be seen. Not with DUMP.
        variable cut_next : boolean;
        variable cutting : boolean := false;    -- the other record is in: no answer is taken
        variable noise : std_logic_vector(15 downto 0) := x"ace1";
        variable beat : unsigned(4 downto 0) := (others => '0');
        file span_file, span_dump : text;
        variable span_line : count_t := (others => '0');
        variable span_bits : std_logic_vector(SPAN_EXP_BITS - 1 downto 0);
        variable span_want : span_exp_t;
        variable span_held : boolean := false;
        variable span_kept : std_logic_vector(82 downto 0);
        -- Rows of tests that have begun and that no answer has matched yet, each with its line.
        type span_node;
        type span_link is access span_node;
        type span_node is record
            number    : count_t;
            bits      : std_logic_vector(SPAN_EXP_BITS - 1 downto 0);
            following : span_link;
        end record span_node;
        variable span_open, span_last : span_link;
        variable span_ahead : boolean := false;  -- span_bits is of a later test, and not among them
        file sample_file, sample_dump : text;
        variable sample_line : count_t := (others => '0');
        variable sample_bits : std_logic_vector(DEPTH_EXP_BITS - 1 downto 0);
        variable sample_want : depth_exp_t;
        variable sample_held : boolean := false;
        variable sample_kept : std_logic_vector(68 downto 0);
        -- Rows of tests that have begun and that no answer has matched yet, each with its line.
        type sample_node;
        type sample_link is access sample_node;
        type sample_node is record
            number    : count_t;
            bits      : std_logic_vector(DEPTH_EXP_BITS - 1 downto 0);
            following : sample_link;
        end record sample_node;
        variable sample_open, sample_last : sample_link;
        variable sample_ahead : boolean := false;  -- sample_bits is of a later test, and not among them
        file triangle_file, triangle_dump : text;
        variable triangle_line : count_t := (others => '0');
        variable triangle_bits : std_logic_vector(TRIANGLE_EXP_BITS - 1 downto 0);
        variable triangle_want : triangle_exp_t;
        variable triangle_held : boolean := false;
        variable triangle_kept : std_logic_vector(96 downto 0);
        -- Rows of tests that have begun and that no answer has matched yet, each with its line.
        type triangle_node;
        type triangle_link is access triangle_node;
        type triangle_node is record
            number    : count_t;
            bits      : std_logic_vector(TRIANGLE_EXP_BITS - 1 downto 0);
            following : triangle_link;
        end record triangle_node;
        variable triangle_open, triangle_last : triangle_link;
        variable triangle_ahead : boolean := false;  -- triangle_bits is of a later test, and not among them

        procedure mismatch(message : string) is
        begin
            bad := bad + 1;
            if bad <= REPORTED then
                say("MISMATCH triangle " & message);
            end if;
        end procedure mismatch;

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(name : string; number : count_t; field : string; expected, got : std_logic_vector) is
        begin
            if expected /= got then
                mismatch("(" & name & " line " & decimal(number) & ") field " & field);
                if bad <= REPORTED then
                    say("    expected " & to_hstring(expected) & "  " & to_string(expected));
                    say("    got      " & to_hstring(got) & "  " & to_string(got));
                end if;
            end if;
        end procedure compare;

        -- A device that never stops answering must not run for ever.
        procedure extra is
        begin
            extras := extras + 1;
            if extras > MOST_EXTRAS then
                fail("triangle: " & decimal(extras) & " rows too much, " & decimal(cfg_line) & " of "
                    & decimal(TRIANGLE_CFG_ROWS) & " records taken: the device answers without end");
            end if;
        end procedure extra;

        -- Which clocks stall, by the record that is in the device.
        impure function stalls return boolean is
        begin
            case cfg_line(5 downto 4) is
                when "00" => return false;
                when "01" => return beat(0) = '1';
                when "10" => return noise(0) = '1';
                when others => return beat(4) = '1';
            end case;
        end function stalls;

        procedure span_read is
        begin
            next_row(span_file, "span.exp.tv", "00000000_00000_00000_00000", SPAN_EXP_PADS, SPAN_EXP_ROWS, span_line, span_bits);
            span_want := to_span_exp(span_bits);
        end procedure span_read;

        procedure span_judge(number : count_t) is
        begin
            compare("span.exp.tv", number, "test", span_want.test, span_test);
            compare("span.exp.tv", number, "y", span_want.y, span_y);
            compare("span.exp.tv", number, "x_begin", span_want.x_begin, span_x_begin);
            compare("span.exp.tv", number, "x_end", span_want.x_end, span_x_end);
        end procedure span_judge;

        -- The row of this answer's key, wherever it stands among those of its test.
        procedure span_find is
            variable node, before : span_link;
        begin
            loop
                if not span_ahead and span_line < SPAN_EXP_ROWS then
                    span_read;
                    span_ahead := true;
                end if;
                span_want := to_span_exp(span_bits);
                exit when not span_ahead or not (unsigned(span_want.test) <= unsigned(span_test))
                    or not (unsigned(span_test) <= unsigned(cfg.test));
                node := new span_node'(span_line, span_bits, null);
                if span_last = null then
                    span_open := node;
                else
                    span_last.following := node;
                end if;
                span_last := node;
                span_ahead := false;
            end loop;
            node := span_open;
            before := null;
            while node /= null loop
                span_want := to_span_exp(node.bits);
                exit when span_test = span_want.test and span_y = span_want.y and span_x_begin = span_want.x_begin and span_x_end = span_want.x_end;
                before := node;
                node := node.following;
            end loop;
            if node = null then
                mismatch("(span.exp.tv): no row is left with test " & decimal(unsigned(span_test)) & ", y " & decimal(unsigned(span_y)) & ", x_begin " & decimal(unsigned(span_x_begin)) & ", x_end " & decimal(unsigned(span_x_end)));
                extra;
            else
                span_judge(node.number);
                if before = null then
                    span_open := node.following;
                else
                    before.following := node.following;
                end if;
                if node.following = null then
                    span_last := before;
                end if;
                deallocate(node);
            end if;
        end procedure span_find;

        -- An answer that has not been taken stays as it is.
        procedure span_watch is
            variable now : std_logic_vector(82 downto 0);
            variable line_out : line;
        begin
            now := span_test & span_y & span_x_begin & span_x_end;
            if span_held and (span_valid /= '1' or now /= span_kept) then
                mismatch("(span.exp.tv line " & decimal(span_line + 1) & "): an answer changes or goes before it is taken");
            end if;
            span_held := span_valid = '1' and span_ready = '0';
            span_kept := now;
            if span_valid = '1' and span_ready = '1' then
                quiet := 0;
                compared := compared + 1;
                if DUMP then
                    write(line_out, to_hstring(span_test) & "_" & to_hstring(span_y) & "_" & to_hstring(span_x_begin) & "_" & to_hstring(span_x_end));
                    writeline(span_dump, line_out);
                end if;
                if ANY_ORDER then
                    span_find;
                elsif span_line >= SPAN_EXP_ROWS then
                    mismatch("(span.exp.tv): a row too much, " & decimal(cfg_line) & " records are in");
                    extra;
                else
                    span_read;
                    span_judge(span_line);
                end if;
            end if;
        end procedure span_watch;

        procedure sample_read is
        begin
            next_row(sample_file, "depth.exp.tv", "00000000_00000_00000_0", DEPTH_EXP_PADS, DEPTH_EXP_ROWS, sample_line, sample_bits);
            sample_want := to_depth_exp(sample_bits);
        end procedure sample_read;

        procedure sample_judge(number : count_t) is
        begin
            compare("depth.exp.tv", number, "test", sample_want.test, sample_test);
            compare("depth.exp.tv", number, "y", sample_want.y, sample_y);
            compare("depth.exp.tv", number, "x", sample_want.x, sample_x);
            compare("depth.exp.tv", number, "depth", sample_want.depth, sample_depth);
        end procedure sample_judge;

        -- The row of this answer's key, wherever it stands among those of its test.
        procedure sample_find is
            variable node, before : sample_link;
        begin
            loop
                if not sample_ahead and sample_line < DEPTH_EXP_ROWS then
                    sample_read;
                    sample_ahead := true;
                end if;
                sample_want := to_depth_exp(sample_bits);
                exit when not sample_ahead or not (unsigned(sample_want.test) <= unsigned(sample_test))
                    or not (unsigned(sample_test) <= unsigned(cfg.test));
                node := new sample_node'(sample_line, sample_bits, null);
                if sample_last = null then
                    sample_open := node;
                else
                    sample_last.following := node;
                end if;
                sample_last := node;
                sample_ahead := false;
            end loop;
            node := sample_open;
            before := null;
            while node /= null loop
                sample_want := to_depth_exp(node.bits);
                exit when sample_test = sample_want.test and sample_y = sample_want.y and sample_x = sample_want.x;
                before := node;
                node := node.following;
            end loop;
            if node = null then
                mismatch("(depth.exp.tv): no row is left with test " & decimal(unsigned(sample_test)) & ", y " & decimal(unsigned(sample_y)) & ", x " & decimal(unsigned(sample_x)));
                extra;
            else
                sample_judge(node.number);
                if before = null then
                    sample_open := node.following;
                else
                    before.following := node.following;
                end if;
                if node.following = null then
                    sample_last := before;
                end if;
                deallocate(node);
            end if;
        end procedure sample_find;

        -- An answer that has not been taken stays as it is.
        procedure sample_watch is
            variable now : std_logic_vector(68 downto 0);
            variable line_out : line;
        begin
            now := sample_test & sample_y & sample_x & sample_depth;
            if sample_held and (sample_valid /= '1' or now /= sample_kept) then
                mismatch("(depth.exp.tv line " & decimal(sample_line + 1) & "): an answer changes or goes before it is taken");
            end if;
            sample_held := sample_valid = '1' and sample_ready = '0';
            sample_kept := now;
            if sample_valid = '1' and sample_ready = '1' then
                quiet := 0;
                compared := compared + 1;
                if DUMP then
                    write(line_out, to_hstring(sample_test) & "_" & to_hstring(sample_y) & "_" & to_hstring(sample_x) & "_" & to_hstring(sample_depth));
                    writeline(sample_dump, line_out);
                end if;
                if ANY_ORDER then
                    sample_find;
                elsif sample_line >= DEPTH_EXP_ROWS then
                    mismatch("(depth.exp.tv): a row too much, " & decimal(cfg_line) & " records are in");
                    extra;
                else
                    sample_read;
                    sample_judge(sample_line);
                end if;
            end if;
        end procedure sample_watch;

        procedure triangle_read is
        begin
            next_row(triangle_file, "triangle.exp.tv", "00000000_00000000_00000000_00000000_00000000_00000000_00000000_0", TRIANGLE_EXP_PADS, TRIANGLE_EXP_ROWS, triangle_line, triangle_bits);
            triangle_want := to_triangle_exp(triangle_bits);
        end procedure triangle_read;

        procedure triangle_judge(number : count_t) is
        begin
            compare("triangle.exp.tv", number, "test", triangle_want.test, triangle_test);
            compare("triangle.exp.tv", number, "spans", triangle_want.spans, triangle_spans);
            compare("triangle.exp.tv", number, "samples", triangle_want.samples, triangle_samples);
            compare("triangle.exp.tv", number, "zero_area", triangle_want.zero_area, triangle_zero_area);
        end procedure triangle_judge;

        -- The row of this answer's key, wherever it stands among those of its test.
        procedure triangle_find is
            variable node, before : triangle_link;
        begin
            loop
                if not triangle_ahead and triangle_line < TRIANGLE_EXP_ROWS then
                    triangle_read;
                    triangle_ahead := true;
                end if;
                triangle_want := to_triangle_exp(triangle_bits);
                exit when not triangle_ahead or not (unsigned(triangle_want.test) <= unsigned(triangle_test))
                    or not (unsigned(triangle_test) <= unsigned(cfg.test));
                node := new triangle_node'(triangle_line, triangle_bits, null);
                if triangle_last = null then
                    triangle_open := node;
                else
                    triangle_last.following := node;
                end if;
                triangle_last := node;
                triangle_ahead := false;
            end loop;
            node := triangle_open;
            before := null;
            while node /= null loop
                triangle_want := to_triangle_exp(node.bits);
                exit when triangle_test = triangle_want.test;
                before := node;
                node := node.following;
            end loop;
            if node = null then
                mismatch("(triangle.exp.tv): no row is left with test " & decimal(unsigned(triangle_test)));
                extra;
            else
                triangle_judge(node.number);
                if before = null then
                    triangle_open := node.following;
                else
                    before.following := node.following;
                end if;
                if node.following = null then
                    triangle_last := before;
                end if;
                deallocate(node);
            end if;
        end procedure triangle_find;

        -- An answer that has not been taken stays as it is.
        procedure triangle_watch is
            variable now : std_logic_vector(96 downto 0);
            variable line_out : line;
        begin
            now := triangle_test & triangle_spans & triangle_samples & triangle_zero_area;
            if triangle_held and (triangle_valid /= '1' or now /= triangle_kept) then
                mismatch("(triangle.exp.tv line " & decimal(triangle_line + 1) & "): an answer changes or goes before it is taken");
            end if;
            triangle_held := triangle_valid = '1' and triangle_ready = '0';
            triangle_kept := now;
            if triangle_valid = '1' and triangle_ready = '1' then
                quiet := 0;
                compared := compared + 1;
                if DUMP then
                    write(line_out, to_hstring(triangle_test) & "_" & to_hstring(triangle_spans) & "_" & to_hstring(triangle_samples) & "_" & "00000000" & "_" & "00000000" & "_" & "00000000" & "_" & "00000000" & "_" & to_hstring(triangle_zero_area) & "_000000000000000000000000ffffffffffffffffffffffffffffffff0");
                    writeline(triangle_dump, line_out);
                end if;
                if ANY_ORDER then
                    triangle_find;
                elsif triangle_line >= TRIANGLE_EXP_ROWS then
                    mismatch("(triangle.exp.tv): a row too much, " & decimal(cfg_line) & " records are in");
                    extra;
                else
                    triangle_read;
                    triangle_judge(triangle_line);
                end if;
            end if;
        end procedure triangle_watch;
    begin
        open_file(cfg_file, "triangle.cfg.tv");
        open_file(span_file, "span.exp.tv");
        if DUMP then
            file_open(span_dump, "span.exp.dut.tv", write_mode);
        end if;
        open_file(sample_file, "depth.exp.tv");
        if DUMP then
            file_open(sample_dump, "depth.exp.dut.tv", write_mode);
        end if;
        open_file(triangle_file, "triangle.exp.tv");
        if DUMP then
            file_open(triangle_dump, "triangle.exp.dut.tv", write_mode);
        end if;
        for k in 1 to 3 loop
            wait until falling_edge(clk);
        end loop;
        rst <= '0';
        loop
            -- What a rising edge takes.
            wait until rising_edge(clk);
            quiet := quiet + 1;
            if in_valid = '1' and in_ready = '1' then
                taken := true;
                quiet := 0;
            end if;
            if rst = '1' then
                span_held := false;
            else
                span_watch;
            end if;
            if rst = '1' then
                sample_held := false;
            else
                sample_watch;
            end if;
            if rst = '1' then
                triangle_held := false;
            else
                triangle_watch;
            end if;

            wait until falling_edge(clk);
            beat := beat + 1;
            if resets then
                resets := false;
                offers := cutting;
                cfg := to_triangle_cfg(cfg_bits);
                cutting := false;
            elsif cut_left > 0 then
                cut_left := cut_left - 1;
                resets := cut_left = 0;
            elsif taken and cutting then
                cut_left := 1 + to_integer(unsigned(noise(4 downto 0)));
            end if;
            span_ready <= '0' when stalls or cutting else '1';
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            sample_ready <= '0' when stalls or cutting else '1';
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            triangle_ready <= '0' when stalls or cutting else '1';
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            if taken then
                offers := false;
                if not DUMP then
                    -- What stands at the inputs without a valid is nothing.
                    cfg.test := not cfg.test;
                    cfg.edge0_init := not cfg.edge0_init;
                    cfg.edge0_dx := not cfg.edge0_dx;
                    cfg.edge0_dy := not cfg.edge0_dy;
                    cfg.edge1_init := not cfg.edge1_init;
                    cfg.edge1_dx := not cfg.edge1_dx;
                    cfg.edge1_dy := not cfg.edge1_dy;
                    cfg.edge2_init := not cfg.edge2_init;
                    cfg.edge2_dx := not cfg.edge2_dx;
                    cfg.edge2_dy := not cfg.edge2_dy;
                    cfg.depth_init := not cfg.depth_init;
                    cfg.depth_dx := not cfg.depth_dx;
                    cfg.depth_dy := not cfg.depth_dy;
                    cfg.zero_area := not cfg.zero_area;
                    cfg.box_y_begin := not cfg.box_y_begin;
                    cfg.box_y_end := not cfg.box_y_end;
                    cfg.box_x_begin := not cfg.box_x_begin;
                    cfg.box_x_end := not cfg.box_x_end;
                end if;
            end if;
            taken := false;
            cut_next := not DUMP and cfg_line(5 downto 0) = 2 and quiet <= PATIENCE / 2;
            if not offers and not stalls and not cutting and cfg_line < TRIANGLE_CFG_ROWS
                and (not cut_next or (quiet > IDLE and in_ready = '1')) then
                cutting := cut_next;
                next_row(cfg_file, "triangle.cfg.tv", "00000000_00_00_00_00_00_00_00_00_00_00_00_00_0_00000_00000_00000_00000", TRIANGLE_CFG_PADS, TRIANGLE_CFG_ROWS, cfg_line, cfg_bits);
                cfg := to_triangle_cfg(cfg_bits);
                if cutting then
                    cfg.test := not cfg.test;
                    cfg.depth_init := not cfg.depth_init;
                    cfg.depth_dx := not cfg.depth_dx;
                    cfg.depth_dy := not cfg.depth_dy;
                end if;
                offers := true;
            end if;
            -- Some clocks more show what comes too much.
            if quiet > IDLE then
                exit when cfg_line >= TRIANGLE_CFG_ROWS and not offers and not cutting
                    and span_line >= SPAN_EXP_ROWS and not span_ahead and span_open = null and sample_line >= DEPTH_EXP_ROWS and not sample_ahead and sample_open = null and triangle_line >= TRIANGLE_EXP_ROWS and not triangle_ahead and triangle_open = null and not (span_valid = '1' or sample_valid = '1' or triangle_valid = '1');
                if quiet > PATIENCE then
                    if span_open /= null then
                        mismatch("(span.exp.tv line " & decimal(span_open.number)
                            & "): this row and maybe others of the tests so far are missing");
                    end if;
                    if sample_open /= null then
                        mismatch("(depth.exp.tv line " & decimal(sample_open.number)
                            & "): this row and maybe others of the tests so far are missing");
                    end if;
                    if triangle_open /= null then
                        mismatch("(triangle.exp.tv line " & decimal(triangle_open.number)
                            & "): this row and maybe others of the tests so far are missing");
                    end if;
                    fail("triangle: no transfer for " & integer'image(quiet) & " clocks, " & decimal(cfg_line) & " of "
                        & decimal(TRIANGLE_CFG_ROWS) & " records begun: the device hangs, or rows are missing");
                end if;
            end if;
            rst <= '1' when resets else '0';
            in_valid <= '1' when offers else '0';
            test <= cfg.test;
            edge0_init <= cfg.edge0_init;
            edge0_dx <= cfg.edge0_dx;
            edge0_dy <= cfg.edge0_dy;
            edge1_init <= cfg.edge1_init;
            edge1_dx <= cfg.edge1_dx;
            edge1_dy <= cfg.edge1_dy;
            edge2_init <= cfg.edge2_init;
            edge2_dx <= cfg.edge2_dx;
            edge2_dy <= cfg.edge2_dy;
            depth_init <= cfg.depth_init;
            depth_dx <= cfg.depth_dx;
            depth_dy <= cfg.depth_dy;
            zero_area <= cfg.zero_area;
            box_y_begin <= cfg.box_y_begin;
            box_y_end <= cfg.box_y_end;
            box_x_begin <= cfg.box_x_begin;
            box_x_end <= cfg.box_x_end;
        end loop;
        last_row(cfg_file, "triangle.cfg.tv", TRIANGLE_CFG_ROWS, cfg_line);
        last_row(span_file, "span.exp.tv", SPAN_EXP_ROWS, span_line);
        last_row(sample_file, "depth.exp.tv", DEPTH_EXP_ROWS, sample_line);
        last_row(triangle_file, "triangle.exp.tv", TRIANGLE_EXP_ROWS, triangle_line);
        rows <= compared;
        mismatches <= bad;
        done <= true;
        wait;
    end process check;
end architecture bench;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.guardbit_bench.all;

entity tb is
    generic (
        DUMP : boolean := false;
        -- Clocks that the outputs of walks come late.
        LATENCY : natural range 0 to 63 := 0;
        -- Rows of a test in any order, for engines with an order of their own.
        ANY_ORDER : boolean := false
    );
end entity tb;

architecture bench of tb is
    signal clk : std_logic := '0';
    signal dda_done : boolean;
    signal dda_rows, dda_mismatches : count_t;
    signal edge_done : boolean;
    signal edge_rows, edge_mismatches : count_t;
    signal setup_done : boolean;
    signal setup_rows, setup_mismatches : count_t;
    signal triangle_done : boolean;
    signal triangle_rows, triangle_mismatches : count_t;
begin
    dda : entity work.dda_check
        generic map (DUMP => DUMP, LATENCY => LATENCY)
        port map (clk => clk, done => dda_done, rows => dda_rows, mismatches => dda_mismatches);
    edge_v : entity work.edge_check
        generic map (DUMP => DUMP, LATENCY => LATENCY)
        port map (clk => clk, done => edge_done, rows => edge_rows, mismatches => edge_mismatches);
    setup : entity work.setup_check
        generic map (DUMP => DUMP)
        port map (clk => clk, done => setup_done, rows => setup_rows, mismatches => setup_mismatches);
    triangle : entity work.triangle_check
        generic map (DUMP => DUMP, ANY_ORDER => ANY_ORDER)
        port map (clk => clk, done => triangle_done, rows => triangle_rows, mismatches => triangle_mismatches);

    run : process is
    begin
        while not (dda_done and edge_done and setup_done and triangle_done) loop
            clk <= not clk;
            wait for 1 ns;
        end loop;
        if DUMP then
            say("NOTE DUMP: walks do not stall, and nothing is reset in the middle; run the bench without it, too");
        end if;
        if dda_mismatches /= 0 or edge_mismatches /= 0 or setup_mismatches /= 0 or triangle_mismatches /= 0 then
            fail("dda rows=" & decimal(dda_rows) & " edge rows=" & decimal(edge_rows) & " setup rows=" & decimal(setup_rows) & " triangle rows=" & decimal(triangle_rows) & " mismatches=" & decimal(dda_mismatches + edge_mismatches + setup_mismatches + triangle_mismatches) & "");
        end if;
        say("PASS dda rows=" & decimal(dda_rows) & " edge rows=" & decimal(edge_rows) & " setup rows=" & decimal(setup_rows) & " triangle rows=" & decimal(triangle_rows) & "");
        std.env.finish(0);
        wait;
    end process run;
end architecture bench;
