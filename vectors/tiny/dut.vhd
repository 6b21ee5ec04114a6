-- guardbit vector set tiny, model version 2: devices, in VHDL-2008, generated.
--
-- Small, synthesizable devices that pass. Put your own entities in their place: same names, same ports,
-- no generics needed.
-- Not checked, setup: the set has no such device in VHDL; tb.sv checks it.
-- Not checked, triangle: the set has no such device in VHDL; tb.sv checks it.
-- Run from inside the set folder:
--     $ ghdl -a --std=08 pkg.vhd dut.vhd tb.vhd && ghdl -e --std=08 tb && ghdl -r --std=08 tb

-- Digital differential analyzer with a guard clamp: an accumulator, two slopes, and a read-out of
-- the integer bits. The accumulator wraps; only SATURATE writes the clamp back to it.
-- Spec: words W, walks D, guard clamp G.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity dda is
    generic (
        G    : natural := 1;   -- guard bits
        I    : natural := 3;  -- integer bits, the width of the read-out
        F    : natural := 3;  -- interpolation bits
        MODE : natural := 1    -- read-out: 0 wrap, 1 guard, 2 sign, 3 saturate
    );
    port (
        clk   : in  std_logic;
        rst   : in  std_logic;
        op    : in  std_logic_vector(1 downto 0);  -- 0 load, 1 step by dx, 2 step by dy, 3 hold
        init  : in  std_logic_vector(G + I + F - 1 downto 0);
        dx    : in  std_logic_vector(G + I + F - 1 downto 0);
        dy    : in  std_logic_vector(G + I + F - 1 downto 0);
        acc   : out std_logic_vector(G + I + F - 1 downto 0);  -- state after the clock edge
        out_v : out std_logic_vector(I - 1 downto 0)
    );
end entity dda;

architecture rtl of dda is
    constant GUARD : natural := 1;
    constant SIGN : natural := 2;
    constant SATURATE : natural := 3;
    constant N : natural := G + I + F;
    -- Two bits more than the accumulator hold any sum of it and a signed step.
    subtype sum_t is signed(N + 1 downto 0);
    constant LIMIT : sum_t := shift_left(to_signed(1, N + 2), I + F);
    -- The guard and integer bits as a pattern, one bit more for the bounds. GUARD splits the
    -- patterns above the integer range in the middle: the lower half has come from above, the
    -- upper from below.
    subtype pattern_t is unsigned(G + I downto 0);
    constant ONE : pattern_t := to_unsigned(1, G + I + 1);
    constant WHOLE : pattern_t := shift_left(ONE, I);
    constant MIDDLE : pattern_t := shift_left(ONE, G + I - 1) + shift_left(ONE, I - 1);
    signal state : unsigned(N - 1 downto 0) := (others => '0');
begin
    step : process (clk) is
        variable sum : sum_t;
    begin
        if rising_edge(clk) then
            sum := signed("00" & state);
            case op is
                when "00" =>
                    sum := resize(signed(init), N + 2);
                    if G = 0 then
                        sum := signed("00" & init);
                    end if;
                when "01" => sum := sum + signed(dx);
                when "10" => sum := sum + signed(dy);
                when others => null;
            end case;
            if MODE = SATURATE and sum < 0 then
                sum := (others => '0');
            elsif MODE = SATURATE and sum >= LIMIT then
                sum := LIMIT - 1;
            end if;
            if rst = '1' then
                state <= (others => '0');
            else
                state <= unsigned(sum(N - 1 downto 0));
            end if;
        end if;
    end process step;

    read_out : process (all) is
        variable u : pattern_t;
    begin
        u := '0' & state(N - 1 downto F);
        out_v <= std_logic_vector(u(I - 1 downto 0));
        if MODE = GUARD and u >= MIDDLE and u >= WHOLE then
            out_v <= (others => '0');
        elsif MODE = SIGN and state(N - 1) = '1' then
            out_v <= (others => '0');
        elsif (MODE = GUARD or MODE = SIGN) and u >= WHOLE then
            out_v <= (others => '1');
        end if;
    end process read_out;

    acc <= std_logic_vector(state);
end architecture rtl;

-- Edge function stepper: a word and its two steps; inside is a clear sign bit. Spec: edges E and C.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity edge_stepper is
    generic (
        M    : natural := 6   -- bits of an edge word
    );
    port (
        clk  : in  std_logic;
        rst  : in  std_logic;
        op   : in  std_logic_vector(1 downto 0);  -- 0 load, 1 step by ea, 2 step by eb, 3 hold
        e0   : in  std_logic_vector(M - 1 downto 0);
        ea   : in  std_logic_vector(M - 1 downto 0);
        eb   : in  std_logic_vector(M - 1 downto 0);
        e    : out std_logic_vector(M - 1 downto 0);  -- state after the clock edge
        in_v : out std_logic
    );
end entity edge_stepper;

architecture rtl of edge_stepper is
    signal state : unsigned(M - 1 downto 0) := (others => '0');
begin
    step : process (clk) is
    begin
        if rising_edge(clk) then
            if rst = '1' then
                state <= (others => '0');
            else
                case op is
                    when "00" => state <= unsigned(e0);
                    when "01" => state <= state + unsigned(ea);
                    when "10" => state <= state + unsigned(eb);
                    when others => null;
                end case;
            end if;
        end if;
    end process step;

    e <= std_logic_vector(state);
    in_v <= not state(M - 1);
end architecture rtl;
