-- guardbit vector set tiny, model version 2: devices, in VHDL-2008, generated.
--
-- Small, synthesizable devices that pass. Put your own entities in their place: same names, same ports,
-- no generics needed.
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

-- Triangle set-up: three vertices in, edge words and a depth plane at pixel (0, 0) out.
-- Spec: triangles T, edges E and C, planes P.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity triangle_setup is
    generic (
        VW   : natural := 4;      -- bits of a vertex coordinate
        VS   : natural := 0;       -- 1 where coordinates are signed
        S    : natural := 1;      -- sub-pixel bits
        SAMPLE_X : natural := 1;  -- the sample in its pixel, in sub-pixels
        SAMPLE_Y : natural := 1;
        RULE : natural := 0;       -- 0 top-left, 1 shadow
        SHIFT : natural := 1;     -- low bits of an edge value that are not kept: 0 or S
        M    : natural := 6;      -- bits of an edge word
        G    : natural := 1;       -- guard bits
        I    : natural := 3;      -- depth bits
        F    : natural := 3;      -- interpolation bits
        ROUNDING : natural := 4;   -- as setup_divider has it
        HALF : natural := 0        -- 1 where the start gains half a depth step
    );
    port (
        clk       : in  std_logic;
        rst       : in  std_logic;
        in_valid  : in  std_logic;
        in_ready  : out std_logic;
        v0_x, v0_y, v1_x, v1_y, v2_x, v2_y : in std_logic_vector(VW - 1 downto 0);
        v0_z, v1_z, v2_z : in std_logic_vector(I - 1 downto 0);
        out_valid : out std_logic;
        out_ready : in  std_logic;
        o_edge0_init, o_edge0_dx, o_edge0_dy : out std_logic_vector(M - 1 downto 0);
        o_edge1_init, o_edge1_dx, o_edge1_dy : out std_logic_vector(M - 1 downto 0);
        o_edge2_init, o_edge2_dx, o_edge2_dy : out std_logic_vector(M - 1 downto 0);
        o_depth_init, o_depth_dx, o_depth_dy : out std_logic_vector(G + I + F - 1 downto 0);
        o_zero_area : out std_logic
    );
end entity triangle_setup;

architecture rtl of triangle_setup is
    constant N : natural := G + I + F;
    constant D : natural := VW + 2;            -- a coordinate, a sample's offset, their difference
    constant P : natural := 2 * D + 2;         -- a product of two of them, a sum of four
    constant NX : natural := I + D + 2;        -- a numerator of a slope
    constant NZ : natural := I + P + 3;        -- that of the start
    constant ZW : natural := NZ + F;           -- the same, scaled
    constant SW : natural := NX + S + F;

    subtype coordinate_t is signed(D - 1 downto 0);
    subtype depth_t is signed(I downto 0);
    type vertex_t is record
        x, y : coordinate_t;
        z    : depth_t;
    end record vertex_t;
    type vertices_t is array (0 to 2) of vertex_t;
    type words_t is array (0 to 2) of std_logic_vector(M - 1 downto 0);

    -- The low bits, or copies of the sign above: mod 2^bits, which resize of a shorter word is not.
    function fit(value : signed; bits : natural) return signed is
        alias word : signed(value'length - 1 downto 0) is value;
    begin
        if bits > value'length then
            return resize(value, bits);
        end if;
        return word(bits - 1 downto 0);
    end function fit;

    function coordinate(v : std_logic_vector) return coordinate_t is
    begin
        if VS = 1 then
            return resize(signed(v), D);
        end if;
        return signed(resize(unsigned(v), D));
    end function coordinate;

    function vertex(x, y, z : std_logic_vector) return vertex_t is
    begin
        return (coordinate(x), coordinate(y), signed('0' & z));
    end function vertex;

    -- E at the sample of pixel (0, 0), less one unless the edge owns its samples.
    function edge_value(a, b : vertex_t) return std_logic_vector is
        variable ex, ey : coordinate_t;
        variable e : signed(P - 1 downto 0);
        variable owns : boolean;
    begin
        ex := b.x - a.x;
        ey := b.y - a.y;
        e := resize(ex * (SAMPLE_Y - a.y), P) - resize(ey * (SAMPLE_X - a.x), P);
        if RULE = 0 then
            owns := ey < 0 or (ey = 0 and ex > 0);
        else
            owns := ey > 0 or (ey = 0 and ex > 0);
        end if;
        if not owns then
            e := e - 1;
        end if;
        return std_logic_vector(fit(shift_right(e, SHIFT), M));
    end function edge_value;

    function step(to_here, from : coordinate_t) return std_logic_vector is
    begin
        return std_logic_vector(shift_left(fit(to_here - from, M), S - SHIFT));
    end function step;

    -- Vertices are held while the dividers work.
    signal v : vertices_t := (others => ((others => '0'), (others => '0'), (others => '0')));
    signal held, going : std_logic := '0';

    signal e_init, e_dx, e_dy : words_t := (others => (others => '0'));
    signal area : unsigned(P - 1 downto 0) := (others => '0');
    signal flat : boolean := true;
    signal gx, gy : signed(NX - 1 downto 0) := (others => '0');
    signal gz : signed(NZ - 1 downto 0) := (others => '0');
    signal numerator_z, start : signed(ZW - 1 downto 0);
    signal numerator_x, numerator_y, slope_x, slope_y : signed(SW - 1 downto 0);
    signal go : std_logic;
    signal busy : std_logic_vector(2 downto 0);

    -- A triangle of no area has no words.
    function alive(word : std_logic_vector; without_area : boolean) return std_logic_vector is
        constant NOTHING : std_logic_vector(word'range) := (others => '0');
    begin
        if without_area then
            return NOTHING;
        end if;
        return word;
    end function alive;

    function bias return signed is
    begin
        if HALF = 1 and F > 0 then
            return shift_left(to_signed(1, ZW), F - 1);
        end if;
        return to_signed(0, ZW);
    end function bias;
begin
    numerators : process (v) is
        variable area2 : signed(P - 1 downto 0);
        variable a, b, c : vertex_t;
        variable zab, zac : signed(I + 1 downto 0);
        variable slope_numerator_x, slope_numerator_y : signed(NX - 1 downto 0);
        variable weight : coordinate_t;
    begin
        -- Twice the area, and the order of vertices that makes it positive.
        area2 := resize((v(1).x - v(0).x) * (v(2).y - v(0).y), P) - resize((v(2).x - v(0).x) * (v(1).y - v(0).y), P);
        a := v(0);
        b := v(1);
        c := v(2);
        if area2 < 0 then
            b := v(2);
            c := v(1);
        end if;
        area2 := abs area2;
        area <= unsigned(area2);
        flat <= area2 = 0;
        e_init <= (edge_value(a, b), edge_value(b, c), edge_value(c, a));
        e_dx <= (step(a.y, b.y), step(b.y, c.y), step(c.y, a.y));
        e_dy <= (step(b.x, a.x), step(c.x, b.x), step(a.x, c.x));

        -- The plane's numerators over twice the area.
        zab := resize(b.z, I + 2) - a.z;
        zac := resize(c.z, I + 2) - a.z;
        slope_numerator_x := fit(zab * (c.y - a.y) - zac * (b.y - a.y), NX);
        slope_numerator_y := fit(zac * (b.x - a.x) - zab * (c.x - a.x), NX);
        gx <= slope_numerator_x;
        gy <= slope_numerator_y;
        weight := SAMPLE_X - a.x;
        gz <= fit(a.z * area2, NZ) + fit(slope_numerator_x * weight, NZ) + fit(slope_numerator_y * (SAMPLE_Y - a.y), NZ);
    end process numerators;

    go <= held and not going;
    numerator_z <= shift_left(resize(gz, ZW), F);
    numerator_x <= shift_left(resize(gx, SW), S + F);
    numerator_y <= shift_left(resize(gy, SW), S + F);
    divide_z : entity work.setup_divider
        generic map (NW => ZW, DW => P, ROUNDING => ROUNDING)
        port map (clk => clk, rst => rst, start => go, numerator => numerator_z, divisor => area,
            busy => busy(0), quotient => start);
    divide_x : entity work.setup_divider
        generic map (NW => SW, DW => P, ROUNDING => ROUNDING)
        port map (clk => clk, rst => rst, start => go, numerator => numerator_x, divisor => area,
            busy => busy(1), quotient => slope_x);
    divide_y : entity work.setup_divider
        generic map (NW => SW, DW => P, ROUNDING => ROUNDING)
        port map (clk => clk, rst => rst, start => go, numerator => numerator_y, divisor => area,
            busy => busy(2), quotient => slope_y);

    in_ready <= not held;
    out_valid <= '1' when held = '1' and going = '1' and busy = "000" else '0';

    control : process (clk) is
    begin
        if rising_edge(clk) then
            if rst = '1' then
                held <= '0';
                going <= '0';
            elsif held = '0' then
                if in_valid = '1' then
                    held <= '1';
                    v <= (vertex(v0_x, v0_y, v0_z), vertex(v1_x, v1_y, v1_z), vertex(v2_x, v2_y, v2_z));
                end if;
            elsif going = '0' then
                going <= '1';
            elsif busy = "000" and out_ready = '1' then
                held <= '0';
                going <= '0';
            end if;
        end if;
    end process control;

    o_edge0_init <= alive(e_init(0), flat);
    o_edge0_dx <= alive(e_dx(0), flat);
    o_edge0_dy <= alive(e_dy(0), flat);
    o_edge1_init <= alive(e_init(1), flat);
    o_edge1_dx <= alive(e_dx(1), flat);
    o_edge1_dy <= alive(e_dy(1), flat);
    o_edge2_init <= alive(e_init(2), flat);
    o_edge2_dx <= alive(e_dx(2), flat);
    o_edge2_dy <= alive(e_dy(2), flat);
    o_depth_init <= alive(std_logic_vector(fit(start + bias, N)), flat);
    o_depth_dx <= alive(std_logic_vector(fit(slope_x, N)), flat);
    o_depth_dy <= alive(std_logic_vector(fit(slope_y, N)), flat);
    o_zero_area <= '1' when flat else '0';
end architecture rtl;

-- A small triangle engine: set-up words and a box in, one triangle at a time; covered runs, depths
-- of covered samples and a summary out, each a valid/ready stream of its own. One sample in each clock.
-- Spec: coverage C, depth P and G, vectors N.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity triangle_engine is
    generic (
        M    : natural := 6;  -- bits of an edge word
        G    : natural := 1;   -- guard bits
        I    : natural := 3;  -- depth bits
        F    : natural := 3;  -- interpolation bits
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
