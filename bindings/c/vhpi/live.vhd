-- A device beside the live model in GHDL, clock by clock, with stimulus that no file holds.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use ieee.math_real.all;
use work.guardbit_vhpi.all;

entity live is
    generic (CLOCKS : natural := 20000);
end entity live;

architecture bench of live is
    constant G : natural := 2;
    constant I : natural := 24;
    constant F : natural := 13;
    constant N : natural := G + I + F;
    signal clk : std_logic := '0';
    signal rst : std_logic := '1';
    signal op : std_logic_vector(1 downto 0) := "11";
    signal init, dx, dy, acc : std_logic_vector(N - 1 downto 0) := (others => '0');
    signal out_v : std_logic_vector(I - 1 downto 0);
begin
    device : entity work.dda
        generic map (G => G, I => I, F => F)
        port map (clk => clk, rst => rst, op => op, init => init, dx => dx, dy => dy, acc => acc, out_v => out_v);

    run : process is
        variable seed1, seed2 : positive := 1;
        variable model, walk : integer;
        variable want_acc, want_out, code : word_t;

        impure function random(bits : positive) return std_logic_vector is
            variable value : std_logic_vector(bits - 1 downto 0);
            variable part : real;
        begin
            for k in value'range loop
                uniform(seed1, seed2, part);
                value(k) := '0' when part < 0.5 else '1';
            end loop;
            return value;
        end function random;

        function wide(word : std_logic_vector) return word_t is
        begin
            return std_logic_vector(resize(unsigned(word), 128));
        end function wide;

        procedure tick is
        begin
            wait for 1 ns;
            clk <= '1';
            wait for 1 ns;
            clk <= '0';
            wait for 1 ns;
        end procedure tick;
    begin
        model := guardbit_open(named("sgi-4k"));
        walk := guardbit_walk(model, 0);
        assert model > 0 and walk > 0 report "no model" severity failure;
        tick;
        tick;
        rst <= '0';
        for clock in 0 to CLOCKS - 1 loop
            op <= "00" when clock = 0 else random(2);
            init <= random(N);
            dx <= random(N);
            dy <= random(N);
            wait for 0 ns;
            guardbit_clock_logic(walk, to_integer(unsigned(op)), wide(init), wide(dx), wide(dy), want_acc, want_out);
            tick;
            assert acc = want_acc(N - 1 downto 0) and out_v = want_out(I - 1 downto 0)
                report "MISMATCH clock " & integer'image(clock) & ": expected " & to_hstring(want_acc) & " "
                    & to_hstring(want_out) & ", got " & to_hstring(acc) & " " & to_hstring(out_v)
                severity failure;
        end loop;
        -- The quotient of u/w and 1/w with 8 bits below the binary point each: 124 of 41, 200 of 1/2.
        model := guardbit_open(named("channels.toml"));
        guardbit_divide_logic(
            model, 1, word_t(to_unsigned(5084, 128)), word_t(to_unsigned(10496, 128)), code);
        assert unsigned(code) = 124 report "5084 over 10496 is " & to_hstring(code) severity failure;
        guardbit_divide_logic(model, 1, word_t(to_unsigned(100, 128)), word_t(to_unsigned(128, 128)), code);
        assert unsigned(code) = 200 report "100 over 128 is " & to_hstring(code) severity failure;
        report "PASS clocks=" & integer'image(CLOCKS) severity note;
        std.env.finish(0);
        wait;
    end process run;
end architecture bench;
