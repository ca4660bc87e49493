# SPDX-License-Identifier: Apache-2.0
"""navcal fleet on a real Slurm: a controller and two nodes on this machine, without munge and without root.

usage: slurm.py NAVCAL [--long] [--keep]
  --long  200 tasks; a node is killed with what it runs, and the controller is restarted, in the middle of it
  --keep  leaves the folder with logs and results

Passes when the merged results equal those of a serial run byte for byte. Exit status 77 where Slurm is missing.
"""

import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 500
NEEDED = ["slurmctld", "slurmd", "slurmstepd", "sbatch", "squeue", "scontrol"]
POISON = "#capture 1\npoison\n"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def find(program):
    return shutil.which(program, path="/usr/sbin:/usr/bin:/sbin:/bin:/usr/local/sbin:/usr/local/bin")


def free_ports(count):
    probes = [socket.socket() for _ in range(count)]
    for probe in probes:
        probe.bind(("127.0.0.1", 0))
    ports = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return ports


class Cluster:
    """A controller and two nodes of one processor each."""

    def __init__(self, folder):
        self.folder = folder
        self.conf = folder / "slurm.conf"
        ports = free_ports(3)
        host = socket.gethostname().split(".")[0]
        user = getpass.getuser()
        (folder / "state").mkdir()
        self.conf.write_text(
            f"""ClusterName=navcal
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=10
JobRequeue=1
MpiDefault=none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=1000
PartitionName=all Nodes=n1,n2 Default=YES State=UP
"""
        )
        # 22.05 reads it whatever the plugins are.
        (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        self.env = {"SLURM_CONF": str(self.conf), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": str(folder)}
        self.controller = None
        self.nodes = {}

    def start(self):
        self.start_controller()
        for name in ("n1", "n2"):
            self.start_node(name)
        self.wait_for(lambda: self.idle_nodes() == 2, "two idle nodes")

    def start_controller(self):
        self.controller = self.spawn("slurmctld", "-D")

    def start_node(self, name):
        (self.folder / f"spool-{name}").mkdir(exist_ok=True)
        self.nodes[name] = self.spawn("slurmd", "-D", "-N", name)

    def spawn(self, program, *arguments):
        out = open(self.folder / f"{program}.out", "ab")
        command = [find(program), *arguments, "-f", str(self.conf)]
        return subprocess.Popen(command, env=self.env, stdout=out, stderr=out, stdin=subprocess.DEVNULL)

    def idle_nodes(self):
        answer = subprocess.run([find("sinfo"), "--noheader", "--Node", "--format=%T"], env=self.env, capture_output=True, text=True)
        return sum(line.strip() == "idle" for line in answer.stdout.splitlines())

    def restart_controller(self):
        # As systemctl restart does. A controller that is killed has lost what it learnt since it saved its state, and Slurm may
        # drain nodes for that until the operator resumes them.
        self.controller.terminate()
        self.controller.wait()
        time.sleep(3)
        self.start_controller()

    def processes_of(self, name):
        """slurmstepd and what it started, on this node."""
        found = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                environment = (folder / "environ").read_bytes()
            except OSError:
                continue
            if f"SLURM_CONF={self.conf}".encode() not in environment:
                continue
            if f"SLURMD_NODENAME={name}".encode() in environment:
                found.append(int(folder.name))
        return found

    def parents_of(self, pids):
        parents = set()
        for pid in pids:
            try:
                stat = pathlib.Path(f"/proc/{pid}/stat").read_text()
                parent = int(stat.rsplit(")", 1)[1].split()[1])
                if b"slurmstepd" in pathlib.Path(f"/proc/{parent}/cmdline").read_bytes():
                    parents.add(parent)
            except (OSError, IndexError, ValueError):
                continue
        return parents

    def kill_node(self, name):
        """As if its power had failed, in the middle of a task: the daemon, the step and what it runs."""
        self.wait_for(lambda: self.processes_of(name), f"a task on {name}")
        self.nodes[name].kill()
        self.nodes[name].wait()
        running = self.processes_of(name)
        victims = {*self.parents_of(running), *running}
        for pid in victims:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        return len(victims)

    def wait_for(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            if time.monotonic() > end:
                sys.exit(f"no {what} within {PATIENCE_S} s; see {self.folder}")
            time.sleep(0.1)

    def stop(self):
        subprocess.run([find("scancel"), "--user", getpass.getuser()], env=self.env, capture_output=True)
        time.sleep(1)
        for process in [self.controller, *self.nodes.values()]:
            if process and process.poll() is None:
                process.terminate()
        for process in [self.controller, *self.nodes.values()]:
            if process:
                try:
                    process.wait(timeout=20)
                except subprocess.TimeoutExpired:
                    process.kill()


def write_recordings(folder, count):
    folder.mkdir()
    for i in range(count):
        reads = "".join(f"170000000{k}.000000000 imu < {i:04x}{k:02x}\n" for k in range(3))
        (folder / f"{i:04}.cap").write_text("#capture 1\n#port imu imu-card 57600\n" + reads)
    (folder / "poison.cap").write_text(POISON)


def results_in(plan):
    return len([*plan.glob("results/*/*.json"), *plan.glob("results/*/*.error")])


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    is_long = "--long" in sys.argv
    missing = [program for program in NEEDED if program != "slurmstepd" and not find(program)]
    if missing:
        skip(f"{', '.join(missing)}: Slurm is not installed (Debian: slurm-wlm)")
    navcal = str(pathlib.Path(arguments[0]).resolve())
    count = 199 if is_long else 5
    folder = pathlib.Path(tempfile.mkdtemp(prefix="navcal-slurm-"))
    plan, serial = folder / "plan", folder / "serial"
    write_recordings(folder / "recordings", count)

    def fleet(*words, **more):
        return subprocess.run([navcal, "fleet", *map(str, words)], check=True, **more)

    for each in (plan, serial):
        fleet("plan", folder / "recordings", "-o", each, "--job", "calibrate", stdout=subprocess.DEVNULL)
    # A task takes a while, so that something can be killed in the middle of it.
    slow = folder / "slow"
    slow.write_text(f'#!/bin/sh\nsleep {0.2 if is_long else 0.1}\nexec {navcal} "$@"\n')
    slow.chmod(0o755)
    cluster = Cluster(folder)
    began = time.monotonic()
    try:
        cluster.start()
        print(f"cluster: {time.monotonic() - began:.1f} s", flush=True)
        submit = [navcal, "fleet", "submit", str(plan), "--slurm", "--poll", "0.5", "--program", str(slow)]
        began = time.monotonic()
        client = subprocess.Popen(submit, env=cluster.env)
        if is_long:
            cluster.wait_for(lambda: results_in(plan) >= count // 5, "a fifth of the results")
            print(f"node n2 killed with {cluster.kill_node('n2')} processes at {results_in(plan)} results", flush=True)
            cluster.wait_for(lambda: results_in(plan) >= 2 * count // 5, "two fifths of the results")
            client.kill()
            client.wait()
            print(f"client killed at {results_in(plan)} results", flush=True)
            cluster.restart_controller()
            print(f"controller restarted at {results_in(plan)} results", flush=True)
            client = subprocess.Popen(submit, env=cluster.env)
            cluster.start_node("n2")
        status = client.wait(timeout=PATIENCE_S)
        print(f"submit: status {status}, {time.monotonic() - began:.1f} s", flush=True)
        if status != 0:
            sys.exit(f"navcal fleet submit ended with {status}; see {folder}")
    finally:
        cluster.stop()
    fleet("run", serial, "--task", f"1-{count + 1}", stderr=subprocess.DEVNULL)
    for each in (plan, serial):
        fleet("merge", each, "-o", each / "merged.sqlite")
    if (plan / "merged.sqlite").read_bytes() != (serial / "merged.sqlite").read_bytes():
        sys.exit(f"the results differ from those of a serial run; see {folder}")
    print(f"{count + 1} tasks, one of them poisoned: equal to a serial run, byte for byte")
    if "--keep" in sys.argv:
        print(folder)
    else:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
