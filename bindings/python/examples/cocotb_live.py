"""A device beside the live model under cocotb. Run it: python cocotb_live.py DDA.sv"""

import random
import sys
from pathlib import Path

import cocotb
import guardbit
from cocotb.triggers import Timer


@cocotb.test()
async def device_and_model_agree(dut):
    walk = guardbit.Model("sgi-4k").depth_walk()
    random.seed(1)
    dut.clk.value = 0
    dut.rst.value = 1
    for _ in range(2):
        await Timer(1, "step")
        dut.clk.value = 1
        await Timer(1, "step")
        dut.clk.value = 0
    dut.rst.value = 0
    for clock in range(2000):
        op = random.randrange(4) if clock else 0
        init, dx, dy = (random.getrandbits(walk.width) for _ in range(3))
        dut.op.value, dut.init.value, dut.dx.value, dut.dy.value = op, init, dx, dy
        await Timer(1, "step")
        dut.clk.value = 1
        await Timer(1, "step")
        got = int(dut.acc.value), int(dut.out_v.value)
        assert got == walk.clock(op, init, dx, dy), f"clock {clock}, op {op}"
        dut.clk.value = 0


def main():
    from cocotb_tools.runner import get_runner

    device = Path(sys.argv[1]).resolve()
    runner = get_runner("icarus")
    runner.build(
        sources=[device],
        hdl_toplevel="dda",
        parameters={"G": 2, "I": 24, "F": 13},
        build_args=["-g2012"],
        build_dir="sim_live",
    )
    results = runner.test(hdl_toplevel="dda", test_module="cocotb_live", build_dir="sim_live")
    from cocotb_tools.check_results import get_results

    tests, failed = get_results(results)
    print(f"{tests} tests, {failed} failed")
    sys.exit(failed != 0)


if __name__ == "__main__":
    main()
