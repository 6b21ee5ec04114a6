# guardbit vector set tiny, model version 2: cocotb scoreboard, generated.
"""Drives the devices of dut.sv with the set beside this file and compares every row.

Run from inside the set folder:
    $ pip install cocotb && python tb_cocotb.py

It prints a line a device and ends with exit status 1 if one fails. GUARDBIT_DEVICE names one device,
GUARDBIT_ROWS stops after so many rows of a file. Each line of a file is checked for its length, its
digits and the widths of its words, and each file for its number of rows and its SHA-256.
"""

import hashlib
import json
import os
import random
import sys
from pathlib import Path

SET = Path(__file__).resolve().parent
# Names that hardware languages reserve, in files and as ports.
RESERVED = {"in": "in_v", "out": "out_v"}
# Device: the file that drives it, and for each file it answers the prefix of its ports.
DEVICES = {
    "dda": ("dda.cfg", {"dda.exp": ""}),
    "edge_stepper": ("edge.cfg", {"edge.exp": ""}),
    "triangle_setup": ("setup.cfg", {"setup.exp": "o_"}),
    "triangle_engine": (
        "triangle.cfg",
        {"span.exp": "span_", "depth.exp": "sample_", "triangle.exp": "triangle_"},
    ),
    "quad_engine": ("words.cfg", {"words-q.exp": "q_"}),
    "anchored_engine": ("words.cfg", {"words-p.exp": "p_"}),
    "vertex_quad_engine": ("words.cfg", {"words-p.exp": "p_"}),
    "given_slope_engine": ("words.cfg", {"words-p.exp": "p_"}),
    "divided_slope_engine": ("words.cfg", {"words-p.exp": "p_"}),
    "sub_scanline_engine": ("words.cfg", {"words-s.exp": "span_", "words-p.exp": "p_"}),
}
# What the summary's events look at is wider than any word of the engine: they are not compared.
EVENTS = {"wrap", "clamp_above", "clamp_below", "inexact"}
REPORTED = 20


class BadSet(Exception):
    """A file is not what the manifest says."""


class File:
    """The rows of a file, checked one by one."""

    def __init__(self, stem):
        self.name = f"{stem}.tv"
        manifest = json.loads((SET / "manifest.json").read_text())
        entries = [entry for entry in manifest["files"] if entry["name"] == self.name]
        if not entries:
            raise BadSet(f"{self.name}: the manifest has no such file")
        [self.entry] = entries
        self.columns = self.entry["columns"]
        self.line = 0
        try:
            self.bytes = (SET / self.name).read_bytes()
        except OSError as error:
            raise BadSet(f"{self.name}: cannot be opened: {error.strerror}") from None
        self.rows = self.bytes.decode("ascii", "replace").splitlines()
        if len(self.rows) != self.entry["rows"]:
            raise BadSet(f"{self.name}: {len(self.rows)} rows, the manifest says {self.entry['rows']}")
        if hashlib.sha256(self.bytes).hexdigest() != self.entry["sha256"]:
            raise BadSet(f"{self.name}: its SHA-256 is not the manifest's")

    def left(self):
        return self.line < len(self.rows)

    def next(self):
        words = self.rows[self.line].split("_")
        self.line += 1
        where = f"{self.name} line {self.line}"
        if len(words) != len(self.columns):
            raise BadSet(f"{where}: {len(words)} words, not {len(self.columns)}")
        row = {}
        for word, column in zip(words, self.columns):
            width = column["width"]
            if len(word) != (width + 3) // 4 or not set(word) <= set("0123456789abcdef"):
                raise BadSet(f"{where}: {word!r} is not a word of {column['name']}")
            row[column["name"]] = int(word, 16)
            if row[column["name"]] >> width:
                raise BadSet(f"{where}: {word} is wider than the {width} bits of {column['name']}")
        return row


def port(name):
    return RESERVED.get(name, name)


class Bench:
    """A device, its files and what has been found."""

    def __init__(self, dut, cfg, exps):
        self.dut = dut
        self.cfg = File(cfg)
        self.exps = {File(stem): prefix for stem, prefix in exps.items()}
        self.most = int(os.environ.get("GUARDBIT_ROWS", "0")) or None
        self.rows = 0
        self.mismatches = 0
        random.seed(1)

    def done(self, file):
        return not file.left() or (self.most is not None and file.line >= self.most)

    def compare(self, file, prefix, want):
        self.rows += 1
        for column in file.columns:
            name, width = column["name"], column["width"]
            if name == "op" or name in EVENTS:
                continue
            got = str(getattr(self.dut, prefix + port(name)).value)
            expected = format(want[name], f"0{width}b")
            if got != expected:
                self.mismatch(f"{file.name} line {file.line} field {name}\n    expected {expected}\n    got      {got}")

    def mismatch(self, text):
        self.mismatches += 1
        if self.mismatches <= REPORTED:
            print(f"MISMATCH {text}")

    def verdict(self, device):
        if self.mismatches:
            raise AssertionError(f"FAIL {device} rows={self.rows} mismatches={self.mismatches}")
        print(f"PASS {device} rows={self.rows}")


async def reset(dut, timer):
    dut.clk.value = 0
    dut.rst.value = 1
    for _ in range(3):
        await timer(1, "step")
        dut.clk.value = 1
        await timer(1, "step")
        dut.clk.value = 0
    dut.rst.value = 0


async def walk(bench, timer):
    """One row a clock; now and then holds, with other words at the inputs, and nothing may change."""
    dut = bench.dut
    dut.op.value = 3
    await reset(dut, timer)

    async def clock():
        await timer(1, "step")
        dut.clk.value = 1
        await timer(1, "step")
        dut.clk.value = 0

    [(exp, prefix)] = bench.exps.items()
    inputs = [column["name"] for column in bench.cfg.columns]
    cfg = None
    while not bench.done(exp):
        want = exp.next()
        if want["op"] == 0:
            cfg = bench.cfg.next()
        elif cfg is None:
            raise BadSet(f"{exp.name} line 1: the first row is not a load")
        dut.op.value = want["op"]
        for name in inputs:
            getattr(dut, port(name)).value = cfg[name]
        await clock()
        bench.compare(exp, prefix, want)
        if random.randrange(32) == 0:
            dut.op.value = 3
            for column in bench.cfg.columns:
                getattr(dut, port(column["name"])).value = random.getrandbits(column["width"])
            await clock()
            bench.rows -= 1
            bench.compare(exp, prefix, want)


async def stream(bench, timer):
    """Valid and ready, stalled in patterns that change every 16 records."""
    dut = bench.dut
    dut.in_valid.value = 0
    ports = {}
    for file, prefix in bench.exps.items():
        flow = "out_" if prefix == "o_" else prefix
        ports[file] = getattr(dut, f"{flow}valid"), getattr(dut, f"{flow}ready")
        ports[file][1].value = 0
    await reset(dut, timer)
    driving = False
    quiet = beat = 0
    while quiet < 100 or driving or not (bench.done(bench.cfg) and all(map(bench.done, bench.exps))):
        beat += 1
        pattern = bench.cfg.line // 16 % 4
        stalls = [False, beat % 2 == 1, random.random() < 0.5, beat // 16 % 2 == 1][pattern]
        for _, ready in ports.values():
            ready.value = int(not stalls)
        if not driving and not stalls and not bench.done(bench.cfg):
            for name, word in bench.cfg.next().items():
                getattr(dut, port(name)).value = word
            dut.in_valid.value = 1
            driving = True
        await timer(1, "step")
        quiet += 1
        taken = driving and str(dut.in_ready.value) == "1"
        for file, (valid, _) in ports.items():
            if str(valid.value) == "1" and not stalls:
                quiet = 0
                if file.left():
                    bench.compare(file, bench.exps[file], file.next())
                else:
                    bench.mismatch(f"{file.name}: a row too much")
        dut.clk.value = 1
        await timer(1, "step")
        dut.clk.value = 0
        if taken:
            dut.in_valid.value = 0
            driving = False
            quiet = 0
        if quiet > 100000:
            raise AssertionError(f"FAIL no transfer for {quiet} clocks, {bench.cfg.line} records taken")
        if bench.most is not None and bench.done(bench.cfg) and quiet > 2000:
            break


def has(device):
    """Whether the set has the files of a device, and dut.sv the device."""
    cfg, exps = DEVICES[device]
    files = all((SET / f"{stem}.tv").exists() for stem in (cfg, *exps))
    return files and f"\nmodule {device} " in (SET / "dut.sv").read_text()


def main():
    from cocotb_tools.check_results import get_results
    from cocotb_tools.runner import get_runner

    wanted = os.environ.get("GUARDBIT_DEVICE")
    devices = [device for device in DEVICES if has(device) and wanted in (None, device)]
    # What the set has no device for: the same as for tb.sv.
    manifest = json.loads((SET / "manifest.json").read_text())
    left = [entry for entry in manifest.get("unchecked", []) if entry["testbench"] == "tb.sv"]
    for entry in left:
        print(f"NOT CHECKED {entry['bench']}: {entry['reason']}")
    if not devices:
        print("FAIL nothing to check")
        return 1
    bad = 0
    for device in devices:
        runner = get_runner("icarus")
        folder = SET / "sim_cocotb" / device
        sources = [SET / "pkg.sv", SET / "dut.sv"]
        runner.build(sources=sources, hdl_toplevel=device, build_args=["-g2012"], build_dir=folder)
        results = runner.test(hdl_toplevel=device, test_module="tb_cocotb", build_dir=folder, test_dir=SET)
        tests, failed = get_results(results)
        bad += failed + (tests == 0)
    names = ["not checked:", *(entry["bench"] for entry in left)] if left else []
    print("FAIL" if bad else "PASS", *devices, *names)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())

import cocotb  # noqa: E402  (the script above runs without a simulator)
from cocotb.triggers import Timer  # noqa: E402


@cocotb.test()
async def scoreboard(dut):
    device = dut._name
    bench = Bench(dut, *DEVICES[device])
    await (walk if device in ("dda", "edge_stepper") else stream)(bench, Timer)
    bench.verdict(device)
