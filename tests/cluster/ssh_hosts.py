"""Hosts to log in to on this machine alone: by an ssh server for each where sshd is installed, else by a command that
stands in for ssh.

Either way `PARALLEL_SSH` is set in `hosts.environment` to what GNU parallel must log in with, and a host can be killed with
all that runs on it; logging in to it fails from then on.
"""

import os
import pwd
import shlex
import subprocess
import time

from process_tree import Machine, adopt_orphans, descendants, kill_below
from virtual_slurm import find, free_ports

SERVER = """\
ListenAddress 127.0.0.1
Port {port}
HostKey {directory}/host_key
AuthorizedKeysFile {directory}/user_key.pub
PidFile none
PasswordAuthentication no
KbdInteractiveAuthentication no
PermitRootLogin prohibit-password
StrictModes no
UsePAM no
MaxStartups 100
"""

CLIENT = """\
Host {name}
    HostName 127.0.0.1
    Port {port}
    User {user}
    IdentityFile {directory}/user_key
    IdentitiesOnly yes
    IdentityAgent none
    BatchMode yes
    ConnectTimeout 10
    StrictHostKeyChecking no
    UserKnownHostsFile /dev/null
    LogLevel ERROR
"""

# As sshd does it: a shell of its own, from the home directory, with nothing of the caller's environment.
STAND_IN = """\
#!/bin/sh
while :; do
    case $1 in
    -l) shift 2 ;;
    -*) shift ;;
    *) break ;;
    esac
done
host=$1
shift
[ "$1" != -- ] || shift
[ -e "{directory}/$host.up" ] || {{ echo "ssh: $host does not answer" >&2; exit 255; }}
cd || exit 255
exec env -i HOME="$HOME" PATH="$PATH" SHELL=/bin/sh STAND_IN_HOST="$host" /bin/sh -c "$*"
"""


def have_sshd():
    """Whether ssh servers can be started: sshd needs root to log anybody in, and a user of its own."""
    if not (find("sshd") and find("ssh") and find("ssh-keygen")) or os.getuid() != 0:
        return False
    try:
        pwd.getpwnam("sshd")
    except KeyError:
        return False
    return True


class SshHosts:
    """Use as `with SshHosts(directory, ["alpha", "beta"]) as hosts:`. Nothing runs afterwards."""

    def __init__(self, directory, names):
        self.directory = os.path.abspath(directory)
        self.names = list(names)
        self.real = have_sshd()
        self.environment = {}
        self._machines = {}

    def __enter__(self):
        adopt_orphans()
        os.makedirs(self.directory)
        try:
            if self.real:
                self._start()
            else:
                self._stand_in()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def _start(self):
        os.makedirs("/run/sshd", mode=0o755, exist_ok=True)  # where sshd locks itself in; made when its service starts
        for key in ["host_key", "user_key"]:
            subprocess.run(
                [find("ssh-keygen"), "-q", "-t", "ed25519", "-N", "", "-f", f"{self.directory}/{key}"], check=True
            )
        user = pwd.getpwuid(os.getuid()).pw_name
        for name, port in zip(self.names, free_ports(len(self.names))):
            values = {"name": name, "port": port, "user": user, "directory": self.directory}
            with open(f"{self.directory}/{name}.sshd", "w", encoding="utf-8") as file:
                file.write(SERVER.format(**values))
            with open(f"{self.directory}/config", "a", encoding="utf-8") as file:
                file.write(CLIENT.format(**values))
            self._machines[name] = Machine(
                [find("sshd"), "-D", "-e", "-f", f"{self.directory}/{name}.sshd"], os.environ,
                f"{self.directory}/{name}.out",
            )  # fmt: skip
        login = [find("ssh"), "-F", f"{self.directory}/config"]
        self.environment["PARALLEL_SSH"] = shlex.join(login)
        for name in self.names:
            end = time.monotonic() + 10
            while (answer := subprocess.run([*login, name, "true"], check=False, capture_output=True)).returncode != 0:
                if time.monotonic() > end or self._machines[name].ended() is not None:
                    with open(f"{self.directory}/{name}.out", encoding="utf-8") as file:
                        raise RuntimeError(f"sshd does not answer: {answer.stderr.decode()}\n{file.read()}")
                time.sleep(0.05)

    def _stand_in(self):
        for name in self.names:
            with open(f"{self.directory}/{name}.up", "w", encoding="utf-8"):
                pass
        with open(f"{self.directory}/ssh", "w", encoding="utf-8") as file:
            file.write(STAND_IN.format(directory=self.directory))
        os.chmod(f"{self.directory}/ssh", 0o755)
        self.environment["PARALLEL_SSH"] = f"{self.directory}/ssh"

    def processes(self, name):
        """What runs on the host, as (pid, name)."""
        if self.real:
            return self._machines[name].processes()
        return [process for process in descendants(os.getpid()) if _is_on(process[0], name)]

    def kill(self, name):
        """kill -9 for everything on the host. Returns what was killed as {pid: name}."""
        if self.real:
            return self._machines.pop(name).pull_the_plug()
        os.unlink(f"{self.directory}/{name}.up")
        killed = {}
        for pid, command in self.processes(name):
            killed.update(kill_below(pid))
            try:
                os.kill(pid, 9)
                killed[pid] = command
            except ProcessLookupError:
                pass
        return killed

    def stop(self):
        """Ends all hosts."""
        for name in list(self._machines):
            self._machines.pop(name).pull_the_plug()


def _is_on(pid, host):
    try:
        with open(f"/proc/{pid}/environ", "rb") as file:
            return f"STAND_IN_HOST={host}".encode() in file.read().split(b"\0")
    except OSError:
        return False
