-- Set-up divider: a signed numerator over a positive divisor, rounded once; one quotient bit in each clock.
-- Spec: planes P and rounding R.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity setup_divider is
    generic (
        NW       : positive := 100;  -- bits of the numerator and of the quotient
        DW       : positive := 50;   -- bits of the divisor
        ROUNDING : natural := 4      -- one of the codes below
    );
    port (
        clk       : in  std_logic;
        rst       : in  std_logic;
        start     : in  std_logic;   -- takes the operands; ignored while busy
        numerator : in  signed(NW - 1 downto 0);
        divisor   : in  unsigned(DW - 1 downto 0);
        busy      : out std_logic;
        quotient  : out signed(NW - 1 downto 0)  -- valid when not busy
    );
end entity setup_divider;

architecture rtl of setup_divider is
    constant FLOOR : natural := 0;
    constant CEILING : natural := 1;
    constant TOWARD_ZERO : natural := 2;
    constant AWAY_FROM_ZERO : natural := 3;
    -- To the nearest; a tie goes where the name says.
    constant NEAREST_EVEN : natural := 4;
    constant NEAREST_UP : natural := 5;
    constant NEAREST_DOWN : natural := 6;
    constant NEAREST_AWAY : natural := 7;
    constant NEAREST_TOWARD_ZERO : natural := 8;
    constant ODD : natural := 9;     -- to the odd neighbour if inexact
    -- Magnitudes are divided: |n| = q d + r. The sign says what rounding does to q.
    signal q : unsigned(NW - 1 downto 0) := (others => '0');  -- numerator shifting out, quotient shifting in
    signal r : unsigned(DW downto 0) := (others => '0');
    signal d : unsigned(DW - 1 downto 0) := (others => '0');
    signal negative : boolean := false;
    signal left : natural range 0 to NW := 0;
begin
    step : process (clk) is
        variable shifted : unsigned(DW downto 0);
    begin
        if rising_edge(clk) then
            if rst = '1' then
                left <= 0;
            elsif left /= 0 then
                shifted := r(DW - 1 downto 0) & q(NW - 1);
                if shifted >= d then
                    r <= shifted - d;
                    q <= q(NW - 2 downto 0) & '1';
                else
                    r <= shifted;
                    q <= q(NW - 2 downto 0) & '0';
                end if;
                left <= left - 1;
            elsif start = '1' then
                negative <= numerator < 0;
                q <= unsigned(abs numerator);
                r <= (others => '0');
                d <= divisor;
                left <= NW;
            end if;
        end if;
    end process step;

    busy <= '1' when left /= 0 else '0';

    -- Rounded when it stands: nothing behind the registers moves while they work.
    round : process (all) is
        variable inexact, over, tie, is_odd, up : boolean;
        variable twice : unsigned(DW + 1 downto 0);
        variable rounded : unsigned(NW - 1 downto 0);
    begin
        quotient <= (others => '0');
        if left = 0 then
            inexact := r /= 0;
            twice := r & '0';
            over := twice > d;
            tie := twice = d;
            is_odd := q(0) = '1';
            case ROUNDING is
                when FLOOR => up := inexact and negative;
                when CEILING => up := inexact and not negative;
                when AWAY_FROM_ZERO => up := inexact;
                when NEAREST_EVEN => up := over or (tie and is_odd);
                when NEAREST_UP => up := over or (tie and not negative);
                when NEAREST_DOWN => up := over or (tie and negative);
                when NEAREST_AWAY => up := over or tie;
                when NEAREST_TOWARD_ZERO => up := over;
                when ODD => up := inexact and not is_odd;
                when others => up := false;
            end case;
            rounded := q;
            if up then
                rounded := q + 1;
            end if;
            quotient <= signed(rounded);
            if negative then
                quotient <= -signed(rounded);
            end if;
        end if;
    end process round;
end architecture rtl;
