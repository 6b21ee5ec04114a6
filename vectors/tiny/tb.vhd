-- guardbit vector set tiny, model version 2: VHDL-2008 testbench, generated.
--
-- Drives the devices of dut.vhd (replace them with yours, same ports) with the set beside this
-- file and compares every row.
-- Not checked, setup: the set has no such device in VHDL; tb.sv checks it.
-- Not checked, triangle: the set has no such device in VHDL; tb.sv checks it.
-- Run from inside the set folder:
--     $ ghdl -a --std=08 pkg.vhd dut.vhd tb.vhd && ghdl -e --std=08 tb && ghdl -r --std=08 tb
-- It ends with a PASS line, or with a FAIL line and a non-zero exit status. More, after tb: -gDUMP=true
-- writes what the devices answer to *.exp.dut.tv, for `guardbit verify --dut`; --vcd=FILE writes waves.
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
-- With DUMP it does not stall: rows are then those of the files.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity dda_check is
    generic (DUMP : boolean);
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

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(field : string; expected, got : std_logic_vector; expected_bits, got_bits : string) is
        begin
            if expected /= got then
                bad := bad + 1;
                if bad <= REPORTED then
                    say("MISMATCH dda walk " & decimal(walk - 1) & " row " & decimal(row) & " (dda.exp.tv line "
                        & decimal(exp_line) & ", op " & to_hstring(want.op) & ") field " & field);
                    say("    expected " & to_hstring(expected) & "  " & expected_bits);
                    say("    got      " & to_hstring(got) & "  " & got_bits);
                end if;
            end if;
        end procedure compare;
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
            elsif walk = 0 then
                fail("dda.exp.tv line 1: the first row is not a load");
            else
                row := row + 1;
            end if;
            op <= want.op;
            wait until falling_edge(clk);
            compare("acc", want.acc, acc, to_string(want.acc(6 downto 6)) & "." & to_string(want.acc(5 downto 3)) & "." & to_string(want.acc(2 downto 0)), to_string(acc(6 downto 6)) & "." & to_string(acc(5 downto 3)) & "." & to_string(acc(2 downto 0)));
            compare("out", want.out_v, out_v, to_string(want.out_v), to_string(out_v));
            if DUMP then
                write(dump_line, to_hstring(op) & "_" & to_hstring(acc) & "_" & to_hstring(out_v));
                writeline(dump_file, dump_line);
            end if;
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            -- One row in 32 stalls, for one to eight clocks.
            if not DUMP and unsigned(noise(4 downto 0)) = 0 then
                op <= OP_HOLD;
                init <= not init;
                dx <= not dx;
                dy <= not dy;
                for k in 0 to to_integer(unsigned(noise(7 downto 5))) loop
                    wait until falling_edge(clk);
                    compare("acc", want.acc, acc, to_string(want.acc(6 downto 6)) & "." & to_string(want.acc(5 downto 3)) & "." & to_string(want.acc(2 downto 0)), to_string(acc(6 downto 6)) & "." & to_string(acc(5 downto 3)) & "." & to_string(acc(2 downto 0)));
                    compare("out", want.out_v, out_v, to_string(want.out_v), to_string(out_v));
                end loop;
                init <= cfg.init;
                dx <= cfg.dx;
                dy <= cfg.dy;
            end if;
        end loop;
        last_row(exp_file, "dda.exp.tv", DDA_EXP_ROWS, exp_line);
        last_row(cfg_file, "dda.cfg.tv", DDA_CFG_ROWS, cfg_line);
        op <= OP_HOLD;
        rows <= exp_line;
        mismatches <= bad;
        done <= true;
        wait;
    end process check;
end architecture bench;

-- Drives edge_stepper with edge.cfg.tv and compares every row of edge.exp.tv. Inputs change and
-- outputs are compared at the falling edge; the device works at the rising edge. Now and then the
-- bench stalls: it holds for some clocks, with other slopes at the inputs, and nothing may change.
-- With DUMP it does not stall: rows are then those of the files.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.guardbit_pkg.all;
use work.guardbit_bench.all;

entity edge_check is
    generic (DUMP : boolean);
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

        -- Compared bit for bit, so that U, X and Z of the device are mismatches.
        procedure compare(field : string; expected, got : std_logic_vector; expected_bits, got_bits : string) is
        begin
            if expected /= got then
                bad := bad + 1;
                if bad <= REPORTED then
                    say("MISMATCH edge walk " & decimal(walk - 1) & " row " & decimal(row) & " (edge.exp.tv line "
                        & decimal(exp_line) & ", op " & to_hstring(want.op) & ") field " & field);
                    say("    expected " & to_hstring(expected) & "  " & expected_bits);
                    say("    got      " & to_hstring(got) & "  " & got_bits);
                end if;
            end if;
        end procedure compare;
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
            elsif walk = 0 then
                fail("edge.exp.tv line 1: the first row is not a load");
            else
                row := row + 1;
            end if;
            op <= want.op;
            wait until falling_edge(clk);
            compare("e", want.e, e, to_string(want.e(5 downto 0)), to_string(e(5 downto 0)));
            compare("in", want.in_v, in_v, to_string(want.in_v), to_string(in_v));
            if DUMP then
                write(dump_line, to_hstring(op) & "_" & to_hstring(e) & "_" & to_hstring(in_v));
                writeline(dump_file, dump_line);
            end if;
            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
            -- One row in 32 stalls, for one to eight clocks.
            if not DUMP and unsigned(noise(4 downto 0)) = 0 then
                op <= OP_HOLD;
                e0 <= not e0;
                ea <= not ea;
                eb <= not eb;
                for k in 0 to to_integer(unsigned(noise(7 downto 5))) loop
                    wait until falling_edge(clk);
                    compare("e", want.e, e, to_string(want.e(5 downto 0)), to_string(e(5 downto 0)));
                    compare("in", want.in_v, in_v, to_string(want.in_v), to_string(in_v));
                end loop;
                e0 <= cfg.e0;
                ea <= cfg.ea;
                eb <= cfg.eb;
            end if;
        end loop;
        last_row(exp_file, "edge.exp.tv", EDGE_EXP_ROWS, exp_line);
        last_row(cfg_file, "edge.cfg.tv", EDGE_CFG_ROWS, cfg_line);
        op <= OP_HOLD;
        rows <= exp_line;
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
    generic (DUMP : boolean := false);
end entity tb;

architecture bench of tb is
    signal clk : std_logic := '0';
    signal dda_done : boolean;
    signal dda_rows, dda_mismatches : count_t;
    signal edge_done : boolean;
    signal edge_rows, edge_mismatches : count_t;
begin
    dda : entity work.dda_check
        generic map (DUMP => DUMP)
        port map (clk => clk, done => dda_done, rows => dda_rows, mismatches => dda_mismatches);
    edge_v : entity work.edge_check
        generic map (DUMP => DUMP)
        port map (clk => clk, done => edge_done, rows => edge_rows, mismatches => edge_mismatches);

    run : process is
    begin
        while not (dda_done and edge_done) loop
            clk <= not clk;
            wait for 1 ns;
        end loop;
        say("NOT CHECKED setup: the set has no such device in VHDL; tb.sv checks it");
        say("NOT CHECKED triangle: the set has no such device in VHDL; tb.sv checks it");
        if dda_mismatches /= 0 or edge_mismatches /= 0 then
            fail("dda rows=" & decimal(dda_rows) & " edge rows=" & decimal(edge_rows) & " mismatches=" & decimal(dda_mismatches + edge_mismatches) & " not checked: setup triangle");
        end if;
        say("PASS dda rows=" & decimal(dda_rows) & " edge rows=" & decimal(edge_rows) & " not checked: setup triangle");
        std.env.finish(0);
        wait;
    end process run;
end architecture bench;
