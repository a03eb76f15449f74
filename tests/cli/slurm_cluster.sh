#!/bin/bash
# A cluster of this one machine for as long as a job takes: slurm_cluster.sh SBATCH_ARGUMENTS..
# Exit code 77: Slurm and munge are not installed, or do not start here.
set -u
PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch sinfo; do
    command -v $program >/dev/null || exit 77
done
folder=$(mktemp -d /tmp/slurm.XXXXXX)
pids=()
finish() {
    for ((i = ${#pids[@]} - 1; i >= 0; --i)); do
        kill "${pids[i]}" 2>/dev/null
        wait "${pids[i]}" 2>/dev/null
    done
    rm -rf "$folder"
}
trap finish EXIT
mkdir "$folder/munge" "$folder/state" "$folder/spool"
chmod 755 "$folder" && chmod 711 "$folder/munge"
(umask 077 && dd if=/dev/urandom of="$folder/munge/key" bs=1024 count=1 2>/dev/null)
port=$((20000 + $$ % 20000))
node=$(hostname -s)
cat >"$folder/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf
munged -F --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" >"$folder/munge.out" 2>&1 &
pids+=($!)
for ((i = 0; i < 50; ++i)); do [ -S "$folder/munge/socket" ] && break || sleep 0.1; done
slurmctld -D -f "$SLURM_CONF" >"$folder/slurmctld.log" 2>&1 &
pids+=($!)
slurmd -D -f "$SLURM_CONF" >"$folder/slurmd.log" 2>&1 &
pids+=($!)
for ((i = 0; i < 100; ++i)); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break || sleep 0.2
done
[ "$(sinfo -h -o %t 2>/dev/null)" = idle ] || { tail -n 3 "$folder"/*.log >&2; exit 77; }
timeout 500 sbatch --wait "$@"
