-- Edge function stepper: a word and its two steps; inside is a clear sign bit. Spec: edges E and C.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity edge_stepper is
    generic (
        M    : natural := 35   -- bits of an edge word
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
