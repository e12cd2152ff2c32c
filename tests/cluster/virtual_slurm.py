"""A real Slurm of several nodes on this machine alone, in a directory of its own.

munged, slurmctld and one slurmd for each node run in the foreground on the loopback interface, with a key, ports and a
configuration that nobody else has. A Slurm that is installed or runs already is neither asked nor touched.
"""

import os
import pwd
import random
import secrets
import shutil
import socket
import subprocess
import time

from process_tree import Machine, adopt_orphans

PROGRAMS = {
    "munge": ["munged"],
    "slurm-wlm": ["slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel", "sinfo"],
}

CONFIGURATION = """\
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
# A task whose node died starts again when its credential has run out: 5 s is the least, 120 s the default.
AuthInfo=socket={directory}/munge.socket,cred_expire=5
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool-%n
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd-%n.pid
SlurmctldLogFile={directory}/slurmctld.log
SlurmdLogFile={directory}/slurmd-%n.log
PlugStackConfig={directory}/plugstack.conf
MailProg=/bin/true
# A container has neither systemd nor cgroups of its own.
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
MpiDefault=none
SwitchType=switch/none
# The nodes have what stands here, whatever the machine has.
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# Everything is noticed within seconds, so that a test is short.
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=2
SlurmdTimeout=6
MessageTimeout=4
TCPTimeout=1
KillWait=1
ReturnToService=0
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
"""


def find(program):
    """Where `program` is, also where only root's PATH looks; None where it is not."""
    return shutil.which(program, path=os.environ.get("PATH", "") + ":/usr/local/sbin:/usr/sbin:/sbin")


def missing_packages():
    """Debian's packages whose programs are not all here."""
    return [package for package, programs in PROGRAMS.items() if not all(map(find, programs))]


def free_ports(count):
    """Ports of the loopback interface that nothing listens on just now, and that connections are not given meanwhile:
    they are below those that Linux hands out."""
    ports = []
    for port in random.SystemRandom().sample(range(20000, 32000), 2000):
        try:
            socket.create_server(("127.0.0.1", port)).close()
        except OSError:
            continue
        ports.append(port)
        if len(ports) == count:
            return ports
    raise RuntimeError(f"there are no {count} free ports from 20000 to 32000")


class VirtualSlurm:
    """Use as `with VirtualSlurm(directory, ["n1", "n2"]) as slurm:`. Whatever happens inside, nothing runs afterwards.

    Slurm's commands reach it with `slurm.environment` in their environment. A node is a Machine with one core, with its
    slurmd, its steps and its tasks on it.
    """

    def __init__(self, directory, nodes):
        self.directory = os.path.abspath(directory)
        self.nodes = list(nodes)
        self.environment = {"SLURM_CONF": f"{self.directory}/slurm.conf"}
        self.machines = {}  # by name: the nodes, munged and slurmctld

    def __enter__(self):
        adopt_orphans()
        try:
            self._start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def _start(self):
        for name in ["state", *[f"spool-{node}" for node in self.nodes]]:
            os.makedirs(f"{self.directory}/{name}")
        ports = free_ports(1 + len(self.nodes))
        nodes = [
            f"NodeName={name} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs=1 RealMemory=4096 State=UNKNOWN"
            for name, port in zip(self.nodes, ports[1:])
        ]
        configuration = CONFIGURATION.format(
            host=socket.gethostname().split(".")[0],
            user=pwd.getpwuid(os.getuid()).pw_name,
            directory=self.directory,
            controller_port=ports[0],
            nodes="\n".join(nodes),
        )
        for name, text in [("slurm.conf", configuration), ("plugstack.conf", ""), ("cgroup.conf", "")]:
            with open(f"{self.directory}/{name}", "w", encoding="utf-8") as file:
                file.write(text)
        key = f"{self.directory}/munge.key"
        with open(os.open(key, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(secrets.token_bytes(128))

        self._boot(
            "munged",
            # --force: it may be root, below a directory that others may write, as /tmp is.
            "--foreground", "--force", f"--socket={self.directory}/munge.socket", f"--key-file={key}",
            f"--pid-file={self.directory}/munged.pid", f"--seed-file={self.directory}/munged.seed",
            f"--log-file={self.directory}/munged.log",
        )  # fmt: skip
        self.until("munged listens", lambda: os.path.exists(f"{self.directory}/munge.socket"))
        self._boot("slurmctld", "-D", "-i")
        self.until("slurmctld answers", lambda: self.run("scontrol", "ping").returncode == 0)
        for name in self.nodes:
            self._boot("slurmd", "-D", "-N", name, name=name)
        self.until("all nodes are idle", lambda: set(self.states().values()) == {"idle"})

    def _boot(self, program, *arguments, name=None):
        name = name or program
        self.machines[name] = Machine(
            [find(program), *arguments], {**os.environ, **self.environment}, f"{self.directory}/{name}.out"
        )

    def until(self, what, is_so, seconds=30):
        """Waits until is_so(); raises RuntimeError when a daemon ends, or it lasts too long."""
        end = time.monotonic() + seconds
        while not is_so():
            ended = [name for name, machine in self.machines.items() if machine.ended() is not None]
            if ended or time.monotonic() > end:
                trouble = f"{ended[0]} has ended" if ended else f"after {seconds} s it is not so that {what}"
                raise RuntimeError(f"{trouble}\n{self.logs()}")
            time.sleep(0.05)

    def logs(self, lines=20):
        """The ends of what the daemons said, for a message about what went wrong."""
        text = ""
        for name in sorted(self.machines):
            with open(f"{self.directory}/{name}.out", encoding="utf-8", errors="replace") as file:
                text += f"--- {name}\n{''.join(file.readlines()[-lines:])}"
        return text

    def run(self, program, *arguments):
        """Runs one of Slurm's commands against this Slurm."""
        return subprocess.run(
            [find(program), *arguments], env={**os.environ, **self.environment}, check=False, text=True,
            capture_output=True, timeout=60,
        )  # fmt: skip

    def states(self):
        """What Slurm says of each node: "idle", "mixed", "allocated", "down*" and so on."""
        lines = self.run("sinfo", "-h", "-N", "-o", "%N %T").stdout.split("\n")
        return dict(line.split() for line in lines if line)

    def stop(self):
        """Ends everything that was started, and everything that this has started."""
        for name in reversed(list(self.machines)):
            self.machines.pop(name).pull_the_plug()
