#!/usr/bin/env bash
# A private Slurm cluster on this host's loopback: two nodes of one processor, a munge daemon of its
# own, no accounting.
#   cluster.sh start FOLDER | cluster.sh stop FOLDER        SLURM_CONF is then FOLDER/slurm.conf
set -euo pipefail
command=$1 folder=$2
export SLURM_CONF=$folder/slurm.conf
nodes=2

free_port() {
    local port hex
    while true; do
        port=$((20000 + RANDOM % 12000))
        printf -v hex ':%04X ' "$port"
        if ! grep -qs "$hex" /proc/net/tcp /proc/net/tcp6; then break; fi
    done
    echo "$port"
}

write_config() {
    local host
    host=$(hostname)
    host=${host%%.*}
    cat > "$SLURM_CONF" << CONF
ClusterName=tests
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
CredType=cred/munge
# A job that is requeued waits until its old credential has expired.
AuthInfo=socket=$folder/socket/munge,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/pid/slurmctld
SlurmdPidFile=$folder/pid/slurmd-%n
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
DependencyParameters=kill_invalid_depend
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
JobRequeue=1
CONF
    # Containers often have no control groups; this plugin starts without them.
    echo "CgroupPlugin=cgroup/v1" > "$folder/cgroup.conf"
    for ((i = 1; i <= nodes; ++i)); do
        echo "NodeName=n$i NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=1 RealMemory=4000" >> "$SLURM_CONF"
        mkdir -p "$folder/spool-n$i"
    done
    echo "PartitionName=p Nodes=n[1-$nodes] Default=YES MaxTime=INFINITE State=UP" >> "$SLURM_CONF"
}

case $command in
    start)
        mkdir -p "$folder"/{state,pid,socket,munge}
        chmod 755 "$folder" "$folder/socket"
        chmod 700 "$folder/munge"
        head -c 128 /dev/urandom > "$folder/munge/key"
        chmod 600 "$folder/munge/key"
        munged --key-file="$folder/munge/key" --socket="$folder/socket/munge" \
            --pid-file="$folder/pid/munged" --log-file="$folder/munge/log" \
            --seed-file="$folder/munge/seed"
        write_config
        slurmctld -c
        for ((i = 1; i <= nodes; ++i)); do
            if ! slurmd -N "n$i"; then
                echo "skipped: slurmd does not start on this host:"
                tail -n 3 "$folder/slurmd-n$i.log"
                exit 77
            fi
        done
        for ((try = 0; try < 200; ++try)); do
            if [ "$(sinfo -h -t idle -o %D 2> /dev/null)" = "$nodes" ]; then exit 0; fi
            sleep 0.1
        done
        echo "the cluster's nodes are not idle after 20 s" >&2
        exit 1
        ;;
    stop)
        pids=()
        for daemon in slurmd-n1 slurmd-n2 slurmctld munged; do
            if [ -s "$folder/pid/$daemon" ]; then pids+=("$(cat "$folder/pid/$daemon")"); fi
        done
        if [ ${#pids[@]} -gt 0 ]; then kill "${pids[@]}" 2> /dev/null || true; fi
        for ((try = 0; try < 100; ++try)); do
            alive=0
            for pid in "${pids[@]}"; do
                if kill -0 "$pid" 2> /dev/null; then alive=1; fi
            done
            if [ $alive -eq 0 ]; then break; fi
            sleep 0.1
        done
        ;;
esac
