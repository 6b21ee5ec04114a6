#!/usr/bin/env bash
# A private Slurm cluster of one node with two processors, for trials of recipes/slurm.
#
# Prints the path of its slurm.conf once it takes jobs: export it as SLURM_CONF. It lasts until
# standard input ends, so it cannot outlive whoever started it. Everything it writes lies in one
# temporary folder, which it removes; it takes no fixed port and reads nothing of /etc/slurm.
# shellcheck disable=SC2317 # a trap calls what seems unreachable
set -euo pipefail

# Daemons live in sbin, which not every user's search path has.
PATH=$PATH:/usr/local/sbin:/usr/sbin:/sbin

# Background commands read nothing unless told to: the descriptor keeps standard input for one.
exec 3<&0
folder=$(mktemp -d "${TMPDIR:-/tmp}/slurm.XXXXXX")
daemons=()

# The processes that carry this folder's mark in their environment: the daemons and, since a
# step's process leaves its parent, whatever the node's daemon started. A user's never do.
ours() {
    local environ pid
    for environ in /proc/[0-9]*/environ; do
        pid=${environ//[!0-9]/}
        if [ "$pid" != $$ ] && grep -qszF "TRIAL_CLUSTER=$folder" "$environ"; then
            echo "$pid"
        fi
    done
}

stop() {
    local status=$? pids
    trap - EXIT
    set +e
    if [ "${SHOW_LOGS:-}" = 1 ]; then
        tail -n 50 "$folder"/*.log >&2
    fi
    # Jobs first: without a daemon nobody would end them.
    timeout 5 scancel --quiet --user="$(id -un)" 2> /dev/null
    for _ in {1..50}; do
        [ -z "$(timeout 5 squeue --noheader 2> /dev/null)" ] && break
        sleep 0.1
    done
    kill "${daemons[@]}" 2> /dev/null
    for _ in {1..50}; do
        pids=$(ours)
        [ -z "$pids" ] && break
        sleep 0.1
    done
    # shellcheck disable=SC2086 # several numbers
    [ -n "$pids" ] && kill -KILL $pids 2> /dev/null
    wait
    rm -rf "$folder"
    exit "$status"
}
trap stop EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

fail() {
    echo "error: $1" >&2
    tail -n 20 "$folder"/*.log >&2 || true
    exit 1
}

# A free port: one that nobody answers on. Below the range that outgoing connections take.
port() {
    local port
    for _ in {1..100}; do
        port=$((20000 + RANDOM % 10000))
        if ! (exec 3<> "/dev/tcp/127.0.0.1/$port") 2> /dev/null; then
            echo "$port"
            return
        fi
    done
    return 1
}

export SLURM_CONF=$folder/slurm.conf TRIAL_CLUSTER=$folder
user=$(id -un)
host=$(hostname -s)
memory=$(awk '/^MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
mkdir -m 755 "$folder/munge" "$folder/state" "$folder/spool"
dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
chmod 400 "$folder/munge.key"

# Delays are short because the trial is: the scheduler looks once a second, so eight tasks at a time
# share the two processors.
cat > "$SLURM_CONF" << CONF
ClusterName=trial
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(port)
SlurmdPort=$(port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
MailProg=/bin/true
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
KillWait=2
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=$((memory / 2)) State=UNKNOWN
PartitionName=trial Nodes=$host Default=YES OverSubscribe=FORCE:4 MaxTime=10 State=UP
CONF

# --force: its folder is not one of a system's, which munged would rather have.
munged --foreground --force --num-threads=2 --key-file="$folder/munge.key" \
    --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --seed-file="$folder/munge/seed" --log-file="$folder/munge/log" \
    > "$folder/munged.log" 2>&1 < /dev/null 3<&- &
daemons+=($!)
slurmctld -D -i > "$folder/slurmctld.out.log" 2>&1 < /dev/null 3<&- &
daemons+=($!)
slurmd -D -N "$host" > "$folder/slurmd.out.log" 2>&1 < /dev/null 3<&- &
daemons+=($!)

for _ in {1..150}; do
    for daemon in "${daemons[@]}"; do
        kill -0 "$daemon" 2> /dev/null || fail "a daemon of the cluster ended"
    done
    if [ "$(timeout 5 sinfo --noheader --format=%t 2> /dev/null)" = idle ]; then
        echo "$SLURM_CONF"
        # In the background, since bash looks at signals when a command in front has ended.
        cat <&3 > /dev/null &
        daemons+=($!)
        wait $! || true
        exit 0
    fi
    sleep 0.1
done
fail "the cluster took no jobs within 15 s"
