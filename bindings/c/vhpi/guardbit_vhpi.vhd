-- guardbit's live model over VHPIDIRECT, for GHDL. Words are 128 bits wide; a result below 0 is an
-- error of guardbit.h.
library ieee;
use ieee.std_logic_1164.all;

package guardbit_vhpi is
    subtype word_t is std_logic_vector(127 downto 0);
    -- A profile's name or path: zero-terminated text of this length.
    subtype name_t is string(1 to 256);

    function guardbit_open(profile : name_t) return integer;
    attribute foreign of guardbit_open : function is "VHPIDIRECT ./libguardbit_c.so guardbit_open";
    function guardbit_walk(model : integer; kind : integer) return integer;
    attribute foreign of guardbit_walk : function is "VHPIDIRECT ./libguardbit_c.so guardbit_walk";
    procedure guardbit_clock_logic(
        walk : in integer; op : in integer; init : in word_t; dx : in word_t; dy : in word_t;
        acc : out word_t; result : out word_t);
    attribute foreign of guardbit_clock_logic : procedure is
        "VHPIDIRECT ./libguardbit_c.so guardbit_clock_logic";
    procedure guardbit_divide_logic(
        model : in integer; channel : in integer; acc : in word_t; acc_w : in word_t; code : out word_t);
    attribute foreign of guardbit_divide_logic : procedure is
        "VHPIDIRECT ./libguardbit_c.so guardbit_divide_logic";

    -- The name with the zero that ends it.
    function named(profile : string) return name_t;
end package guardbit_vhpi;

package body guardbit_vhpi is
    function guardbit_open(profile : name_t) return integer is
    begin
        report "the foreign function is not there" severity failure;
        return -6;
    end function guardbit_open;

    function guardbit_walk(model : integer; kind : integer) return integer is
    begin
        report "the foreign function is not there" severity failure;
        return -6;
    end function guardbit_walk;

    procedure guardbit_clock_logic(
        walk : in integer; op : in integer; init : in word_t; dx : in word_t; dy : in word_t;
        acc : out word_t; result : out word_t) is
    begin
        report "the foreign procedure is not there" severity failure;
    end procedure guardbit_clock_logic;

    procedure guardbit_divide_logic(
        model : in integer; channel : in integer; acc : in word_t; acc_w : in word_t; code : out word_t) is
    begin
        report "the foreign procedure is not there" severity failure;
    end procedure guardbit_divide_logic;

    function named(profile : string) return name_t is
        variable name : name_t := (others => nul);
    begin
        name(1 to profile'length) := profile;
        return name;
    end function named;
end package body guardbit_vhpi;
