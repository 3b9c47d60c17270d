# SPDX-License-Identifier: BSD-3-Clause
"""A Slurm of two nodes on this host, for tests: it is started and stopped here, and nothing of it is left."""
import collections
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel")
PATIENCE = 60  # s

Task = collections.namedtuple("Task", "process starter job node")  # process ids of the program and of its slurmstepd

# cred_expire is also how long a requeued task waits before it starts again, s; Slurm's default is 120. A node whose daemon
# is silent for SlurmdTimeout, s, counts as lost, and its tasks are requeued; the default is 300.
CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=10
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
SlurmctldPort={port}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdTimeout=10
MaxArraySize=101
KillWait=5
MinJobAge=300
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{first}-{last}] CPUs=1 State=UNKNOWN
PartitionName=main Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """The reason for which no Slurm can be started here; empty if one can."""
    missing = [name for name in PROGRAMS if not shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")]
    if missing:
        return "not installed: " + ", ".join(missing)
    if os.geteuid() != 0:
        return "it needs root"
    if not os.path.isdir("/sys/devices/system/node") and not os.path.isdir("/sys/devices"):
        return "there is no /sys"
    if not [name for _, name in socket.if_nameindex() if name != "lo"]:
        return "there is no network interface besides loopback"
    return ""


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.daemons = {}
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(parents=True)
        (self.folder / "munge").chmod(0o755)
        key = self.folder / "munge/key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        first = 16800 + os.getpid() % 2000
        self.configuration = self.folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.folder,
                                                           port=first + 2, first=first, last=first + 1), encoding="utf-8")
        self.environment = {**os.environ, "SLURM_CONF": str(self.configuration), "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        self.start("munged", "munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge/socket",
                   f"--pid-file={self.folder}/munge/pid", f"--log-file={self.folder}/munge/log",
                   f"--seed-file={self.folder}/munge/seed")
        self.wait(lambda: (self.folder / "munge/socket").exists(), "munged")
        self.start("slurmctld", "slurmctld", "-D", "-i")
        for node in ("n1", "n2"):
            self.start_node(node)
        self.wait(lambda: self.call("sinfo", "-h", "-o", "%D %t").stdout.split() == ["2", "idle"], "idle nodes")

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as log:
            self.daemons[name] = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def start_node(self, node):
        self.start(node, "slurmd", "-D", "-N", node)

    def kill_node(self, node, with_tasks=False):
        """Kills a node's daemon and, as when a machine breaks down, all that it has started."""
        self.daemons[node].kill()
        self.daemons[node].wait()
        for task in self.tasks(node) if with_tasks else []:
            for process in (task.starter, task.process):
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass  # it has just ended

    def wait_for_loss(self, node):
        """Waits until Slurm counts the node as lost and has requeued its tasks."""
        self.wait(lambda: self.call("sinfo", "-h", "-n", node, "-o", "%t").stdout.startswith("down"), f"the loss of {node}")

    def tasks(self, node=None):
        """The programs, not their scripts, that run in job arrays of this cluster, or on one node of it."""
        found = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                entries = (folder / "environ").read_bytes().split(b"\0")
                variables = dict(entry.decode(errors="replace").split("=", 1) for entry in entries if b"=" in entry)
                words = (folder / "cmdline").read_bytes().split(b"\0")
                parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            except (OSError, IndexError):
                continue  # it has just ended
            ours = variables.get("SLURM_CONF") == str(self.configuration) and "SLURM_ARRAY_TASK_ID" in variables
            if ours and b"--shard" in words and node in (None, variables.get("SLURMD_NODENAME")):
                job = f"{variables['SLURM_ARRAY_JOB_ID']}_{variables['SLURM_ARRAY_TASK_ID']}"
                found.append(Task(int(folder.name), parent, job, variables["SLURMD_NODENAME"]))
        return sorted(found)

    def wait_for_task(self, patience=PATIENCE):
        """A task of an array that runs."""
        return self.wait(self.tasks, "a running task", patience)[0]

    def wait(self, ready, what, patience=PATIENCE):
        """What `ready` returns, once that is true."""
        end = time.monotonic() + patience
        while not (found := ready()):
            if time.monotonic() > end:
                logs = "".join(f"{path.name}: {path.read_text(errors='replace')[-800:]}\n" for path in self.folder.glob("*.log"))
                raise AssertionError(f"waited in vain for {what}\n{logs}")
            time.sleep(0.1)
        return found

    def call(self, *command, **settings):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=PATIENCE, **settings)

    def jobs(self):
        return self.call("squeue", "-h", "-o", "%i %t").stdout.split("\n")[:-1]

    def wait_for_jobs(self, patience=PATIENCE):
        self.wait(lambda: not self.jobs(), "the end of all jobs", patience)

    def stop(self):
        self.call("scancel", "--signal=KILL", "--full", "--user=root")
        self.call("scancel", "--user=root")
        for name in reversed(list(self.daemons)):
            daemon = self.daemons[name]
            if daemon.poll() is None:
                daemon.send_signal(signal.SIGTERM)
                try:
                    daemon.wait(10)
                except subprocess.TimeoutExpired:
                    daemon.kill()
                    daemon.wait()
