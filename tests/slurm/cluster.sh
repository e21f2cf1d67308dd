#!/usr/bin/env bash
# A Slurm of two nodes on one host, in a folder of its own: cluster.sh start FOLDER, cluster.sh stop FOLDER. Needs the packages slurmctld,
# slurmd, slurm-client and munge, and root. What it starts is found by SLURM_CONF=FOLDER/slurm.conf.
set -euo pipefail
what="$1" folder="$2"
export PATH="/usr/sbin:$PATH" SLURM_CONF="$folder/slurm.conf"

stop() {
	for name in slurmd-n1 slurmd-n2 slurmctld munged; do
		if [ -f "$folder/$name.pid" ]; then kill "$(cat "$folder/$name.pid")" 2>/dev/null || true; fi
	done
}

if [ "$what" = stop ]; then stop; exit 0; fi

mkdir -p "$folder/state" "$folder/spool-n1" "$folder/spool-n2"
base=$((20000 + RANDOM % 10000))
host="$(hostname -s)"
head -c 128 /dev/urandom > "$folder/munge.key"
chmod 600 "$folder/munge.key"
cat > "$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$base
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/builtin
SlurmdTimeout=10
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 1)) CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 2)) CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
	--log-file="$folder/munged.log" --seed-file="$folder/munged.seed"
slurmctld
slurmd -N n1
slurmd -N n2
for _ in $(seq 100); do
	if [ "$(sinfo --noheader --Node --format=%T 2>/dev/null | grep -c idle)" = 2 ]; then exit 0; fi
	sleep 0.1
done
tail -n 20 "$folder"/*.log >&2
stop
exit 1
