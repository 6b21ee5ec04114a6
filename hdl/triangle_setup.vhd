-- Triangle set-up: three vertices in, edge words and a depth plane at pixel (0, 0) out.
-- Spec: triangles T, edges E and C, planes P.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity triangle_setup is
    generic (
        VW   : natural := 23;      -- bits of a vertex coordinate
        VS   : natural := 0;       -- 1 where coordinates are signed
        S    : natural := 10;      -- sub-pixel bits
        SAMPLE_X : natural := 512;  -- the sample in its pixel, in sub-pixels
        SAMPLE_Y : natural := 512;
        RULE : natural := 0;       -- 0 top-left, 1 shadow
        SHIFT : natural := 10;     -- low bits of an edge value that are not kept: 0 or S
        M    : natural := 35;      -- bits of an edge word
        G    : natural := 1;       -- guard bits
        I    : natural := 24;      -- depth bits
        F    : natural := 13;      -- interpolation bits
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
