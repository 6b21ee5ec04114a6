#!/usr/bin/env bash
# Mutates a module with yosys, runs a bench on each mutant, and says how many the bench catches.
# See README.md beside this file.
#
#   mutate.sh --set DIR --top MODULE [OPTIONS] FILE.sv...
set -euo pipefail

fail() {
    echo "error: $1" >&2
    exit 2
}

usage='usage: mutate.sh --set DIR --top MODULE [--bench COMMAND] [--count N] [--seed N] [--reset PORT] [--limit SECONDS] [--jobs N] [--out DIR] FILE.sv...'
set='' top='' bench='' count=100 seed=1 reset=rst limit=20 jobs=$(nproc) out=mutation files=()
while [ $# -gt 0 ]; do
    case $1 in
        --set | --top | --bench | --count | --seed | --reset | --limit | --jobs | --out)
            [ $# -ge 2 ] || fail "$1 needs a value; $usage"
            declare "${1#--}=$2"
            shift 2
            ;;
        -*) fail "there is no option $1; $usage" ;;
        *)
            files+=("$(realpath -- "$1")")
            shift
            ;;
    esac
done

# What cannot work is said before anything runs.
[ -n "$top" ] || fail "which module? $usage"
[ ${#files[@]} -gt 0 ] || fail "no source file of $top; $usage"
for number in count seed limit jobs; do
    [[ ${!number} =~ ^[1-9][0-9]{0,8}$ ]] || fail "--$number ${!number}: a number from 1 to 999999999 is needed"
done
for file in "${files[@]}"; do
    [ -f "$file" ] || fail "$file: there is no such file"
    grep -q '[^[:space:]]' "$file" || fail "$file is empty"
done
command -v yosys > /dev/null || fail "yosys is missing, which makes the mutants: apt-get install yosys"
guardbit=${GUARDBIT:-guardbit}
if [ -z "$bench" ]; then
    [ -n "$set" ] || fail "no bench: --set takes the folder of a set, --bench a command of your own"
    for file in pkg.sv tb.sv manifest.json; do
        [ -f "$set/$file" ] || fail "$set/$file: no such file; --set takes a folder that \`guardbit vectors\` wrote"
    done
    for program in iverilog vvp; do
        command -v $program > /dev/null || fail "$program is missing, which runs the set's bench: apt-get install iverilog"
    done
fi
if [ -n "$set" ]; then
    [ -f "$set/manifest.json" ] || fail "$set/manifest.json: no such file; --set takes a folder that \`guardbit vectors\` wrote"
    set=$(realpath -- "$set")
    command -v "$guardbit" > /dev/null || fail "$guardbit is missing, which reads the dumps: put guardbit on the search path, or its path in GUARDBIT"
    guardbit=$(command -v "$guardbit")
    guardbit=$(realpath -- "$guardbit")
fi
if [ -e "$out" ]; then
    fail "$out is there already: remove it, or name another folder with --out"
fi
mkdir -p -- "$out"
out=$(realpath -- "$out")
cd "$out"

# The module, flat, as words: one netlist that all mutants start from.
cat > sound.ys << END
read_verilog -sv$(printf ' "%s"' "${files[@]}")
hierarchy -check -top $top
proc
flatten
opt -full
memory_map
opt -full
write_rtlil sound.il
write_verilog -noattr sound.v
mutate -list $count -seed $seed -o mutants.ys
END
if ! yosys -q -l sound.log sound.ys > /dev/null 2>&1; then
    grep -q "Module \`$top' not found" sound.log &&
        fail "there is no module $top in ${files[*]}; there are: $(grep -ohE '^[[:space:]]*module[[:space:]]+[A-Za-z_][A-Za-z0-9_]*' "${files[@]}" | awk '{print $2}' | tr '\n' ' ')"
    fail "yosys cannot read it: $(grep -m 1 'ERROR' sound.log || tail -n 1 sound.log)"
fi
[ -s mutants.ys ] || fail "$top has no place to mutate: is it empty?"

# The bench on a netlist, in a folder of its own. 0 passes, 1 fails; the text is in bench.log.
# What does not end is ended, and counts as caught.
run_bench() {
    local folder=$1 patience=$2
    (
        cd "$folder"
        if [ -n "$bench" ]; then
            MUTANT=$folder/mutant.v timeout "$patience" bash -c "$bench"
        else
            ln -s "$set"/*.tv .
            iverilog -g2012 -Y .sv -y "$out/library" -o sim.vvp "$set/pkg.sv" mutant.v \
                "${others[@]}" "$set/tb.sv" || exit 3
            timeout "$patience" vvp -n sim.vvp +dump
        fi
    ) > "$folder/bench.log" 2>&1
}
# The other modules that the bench asks for: from the sources, and else from the set's devices.
mkdir rest library
others=()
for file in "${files[@]}"; do
    rest=rest/${#others[@]}-$(basename "$file")
    awk -v top="$top" '
        $1 == "module" { split($2, name, /[^A-Za-z0-9_]/); if (name[1] == top) skip = 1 }
        !skip
        $1 ~ /^endmodule/ { skip = 0 }' "$file" > "$rest"
    others+=("$out/$rest")
done
if [ -n "$set" ] && [ -f "$set/dut.sv" ]; then
    awk '
        $1 == "module" { split($2, name, /[^A-Za-z0-9_]/); file = "library/" name[1] ".sv" }
        file != "" { print > file }
        $1 ~ /^endmodule/ { file = "" }' "$set/dut.sv"
fi

mkdir sound
cp sound.v sound/mutant.v
SECONDS=0
run_bench "$out/sound" 3600 ||
    fail "the bench fails without a mutation, so it can judge none; the end of $out/sound/bench.log:
$(tail -n 5 sound/bench.log)"
patience=$((10 + 10 * SECONDS))
rm -f sound/*.dut.tv sound/sim.vvp

# Both designs side by side; % stands for the mutant's folder. They differ where an answer does: what
# stands in x_... counts while x_valid is high, and o_... while out_valid is.
both="read_rtlil sound.il; rename $top gold; design -stash gold; read_rtlil %/mutant.il; rename $top gate; design -stash gate; design -copy-from gold -as gold gold; design -copy-from gate -as gate gate"
same='equiv_make gold gate equiv; hierarchy -top equiv; opt_clean; opt_merge; equiv_struct; opt_merge; opt_clean; equiv_simple -short; equiv_induct -seq 2; equiv_status -assert'
differ="read_verilog miter.v; hierarchy -top miter; flatten; opt -full; sat -seq 8 -prove-skip 1 -set-at 1 $reset 1 -show-inputs -prove trigger 0 miter"
awk -v top="$top" '
    $1 == "module" { split($2, head, "("); here = head[1] == top }
    here && /^  (input|output) / {
        name = $NF; sub(/;/, "", name); range = $2 ~ /^\[/ ? $2 : ""
        if ($1 == "input") inputs[name] = range; else outputs[name] = range
    }
    END {
        for (name in inputs) { ports = ports name ", "; ins = ins "input " inputs[name] " " name ";\n"; pins = pins "." name "(" name "), " }
        for (name in outputs) {
            split("gold gate", sides)
            for (n in sides) {
                ins = ins "wire " outputs[name] " " sides[n] "_" name ";\n"
                outs[n] = outs[n] "." name "(" sides[n] "_" name "), "
            }
            prefix = name; sub(/_.*/, "", prefix)
            valid = (prefix == "o" ? "out" : prefix) "_valid"
            counts = valid in outputs && name != valid ? "gold_" valid " && " : ""
            trigger = trigger " || (" counts "gold_" name " != gate_" name ")"
        }
        sub(/, $/, "", outs[1]); sub(/, $/, "", outs[2])
        print "module miter(" ports "trigger);\n" ins "output trigger;"
        print "gold gold_device(" pins outs[1] ");\ngate gate_device(" pins outs[2] ");"
        print "assign trigger = 1\047b0" trigger ";\nendmodule"
    }' sound.v > miter.v

# One mutant: its verdict and the classes of tests that differ, into its folder.
judge() {
    local number=$1 mutation=$2 folder=$out/$1
    mkdir "$folder"
    printf 'read_rtlil sound.il\n%s\nopt_clean\nwrite_rtlil %s/mutant.il\nwrite_verilog -noattr %s/mutant.v\n' \
        "$mutation" "$number" "$number" > "$folder/mutant.ys"
    yosys -q "$folder/mutant.ys" > "$folder/yosys.log" 2>&1
    local status=0
    run_bench "$folder" "$patience" || status=$?
    if [ $status -eq 3 ] && [ -z "$bench" ]; then
        echo "the mutant does not build" > "$folder/verdict"
    elif [ $status -ne 0 ]; then
        echo killed > "$folder/verdict"
        local dump name
        for dump in "$folder"/*.exp.dut.tv; do
            if [ -z "$set" ] || [ ! -s "$dump" ]; then continue; fi
            name=$(basename "$dump")
            # A simulation that was ended leaves half a row. The head of a mismatch ends with the
            # test: bench, class and index.
            sed -i '$ { /[0-9a-fxz]$/! d }' "$dump"
            { "$guardbit" verify "$set" --dut "$dump" --errors 100000 || true; } 2> /dev/null |
                grep -F "$name" | awk '{print $NF}' | grep -E '^[a-z0-9-]+/[a-z0-9-]+/[0-9]+$' |
                sed 's|/[0-9]*$||' || true
        done | sort -u > "$folder/classes"
    elif timeout "$limit" yosys -q -p "${both//%/$number}; $same" > "$folder/equal.log" 2>&1; then
        echo equivalent > "$folder/verdict"
    elif timeout "$limit" yosys -p "${both//%/$number}; $differ" > "$folder/differ.log" 2>&1 &&
        grep -q 'model found: FAIL!' "$folder/differ.log"; then
        echo SURVIVES > "$folder/verdict"
    else
        echo open > "$folder/verdict"
    fi
    rm -f "$folder"/*.tv "$folder/sim.vvp" "$folder/mutant.il"
}

number=0
while read -r mutation; do
    number=$((number + 1))
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
    judge "$number" "$mutation" < /dev/null &
done < mutants.ys
wait

# The table. -src says where a mutant is: a port first, the innermost statement last. A cell that
# yosys made up has none, and stands there by its name.
all=$number number=0
while read -r mutation; do
    number=$((number + 1))
    place=$(grep -oE -- '-(cell|src) [^ ]*' <<< "$mutation" | tail -n 1 | sed -E 's/^-(cell|src) //; s/\|.*//')
    mode=${mutation#*-mode } mode=${mode%% *}
    port=$(sed -n 's/.*-port \(\S*\) -portbit \([0-9]*\).*/\1[\2]/p' <<< "$mutation")
    verdict=$(cat "$number/verdict" 2> /dev/null || echo "not judged")
    printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$number" "$verdict" "$mode" "$port" "$place" \
        "$(if [ -f "$number/classes" ]; then tr '\n' ' ' < "$number/classes"; fi)"
done < mutants.ys > mutants.tsv
verdicts() { cut -f 2 mutants.tsv | grep -cx "$1" || true; }
killed=$(verdicts killed) equivalent=$(verdicts equivalent) survives=$(verdicts SURVIVES) open=$(verdicts open)
judged=$((killed + equivalent + survives + open))
[ $judged -eq "$all" ] || fail "$((all - judged)) of $all mutants were not judged: see $out/mutants.tsv"
real=$((all - equivalent))
echo "module $top, seed $seed: $all mutants, $equivalent proved equivalent"
[ $real -gt 0 ] || fail "no mutant is left: take a larger --count"
awk -v k="$killed" -v r=$real 'BEGIN { printf "score: %d of %d caught, %.1f %%\n", k, r, 100 * k / r }'
if [ -n "$set" ] && [ "$killed" -gt 0 ]; then
    echo "caught   class of tests"
    cat ./*/classes | sort | uniq -c | sort -k1,1nr -k2 | awk '{ printf "%6d   %s\n", $1, $2 }'
fi
while IFS=$'\t' read -r number verdict mode port place _; do
    case $verdict in
        SURVIVES) echo "$number survives, and is another device: $mode at $place, $port; inputs that show it: $out/$number/differ.log" ;;
        open) echo "$number survives, and yosys does not know: $mode at $place, $port" ;;
        *) continue ;;
    esac
    file=${place%%:*} line=${place#*:}
    sed -n "${line%%.*}s/^[[:space:]]*/    /p" "$file" 2> /dev/null || true
done < mutants.tsv
[ "$survives" -eq 0 ] || exit 1
