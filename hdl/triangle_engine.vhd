-- A small triangle engine: set-up words and a box in, one triangle at a time; covered runs, depths
-- of covered samples and a summary out, each a valid/ready stream of its own. One sample in each clock.
-- Spec: coverage C, depth P and G, vectors N.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity triangle_engine is
    generic (
        M    : natural := 35;  -- bits of an edge word
        G    : natural := 1;   -- guard bits
        I    : natural := 24;  -- depth bits
        F    : natural := 13;  -- interpolation bits
        MODE : natural := 1;   -- read-out, as dda has it; not saturate
        C    : natural := 17   -- bits of a pixel coordinate
    );
    port (
        clk       : in  std_logic;
        rst       : in  std_logic;
        in_valid  : in  std_logic;
        in_ready  : out std_logic;
        test      : in  std_logic_vector(31 downto 0);
        edge0_init, edge0_dx, edge0_dy : in std_logic_vector(M - 1 downto 0);
        edge1_init, edge1_dx, edge1_dy : in std_logic_vector(M - 1 downto 0);
        edge2_init, edge2_dx, edge2_dy : in std_logic_vector(M - 1 downto 0);
        depth_init, depth_dx, depth_dy : in std_logic_vector(G + I + F - 1 downto 0);
        zero_area : in  std_logic;
        -- Half open.
        box_y_begin, box_y_end, box_x_begin, box_x_end : in std_logic_vector(C - 1 downto 0);
        -- Maximal runs of covered samples, half open, in the order of y then x.
        span_valid : out std_logic;
        span_ready : in  std_logic;
        span_test : out std_logic_vector(31 downto 0);
        span_y, span_x_begin, span_x_end : out std_logic_vector(C - 1 downto 0);
        -- Covered samples.
        sample_valid : out std_logic;
        sample_ready : in  std_logic;
        sample_test : out std_logic_vector(31 downto 0);
        sample_y, sample_x : out std_logic_vector(C - 1 downto 0);
        sample_depth : out std_logic_vector(I - 1 downto 0);
        -- One a triangle, when the rest of it has been taken.
        triangle_valid : out std_logic;
        triangle_ready : in  std_logic;
        triangle_test, triangle_spans, triangle_samples : out std_logic_vector(31 downto 0);
        triangle_zero_area : out std_logic
    );
end entity triangle_engine;

architecture rtl of triangle_engine is
    constant N : natural := G + I + F;
    type state_t is (IDLE, CORNER, RUN, FINISHED);
    subtype edge_t is unsigned(M - 1 downto 0);
    type edges_t is array (0 to 2) of edge_t;
    subtype place_t is unsigned(C - 1 downto 0);
    subtype depth_t is unsigned(N - 1 downto 0);

    -- A word at the corner of the box, mod 2^bits as everything else.
    function at_corner(start, slope_x, slope_y : unsigned; x, y : place_t) return unsigned is
        constant BITS : natural := start'length;
        variable across, down : unsigned(BITS + C - 1 downto 0);
    begin
        across := slope_x * x;
        down := slope_y * y;
        return start + across(BITS - 1 downto 0) + down(BITS - 1 downto 0);
    end function at_corner;

    signal state : state_t := IDLE;
    signal name : std_logic_vector(31 downto 0) := (others => '0');
    -- The word at this sample, that at the row's first sample, and its steps.
    signal here, row, a, b : edges_t := (others => (others => '0'));
    signal depth_row, slope_x, slope_y : depth_t := (others => '0');
    signal nothing : std_logic := '0';
    signal left, right, bottom, x, y, first : place_t := (others => '0');
    signal in_run : boolean := false;    -- samples since first are covered
    signal spans, samples : unsigned(31 downto 0) := (others => '0');

    signal at_end, covered, closes, moves, last_row : boolean;
    signal op : std_logic_vector(1 downto 0);
    signal loaded : depth_t;
begin
    at_end <= x = right;
    covered <= state = RUN and not at_end and (here(0)(M - 1) or here(1)(M - 1) or here(2)(M - 1)) = '0';
    closes <= state = RUN and in_run and not covered;
    moves <= state = RUN and not (covered and sample_ready = '0') and not (closes and span_ready = '0');
    last_row <= ('0' & y) + 1 >= bottom;

    -- The depth along a row; a row begins with a load.
    loaded <= at_corner(depth_row, slope_x, slope_y, left, y) when state = CORNER else depth_row + slope_y;
    op <= "00" when state = CORNER or (moves and at_end) else "01" when moves else "11";
    depth : entity work.dda
        generic map (G => G, I => I, F => F, MODE => MODE)
        port map (clk => clk, rst => rst, op => op, init => std_logic_vector(loaded),
            dx => std_logic_vector(slope_x), dy => std_logic_vector(slope_y), acc => open, out_v => sample_depth);

    in_ready <= '1' when state = IDLE else '0';
    span_valid <= '1' when closes else '0';
    span_test <= name;
    span_y <= std_logic_vector(y);
    span_x_begin <= std_logic_vector(first);
    span_x_end <= std_logic_vector(x);
    sample_valid <= '1' when covered else '0';
    sample_test <= name;
    sample_y <= std_logic_vector(y);
    sample_x <= std_logic_vector(x);
    triangle_valid <= '1' when state = FINISHED else '0';
    triangle_test <= name;
    triangle_spans <= std_logic_vector(spans);
    triangle_samples <= std_logic_vector(samples);
    triangle_zero_area <= nothing;

    control : process (clk) is
        variable word : edge_t;
    begin
        if rising_edge(clk) then
            if rst = '1' then
                state <= IDLE;
                in_run <= false;
            else
                case state is
                    when IDLE =>
                        if in_valid = '1' then
                            name <= test;
                            row <= (unsigned(edge0_init), unsigned(edge1_init), unsigned(edge2_init));
                            a <= (unsigned(edge0_dx), unsigned(edge1_dx), unsigned(edge2_dx));
                            b <= (unsigned(edge0_dy), unsigned(edge1_dy), unsigned(edge2_dy));
                            depth_row <= unsigned(depth_init);
                            slope_x <= unsigned(depth_dx);
                            slope_y <= unsigned(depth_dy);
                            nothing <= zero_area;
                            left <= unsigned(box_x_begin);
                            right <= unsigned(box_x_end);
                            bottom <= unsigned(box_y_end);
                            x <= unsigned(box_x_begin);
                            y <= unsigned(box_y_begin);
                            spans <= (others => '0');
                            samples <= (others => '0');
                            in_run <= false;
                            state <= CORNER;
                        end if;
                    when CORNER =>
                        for k in 0 to 2 loop
                            word := at_corner(row(k), a(k), b(k), left, y);
                            here(k) <= word;
                            row(k) <= word;
                        end loop;
                        depth_row <= loaded;
                        state <= RUN;
                        if nothing = '1' or left >= right or y >= bottom then
                            state <= FINISHED;
                        end if;
                    when RUN =>
                        if moves then
                            if covered then
                                samples <= samples + 1;
                                if not in_run then
                                    first <= x;
                                end if;
                            end if;
                            in_run <= covered;
                            if closes then
                                spans <= spans + 1;
                            end if;
                            if at_end then
                                for k in 0 to 2 loop
                                    here(k) <= row(k) + b(k);
                                    row(k) <= row(k) + b(k);
                                end loop;
                                depth_row <= loaded;
                                x <= left;
                                y <= y + 1;
                                if last_row then
                                    state <= FINISHED;
                                end if;
                            else
                                for k in 0 to 2 loop
                                    here(k) <= here(k) + a(k);
                                end loop;
                                x <= x + 1;
                            end if;
                        end if;
                    when FINISHED =>
                        if triangle_ready = '1' then
                            state <= IDLE;
                        end if;
                end case;
            end if;
        end if;
    end process control;
end architecture rtl;
