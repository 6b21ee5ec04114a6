-- guardbit vector set tiny, model version 1: devices that pass, in VHDL-2008, generated.
--
-- Small, synthesizable and plain. Put your own entities in their place: same names, same ports,
-- no generics needed. Run from inside the set folder:
--     $ ghdl -a --std=08 pkg.vhd dut.vhd tb.vhd && ghdl -e --std=08 tb && ghdl -r --std=08 tb

-- Walks a plane: start, then steps of dx or dy, with a read-out of the integer bits that the
-- guard bits clamp. The accumulator wraps; only CLAMP_SATURATE writes the clamp back to it.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.guardbit_pkg.all;

entity dda is
    generic (
        G    : natural  := GUARD_BITS;
        I    : positive := INTEGER_BITS;
        F    : natural  := FRACTION_BITS;
        MODE : clamp_t  := CLAMP_MODE
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
    constant N : positive := G + I + F;
    -- Two bits more than the accumulator hold any sum of it and a signed step.
    subtype sum_t is signed(N + 1 downto 0);
    constant LIMIT : sum_t := shift_left(to_signed(1, N + 2), I + F);
    -- The guard and integer bits as a pattern, one bit more for the bounds. CLAMP_GUARD splits the
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
                when OP_LOAD =>
                    sum := resize(signed(init), N + 2);
                    if G = 0 then
                        sum := signed("00" & init);
                    end if;
                when OP_STEP_X => sum := sum + signed(dx);
                when OP_STEP_Y => sum := sum + signed(dy);
                when others => null;
            end case;
            if MODE = CLAMP_SATURATE and sum < 0 then
                sum := (others => '0');
            elsif MODE = CLAMP_SATURATE and sum >= LIMIT then
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
        if MODE = CLAMP_GUARD and u >= MIDDLE and u >= WHOLE then
            out_v <= (others => '0');
        elsif MODE = CLAMP_SIGN and state(N - 1) = '1' then
            out_v <= (others => '0');
        elsif (MODE = CLAMP_GUARD or MODE = CLAMP_SIGN) and u >= WHOLE then
            out_v <= (others => '1');
        end if;
    end process read_out;

    acc <= std_logic_vector(state);
end architecture rtl;

-- Walks an edge function: start, then steps of its two coefficients; inside is a clear sign bit.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.guardbit_pkg.all;

entity edge_stepper is
    generic (M : positive := EDGE_EXP_E_WIDTH);
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
                    when OP_LOAD => state <= unsigned(e0);
                    when OP_STEP_X => state <= state + unsigned(ea);
                    when OP_STEP_Y => state <= state + unsigned(eb);
                    when others => null;
                end case;
            end if;
        end if;
    end process step;

    e <= std_logic_vector(state);
    in_v <= not state(M - 1);
end architecture rtl;
