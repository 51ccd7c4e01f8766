#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# slurm_test.sh SPA ARRAY_SCRIPT PYTHON CHECK_REPORTS: a job array of a real Slurm, which this script starts on this
# machine and ends again, must bake what one run of `spa batch` bakes, byte for byte.
#
# Needs slurmctld, slurmd, Slurm's commands and munged, and neither root, systemd, nor cgroups. Without them it ends
# with status 77 (skipped), or 1 if SPA_REQUIRE_SLURM is set.
set -eu
spa=$1
array_script=$2
python=$3
check_reports=$4

PATH=$PATH:/usr/sbin:/sbin
for command in munged slurmctld slurmd sbatch squeue scontrol sinfo; do
    command -v $command >/dev/null && continue
    echo "slurm_test.sh: there is no $command here" >&2
    [ -z "${SPA_REQUIRE_SLURM-}" ] || exit 1
    exit 77
done

# munged wants folders that only their owner may write.
umask 022
folder=$(mktemp -d)
chmod 755 "$folder"
export SLURM_CONF="$folder/slurm.conf"
daemons=
finish() {
    status=$?
    trap - EXIT
    # slurmd and slurmctld first; munged, which they need until the end, was started before them.
    for daemon in $daemons; do
        kill "$daemon" 2>/dev/null || true
        wait "$daemon" 2>/dev/null || true
    done
    if [ $status -ne 0 ]; then
        tail -n 40 "$folder"/*.log "$folder"/tasks/* >&2 2>/dev/null || true
        echo "slurm_test.sh: failed; above: the ends of the logs" >&2
    fi
    rm -rf "$folder"
    exit $status
}
trap finish EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

fail() {
    echo "slurm_test.sh: $*" >&2
    exit 1
}

# start NAME COMMAND...: in the background, what it says into NAME.log.
start() {
    name=$1
    shift
    "$@" >"$folder/$name.log" 2>&1 &
    daemons="$! $daemons"
}

# wait_for WHAT COMMAND...: until the command succeeds; the limit is for what will never come.
wait_for() {
    what=$1
    shift
    deadline=$(($(date +%s) + 60))
    until "$@" >/dev/null 2>&1; do
        [ "$(date +%s)" -lt $deadline ] || fail "waited for a minute for $what"
        for daemon in $daemons; do
            kill -0 "$daemon" 2>/dev/null || fail "a daemon ended while waiting for $what"
        done
        sleep 0.1
    done
}

# Below the ports that the system hands out to clients; ports that were free a moment ago.
ports=$("$python" - <<'END'
import random, socket
free = []
while len(free) < 2:
    with socket.socket() as probe:
        port = random.randrange(10000, 30000)
        try:
            probe.bind(("", port))
        except OSError:
            continue
    free.append(port)
print(*free)
END
)

# The node claims more processors and memory than there may be, so that all tasks of an array run at once.
host=$(uname -n)
host=${host%%.*}
user=$(id -un)
mkdir "$folder/state" "$folder/spool" "$folder/tasks"
cat >"$SLURM_CONF" <<END
ClusterName=spa
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=${ports% *}
SlurmdPort=${ports#* }
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
MailProg=/bin/true
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=8 RealMemory=65536
PartitionName=all Nodes=ALL Default=YES
END

# No part of Slurm that is at work here uses cgroups; still slurmd sets up version 2 where it finds it, which in a
# container without systemd it cannot.
echo CgroupPlugin=cgroup/v1 >"$folder/cgroup.conf"

head -c 1024 /dev/urandom >"$folder/munge.key"
chmod 400 "$folder/munge.key"
start munged munged --foreground --socket="$folder/munge.socket" --key-file="$folder/munge.key" \
    --pid-file="$folder/munged.pid" --seed-file="$folder/munged.seed" --log-file="$folder/munged.log"
wait_for munged test -S "$folder/munge.socket"
start slurmctld slurmctld -D
start slurmd slurmd -D
node_is_idle() { sinfo --noheader --format=%T | grep -qx idle; }
wait_for "the node" node_is_idle

# Small assets in folders, all names different.
assets=$folder/assets
for set in props/small props/large rocks; do
    mkdir -p "$assets/$set"
    for sample in cube sphere torus cliff; do
        "$spa" sample $sample --level 1 -o "$assets/$set/$sample.glb" >/dev/null
        for copy in 1 2; do cp "$assets/$set/$sample.glb" "$assets/$set/$sample-$copy.glb"; done
    done
done
"$spa" batch "$assets" -o "$folder/whole" --size 32 --quiet >"$folder/whole.log" 2>&1 || fail "spa batch failed"

# submit ARRAY MAPS: sets $job.
submit() {
    maps=$2
    job=$(SPA="$spa" SPA_IN="$assets" SPA_OUT="$maps" sbatch --parsable --array="$1" \
        --output="$folder/tasks/%A_%a.log" "$array_script" --size 32)
}
job_has_ended() { [ -z "$(squeue --noheader --jobs="$job")" ]; }
# Waits for the end of $job, all of whose tasks must have succeeded, and compares $maps with the one run's.
compare() {
    wait_for "job $job" job_has_ended
    if scontrol show job "$job" | grep -E '\<JobState=' | grep -v 'JobState=COMPLETED'; then
        fail "job $job: a task did not succeed"
    fi
    diff -r "$folder/whole" "$maps" >&2 || fail "job $job: not the bytes of one run"
}

for array in 1-4 0-3 10-16:2; do
    submit $array "$folder/maps-$array"
    compare
    "$python" -B "$check_reports" "$assets" "$maps".reports/*.json
done

# The check itself must be able to fail: a report that is lost, one that is there twice.
lost=$maps.reports/12.json
if "$python" -B "$check_reports" "$assets" "$maps".reports/1[046].json 2>/dev/null; then
    fail "nobody missed the report of a task"
fi
if "$python" -B "$check_reports" "$assets" "$maps".reports/*.json "$lost" 2>/dev/null; then
    fail "nobody saw that a report came twice"
fi

# A task that Slurm stops and starts again goes on where it was, wherever that is.
submit 1-4 "$folder/maps-requeued"
some_map_exists() { [ -n "$(find "$maps" -name '*.spa' 2>/dev/null)" ]; }
wait_for "the first map" some_map_exists
scontrol requeue "$job"
compare
